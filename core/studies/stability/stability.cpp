#include "studies/stability/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <variant>

#include "base/in_parallel.h"
#include "base/stop_scope.h"
#include "harness/run/requested_runs.h"
#include "scenario/fault.h"

namespace slipcheck {
namespace {

/// Where neither the grid nor the scene says at what rate [Hz].
constexpr double kUsualRate = 240;

void refuse_boxes(const std::vector<Scenario>& cases) {
  std::vector<Fault> faults;
  for (const Scenario& scenario : cases) {
    if (!std::holds_alternative<Container>(scenario.surroundings)) continue;
    const auto place = scenario.locations.find("container");
    faults.push_back({scenario.file, place == scenario.locations.end() ? Location{} : place->second,
                      "container",
                      "is not for the stability run, which takes scenes on a substrate", ""});
  }
  if (!faults.empty()) throw BadScenario(std::move(faults));
}

std::vector<double> rates_of(const Scenario& scenario, const StabilityGrid& grid) {
  std::set<double> rates(grid.rates.begin(), grid.rates.end());
  if (rates.empty())
    for (const EngineRequest& request : scenario.compare.engines)
      rates.insert(request.rates.begin(), request.rates.end());
  if (rates.empty()) rates.insert(kUsualRate);
  return {rates.begin(), rates.end()};
}

/// A case with its reference, if there is one.
struct PreparedCase {
  std::vector<PreparedScene> scene;  ///< one or none
  ReferenceOutcome outcome;
};

PreparedCase prepare(const Scenario& scenario, double time_limit) {
  PreparedCase made;
  try {
    made.scene = prepare_scenes({scenario}, false, 1, time_limit);
    made.outcome = reference_outcome(made.scene.front());
  } catch (const Unsupported& unsupported) {
    made.outcome.refused = true;
    made.outcome.why = unsupported.what();
  } catch (const BadScenario& bad) {  // a law that cannot be what the scene asks for
    made.outcome.refused = true;
    made.outcome.why = bad.what();
  } catch (const std::exception& error) {
    made.scene.clear();
    made.outcome.why = error.what();
  }
  return made;
}

bool is_interrupted(const RunOptions& options) { return options.stop && *options.stop; }

}  // namespace

std::vector<StabilityCase> run_stability(std::vector<Scenario> cases, const StabilityGrid& grid,
                                         const RunOptions& options) {
  const StopScope scope(options.stop);
  refuse_boxes(cases);
  for (Scenario& scenario : cases) ask_for(scenario, grid.engines, rates_of(scenario, grid));
  std::vector<std::vector<EngineRecord>> records =
      requested_runs(cases, options.limits, options.stop, options.settings);

  std::vector<PreparedCase> prepared(cases.size());
  in_parallel(cases.size(), options.workers, [&](std::size_t k) {
    if (is_interrupted(options))
      prepared[k].outcome.why = "interrupted";
    else
      prepared[k] = prepare(cases[k], options.time_limit);
  });

  std::vector<OutcomeTask> tasks;
  std::vector<std::size_t> case_of;  // of each task
  std::vector<StabilityCase> results;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const PreparedCase& made = prepared[k];
    results.push_back({std::move(cases[k]), made.outcome, {}});
    const bool usable = !made.scene.empty() && !made.scene.front().reference.run.failed;
    for (EngineRecord& record : records[k]) {
      if (usable) {
        tasks.push_back({&made.scene.front(), std::move(record)});
        case_of.push_back(k);
        continue;
      }
      StabilityRun& run = results[k].runs.emplace_back();
      run.record = std::move(record);
      if (run.record.reason.empty())
        run.record.reason =
            fmt::format("there is no reference to hold it against: {}", made.outcome.why);
      run.why = run.record.reason;
    }
  }
  std::vector<StabilityRun> runs = run_outcomes(tasks, grid.criteria, options);
  for (std::size_t t = 0; t < runs.size(); ++t)
    results[case_of[t]].runs.push_back(std::move(runs[t]));
  return results;
}

}  // namespace slipcheck
