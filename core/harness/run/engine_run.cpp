#include "harness/run/engine_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "base/stop_scope.h"
#include "harness/compare/comparison.h"
#include "harness/run/phase_run.h"
#include "harness/run/phases.h"
#include "scene/similarity.h"

namespace slipcheck {
namespace {

/// When the phases of an ensemble start [s]: they differ in where in a step the first contact
/// falls, in a box in where in the floor's period the first step does.
std::vector<double> starts_of(const EnsembleTask& task, double step) {
  const bool boxed = task.solver->scene().hard.box.has_value();
  return phase_starts(boxed ? step : task.reference->first_contact, step, task.phases);
}

/// The first of every `stride`.
std::size_t counted(std::size_t phases, std::size_t stride) {
  return (phases + stride - 1) / stride;
}

/// With which stride runs of `each` [s] in so many phases and headings keep within a budget [s].
std::size_t stride_within(double budget, double each, std::size_t phases, std::size_t headings) {
  std::size_t stride = 1;
  while (counted(phases, stride) > 2 &&
         each * static_cast<double>(counted(phases, stride) * headings) > budget)
    ++stride;
  return stride;
}

/// How many steps are asked for at once: most of those that the reference lets expect with the
/// first message, as a message costs as much as many steps, and then few, for little waste after
/// the end.
class Chunks {
 public:
  Chunks(double expected_time, double step)
      : first_(whole(expected_time / step * 7 / 8)), next_(whole(expected_time / step / 16)) {}

  /// `taken`: steps of the run so far.
  std::size_t after(std::size_t taken) const { return taken < first_ ? first_ : next_; }

 private:
  static std::size_t whole(double steps) {
    return static_cast<std::size_t>(std::clamp(steps, 16.0, 4096.0));
  }
  std::size_t first_, next_;
};

std::vector<BodyState> similar_states(std::vector<BodyState> states, const Similarity& similarity) {
  for (BodyState& state : states) state = similarity.of(state);
  return states;
}

/// What lasts between bodies knows no heading.
EngineScene in_heading(EngineScene scene, const Vector2& heading) {
  static_cast<Scene&>(scene) = turned(scene, heading);
  return scene;
}

/// Shows a run a frame of the similar scene as one of the scene.
void show(const Frame& frame, const Similarity& similarity, PhaseRun& run) {
  if (similarity.is_identity()) return run.take(frame);
  Frame seen = frame;
  similarity.take_back(seen);
  run.take(seen);
}

}  // namespace

std::size_t phase_count(const EnsembleTask& task, double rate, std::size_t stride) {
  return counted(starts_of(task, 1 / rate).size(), stride);
}

std::vector<PhaseShare> phase_shares(std::size_t runs, std::size_t count) {
  std::vector<PhaseShare> shares(std::clamp<std::size_t>(count, 1, runs));
  for (std::size_t k = 0; k < shares.size(); ++k) {
    shares[k].first = runs * k / shares.size();
    shares[k].last = runs * (k + 1) / shares.size();
  }
  return shares;
}

void run_phases(RemoteEngine& engine, const EnsembleTask& task, const EngineRecord& record,
                PhaseShare& share) {
  const double step = 1 / record.rate;
  const EngineScene scene(task.scaled ? *task.scaled : task.solver->scene());
  share.version = engine.info().version;

  const std::vector<double> starts = starts_of(task, step);
  const Chunks chunks(task.reference->run.end_time, step);
  Similarity similarity{record.scale};
  std::optional<std::size_t> configured;  // for this heading
  try {
    for (std::size_t k = share.first; k < std::min(share.last, starts.size() * record.headings);
         ++k) {
      if (k % starts.size() % share.stride != 0) continue;
      const double start = starts[k % starts.size()];
      const std::size_t heading = k / starts.size();
      if (configured != heading) {
        configured = heading;
        similarity.heading = even_heading(heading, record.headings);
        share.applied =
            engine.configure(heading == 0 ? scene : in_heading(scene, similarity.heading),
                             record.settings, step * similarity.time());
      }
      const StopScope limit(task.time_limit);
      const std::vector<BodyState> states = task.solver->states_at(start);
      const std::unique_ptr<PhaseRun> run = make_phase_run(task, step, start, states);
      engine.start(similar_states(states, similarity), start * similarity.time());
      std::size_t taken = 0;
      while (!run->ended() || run->wants_more()) {
        const std::size_t chunk = chunks.after(taken);
        share.cpu_seconds +=
            engine.advance(chunk, [&](const Frame& frame) { show(frame, similarity, *run); });
        taken += chunk;
      }
      share.steps += taken;
      if (!run->reached()) ++share.unfinished;
      share.seen.push_back(run->values());
      if (k == 0)
        share.stride =
            stride_within(task.budget, share.cpu_seconds, starts.size(), record.headings);
    }
  } catch (const Unstable& unstable) {
    share.unstable = unstable.reason;
  }
}

std::size_t finish_ensemble(const EnsembleTask& task, const std::vector<PhaseShare>& shares,
                            EngineRecord& record) {
  const double step = 1 / record.rate, first_contact = task.reference->first_contact;
  const std::size_t stride = shares.front().stride;
  const std::size_t phases = phase_count(task, record.rate, stride);
  const std::size_t runs = phases * record.headings;
  std::vector<std::map<std::string, double>> seen;
  std::size_t unfinished = 0;
  record.version = shares.front().version;
  record.applied = shares.front().applied;
  for (const PhaseShare& share : shares) {
    record.cpu_seconds += share.cpu_seconds;
    record.steps += share.steps;
    unfinished += share.unfinished;
    seen.insert(seen.end(), share.seen.begin(), share.seen.end());
    record.phases = std::min(seen.size(), phases);
    if (!share.unstable.empty()) {
      record.status = EngineRecord::Status::unstable;
      record.reason = share.unstable;
      return seen.size();
    }
    if (seen.size() < std::min(share.last, runs)) return seen.size();  // the worker failed
  }
  record.status = EngineRecord::Status::ok;
  record.observables = ensemble_values(seen);
  note_heading_spreads(record.observables, record.headings);
  record.errors = deviations(*task.scenario, *task.reference, record.observables);
  if (unfinished > 0)
    record.warnings.push_back(
        fmt::format("{} of {} {} had not ended at the limit of {} s", unfinished, seen.size(),
                    record.headings > 1 ? "runs" : "phases", task.scenario->run.limit));
  if (stride > 1)
    record.warnings.push_back(
        fmt::format("{} of {} phases: more take longer than {:g} CPU seconds (--budget)", phases,
                    phase_count(task, record.rate, 1), task.budget));
  if (first_contact == 0)
    record.warnings.push_back("the first contact is there from the start: it has one phase only");
  else if (std::isfinite(first_contact) && first_contact < step)
    record.warnings.push_back(
        "the first contact falls inside the first step: its phases cover a part of a step only");
  return seen.size();
}

}  // namespace slipcheck
