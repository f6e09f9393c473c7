#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/run/engine_grid.h"
#include "harness/run/scene_run.h"
#include "studies/stability/outcome.h"

namespace slipcheck {

/// How far something works, found by bisection.
struct Limit {
  enum class Kind {
    stable_step,    ///< largest step that is not worse than degraded [s]
    accurate_step,  ///< largest step that is accurate [s]
    length_scale,   ///< smallest factor on all lengths that is accurate [-]
    mass_ratio,     ///< largest ratio of masses that is accurate [-]
  };
  Kind kind = Kind::stable_step;
  std::string method;                       ///< "bullet" or "fixed-step"
  std::string version, precision, profile;  ///< of an engine
  std::string scene;                        ///< name of the scene that is varied
  /// The last good value of the good region and the first bad one beyond it (LimitSearch). Where
  /// all of the range is good `bad` is missing; where none is, `good`, and `bad` is at the good
  /// end.
  std::optional<double> good, bad;
  double low = 0, high = 0;            ///< the range that was searched
  Outcome beyond = Outcome::accurate;  ///< how it comes out at `bad`
  std::string why;                     ///< at `bad`
  std::vector<double> islands;         ///< values on the good side that are bad all the same
  std::vector<double> strays;          ///< values beyond `bad` that are good all the same
  std::optional<double> theory;        ///< what it should be, in the same unit
  std::string theory_name;             ///< "2/ω0", "2 (√(1 + ε²) − ε)/ω0"
  std::string reason;                  ///< why there is no answer

  /// Geometric mean of good and bad; NaN without both.
  double value() const;
};
template <>
inline constexpr std::array kNamesOf<Limit::Kind> = {"stable_step", "accurate_step", "length_scale",
                                                     "mass_ratio"};

/// How it comes out over two parameters.
struct OutcomeMap {
  std::string name;   ///< of its files, "speed-restitution-bullet-double-tuned"
  std::string title;  ///< "bullet double tuned at 240 Hz"
  std::string method, precision, profile;
  struct Axis {
    std::string label;  ///< with its unit, "speed [m/s]"
    bool logarithmic = false;
    std::vector<double> values;  ///< rising
  };
  Axis x, y;
  /// At y.values[r] and x.values[c]: [r * x.values.size() + c].
  std::vector<Outcome> outcome;
  std::vector<double> worst_error;  ///< in the unit of `error_label`; NaN where there is none
  std::string error_label;          ///< "|e − e_ref|"
  std::vector<std::pair<double, double>> theory;  ///< a line (x, y) where theory knows a border
  std::string theory_name;
};

struct LimitGrid {
  EngineGrid engines;
  double ratio = 1.01;       ///< bad/good at which a bisection ends, > 1
  double per_decade = 3;     ///< values of the scan before it in a factor of ten, > 0
  double least_step = 1e-5;  ///< of engines [s], in (0, 1)
  std::size_t cells = 12;    ///< of a map along each axis, >= 2
  OutcomeCriteria criteria;
};

struct LimitResults {
  std::vector<Limit> limits;
  std::vector<OutcomeMap> maps;
};

/// Limits and maps of every engine of the grid and of the reference's fixed-step solver, on the
/// scenes that docs/stability.md names. Maps of engines are of double precision alone unless the
/// grid names precisions.
///
/// Whatever an engine does in a trial, the search goes on: that value is bad for its reason. Once
/// interrupted, limits that are not yet found have the reason "interrupted", and maps that are not
/// complete are left out. Throws BadScenario as requested_runs().
LimitResults find_limits(const LimitGrid& grid, const RunOptions& options);

}  // namespace slipcheck
