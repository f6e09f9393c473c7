#include "harness/run/engine_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/compare/comparison.h"
#include "harness/run/whole_run.h"
#include "scenario/scaled_lengths.h"

namespace slipcheck {
namespace {

/// The scene at another scale, as engines are given it; null at its own. Throws Unsupported where
/// there is none.
std::shared_ptr<const ContactScene> scene_at(const Scenario& scenario, double scale) {
  if (scale == 1) return nullptr;
  auto scaled = solved_scene(scaled_lengths(scenario, scale));
  if (!scaled) throw Unsupported(fmt::format("the scene has no similar one at scale {:g}", scale));
  return scaled;
}

}  // namespace

EngineRecord::Status status_of(JobResult::Status status) {
  switch (status) {
    case JobResult::Status::ok:
      return EngineRecord::Status::ok;
    case JobResult::Status::timed_out:
      return EngineRecord::Status::timed_out;
    case JobResult::Status::skipped:
    case JobResult::Status::failed:  // a fault of ours is no result of an engine
      return EngineRecord::Status::skipped;
    case JobResult::Status::crashed:
      break;
  }
  return EngineRecord::Status::crashed;
}

bool is_recorded(const PreparedScene& scene) {
  return !scene.contact->hard.box && scene.scenario.bodies.size() <= kMostRecordedBodies;
}

EngineWork::EngineWork(const EngineTask& task, const RunOptions& options, std::size_t workers)
    : task_(task),
      options_(&options),
      scaled_(scene_at(task.scene->scenario, task.record->scale)),
      ensemble_{.solver = &task.scene->solver,
                .reference = &task.scene->reference,
                .scenario = &task.scene->scenario,
                .scaled = scaled_.get(),
                .phases = options.phases,
                .time_limit = options.time_limit,
                .budget = options.budget,
                .watch = task.watch},
      records_motion_(options.record_motion && !options.whole && !task.watch &&
                      is_recorded(*task.scene)),
      shares_(phase_shares(
          options.phases * task.record->headings,
          task.watch || records_motion_ || options.whole || std::isfinite(options.budget)
              ? 1
              : workers)) {
  if (options.whole) samples_ = options.extras.at(task.scene->scenario.name).samples;
}

void EngineWork::run(RemoteEngine& engine, std::size_t part) {
  engine.limit_run(options_->time_limit);
  if (samples_ > 0)
    return run_whole(engine, ensemble_, samples_, record(), task_.checkpoints.get());
  if (records_motion_) recorder_.emplace(ensemble_.solver->scene().hard);
  EnsembleTask ensemble = ensemble_;
  if (recorder_) ensemble.watch = &*recorder_;
  run_phases(engine, ensemble, record(), shares_[part]);
}

void EngineWork::finish() {
  if (samples_ > 0) return;  // the run has filled in the record
  ended_ = finish_ensemble(ensemble_, shares_, record());
  if (!recorder_) return;
  record().motions = record().status == EngineRecord::Status::ok
                         ? recorder_->picked(phase_errors(*ensemble_.scenario, *ensemble_.reference,
                                                          record().observables))
                         : recorder_->last_seen();
  const std::size_t phases = phase_count(ensemble_, record().rate, shares_.front().stride);
  for (RecordedMotion& motion : record().motions) {
    motion.heading = motion.phase / phases;
    motion.phase %= phases;
  }
}

/// Of a part that did not come to its end.
void EngineWork::note_failure(const JobResult& result) {
  if (result.status == JobResult::Status::ok) return;
  record().status = status_of(result.status);
  record().errors.clear();
  record().reason = result.status == JobResult::Status::failed
                        ? "it could not be compared: " + result.reason
                        : result.reason;
  if (ended_ == 0) return;
  const std::size_t phases = phase_count(ensemble_, record().rate, shares_.front().stride);
  record().reason += fmt::format(" (in phase {} of {}", ended_ % phases + 1, phases);
  if (record().headings > 1)
    record().reason += fmt::format(", heading {} of {}", ended_ / phases + 1, record().headings);
  record().reason += ")";
}

void EngineWork::settle(std::span<const JobResult> results) {
  try {
    finish();
  } catch (const std::exception& fault) {  // in the deviations: no result of the engine
    note_failure({JobResult::Status::failed, fault.what(), std::current_exception()});
  }
  const auto failed = std::ranges::find_if(
      results, [](const JobResult& each) { return each.status != JobResult::Status::ok; });
  // What an unstable phase before it says stands.
  if (failed != results.end() && record().status != EngineRecord::Status::unstable)
    note_failure(*failed);
}

}  // namespace slipcheck
