#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/observe/phase_watch.h"
#include "studies/stability/body_passage.h"
#include "studies/stability/energy_watch.h"
#include "studies/stability/outcome.h"
#include "studies/stability/reference_path.h"
#include "studies/stability/rest_watch.h"

namespace slipcheck {

/// One run as far as its frames tell: `accurate` where nothing was found. What its observables are
/// worth is compared afterwards (phase_comparison.h).
struct WatchedPhase {
  PhaseOutcome outcome;
  double end = 0;          ///< time of its last frame [s]
  double energy_gain = 0;  ///< beyond the reference's largest rise, over the energy scale [-], >= 0
  double creep = 0;        ///< largest, over the radius [-], >= 0
  double depth = 0;        ///< deepest overlap beyond the reference's, over the smaller radius [-]
};

/// Classes runs of one method on one scene by their frames, one after the other, while they go on;
/// docs/stability.md gives the criteria with their reasons. It needs no engine: begin() and take()
/// may be fed by any method.
class OutcomeWatch final : public PhaseWatch {
 public:
  /// `path` must outlive this. step [s], > 0, of the method. `soft`: the method has the scene's
  /// soft contacts, so that their elastic energy is its own; engines have hard ones.
  OutcomeWatch(const ReferencePath& path, const OutcomeCriteria& criteria, double step,
               bool soft = false);

  void begin(double time, std::span<const BodyState> states) override;
  void take(double time, const Frame& frame) override;
  /// To the end of the reference's run, unless a body was lost.
  bool wants_more() const override;

  /// Every run that began, the last one as far as it came.
  std::vector<WatchedPhase> phases() const;

 private:
  WatchedPhase described() const;
  void note(Outcome outcome, double time, std::string why);

  const ReferencePath* path_;
  OutcomeCriteria criteria_;
  BodyPassage passage_;
  EnergyWatch energy_;
  RestWatch rest_;
  std::vector<WatchedPhase> done_;
  bool running_ = false;
  double time_ = 0;
  PhaseOutcome lost_;  ///< tunnelled or worse, where the run is
};

}  // namespace slipcheck
