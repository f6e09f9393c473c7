#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "harness/observe/motion.h"
#include "harness/run/reference_run.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// How far the headings of one phase are apart in an observable: of a law that knows no direction
/// not at all.
struct HeadingSpread {
  double spread = 0;  ///< largest less smallest value over the headings, in the observable's unit
  std::size_t phase = 0;  ///< in which they are the farthest apart
};

/// One observable over the phases of an engine's ensemble, and over its headings.
struct EnsembleValue {
  double median = 0, min = 0, max = 0;
  std::vector<double> values;  ///< by heading, then phase; NaN where a run has none
  std::size_t missing = 0;     ///< how many phases have none; median, min, max are of the others
  std::optional<HeadingSpread> headings =
      std::nullopt;  ///< where two headings or more show it in some phase
};

/// What a comparison comes to, from the best to the worst. unjudged: no tolerance asks for it.
/// undecided: one does, but nothing can be judged by it, as the reference does not show the
/// observable, did not end or is less certain than that, or the run was skipped.
enum class Verdict { unjudged, within, undecided, deviates, failed };
template <>
inline constexpr std::array kNamesOf<Verdict> = {"not judged", "within", "undecided", "deviates",
                                                 "failed"};

/// An observable's deviation from the reference: relative, absolute for restitution coefficients
/// and where the tolerance has a unit; of a vector relative to the reference's length. NaN with a
/// reason where it is undefined.
struct Deviation {
  double median = 0;  ///< of the absolute deviations over the phases
  double max = 0;
  std::optional<double> tolerance;
  bool absolute = false;
  Verdict verdict = Verdict::unjudged;  ///< not failed
  std::string reason;
  double rms = 0;  ///< root of the mean square of the absolute deviations
  /// Zero in the reference and, as far as that knows, in every phase: no relative error.
  bool is_zero = false;
};

/// How a statistic of an ensemble stands to what is expected of it.
struct ExpectationResult {
  enum class Statistic { min, median, max, none };

  std::string observable;
  Statistic statistic = Statistic::none;  ///< none: no phase is to show the observable
  double low = 0, high = 0;               ///< where the value is expected [SI]; 0 of `none`
  double value = 0;  ///< [SI], of `none` the median of the phases that show it; NaN if none does
  bool met = false;
  std::string reason;  ///< why there is no value, or which phases are missing
};
template <>
inline constexpr std::array kNamesOf<ExpectationResult::Statistic> = {"min", "median", "max",
                                                                      "none"};

/// One engine at one rate on one scene.
struct EngineRecord {
  using Status = RunStatus;

  std::string engine, version, precision;
  std::string profile;  ///< as the scenario names it: a name or a path
  Settings settings;    ///< that the profile chooses
  double rate = 0;      ///< [Hz]
  /// Lengths of the similar scene that the engine ran over those of the scene, > 0; its own steps
  /// are √scale/rate. What it showed there is told in the scene's own lengths, times and masses.
  double scale = 1;
  std::size_t headings = 1;  ///< in which each phase was run, >= 1
  Status status = Status::skipped;
  std::string reason;      ///< why not ok
  double cpu_seconds = 0;  ///< of the stepping alone, all phases
  std::size_t steps = 0;   ///< of all phases
  std::size_t phases = 0;  ///< in each heading
  std::map<std::string, EnsembleValue> observables;
  std::map<std::string, Deviation> errors;
  std::optional<Assembly> assembly;  ///< of a run that was looked at as a whole alone
  Applied applied;
  std::vector<std::string> warnings;
  std::optional<Expectation> expect;  ///< judges the run in place of the tolerances
  /// Where motion is recorded, the phases nearest to the reference, in the middle and worst.
  std::vector<RecordedMotion> motions;

  /// "240 Hz", with its scale where that is not 1: "240 Hz, scale 0.01".
  std::string rate_text() const;
  /// Of each statistic that is expected, in the order of names, then min, median, max.
  std::vector<ExpectationResult> expectations() const;
  /// Whether it does what is expected or, where nothing is, the worst of its errors; undecided
  /// where it was skipped.
  Verdict verdict() const;
};

/// A scene with all that was found out about it.
struct SceneRecord {
  Scenario scenario;
  /// In numbers, as the reference solves it; none where this version has no solver for it.
  std::shared_ptr<const ContactScene> scene;
  ReferenceResult reference;
  std::vector<EngineRecord> runs;

  /// The worst of its runs, undecided where the reference came to no end; unjudged without engines.
  Verdict verdict() const;
};

/// What SceneRecord::scene is.
std::shared_ptr<const ContactScene> solved_scene(const Scenario& scenario);

}  // namespace slipcheck
