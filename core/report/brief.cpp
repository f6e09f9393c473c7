#include "report/brief.h"

#include <fmt/format.h>

#include <cmath>

#include "report/comparison_rows.h"
#include "report/selection.h"

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
      if (row.mark != Mark::deviates) continue;
      const bool worse =
          !worst.run || std::isnan(worst.row.severity) || row.severity > worst.row.severity;
      if (worse && !(worst.run && std::isnan(row.severity))) worst = {&run, std::move(row)};
    }
  }
  return worst;
}

}  // namespace

std::string brief_of(const std::vector<SceneRecord>& scenes, const TableStyle& style) {
  std::vector<std::vector<Cell>> rows;
  for (const SceneRecord& scene : scenes) {
    std::size_t within = 0, counted = 0;
    for (const EngineRecord& run : scene.runs) {
      if (run.status == EngineRecord::Status::skipped) continue;
      ++counted;
      within += run.status == EngineRecord::Status::ok && run.within();
    }
    const bool good = scene.verdict() == Verdict::within;
    const Worst worst = worst_of(scene);
    rows.push_back(
        {{scene.scenario.name, Ink::plain},
         {good ? "✓" : "✗", good ? Ink::good : Ink::bad},
         {fmt::format("{}/{}", within, counted), Ink::plain},
         {worst.run ? fmt::format("{} {}, {} {} {} {:g} Hz", worst.row.name,
                                  worst.row.worst == "–" ? "never shown" : worst.row.worst,
                                  worst.run->engine, worst.run->precision, worst.run->profile,
                                  worst.run->rate)
                    : "",
          Ink::faint}});
  }
  return aligned({{"scene"}, {""}, {"runs within", true}, {"worst deviation", false, 1}},
                 std::move(rows), style, 0);
}

}  // namespace slipcheck
