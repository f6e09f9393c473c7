#include "report/html/html_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/compare/scene_features.h"
#include "report/charts/scene_drawing.h"
#include "report/html/html_index.h"
#include "report/html/html_run.h"
#include "report/html/html_text.h"
#include "report/rows/comparison_rows.h"
#include "report/rows/expectation_rows.h"
#include "report/rows/findings.h"
#include "report/rows/selection.h"
#include "report/rows/told_verdict.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {
namespace {

std::string reference_part(const SceneRecord& scene, const std::vector<std::string>& names) {
  const ReferenceResult& reference = scene.reference;
  TextTable table = reference_table(scene, names, kMostRows);
  if (!reference.closed_form.empty() || !absent_observables(scene).empty())
    table.columns[2].header = "closed form";
  std::string html = "<div class=\"reference\"><h4>The reference</h4>\n" +
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

std::string html_runs(const SceneRecord& scene, const SharedSettings& shared) {
  const std::vector<std::string> names = shown_observables(scene, false);
  std::string html;
  for (std::size_t run = 0; run < scene.runs.size(); ++run)
    html += html_run(scene, run, names, shared);
  return html;
}

std::string html_run_list(const SceneRecord& scene) {
  TextTable table{{{"run"}, {"verdict"}, {"finding"}}, {}, "Engine by engine"};
  for (const EngineRecord& run : scene.runs) {
    const Verdict verdict = run.verdict();
    table.rows.push_back(
        {{run_name(run)},
         {.text = outcome_text(run), .tone = tone_of(verdict), .symbol = symbol_of(verdict)},
         {finding_text(scene, run), Tone::faint}});
  }
  return html_table(table);
}

std::string html_scene(const PageScene& each, const SharedSettings& shared,
                       const std::string& charts, const std::string& runs) {
  const SceneRecord& scene = *each.scene;
  const Scenario& scenario = scene.scenario;
  const std::vector<std::string> names = shown_observables(scene, false);
  std::string html = fmt::format(
      "<section class=\"scene {0}\" id=\"{1}\" data-scene=\"{2}\" data-name=\"{3}\" "
      "data-verdict=\"{0}\">\n<details><summary><h3>{3}</h3> {4} <span "
      "class=\"title\">{5}</span> <span class=\"says\">{6}.</span></summary>\n",
      class_of(told_verdict(scene)), each.id, each.place, escaped(scenario.name),
      verdict_label(scene), escaped(scenario.title), escaped(scene_finding(scene)));
  html += html_paragraph("faint", "", scenario.source);
  html += "<div class=\"setting\">\n" + scene_drawing(scenario) + reference_part(scene, names) +
          "</div>\n";
  html += fmt::format("<div class=\"plots\" data-scene=\"{}\"></div>\n", each.place) + charts;
  html += left_out_part(scene);
  if (!scene.runs.empty()) html += "<h4>Engine by engine</h4>\n";
  html += html_settings("Settings of all runs [SI]:", shared.of_scene(scene));
  html += fmt::format("<div class=\"runs\" data-runs=\"{}\">\n{}</div>\n", each.place, runs);
  return html + "</details></section>\n";
}

}  // namespace slipcheck
