#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "harness/compare/record.h"
#include "harness/run/prepared_scene.h"
#include "harness/run/scene_run.h"
#include "studies/stability/limit_search.h"
#include "studies/stability/limits.h"

namespace slipcheck {

/// A variation of a scene with its reference, or why it has none.
struct VariedScene {
  std::optional<PreparedScene> prepared;
  std::string why;
};

/// Variations of scenes, each solved once; their places do not change.
class VariedScenes {
 public:
  /// The scene that `make` gives, known as the variation of the scene `name` by `value`.
  const VariedScene& get(const std::string& name, double value,
                         const std::function<Scenario()>& make);

 private:
  std::map<std::pair<std::string, double>, VariedScene> scenes_;
};

/// How an ensemble came out.
struct EnsembleTrial {
  Outcome outcome = Outcome::refused;  ///< the worst of the phases
  std::string why;
  double restitution_error = kNotObserved;  ///< largest |e_n − e_ref| of any pair
  std::string version;                      ///< of the engine, where it ran
};

/// An engine's ensemble that is to be run.
struct EnsembleRequest {
  const VariedScene* scene = nullptr;
  const EngineRecord* method = nullptr;  ///< engine, precision, profile and settings
  double step = 0;                       ///< [s], > 0
};

/// The engines of the grid with the profiles' settings, each a record without a rate; those that
/// cannot run have their reason. Throws as requested_runs().
std::vector<EngineRecord> methods_of(const EngineGrid& grid, const RunOptions& options);

/// Runs engines' ensembles, each once however often it is asked for.
class EnsembleTrials {
 public:
  /// `options` is copied but for what it points to.
  EnsembleTrials(const OutcomeCriteria& criteria, const RunOptions& options)
      : criteria_(criteria), options_(options) {}

  /// The outcomes in the order of the requests. Once interrupted they mean nothing.
  std::vector<EnsembleTrial> make(std::span<const EnsembleRequest> requests);
  bool is_interrupted() const { return options_.stop && *options_.stop; }
  /// For the progress: how many ensembles may still come, and how many after these.
  void expect(std::size_t more) { expected_ = done_ + more + later_; }
  void expect_later(std::size_t more) { later_ = more; }

 private:
  using Key = std::tuple<const VariedScene*, const EngineRecord*, double>;

  OutcomeCriteria criteria_;
  RunOptions options_;
  std::map<Key, EnsembleTrial> known_;
  std::size_t expected_ = 0, done_ = 0, later_ = 0;
};

/// What the search has found, or why it has no answer; a search that is not done was interrupted.
void fill_in(Limit& limit, const LimitSearch& search);

/// Largest absolute deviation of a pair's normal restitution; NaN where there is none.
double restitution_error(const std::map<std::string, Deviation>& errors);

}  // namespace slipcheck
