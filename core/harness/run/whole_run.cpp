#include "harness/run/whole_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/stop_scope.h"
#include "engine/scene_needs.h"
#include "harness/observe/assembly_observer.h"
#include "harness/observe/energy_budget.h"
#include "harness/run/engine_state.h"
#include "reference/initial_contacts.h"

namespace slipcheck {
namespace {

/// Of the energies that take part: what springs on the substrate and on surfaces hold is not seen.
constexpr double kNoRise = 0.01;

double last_time(const EnsembleTask& task) {
  const double last = run_end(*task.scenario).last();
  const SolvedRun& reference = task.reference->run;
  return reference.reached ? std::min(last, reference.end_time) : last;
}

/// The engine was given hard contacts in place of those that remember.
bool forgets(const EngineRecord& record) {
  return std::ranges::find(record.applied.not_represented, lack::kMemory, &Lack::kind) !=
         record.applied.not_represented.end();
}

void note_warnings(const ContactScene& scene, EngineRecord& record) {
  if (forgets(record))
    record.warnings.emplace_back(
        "contacts that remember went to it as hard ones: stress and elastic energy are of the "
        "scene's own law at the overlaps that the engine shows");
  if (!is_left_alone(scene.hard)) return;
  const EnergyBudget budget = energy_budget(*record.assembly);
  if (budget.rise > kNoRise * budget.scale)
    record.warnings.push_back(
        fmt::format("the energy rises by {:.3g} J from one sample to a later one, {:.2g} % of what "
                    "takes part, and nothing does work",
                    budget.rise, 100 * budget.rise / budget.scale));
}

/// What another process needs to go on from the last sample.
struct Progress {
  AssemblyObserver observer;
  EngineRecord* record;
  Frame frame = {};  ///< at the last sample
  std::size_t sample = 0;
  std::vector<double> starts = {};  ///< times at which a process went on [s]

  void exchange(StateArchive& archive) {
    archive(observer, record->version, record->cpu_seconds, record->steps, frame.bodies, sample,
            starts);
  }
};

/// Goes on from a state that was kept. Throws Refused for one of another version of the engine.
void resume(const std::string& state, double interval, bool remembers, Progress& progress) {
  EngineRecord& record = *progress.record;
  const std::string version = record.version;
  StateArchive archive{std::string_view(state)};
  archive(progress);
  archive.finish();
  const std::string kept = std::exchange(record.version, version);
  if (kept != version)
    throw Refused(
        fmt::format("what was kept is of {} {}, and this is {}", record.engine, kept, version));
  progress.starts.push_back(static_cast<double>(progress.sample) * interval);
  record.warnings.push_back(fmt::format(
      "went on at {:g} s from bodies' states alone{}: not with the bits of a run in one piece",
      fmt::join(progress.starts, " s and "),
      remembers ? ", with the springs of contacts relaxed" : ""));
}

}  // namespace

void run_whole(RemoteEngine& engine, const EnsembleTask& task, std::size_t samples,
               EngineRecord& record, const Checkpoints* checkpoints) {
  const ContactScene& scene = task.solver->scene();
  record.version = engine.info().version;
  const double interval = last_time(task) / static_cast<double>(samples - 1);
  const double each = std::ceil(interval * record.rate * (1 - 1e-9));
  if (!(each >= 1 && each < 1e9))
    throw Refused(fmt::format("no samples of the whole: {:.3g} steps from one to the next", each));
  record.applied = engine.configure(EngineScene(scene), record.settings, interval / each);

  const StopScope limit(task.time_limit);
  const double fastest = speed_scale(scene);
  Progress progress{{scene, interval * static_cast<double>(samples - 1), samples}, &record};
  Frame& frame = progress.frame;
  frame.bodies = scene.hard.initial;
  std::optional<CheckpointClock> clock;
  if (checkpoints) clock.emplace(*checkpoints);
  if (checkpoints && !checkpoints->state.empty())
    resume(checkpoints->state, interval, scene.has_memory() && !forgets(record), progress);
  else
    progress.observer.take(0, frame);
  engine.start(frame.bodies, static_cast<double>(progress.sample) * interval);
  while (progress.sample + 1 < samples) {
    heed_stop();
    const auto count = static_cast<std::size_t>(each);
    record.cpu_seconds += engine.skip(count, frame.bodies);
    record.steps += count;
    const double time = static_cast<double>(++progress.sample) * interval;
    record.reason = fault_of_state(frame, time, fastest + scene.hard.gravity * time);
    if (!record.reason.empty()) {
      record.status = EngineRecord::Status::unstable;
      return;
    }
    progress.observer.take(time, frame);
    if (!clock || !clock->is_due()) continue;
    StateArchive archive;
    archive(progress);
    clock->write(archive);
  }
  if (clock && !clock->trouble().empty())
    record.warnings.push_back("its state could not be kept on the way: " + clock->trouble());
  record.assembly = progress.observer.assembly();
  record.status = EngineRecord::Status::ok;
  record.phases = 1;
  note_warnings(scene, record);
}

}  // namespace slipcheck
