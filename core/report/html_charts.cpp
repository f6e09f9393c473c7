#include "report/html_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "report/comparison_rows.h"
#include "report/html_text.h"
#include "report/phase_spread.h"
#include "report/selection.h"
#include "report/strip_chart.h"

namespace slipcheck {
namespace {

constexpr std::size_t kMostCharts = 6;

/// What is charted first: effective restitution, then what is worst by its tolerance.
std::vector<std::string> charted(const SceneRecord& scene, const std::vector<std::string>& names) {
  struct Candidate {
    std::string name;
    bool is_first;
    double severity;
  };
  std::vector<Candidate> candidates;
  for (const std::string& name : names) {
    if (!has_tolerance(scene.scenario, name)) continue;
    Candidate candidate{name, name.ends_with(".effective_restitution"), 0};
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

std::string chart(const PhaseSpread& spread, const std::string& twins) {
  const auto worst = std::max_element(
      spread.runs.begin(), spread.runs.end(), [](const RunSpread& a, const RunSpread& b) {
        return std::pair(a.outside, a.far_off) < std::pair(b.outside, b.far_off);
      });
  std::string html = fmt::format("<figure class=\"chart\"><h4>{}</h4>\n", escaped(spread.name));
  html += strip_chart(spread) + "<figcaption>";
  html += escaped(fmt::format("{}: {}", run_name(*worst->run), words_of(spread, *worst)));
  for (const std::string& words : words_on_convergence(spread))
    html += " <strong>" + escaped(words) + "</strong>";
  if (!twins.empty()) html += escaped(" It looks the same for " + twins + ".");
  return html + "</figcaption></figure>\n";
}

}  // namespace

std::string html_charts(const SceneRecord& scene, const std::vector<std::string>& names) {
  struct Chart {
    PhaseSpread spread;
    std::string twins;
  };
  std::vector<Chart> charts;
  std::size_t left_out = 0;
  for (const std::string& name : charted(scene, names)) {
    const auto spread = phase_spread(scene, name);
    if (!spread) continue;
    const auto twin = std::find_if(charts.begin(), charts.end(), [&](const Chart& other) {
      return look_alike(other.spread, *spread);
    });
    if (twin != charts.end()) {
      twin->twins += (twin->twins.empty() ? "" : ", ") + name;
    } else if (charts.size() < kMostCharts) {
      charts.push_back({*spread, ""});
    } else {
      ++left_out;
    }
  }
  std::string html;
  for (const Chart& one : charts) html += chart(one.spread, one.twins);
  if (html.empty()) return {};
  std::string part = "<h3>Phase by phase</h3>\n";
  part += html_paragraph(
      "faint", "",
      fmt::format(
          "Each mark is one run. The runs of a strip differ only in where within a time step "
          "{}: from top to bottom the start is shifted through one step. The line is the "
          "reference, the shaded band the tolerance; ● within, × outside, ◀ ▶ beyond the axis.",
          scene.reference.box ? "they start" : "the first contact falls"));
  part += "<div class=\"charts\">\n" + html + "</div>\n";
  if (left_out > 0)
    part += html_paragraph("faint", "",
                           fmt::format("{} observables more are in the tables only.", left_out));
  return part;
}

}  // namespace slipcheck
