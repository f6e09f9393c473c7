#include "report/html/html_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/charts/precision_charts.h"
#include "report/html/html_text.h"
#include "report/rows/precision_rows.h"
#include "report/rows/quantity.h"

namespace slipcheck {
namespace {

/// "0.14 → 0.14: does not converge"
Cell convergence_cell(const PrecisionScene& scene, const MethodCurve& curve,
                      const std::string& quantity) {
  const auto found = curve.convergence.find(quantity);
  if (found == curve.convergence.end()) return {"–", Tone::faint};
  const Convergence& falls = found->second;
  const Dimension& dimension = error_dimension(scene, quantity);
  const std::string words = words_of(falls);
  if (!std::isfinite(falls.coarsest)) return {words, tone_of(falls.kind)};
  return {fmt::format("{} → {}: {}{}", short_error(falls.coarsest, dimension),
                      short_error(falls.finest, dimension), words,
                      is_on_front(curve, quantity) ? " ◆" : ""),
          tone_of(falls.kind), falls.coarsest};
}

Cell step_cost(const MethodCurve& curve) {
  double least = kNotObserved, spread = kNotObserved;
  for (const WorkPrecision& point : curve.points)
    if (point.cost) {
      least = std::fmin(least, point.cost->per_step);
      spread = std::fmax(spread, point.cost->spread);
    }
  if (std::isnan(least)) return {"–"};
  return {fmt::format("{}, spread {:.0f} %", short_error(least, kTime), 100 * spread), Tone::plain,
          least};
}

std::string curves_table(const PrecisionScene& scene) {
  const std::vector<std::string> quantities = drawn_quantities(scene);
  TextTable table{{{"method"}}};
  for (const std::string& quantity : quantities) table.columns.push_back({quantity});
  table.columns.push_back({"CPU time for a simulated second"});
  table.columns.push_back({"least for a step"});
  for (const MethodCurve& curve : scene.curves) {
    // Other iterations than the profile's own are in the charts, where they are best at something.
    if (curve.iterations) continue;
    std::vector<Cell>& row = table.rows.emplace_back(1, Cell{label_of(curve)});
    for (const std::string& quantity : quantities)
      row.push_back(convergence_cell(scene, curve, quantity));
    row.push_back(cost_cell(curve, &WorkCost::per_simulated_second));
    row.push_back(step_cost(curve));
  }
  return html_details("Methods in figures", html_table(table));
}

std::string troubles_part(const PrecisionScene& scene) {
  std::vector<std::string> items;
  for (const MethodCurve& curve : scene.curves)
    for (const std::string& trouble : troubles_of(curve))
      items.push_back(fmt::format("{}: {}", label_of(curve), trouble));
  return html_list("warnings", "Without a result", items);
}

std::string scene_part(const PrecisionScene& scene, std::size_t k, const std::string& charts) {
  std::string html = fmt::format(
      "<section class=\"precision\" id=\"precision-{}\" data-precision=\"{}\">\n<h3>{}</h3>\n",
      k + 1, k, escaped(scene.scenario.name));
  html += html_paragraph("title", "", scene.scenario.title);
  html += fmt::format("<div class=\"plots\" data-precision=\"{}\"></div>\n", k) + charts;
  return html + curves_table(scene) + troubles_part(scene) + "</section>\n";
}

}  // namespace

std::string html_precision(const std::vector<PrecisionScene>& scenes, const ReportCharts& charts,
                           const StandingCharts& standing) {
  if (scenes.empty()) return {};
  std::string html = "<h2 id=\"precision\">Error against run time</h2>\n";
  html += html_paragraph(
      "", "",
      "What an engine's steps cost and what they are worth: the worst error over an ensemble of "
      "phases within a step, against CPU time, beside the reference's own solvers.");
  html += html_paragraph(
      "faint", "",
      fmt::format(
          "In how many of {} scenes the errors of a method fall with its step or tolerance: "
          "those of effective restitution, or of the worst observable that has a "
          "tolerance, and those of the trajectory. ◆ counts the scenes in which no other "
          "engine, or no other solver of the reference, is cheaper and no worse.",
          scenes.size()));
  html += html_table(convergence_table(convergence_counts(scenes)));
  html += "<nav aria-label=\"Scenes of error against run time\"><ul class=\"contents wide\">\n";
  for (std::size_t k = 0; k < scenes.size(); ++k)
    html += fmt::format("<li><a href=\"#precision-{}\">{}</a></li>\n", k + 1,
                        escaped(scenes[k].scenario.name));
  html += "</ul></nav>\n";
  for (std::size_t k = 0; k < scenes.size(); ++k)
    html += scene_part(scenes[k], k, standing.html(charts.precision[k]));
  return html;
}

}  // namespace slipcheck
