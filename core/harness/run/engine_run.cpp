#include "harness/run/engine_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/stop_scope.h"
#include "harness/compare/comparison.h"
#include "harness/run/phase_run.h"
#include "harness/run/phases.h"

namespace slipcheck {
namespace {

/// When the phases of an ensemble start [s]: they differ in where in a step the first contact
/// falls, in a box in where in the floor's period the first step does.
std::vector<double> starts_of(const EnsembleTask& task, double step) {
  const bool boxed = task.solver->scene().hard.box.has_value();
  return phase_starts(boxed ? step : task.reference->first_contact, step, task.phases);
}

/// Few enough steps for little waste after the end, many enough for few messages.
std::size_t steps_at_once(double expected_time, double step) {
  return static_cast<std::size_t>(std::clamp(expected_time / step / 16, 16.0, 4096.0));
}

}  // namespace

std::vector<PhaseShare> phase_shares(std::size_t phases, std::size_t count) {
  std::vector<PhaseShare> shares(std::clamp<std::size_t>(count, 1, phases));
  for (std::size_t k = 0; k < shares.size(); ++k) {
    shares[k].first = phases * k / shares.size();
    shares[k].last = phases * (k + 1) / shares.size();
  }
  return shares;
}

void run_phases(RemoteEngine& engine, const EnsembleTask& task, const EngineRecord& record,
                PhaseShare& share) {
  const double step = 1 / record.rate;
  share.version = engine.info().version;
  share.applied = engine.configure(EngineScene(task.solver->scene()), record.settings, step);

  const std::vector<double> starts = starts_of(task, step);
  const std::size_t chunk = steps_at_once(task.reference->run.end_time, step);
  try {
    for (std::size_t p = share.first; p < std::min(share.last, starts.size()); ++p) {
      const StopScope limit(task.time_limit);
      const std::vector<BodyState> states = task.solver->states_at(starts[p]);
      const std::unique_ptr<PhaseRun> run = make_phase_run(task, step, starts[p], states);
      engine.start(states, starts[p]);
      while (!run->ended() || run->wants_more()) {
        share.cpu_seconds += engine.advance(chunk, [&](const Frame& frame) { run->take(frame); });
        share.steps += chunk;
      }
      if (!run->reached()) ++share.unfinished;
      share.seen.push_back(run->values());
    }
  } catch (const Unstable& unstable) {
    share.unstable = unstable.reason;
  }
}

void finish_ensemble(const EnsembleTask& task, const std::vector<PhaseShare>& shares,
                     EngineRecord& record) {
  const double step = 1 / record.rate, first_contact = task.reference->first_contact;
  const std::size_t phases = starts_of(task, step).size();
  std::vector<std::map<std::string, double>> seen;
  std::size_t unfinished = 0;
  record.version = shares.front().version;
  record.applied = shares.front().applied;
  for (const PhaseShare& share : shares) {
    record.cpu_seconds += share.cpu_seconds;
    record.steps += share.steps;
    unfinished += share.unfinished;
    seen.insert(seen.end(), share.seen.begin(), share.seen.end());
    record.phases = seen.size();
    if (!share.unstable.empty()) {
      record.status = EngineRecord::Status::unstable;
      record.reason = share.unstable;
      return;
    }
    if (seen.size() < std::min(share.last, phases)) return;  // the worker failed
  }
  record.status = EngineRecord::Status::ok;
  record.observables = ensemble_values(seen);
  record.errors = deviations(*task.scenario, *task.reference, record.observables);
  if (unfinished > 0)
    record.warnings.push_back(fmt::format("{} of {} phases had not ended at the limit of {} s",
                                          unfinished, seen.size(), task.scenario->run.limit));
  if (first_contact == 0)
    record.warnings.push_back("the first contact is there from the start: it has one phase only");
  else if (std::isfinite(first_contact) && first_contact < step)
    record.warnings.push_back(
        "the first contact falls inside the first step: its phases cover a part of a step only");
}

}  // namespace slipcheck
