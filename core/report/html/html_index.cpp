#include "report/html/html_index.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string_view>

#include "report/html/html_text.h"
#include "report/rows/told_verdict.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {
namespace {

/// How far off a cell is, as a colour; its number or symbol says the same.
const char* level_of(const MatrixCell& cell) {
  if (cell.run == nullptr) return "";
  if (cell.run->status == RunStatus::skipped) return "skipped";
  if (cell.run->verdict() == Verdict::failed) return "m5";
  if (std::isnan(cell.error)) return "m-none";
  if (cell.error <= 0.1) return "m0";
  if (cell.error <= 1) return "m1";
  if (cell.error <= 10) return "m2";
  return cell.error <= 100 ? "m3" : "m4";
}

std::string cell_html(const MatrixCell& cell, std::size_t method) {
  const Cell made = matrix_cell(cell);
  const std::string value =
      std::isnan(made.value) ? ""
                             : fmt::format(" data-value=\"{:.6g}\"", std::fmin(made.value, 1e300));
  const char* level = level_of(cell);
  return fmt::format("<td data-method=\"{}\"{}{}>{}</td>", method,
                     *level == '\0' ? "" : fmt::format(" class=\"{}\"", level), value,
                     escaped(made.text));
}

std::string head_html(const EngineMethod& method, bool with_precision, std::size_t k) {
  return fmt::format(
      "<th scope=\"col\" data-method=\"{}\"{}><span>{} {}{}{}</span> <span>{}</span> <span>{:g} "
      "Hz</span></th>",
      k, method.profile == "naive" ? " class=\"naive\"" : "", escaped(method.engine),
      escaped(method.version), with_precision ? " " : "",
      with_precision ? escaped(method.precision) : "", escaped(method.profile), method.rate);
}

std::string row_html(const PageScene& each, const EngineMatrix::Row& row) {
  const SceneRecord& scene = *each.scene;
  std::size_t within = 0;
  for (const EngineRecord& run : scene.runs) within += run.verdict() == Verdict::within ? 1 : 0;
  std::string html = fmt::format(
      "<tr class=\"scene {}\" data-scene=\"{}\"><th scope=\"row\"><a href=\"#{}\">{}</a></th><td "
      "class=\"of-scene\" data-value=\"{}\">{}</td><td class=\"share\"{}>{}</td>",
      class_of(told_verdict(scene)), each.place, each.id, escaped(scene.scenario.name),
      static_cast<int>(told_verdict(scene)), verdict_label(scene),
      scene.runs.empty()
          ? ""
          : fmt::format(" data-value=\"{:.4g}\"",
                        static_cast<double>(within) / static_cast<double>(scene.runs.size())),
      scene.runs.empty() ? "" : fmt::format("{}/{}", within, scene.runs.size()));
  for (std::size_t k = 0; k < row.cells.size(); ++k) html += cell_html(row.cells[k], k);
  return html + "</tr>\n";
}

/// Plain radio buttons that the style sheet listens to.
std::string filter_part() {
  std::string html = "<fieldset class=\"filter\"><legend>Show scenes</legend>\n";
  for (const char* choice : {"all", "deviates", "undecided", "failed", "within"})
    html += fmt::format(
        "<span><input type=\"radio\" name=\"show\" id=\"show-{0}\"{1}/><label "
        "for=\"show-{0}\">{0}</label></span>\n",
        choice, std::string_view(choice) == "all" ? " checked=\"checked\"" : "");
  return html + "</fieldset>\n";
}

constexpr const char* kLegend =
    "<p class=\"faint legend\">Each cell: the worst phase’s largest error in tolerances, 1 is just "
    "within. <span class=\"m0\">≤ 0.1</span> <span class=\"m1\">≤ 1 within</span> <span "
    "class=\"m2\">≤ 10</span> <span class=\"m3\">≤ 100</span> <span class=\"m4\">more</span> <span "
    "class=\"m5\">✗ failed</span> <span>– cannot run it</span> <span>· not judged</span></p>\n";

}  // namespace

std::string verdict_label(const SceneRecord& scene) {
  const Verdict verdict = told_verdict(scene);
  return fmt::format("<span class=\"verdict {}\">{} {}</span>", class_of(verdict),
                     symbol_of(verdict), verdict_name(scene));
}

std::string html_index(const std::vector<PageTopic>& topics, const EngineMatrix& matrix) {
  if (topics.empty()) return {};
  std::map<std::size_t, const EngineMatrix::Row*> rows;
  for (const EngineMatrix::Row& row : matrix.rows) rows[row.place] = &row;
  std::string html = "<section id=\"index\">\n<h2>Scenes by engines</h2>\n";
  html += filter_part();
  if (!matrix.methods.empty()) html += kLegend;
  html +=
      "<div class=\"table matrix\" tabindex=\"0\" role=\"region\" aria-label=\"Scenes by "
      "engines\"><table><caption>The worst phase’s largest error in tolerances, scene by "
      "engine</caption><thead><tr><th scope=\"col\">scene</th><th scope=\"col\">verdict</th><th "
      "scope=\"col\">within</th>";
  for (std::size_t k = 0; k < matrix.methods.size(); ++k)
    html += head_html(matrix.methods[k], matrix.has_both_precisions(), k);
  html += "</tr></thead>\n";
  for (const PageTopic& topic : topics) {
    html += fmt::format(
        "<tbody><tr class=\"topic\"><th scope=\"rowgroup\" colspan=\"{}\"><a href=\"#{}\">{}</a> "
        "<span class=\"faint\">{}</span></th></tr>\n",
        3 + matrix.methods.size(), topic.id, escaped(topic.name), topic.counts());
    for (const PageScene& each : topic.scenes) html += row_html(each, *rows.at(each.place));
    html += "</tbody>\n";
  }
  return html + "</table></div>\n</section>\n";
}

}  // namespace slipcheck
