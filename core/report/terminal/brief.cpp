#include "report/terminal/brief.h"

#include <fmt/format.h>

#include <cmath>

#include "report/rows/comparison_rows.h"
#include "report/rows/expectation_rows.h"
#include "report/rows/selection.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {
namespace {

struct Worst {
  const EngineRecord* run = nullptr;
  ComparisonRow row;
};

/// The deviation that is largest in units of its tolerance; what no run shows counts as no number.
Worst worst_of(const SceneRecord& scene) {
  Worst worst;
  const std::vector<std::string> names = shown_observables(scene, false);
  for (const EngineRecord& run : scene.runs) {
    if (run.status != EngineRecord::Status::ok) continue;
    for (ComparisonRow& row : comparison_rows(scene, run, names)) {
      if (row.verdict != Verdict::deviates) continue;
      const bool worse =
          !worst.run || std::isnan(worst.row.severity) || row.severity > worst.row.severity;
      if (worse && !(worst.run && std::isnan(row.severity))) worst = {&run, std::move(row)};
    }
  }
  return worst;
}

/// "bullet double tuned 240 Hz"
std::string short_name(const EngineRecord& run) {
  return fmt::format("{} {} {} {}", run.engine, run.precision, run.profile, run.rate_text());
}

/// "undecided: flight_time", "skipped"
std::string undecided_text(const EngineRecord& run) {
  for (const auto& [name, error] : run.errors)
    if (error.verdict == Verdict::undecided) return "undecided: " + name;
  return status_text(run.status);
}

/// The worst deviation of a scene, else the first thing that is not as expected or not decided; may
/// be empty.
std::string worst_text(const SceneRecord& scene) {
  if (const Worst worst = worst_of(scene); worst.run)
    return fmt::format("{} {}, {}", worst.row.name,
                       worst.row.worst.text == "–" ? "never shown" : worst.row.worst.text,
                       short_name(*worst.run));
  for (const EngineRecord& run : scene.runs)
    if (const std::string unmet = unmet_expectation(run, false); !unmet.empty())
      return unmet + ", " + short_name(run);
  for (const EngineRecord& run : scene.runs)
    if (run.verdict() == Verdict::undecided) return undecided_text(run) + ", " + short_name(run);
  return scene.verdict() == Verdict::undecided ? "the reference did not end" : "";
}

}  // namespace

std::string brief_of(const std::vector<SceneRecord>& scenes, const TableStyle& style) {
  TextTable table{{{"scene"}, {""}, {"runs within", true}, {"worst deviation", false, 1}}};
  for (const SceneRecord& scene : scenes) {
    std::size_t within = 0;
    for (const EngineRecord& run : scene.runs) within += run.verdict() == Verdict::within;
    const Verdict verdict = scene.verdict();
    table.rows.push_back({{scene.scenario.name},
                          {symbol_of(verdict), tone_of(verdict)},
                          {fmt::format("{}/{}", within, scene.runs.size())},
                          {worst_text(scene), Tone::faint}});
  }
  return terminal_table(std::move(table), style, 0);
}

}  // namespace slipcheck
