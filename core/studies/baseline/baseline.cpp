#include "studies/baseline/baseline.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "scenario/content_digest.h"
#include "scenario/tolerances.h"

namespace slipcheck {
namespace {

BaselineRun run_of(const Scenario& scenario, const EngineRecord& record) {
  BaselineRun run;
  run.engine = record.engine;
  run.version = record.version;
  run.precision = record.precision;
  run.profile = record.profile;
  run.rate = record.rate;
  run.scale = record.scale;
  run.headings = record.headings;
  run.status = record.status;
  run.verdict = record.verdict();
  run.phases = record.phases;
  run.cpu_seconds = record.cpu_seconds;
  // What an engine showed before it failed is no result.
  if (record.status != RunStatus::ok) return run;
  for (const auto& [name, seen] : record.observables)
    if (tolerance_of_part(scenario, name) ||
        (record.expect && record.expect->observables.count(name)))
      run.observables[name] = {seen.median, seen.min, seen.max, seen.missing};
  return run;
}

}  // namespace

SceneBaseline baseline_of(const SceneRecord& scene, std::size_t phases,
                          const std::string& slipcheck_version) {
  SceneBaseline baseline;
  baseline.scene = scene.scenario.name;
  baseline.sha256 = content_digest(scene.scenario);
  baseline.slipcheck = slipcheck_version;
  baseline.phases = phases;
  baseline.solver = scene.reference.solver;
  baseline.cpu_seconds = scene.reference.cpu_seconds;
  baseline.reference = scene.reference.observables;
  for (auto& [name, value] : baseline.reference)
    if (!std::isfinite(value.uncertainty))
      value.uncertainty = std::numeric_limits<double>::quiet_NaN();
  for (const EngineRecord& record : scene.runs)
    baseline.runs.push_back(run_of(scene.scenario, record));
  return baseline;
}

std::string run_label(const BaselineRun& run) {
  std::string label =
      fmt::format("{} {} {} {:g} Hz", run.engine, run.precision, run.profile, run.rate);
  if (run.scale != 1) label += fmt::format(", scale {:g}", run.scale);
  if (run.headings > 1) label += fmt::format(", {} headings", run.headings);
  return label;
}

}  // namespace slipcheck
