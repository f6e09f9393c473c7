#include "studies/precision/precision.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "base/in_parallel.h"
#include "base/stop_scope.h"
#include "engine/engine_registry.h"
#include "engine/remote_engine.h"
#include "harness/run/phases.h"
#include "harness/run/prepared_scene.h"
#include "harness/run/requested_runs.h"
#include "scenario/fault.h"
#include "studies/precision/precision_errors.h"
#include "studies/precision/reference_curves.h"
#include "studies/precision/timed_works.h"
#include "studies/precision/trajectory.h"

namespace slipcheck {
namespace {

constexpr const char* kIterations = "solver_iterations";

void refuse_boxes(const std::vector<Scenario>& scenarios) {
  std::vector<Fault> faults;
  for (const Scenario& scenario : scenarios) {
    if (!std::holds_alternative<Container>(scenario.surroundings)) continue;
    const auto place = scenario.locations.find("container");
    faults.push_back({scenario.file, place == scenario.locations.end() ? Location{} : place->second,
                      "container", "error against run time is measured on substrates, not in boxes",
                      ""});
  }
  if (!faults.empty()) throw BadScenario(faults);
}

/// What engines' solvers iterate on their own, asked once of each.
class OwnIterations {
 public:
  explicit OwnIterations(const RunOptions& options) : options_(options) {}

  /// Under these settings; nothing where the engine has no such setting or does not answer.
  std::optional<double> of(const EngineRecord& record) {
    const auto chosen = record.settings.find(kIterations);
    const std::optional<double>& shipped = shipped_by(record.engine, record.precision);
    if (!shipped || chosen == record.settings.end()) return shipped;
    const auto* number = std::get_if<double>(&chosen->second);
    return number != nullptr ? *number : shipped;
  }

 private:
  const std::optional<double>& shipped_by(const std::string& engine, const std::string& precision) {
    const auto [found, is_new] = shipped_.try_emplace({engine, precision});
    const auto executable = find_engine(engine, precision);
    if (!is_new || !executable) return found->second;
    try {
      const RemoteEngine worker(executable->command, options_.limits, options_.stop);
      for (const SettingInfo& setting : worker.info().settings)
        if (setting.name == kIterations)
          if (const auto* number = std::get_if<double>(&setting.shipped)) found->second = *number;
    } catch (const WorkerFailure&) {  // its runs will tell
    } catch (const Interrupted&) {
    }
    return found->second;
  }

  const RunOptions& options_;
  std::map<std::pair<std::string, std::string>, std::optional<double>> shipped_;
};

/// A curve of an engine with the records of its points.
struct EngineCurve {
  std::optional<double> iterations;
  std::vector<EngineRecord> records;
};

/// From the records of a scene, of which those with one profile stand together: that profile's own
/// curve, then those with other iterations.
std::vector<EngineCurve> engine_curves(const std::vector<EngineRecord>& records,
                                       const PrecisionGrid& grid, OwnIterations& own) {
  std::vector<EngineCurve> curves;
  const auto is_alike = [](const EngineRecord& a, const EngineRecord& b) {
    return a.engine == b.engine && a.precision == b.precision && a.profile == b.profile;
  };
  for (auto first = records.begin(); first != records.end();) {
    const auto last = std::find_if(first, records.end(),
                                   [&](const auto& each) { return !is_alike(each, *first); });
    curves.push_back({std::nullopt, {first, last}});
    const auto shipped = first->reason.empty() ? own.of(*first) : std::nullopt;
    for (const double iterations : grid.iterations) {
      if (!shipped || *shipped == iterations) continue;
      EngineCurve other{iterations, {}};
      for (auto each = first; each != last; ++each) {
        if (each->rate > grid.iterations_up_to) continue;
        other.records.push_back(*each);
        other.records.back().settings[kIterations] = iterations;
      }
      if (!other.records.empty()) curves.push_back(std::move(other));
    }
    first = last;
  }
  return curves;
}

/// A scene while it is worked on.
struct Work {
  const PreparedScene* scene = nullptr;
  TravelledPath path;
  std::map<double, TrajectorySamples> samples;  ///< by rate
  std::vector<EngineCurve> engines;
  std::vector<std::unique_ptr<TrajectoryWatch>> watches;  ///< of the engines' records, in order
  std::vector<MethodCurve> reference;

  const ReferenceSolver& solver() const { return scene->solver; }
};

/// Of a scene whose reference has an end to be held against.
void run_reference_solvers(Work& work, const PrecisionGrid& grid, const RunOptions& options) {
  const double end = work.scene->reference.run.end_time;
  work.path = travelled_path(work.solver(), work.scene->reference);
  for (const double rate : grid.rates) {
    const auto starts = phase_starts(work.scene->reference.first_contact, 1 / rate, options.phases);
    work.samples[rate] = trajectory_samples(work.solver(), end, 1 / rate, starts);
  }
  work.reference = reference_curves(*work.scene, work.path, grid);
}

/// There is nothing to hold the scene's engines against.
void skip(Work& work, const std::string& reason) {
  for (EngineCurve& curve : work.engines)
    for (EngineRecord& record : curve.records)
      if (record.reason.empty())
        record.reason = "there is no reference to hold it against: " + reason;
}

void run_all_engines(std::vector<Work>& works, const RunOptions& options) {
  std::vector<EngineTask> tasks;
  for (Work& work : works)
    for (EngineCurve& curve : work.engines)
      for (EngineRecord& record : curve.records) {
        work.watches.push_back(std::make_unique<TrajectoryWatch>(work.samples[record.rate]));
        if (record.reason.empty())
          tasks.push_back({work.scene, &record, work.watches.back().get()});
      }
  run_engines(tasks, options);
}

/// The engines' records and the reference's points as curves.
std::vector<MethodCurve> curves_of(Work& work) {
  std::vector<MethodCurve> curves;
  auto watch = work.watches.begin();
  for (const EngineCurve& from : work.engines) {
    MethodCurve& curve = curves.emplace_back();
    curve.iterations = from.iterations;
    for (const EngineRecord& record : from.records) {
      curve.engine = record.engine;
      curve.precision = record.precision;
      curve.profile = record.profile;
      curve.settings = record.settings;
      if (!record.version.empty()) curve.version = record.version;
      WorkPrecision& point = curve.points.emplace_back();
      point.knob = record.rate;
      point.status = record.status;
      point.reason = record.reason;
      point.phases = record.phases;
      point.errors = phase_errors(record.errors);
      if (record.status == RunStatus::ok) {
        PhaseErrors& trajectory = point.errors[kTrajectory];
        const TrajectorySamples& samples = work.samples[record.rate];
        if (samples.reason.empty())
          trajectory = trajectory_errors((*watch)->distances(), work.path.length);
        else
          trajectory.reason = samples.reason;
      }
      ++watch;
    }
  }
  std::ranges::move(work.reference, std::back_inserter(curves));
  return curves;
}

}  // namespace

std::vector<PrecisionScene> run_precision(std::vector<Scenario> scenarios,
                                          const PrecisionGrid& grid, const RunOptions& options) {
  const StopScope scope(options.stop);
  refuse_boxes(scenarios);
  std::vector<Scenario> asked = scenarios;
  for (Scenario& scenario : asked) ask_for(scenario, grid.engines, grid.rates);
  const auto records = requested_runs(asked, options.limits, options.stop, options.settings);
  std::vector<PreparedScene> prepared =
      prepare_scenes(std::move(scenarios), false, options.workers, options.time_limit);

  OwnIterations own(options);
  std::vector<Work> works(prepared.size());
  for (std::size_t s = 0; s < works.size(); ++s) {
    works[s].scene = &prepared[s];
    works[s].engines = engine_curves(records[s], grid, own);
  }
  in_parallel(works.size(), options.workers, [&](std::size_t s) {
    const SolvedRun& run = prepared[s].reference.run;
    try {
      heed_stop();
      if (run.failed) return skip(works[s], run.reason);
      run_reference_solvers(works[s], grid, options);
    } catch (const Interrupted&) {
      // The runs of its engines will say so.
    } catch (const std::exception& fault) {
      skip(works[s], fault.what());
    }
  });
  // A scene's timing counts as one ensemble more.
  RunOptions with_timing = options;
  std::size_t ensembles = 0;
  if (options.progress)
    with_timing.progress = [&](std::size_t done, std::size_t total) {
      ensembles = total;
      options.progress(done, total + works.size());
    };
  run_all_engines(works, with_timing);

  std::vector<PrecisionScene> scenes(works.size());
  TimingWorkers workers(options.limits, options.stop);
  for (std::size_t s = 0; s < works.size(); ++s) {
    PrecisionScene& scene = scenes[s];
    scene.simulated = prepared[s].reference.run.end_time;
    scene.path_length = works[s].path.length;
    scene.curves = curves_of(works[s]);
    try {
      heed_stop();
      std::vector<TimedWork> timed = timed_works(prepared[s], scene.curves, workers);
      time_in_turn(timed, grid.repeats, options.stop);
    } catch (const Interrupted&) {
      // What is not timed has no cost.
    }
    for (MethodCurve& curve : scene.curves)
      find_convergence(prepared[s].scenario, prepared[s].reference, curve);
    mark_fronts(scene.curves);
    if (options.progress) options.progress(ensembles + s + 1, ensembles + works.size());
  }
  for (std::size_t s = 0; s < works.size(); ++s) {
    scenes[s].scenario = std::move(prepared[s].scenario);
    scenes[s].reference = std::move(prepared[s].reference);
  }
  return scenes;
}

}  // namespace slipcheck
