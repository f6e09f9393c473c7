#include "studies/stability/outcome_watch.h"

#include <utility>

#include "harness/run/engine_state.h"

namespace slipcheck {
namespace {

bool is_finite(const Frame& frame) {
  for (const BodyState& s : frame.bodies)
    if (!s.position.allFinite() || !s.velocity.allFinite() || !s.angular_velocity.allFinite())
      return false;
  return true;
}

}  // namespace

OutcomeWatch::OutcomeWatch(const ReferencePath& path, const OutcomeCriteria& criteria, double step,
                           bool soft)
    : path_(&path),
      criteria_(criteria),
      passage_(path),
      energy_(path, criteria, step, soft),
      rest_(path, criteria) {}

void OutcomeWatch::begin(double time, std::span<const BodyState> states) {
  if (running_) done_.push_back(described());
  running_ = true;
  time_ = time;
  lost_ = {};
  passage_.begin(states);
  energy_.begin(time, states);
  rest_.begin(time, states);
}

void OutcomeWatch::take(double time, const Frame& frame) {
  time_ = time;
  if (!is_finite(frame)) {
    note(Outcome::not_finite, time,
         fault_of_state(frame, time, path_->fastest(time), criteria_.exploded));
    return;
  }
  if (lost_.outcome >= Outcome::exploded) return;
  std::string blown = fault_of_state(frame, time, path_->fastest(time), criteria_.exploded);
  if (!blown.empty()) note(Outcome::exploded, time, std::move(blown));
  if (lost_.outcome >= Outcome::tunnelled) return;
  std::string passed = passage_.take(frame.bodies);
  if (!passed.empty()) note(Outcome::tunnelled, time, std::move(passed));
  energy_.take(time, frame);
  rest_.take(time, frame.bodies);
}

void OutcomeWatch::note(Outcome outcome, double time, std::string why) {
  if (lost_.outcome < outcome) lost_ = {outcome, std::move(why), time};
}

bool OutcomeWatch::wants_more() const {
  return lost_.outcome == Outcome::accurate && time_ < path_->end();
}

WatchedPhase OutcomeWatch::described() const {
  WatchedPhase phase;
  phase.end = time_;
  phase.energy_gain = energy_.gain();
  phase.creep = rest_.creep();
  phase.depth = passage_.depth();
  phase.outcome = lost_;
  for (const PhaseOutcome& found : {energy_.outcome(), rest_.outcome()})
    if (found.outcome > phase.outcome.outcome) phase.outcome = found;
  return phase;
}

std::vector<WatchedPhase> OutcomeWatch::phases() const {
  std::vector<WatchedPhase> phases = done_;
  if (running_) phases.push_back(described());
  return phases;
}

}  // namespace slipcheck
