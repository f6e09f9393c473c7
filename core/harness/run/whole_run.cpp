#include "harness/run/whole_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/stop_scope.h"
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

void note_warnings(const ContactScene& scene, EngineRecord& record) {
  if (scene.has_memory())
    record.warnings.emplace_back(
        "contacts with memory go to engines as hard ones: stress and elastic energy are of the "
        "scene's own law at the overlaps that the engine shows");
  if (!is_left_alone(scene.hard)) return;
  const EnergyBudget budget = energy_budget(*record.assembly);
  if (budget.rise > kNoRise * budget.scale)
    record.warnings.push_back(
        fmt::format("the energy rises by {:.3g} J from one sample to a later one, {:.2g} % of what "
                    "takes part, and nothing does work",
                    budget.rise, 100 * budget.rise / budget.scale));
}

}  // namespace

void run_whole(RemoteEngine& engine, const EnsembleTask& task, std::size_t samples,
               EngineRecord& record) {
  const ContactScene& scene = task.solver->scene();
  record.version = engine.info().version;
  const double interval = last_time(task) / static_cast<double>(samples - 1);
  const double steps = std::ceil(interval * record.rate * (1 - 1e-9));
  if (!(steps >= 1 && steps < 1e9))
    throw Refused(fmt::format("no samples of the whole: {:.3g} steps from one to the next", steps));
  record.applied = engine.configure(EngineScene(scene), record.settings, interval / steps);

  const StopScope limit(task.time_limit);
  const double fastest = speed_scale(scene);
  AssemblyObserver observer(scene, interval * static_cast<double>(samples - 1), samples);
  Frame frame;
  frame.bodies = scene.hard.initial;
  observer.take(0, frame);
  engine.start(frame.bodies);
  for (std::size_t k = 1; k < samples; ++k) {
    heed_stop();
    const auto count = static_cast<std::size_t>(steps);
    record.cpu_seconds += engine.skip(count, frame.bodies);
    record.steps += count;
    const double time = static_cast<double>(k) * interval;
    record.reason = fault_of_state(frame, time, fastest + scene.hard.gravity * time);
    if (!record.reason.empty()) {
      record.status = EngineRecord::Status::unstable;
      return;
    }
    observer.take(time, frame);
  }
  record.assembly = observer.assembly();
  record.status = EngineRecord::Status::ok;
  record.phases = 1;
  note_warnings(scene, record);
}

}  // namespace slipcheck
