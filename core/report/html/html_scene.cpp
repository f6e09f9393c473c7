#include "report/html/html_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/compare/scene_features.h"
#include "report/charts/scene_drawing.h"
#include "report/html/html_run.h"
#include "report/html/html_summary.h"
#include "report/html/html_text.h"
#include "report/rows/comparison_rows.h"
#include "report/rows/selection.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {
namespace {

std::string reference_part(const SceneRecord& scene, const std::vector<std::string>& names) {
  const ReferenceResult& reference = scene.reference;
  TextTable table = reference_table(scene, names, kMostRows);
  if (!reference.closed_form.empty() || !absent_observables(scene).empty())
    table.columns[2].header = "closed form";
  std::string html = "<div class=\"reference\"><h3>The reference</h3>\n" +
                     html_paragraph("faint", "", reference_summary(reference)) + html_table(table);
  if (const std::size_t left_out = names.size() - table.rows.size(); left_out > 0)
    html += html_paragraph("faint", "", fmt::format("… {} observables more", left_out));
  return html + html_list("warnings", "Warnings", reference.warnings) + "</div>\n";
}

/// The features of the reference that the scene does without, as `slipcheck explain` tells them.
std::string left_out_part(const SceneRecord& scene) {
  if (!scene.scene) return {};
  const std::vector<Feature> features = scene_features(*scene.scene);
  std::vector<std::string> left_out;
  for (const Feature& feature : features)
    if (!feature.needed) left_out.push_back(fmt::format("{}: {}", feature.name, feature.detail));
  if (left_out.empty()) return {};
  return html_details(fmt::format("Left out: {} of {} features", left_out.size(), features.size()),
                      html_paragraph("faint", "", fmt::format("{}.", fmt::join(left_out, "; "))));
}

}  // namespace

std::string verdict_label(const SceneRecord& scene) {
  const Verdict verdict = scene.verdict();
  return fmt::format("<span class=\"verdict {}\">{} {}</span>", class_of(verdict),
                     symbol_of(verdict), verdict_name(scene));
}

std::string html_scene(const SceneRecord& scene, std::size_t k, const SharedSettings& shared,
                       const std::string& charts) {
  const Scenario& scenario = scene.scenario;
  const std::vector<std::string> names = shown_observables(scene, false);
  std::string html = fmt::format(
      "<section class=\"scene {0}\" id=\"{1}\" data-scene=\"{2}\" data-name=\"{3}\" "
      "data-verdict=\"{0}\">\n<h2>{3} {4}</h2>\n",
      class_of(scene.verdict()), scene_id(k), k, escaped(scenario.name), verdict_label(scene));
  html += html_paragraph("title", "", scenario.title);
  html += html_paragraph("faint", "", scenario.source);
  html += "<div class=\"setting\">\n" + scene_drawing(scenario) + reference_part(scene, names) +
          "</div>\n";
  html += left_out_part(scene);
  html += fmt::format("<div class=\"plots\" data-scene=\"{}\"></div>\n", k) + charts;
  if (!scene.runs.empty()) html += "<h3>Engine by engine</h3>\n";
  html += html_settings("Settings of all runs [SI]:", shared.of_scene(scene));
  for (std::size_t run = 0; run < scene.runs.size(); ++run)
    html += html_run(scene, run, names, shared);
  return html + "</section>\n";
}

}  // namespace slipcheck
