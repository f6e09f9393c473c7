// Scene, solver, comparison: a scene of a few bodies that the loader takes is solved, and the
// reference held against itself never deviates.

#include <cmath>

#include "fuzz_text.h"
#include "harness/compare/comparison.h"
#include "harness/run/scene_run.h"
#include "scenario/load.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slipcheck;
  try {
    Scenario scenario = parse_scenario(fuzz::text(data, size), "s.yaml");
    if (scenario.bodies.size() > 6) return 0;
    scenario.compare.engines.clear();
    RunOptions options;
    options.phases = 1;
    options.workers = 1;
    options.time_limit = 0.5;
    const std::vector<SceneRecord> records = run_scenes({std::move(scenario)}, options);
    for (const SceneRecord& record : records) {
      std::map<std::string, double> values;
      for (const auto& [name, seen] : record.reference.observables) {
        fuzz::require(!std::isnan(seen.value) && seen.uncertainty >= 0,
                      "an observable is a number");
        values.emplace(name, seen.value);
      }
      const auto held = deviations(record.scenario, record.reference, ensemble_values({values}));
      for (const auto& [name, deviation] : held)
        fuzz::require(deviation.verdict != Verdict::deviates, "the reference deviates from itself");
    }
  } catch (const BadScenario& bad) {
    fuzz::require(!bad.faults().empty(), "a refusal has a fault");
  } catch (const Unsupported&) {
  }
  return 0;
}
