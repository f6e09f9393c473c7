#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "report/charts/plot_text.h"
#include "report/charts/scene_charts.h"
#include "report/files/file_stem.h"
#include "report/rows/comparison_rows.h"
#include "report/rows/findings.h"
#include "report/rows/phase_spread.h"
#include "report/rows/quantity.h"
#include "report/rows/selection.h"
#include "report/rows/told_verdict.h"
#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

constexpr std::size_t kMostCharts = 6;  // of a page
constexpr double kSpread = 0.7;         // of a row's height, taken by its points

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

/// Covers the tolerance, nine tenths of the values, and what is not far beyond these: a run that
/// left the scene does not squeeze the others, nor do naive ones.
AxisRange axis_of(const PhaseSpread& spread) {
  std::vector<double> values;
  const bool all_naive =
      std::ranges::all_of(spread.runs, [](const RunSpread& run) { return is_naive(*run.run); });
  for (const RunSpread& run : spread.runs)
    for (const double value : run.values)
      if (std::isfinite(value) && (all_naive || !is_naive(*run.run))) values.push_back(value);
  AxisRange range{spread.low, spread.high};
  const auto take = [&](double value) {
    range = {std::fmin(range.low, value), std::fmax(range.high, value)};
  };
  std::sort(values.begin(), values.end());
  const std::size_t tenth = values.size() / 10;
  if (!values.empty()) {
    take(values[tenth]);
    take(values[values.size() - 1 - tenth]);
  }
  const double reach = 2 * (range.high - range.low);
  const double lowest = range.low - reach, highest = range.high + reach;
  for (const double value : values)
    if (value >= lowest && value <= highest) take(value);
  const double room = std::max(0.04 * (range.high - range.low), 1e-12 * std::abs(range.high));
  return {range.low - (room > 0 ? room : 1), range.high + (room > 0 ? room : 1)};
}

/// "phase 3 of 32", "phase 3 of 32, heading 2 of 8"
std::string note_of(std::size_t k, const RunSpread& run) {
  const std::size_t headings = run.run->headings, phases = run.values.size() / headings;
  std::string note = fmt::format("phase {} of {}", k % phases + 1, phases);
  if (headings > 1) note += fmt::format(", heading {} of {}", k / phases + 1, headings);
  return note;
}

Chart phase_chart(const SceneRecord& scene, const PhaseSpread& spread, const std::string& caption,
                  std::set<std::string>& taken) {
  const AxisRange axis = axis_of(spread);
  const QuantityFormat format(std::max(std::abs(axis.low), std::abs(axis.high)), spread.dimension);
  const double unit = format.factor();
  const std::string what = (spread.is_distance ? "distance from the reference's " : "") +
                           spread.name +
                           (format.unit().empty() ? "" : fmt::format(" [{}]", format.unit()));
  Chart chart{file_stem("phases-" + scene.scenario.name + "-" + spread.name, taken),
              plot_literal(what),
              plot_literal(caption),
              {},
              1};
  Panel panel{plot_literal(scene.scenario.name),
              {plot_literal(what), false, axis.low / unit, axis.high / unit},
              {}};
  panel.truth = Truth{spread.reference / unit, (spread.high - spread.reference) / unit};
  panel.bands.push_back({plot_literal("tolerance " + spread.tolerance), spread.low / unit,
                         spread.high / unit, -INFINITY, INFINITY});
  const double rows = static_cast<double>(spread.runs.size());
  const Curve reference{
      "reference", {}, {spread.reference / unit, spread.reference / unit}, {-0.5, rows - 0.5}};
  Curve within{"within the tolerance", {Ink::blue, Line::none, Marker::circle}, {}, {}};
  Curve outside{"outside", {Ink::vermilion, Line::none, Marker::diamond}, {}, {}};
  Curve beyond{"beyond the axis", {Ink::vermilion, Line::none, Marker::triangle}, {}, {}};
  beyond.at_edge = true;
  for (std::size_t k = 0; k < spread.runs.size(); ++k) {
    const RunSpread& run = spread.runs[k];
    panel.y.names.push_back(plot_literal(run_label(*run.run)));
    panel.y.runs.push_back(static_cast<std::size_t>(run.run - scene.runs.data()));
    const auto phases = static_cast<double>(run.values.size());
    for (std::size_t phase = 0; phase < run.values.size(); ++phase) {
      const double value = run.values[phase];
      if (!std::isfinite(value)) continue;
      Curve& curve = value < axis.low || value > axis.high       ? beyond
                     : value < spread.low || value > spread.high ? outside
                                                                 : within;
      const double depth = (static_cast<double>(phase) + 0.5) / phases - 0.5;
      curve.x.push_back(value / unit);
      curve.y.push_back(static_cast<double>(k) + kSpread * depth);
      curve.notes.push_back(note_of(phase, run));
    }
  }
  panel.curves = {reference};
  for (Curve* curve : {&within, &outside, &beyond})
    if (!curve->x.empty()) panel.curves.push_back(std::move(*curve));
  chart.plot_height = 8 + 44 * rows;
  chart.panels.push_back(std::move(panel));
  return chart;
}

}  // namespace

std::vector<Chart> phase_charts(const SceneRecord& scene, ChartExtent extent,
                                std::set<std::string>& taken) {
  struct Charted {
    PhaseSpread spread;
    std::string twins;
  };
  std::vector<Charted> all;
  for (const std::string& name : charted(scene)) {
    auto spread = phase_spread(scene, name);
    if (!spread) continue;
    const auto twin = std::ranges::find_if(all, [&](const Charted& other) {
      return extent == ChartExtent::page && look_alike(other.spread, *spread);
    });
    if (twin != all.end())
      twin->twins += (twin->twins.empty() ? "" : ", ") + name;
    else if (extent == ChartExtent::all || all.size() < kMostCharts)
      all.push_back({std::move(*spread), ""});
  }
  std::vector<Chart> charts;
  for (const auto& [spread, twins] : all)
    charts.push_back(phase_chart(scene, spread, caption_of(spread, twins), taken));
  return charts;
}

}  // namespace slipcheck
