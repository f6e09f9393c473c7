#include "report/charts/phase_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "report/rows/comparison_rows.h"
#include "report/rows/selection.h"
#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

constexpr std::size_t kMostCharts = 6;

/// What is charted first: effective restitution, then what is worst by its tolerance.
std::vector<std::string> charted(const SceneRecord& scene) {
  struct Candidate {
    std::string name;
    bool is_first;
    double severity;
  };
  std::vector<Candidate> candidates;
  for (const std::string& name : shown_observables(scene, false)) {
    if (!has_tolerance(scene.scenario, name)) continue;
    Candidate candidate{name, observable_key(name).observable == "effective_restitution", 0};
    for (const EngineRecord& run : scene.runs)
      for (const ComparisonRow& row : comparison_rows(scene, run, {name}))
        candidate.severity = std::fmax(candidate.severity, row.severity);
    candidates.push_back(std::move(candidate));
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return a.is_first != b.is_first ? a.is_first : a.severity > b.severity;
  });
  std::vector<std::string> result;
  for (const Candidate& candidate : candidates) result.push_back(candidate.name);
  return result;
}

std::string caption_of(const PhaseSpread& spread, const std::string& twins) {
  const auto worst = std::max_element(
      spread.runs.begin(), spread.runs.end(), [](const RunSpread& a, const RunSpread& b) {
        return std::pair(a.outside, a.far_off) < std::pair(b.outside, b.far_off);
      });
  std::string text = fmt::format("{}: {}", run_name(*worst->run), words_of(spread, *worst));
  for (const std::string& words : words_on_convergence(spread)) text += " " + words;
  if (!twins.empty()) text += fmt::format(" It looks the same for {}.", twins);
  return text;
}

}  // namespace

std::vector<PhaseChart> phase_charts(const SceneRecord& scene) {
  struct Chart {
    PhaseSpread spread;
    std::string twins;
  };
  std::vector<Chart> charts;
  for (const std::string& name : charted(scene)) {
    auto spread = phase_spread(scene, name);
    if (!spread) continue;
    const auto twin = std::find_if(charts.begin(), charts.end(), [&](const Chart& other) {
      return look_alike(other.spread, *spread);
    });
    if (twin != charts.end())
      twin->twins += (twin->twins.empty() ? "" : ", ") + name;
    else if (charts.size() < kMostCharts)
      charts.push_back({std::move(*spread), ""});
  }
  std::vector<PhaseChart> result;
  for (Chart& chart : charts) {
    std::string caption = caption_of(chart.spread, chart.twins);
    result.push_back({std::move(chart.spread), std::move(caption)});
  }
  return result;
}

}  // namespace slipcheck
