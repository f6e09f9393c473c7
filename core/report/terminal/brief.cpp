#include "report/terminal/brief.h"

#include <fmt/format.h>

#include "report/rows/comparison_rows.h"
#include "report/rows/expectation_rows.h"
#include "report/rows/findings.h"
#include "report/rows/told_verdict.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {
namespace {

/// "undecided: flight_time", "skipped"
std::string undecided_text(const EngineRecord& run) {
  for (const auto& [name, error] : run.errors)
    if (error.verdict == Verdict::undecided) return "undecided: " + name;
  return status_text(run.status);
}

/// The worst deviation of a scene, else the first thing that is not as expected or not decided; may
/// be empty.
std::string what_is_worst(const SceneRecord& scene) {
  if (const auto worst = worst_finding(scene))
    return fmt::format("{} {}, {}", worst->row.name,
                       worst->row.worst.text == "–" ? "never shown" : worst->row.worst.text,
                       run_label(*worst->run));
  for (const EngineRecord& run : scene.runs)
    if (const std::string unmet = unmet_expectation(run, false); !unmet.empty())
      return unmet + ", " + run_label(run);
  for (const EngineRecord& run : scene.runs)
    if (run.verdict() == Verdict::undecided && decides(scene, run))
      return undecided_text(run) + ", " + run_label(run);
  return told_verdict(scene) == Verdict::undecided ? "the reference did not end" : "";
}

}  // namespace

std::string brief_of(const std::vector<SceneRecord>& scenes, const TableStyle& style) {
  TextTable table{{{"scene"}, {""}, {"runs within", true}, {"worst deviation", false, 1}}};
  for (const SceneRecord& scene : scenes) {
    std::size_t within = 0;
    for (const EngineRecord& run : scene.runs) within += run.verdict() == Verdict::within;
    const Verdict verdict = told_verdict(scene);
    table.rows.push_back({{scene.scenario.name},
                          {symbol_of(verdict), tone_of(verdict)},
                          {fmt::format("{}/{}", within, scene.runs.size())},
                          {what_is_worst(scene), Tone::faint}});
  }
  return terminal_table(std::move(table), style, 0);
}

}  // namespace slipcheck
