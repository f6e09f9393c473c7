#include "report/html_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "report/comparison_rows.h"
#include "report/expectation_rows.h"
#include "report/html_charts.h"
#include "report/html_text.h"
#include "report/scene_drawing.h"
#include "report/selection.h"
#include "report/time_chart.h"

namespace slipcheck {
namespace {

// Keeps the page of a scene of many bodies readable; the result file has everything.
constexpr std::size_t kMostRows = 20;

std::string list(const std::string& head, const std::vector<std::string>& items,
                 const char* css_class) {
  if (items.empty()) return {};
  std::string html =
      fmt::format("<div class=\"{}\"><strong>{}</strong><ul>", css_class, escaped(head));
  for (const std::string& item : items) html += "<li>" + escaped(item) + "</li>";
  return html + "</ul></div>\n";
}

std::string reference_part(const SceneRecord& scene, const std::vector<std::string>& names) {
  const ReferenceResult& reference = scene.reference;
  const auto absent = absent_observables(scene);
  std::vector<std::vector<HtmlCell>> rows;
  for (const std::string& name : names) {
    if (rows.size() == kMostRows) break;
    const QuantityFormat format = format_for(scene, name, nullptr);
    const auto reason = absent.find(name);
    rows.push_back(
        {{name, ""},
         {reference_text(scene, name, format), "number"},
         {reason != absent.end() ? reason->second : closed_form_text(reference, name, format),
          "faint"}});
  }
  std::string html = "<div class=\"reference\"><h3>The reference</h3>\n" +
                     html_paragraph("faint", "", reference_summary(reference));
  html += html_table("Reference values",
                     {{"observable", ""},
                      {"value", "number"},
                      {reference.closed_form.empty() && absent.empty() ? "" : "closed form", ""}},
                     rows);
  if (names.size() > rows.size())
    html += html_paragraph("faint", "",
                           fmt::format("… {} observables more", names.size() - rows.size()));
  return html + list("Warnings", reference.warnings, "warnings") + "</div>\n";
}

HtmlCell mark_cell(const ComparisonRow& row) {
  const char* css_class = row.mark == Mark::within     ? "good"
                          : row.mark == Mark::deviates ? "bad"
                                                       : "faint";
  return {std::string(symbol_of(row.mark)) + " " + word_of(row.mark), css_class};
}

std::string applied_settings(const Applied& applied) {
  if (applied.settings.empty()) return {};
  std::vector<std::vector<HtmlCell>> rows;
  for (const auto& [name, setting] : applied.settings) {
    std::string text;
    if (const double* number = std::get_if<double>(&setting)) {
      text = fmt::format("{}", *number);
    } else if (const bool* flag = std::get_if<bool>(&setting)) {
      text = *flag ? "true" : "false";
    } else {
      text = std::get<std::string>(setting);
    }
    rows.push_back({{name, ""}, {text, ""}});
  }
  return "<details><summary>Settings as applied [SI]</summary>\n" +
         html_table("Settings as applied", {{"setting", ""}, {"value", ""}}, rows) + "</details>\n";
}

std::string run_table(const SceneRecord& scene, const EngineRecord& run,
                      const std::vector<std::string>& names) {
  std::vector<ComparisonRow> comparison = comparison_rows(scene, run, names);
  const std::size_t count = comparison.size();
  comparison = most_severe(std::move(comparison), kMostRows);
  std::vector<std::vector<HtmlCell>> rows;
  std::vector<std::string> notes;
  for (const ComparisonRow& row : comparison) {
    rows.push_back({{row.name, ""},
                    {row.reference, "number"},
                    {row.median, "number"},
                    {row.spread, "number"},
                    {row.worst, row.mark == Mark::deviates ? "number bad" : "number"},
                    {row.tolerance, "number"},
                    mark_cell(row)});
    if (!row.note.empty()) notes.push_back(row.name + ": " + row.note);
  }
  if (count > rows.size())
    notes.push_back(fmt::format("{} rows more, none more severe", count - rows.size()));
  return html_table(run_name(run),
                    {{"observable", ""},
                     {"reference", "number"},
                     {"median", "number"},
                     {"min … max", "number"},
                     {"max error", "number"},
                     {"tolerance", "number"},
                     {"verdict", ""}},
                    rows) +
         list("Notes", notes, "faint");
}

std::string expectations_table(const EngineRecord& run) {
  std::vector<std::vector<HtmlCell>> rows;
  std::vector<std::string> notes;
  for (const ExpectationRow& row : expectation_rows(run)) {
    const char* css_class = row.met ? "good" : "bad";
    rows.push_back({{row.name, ""},
                    {row.statistic, ""},
                    {row.value, row.met ? "number" : "number bad"},
                    {row.limits, "number"},
                    {std::string(symbol_of(row.met ? Mark::within : Mark::deviates)) + " " +
                         expectation_word(row.met),
                     css_class}});
    if (!row.note.empty()) notes.push_back(row.name + ": " + row.note);
  }
  if (rows.empty()) return {};
  return html_table("What is expected of " + run_name(run),
                    {{"of this engine", ""},
                     {"", ""},
                     {"value", "number"},
                     {"expected", "number"},
                     {"verdict", ""}},
                    rows) +
         list("Notes", notes, "faint");
}

std::string run_part(const SceneRecord& scene, const EngineRecord& run,
                     const std::vector<std::string>& names) {
  const bool ok = run.status == RunStatus::ok;
  const Mark mark = run.verdict() == Verdict::within ? Mark::within
                    : run.verdict()                  ? Mark::deviates
                                                     : Mark::no_tolerance;
  const char* css_class = mark == Mark::within ? "good" : mark == Mark::deviates ? "bad" : "faint";
  std::string html =
      fmt::format("<section class=\"run\"><h4>{} <span class=\"{}\">{} {}</span></h4>\n",
                  escaped(run_name(run)), css_class, symbol_of(mark), escaped(outcome_text(run)));
  if (ok) {
    std::string cost = fmt::format("{} phase{}", run.phases, run.phases == 1 ? "" : "s");
    if (const std::string each = step_cost(run); !each.empty()) cost += ", " + each;
    html +=
        html_paragraph("faint", "", cost) + run_table(scene, run, names) + expectations_table(run);
  } else {
    html += html_paragraph("reason", status_text(run.status) + ":",
                           run.reason.empty() ? "not known why" : run.reason);
  }
  html += html_paragraph(
      "", "Not represented:", fmt::format("{}", fmt::join(run.applied.not_represented, ", ")));
  html += list("Warnings", run.warnings, "warnings");
  return html + applied_settings(run.applied) + "</section>\n";
}

}  // namespace

std::string verdict_class(const SceneRecord& scene) { return name_of(scene.verdict()); }

std::string verdict_label(const SceneRecord& scene) {
  if (scene.runs.empty()) return "<span class=\"verdict\">– reference only</span>";
  const char* symbol = scene.verdict() == Verdict::within     ? "✓"
                       : scene.verdict() == Verdict::deviates ? "✗"
                                                              : "⚠";
  const std::string word = is_judged_by_expectations(scene) && scene.verdict() != Verdict::failed
                               ? expectation_word(scene.verdict() == Verdict::within)
                               : name_of(scene.verdict());
  return fmt::format("<span class=\"verdict {}\">{} {}</span>", verdict_class(scene), symbol, word);
}

std::string html_scene(const SceneRecord& scene, const std::string& id) {
  const Scenario& scenario = scene.scenario;
  const std::vector<std::string> names = shown_observables(scene, false);
  std::string html =
      fmt::format("<section class=\"scene {}\" id=\"{}\">\n<h2>{} {}</h2>\n", verdict_class(scene),
                  escaped(id), escaped(scenario.name), verdict_label(scene));
  html += html_paragraph("title", "", scenario.title);
  html += html_paragraph("faint", "", scenario.source);
  html += "<div class=\"setting\">\n" + scene_drawing(scenario) + reference_part(scene, names) +
          "</div>\n";
  html += html_time_charts(scene) + html_charts(scene, names);
  if (!scene.runs.empty()) html += "<h3>Engine by engine</h3>\n";
  for (const EngineRecord& run : scene.runs) html += run_part(scene, run, names);
  return html + "</section>\n";
}

}  // namespace slipcheck
