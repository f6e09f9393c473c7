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

const char* class_of(Convergence::Kind kind) {
  switch (kind) {
    case Convergence::Kind::exact:
    case Convergence::Kind::converges:
      return "good";
    case Convergence::Kind::does_not_converge:
      return "bad";
    case Convergence::Kind::unknown:
      break;
  }
  return "faint";
}

/// "0.14 → 0.14: does not converge"
HtmlCell convergence_cell(const PrecisionScene& scene, const MethodCurve& curve,
                          const std::string& quantity) {
  const auto found = curve.convergence.find(quantity);
  if (found == curve.convergence.end()) return {"–", "faint"};
  const Convergence& falls = found->second;
  const Dimension& dimension = error_dimension(scene, quantity);
  const std::string words = words_of(falls);
  if (!std::isfinite(falls.coarsest)) return {words, class_of(falls.kind)};
  return {fmt::format("{} → {}: {}{}", short_error(falls.coarsest, dimension),
                      short_error(falls.finest, dimension), words,
                      is_on_front(curve, quantity) ? " ◆" : ""),
          class_of(falls.kind)};
}

std::string cost_text(const MethodCurve& curve) {
  std::string first, last;
  for (const WorkPrecision& point : curve.points) {
    if (!point.cost) continue;
    last = short_error(point.cost->per_simulated_second, kTime);
    if (first.empty()) first = last;
  }
  return first.empty() ? "–" : first == last ? first : fmt::format("{} → {}", first, last);
}

std::string step_cost(const MethodCurve& curve) {
  double least = kNotObserved, spread = kNotObserved;
  for (const WorkPrecision& point : curve.points)
    if (point.cost) {
      least = std::fmin(least, point.cost->per_step);
      spread = std::fmax(spread, point.cost->spread);
    }
  if (std::isnan(least)) return "–";
  return fmt::format("{}, spread {:.0f} %", short_error(least, kTime), 100 * spread);
}

std::string curves_table(const PrecisionScene& scene) {
  const std::vector<std::string> quantities = drawn_quantities(scene);
  std::vector<HtmlCell> headers = {{"method", ""}};
  for (const std::string& quantity : quantities) headers.push_back({quantity, ""});
  headers.push_back({"CPU time for a simulated second", ""});
  headers.push_back({"least for a step", ""});
  std::vector<std::vector<HtmlCell>> rows;
  for (const MethodCurve& curve : scene.curves) {
    // Other iterations than the profile's own are in the charts, where they are best at something.
    if (curve.iterations) continue;
    std::vector<HtmlCell> row = {{label_of(curve), ""}};
    for (const std::string& quantity : quantities)
      row.push_back(convergence_cell(scene, curve, quantity));
    row.push_back({cost_text(curve), ""});
    row.push_back({step_cost(curve), ""});
    rows.push_back(std::move(row));
  }
  return html_details("Methods in figures", html_table("", headers, rows));
}

std::string troubles_part(const PrecisionScene& scene) {
  std::vector<std::string> items;
  for (const MethodCurve& curve : scene.curves)
    for (const std::string& trouble : troubles_of(curve))
      items.push_back(fmt::format("{}: {}", label_of(curve), trouble));
  return html_list("warnings", "Without a result", items);
}

std::string summary_table(const std::vector<PrecisionScene>& scenes) {
  const auto number = [](std::size_t count, const char* css_class) {
    return HtmlCell{count == 0 ? "·" : std::to_string(count), count == 0 ? "faint" : css_class};
  };
  std::vector<std::vector<HtmlCell>> rows;
  for (const ConvergenceCounts& counts : convergence_counts(scenes)) {
    std::vector<HtmlCell> row = {{counts.method, ""}};
    for (const auto& kinds : {counts.judged, counts.trajectory})
      for (std::size_t k = 0; k < kinds.size(); ++k)
        row.push_back(number(kinds[k], class_of(static_cast<Convergence::Kind>(k))));
    row.push_back(number(counts.on_front, ""));
    rows.push_back(std::move(row));
  }
  return html_table("Convergence over all scenes",
                    {{"method", ""},
                     {"judged: exact", "n"},
                     {"converges", "n"},
                     {"does not", "n"},
                     {"not known", "n"},
                     {"trajectory: exact", "n"},
                     {"converges", "n"},
                     {"does not", "n"},
                     {"not known", "n"},
                     {"◆", "n"}},
                    rows);
}

std::string scene_part(const PrecisionScene& scene, std::size_t k) {
  std::string html = fmt::format(
      "<section class=\"precision\" id=\"precision-{}\" data-precision=\"{}\">\n<h3>{}</h3>\n",
      k + 1, k, escaped(scene.scenario.name));
  html += html_paragraph("title", "", scene.scenario.title);
  html += fmt::format("<div class=\"plots\" data-precision=\"{}\"></div>\n", k);
  return html + curves_table(scene) + troubles_part(scene) + "</section>\n";
}

}  // namespace

std::string html_precision(const std::vector<PrecisionScene>& scenes) {
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
  html += summary_table(scenes);
  html += "<nav aria-label=\"Scenes of error against run time\"><ul class=\"contents wide\">\n";
  for (std::size_t k = 0; k < scenes.size(); ++k)
    html += fmt::format("<li><a href=\"#precision-{}\">{}</a></li>\n", k + 1,
                        escaped(scenes[k].scenario.name));
  html += "</ul></nav>\n";
  for (std::size_t k = 0; k < scenes.size(); ++k) html += scene_part(scenes[k], k);
  return html;
}

}  // namespace slipcheck
