#include "explain/explain_engines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <variant>

#include "engine/engine_registry.h"
#include "engine/remote_engine.h"
#include "harness/run/engine_grid.h"

namespace slipcheck {
namespace {

std::string text_of(const Setting& setting) {
  if (const bool* flag = std::get_if<bool>(&setting)) return *flag ? "true" : "false";
  if (const double* number = std::get_if<double>(&setting)) return fmt::format("{:g}", *number);
  return std::get<std::string>(setting);
}

/// Asks the engine of a run what it would make of the scene; takes no step.
void ask(ExplainSection& section, const EngineRecord& run, const EngineScene& scene,
         const std::atomic<bool>* stop) {
  const auto executable = find_engine(run.engine, run.precision);
  if (!executable) {
    section.add("not installed");
    return;
  }
  if (!run.reason.empty()) {
    section.add("skipped: " + run.reason);
    return;
  }
  for (const auto& [name, setting] : run.settings)
    section.add(fmt::format("the profile sets {:<32} {}", name, text_of(setting)));
  try {
    RemoteEngine engine(executable->command, {}, stop);
    const Applied applied = engine.configure(scene, run.settings, 1 / run.rate);
    for (const Lack& lack : applied.not_represented) section.add("not represented: " + lack.text);
    for (const std::string& text : applied.left_out) section.add("left out: " + text);
    for (const auto& [name, setting] : applied.settings) section.add(name, text_of(setting));
  } catch (const Refused& refused) {
    section.add(std::string("refused: ") + refused.what());
  } catch (const WorkerFailure& failure) {
    section.add(std::string("failed: ") + failure.what());
  }
}

}  // namespace

ExplainSections explain_engines(const Scenario& scenario, const EngineScene& scene,
                                const std::vector<EngineRecord>& runs,
                                const std::atomic<bool>* stop) {
  ExplainSections sections;
  auto run = runs.begin();
  for (const EngineRequest& request : requests_of(scenario)) {
    ExplainSection& section = sections.emplace_back();
    section.title = fmt::format("Engine {} {}, profile {}, {} Hz", run->engine, run->precision,
                                run->profile, fmt::join(request.rates, ", "));
    if (run->headings > 1) section.title += fmt::format(", {} headings", run->headings);
    if (const auto& scales = scenario.compare.scales; scales != std::vector<double>{1})
      section.title += fmt::format(", scales {}", fmt::join(scales, ", "));
    section.label_width = 36;
    ask(section, *run, scene, stop);
    run += static_cast<std::ptrdiff_t>(request.rates.size() * scenario.compare.scales.size());
  }
  return sections;
}

}  // namespace slipcheck
