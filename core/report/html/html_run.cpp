#include "report/html/html_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "report/html/html_text.h"
#include "report/rows/comparison_rows.h"
#include "report/rows/expectation_rows.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {
namespace {

// Keeps the page of a scene of many bodies readable; the result file has everything.
constexpr std::size_t kMostRows = 20;

/// The style of a verdict's word.
const char* ink_of(Verdict verdict) {
  return verdict == Verdict::within ? "good" : verdict == Verdict::unjudged ? "faint" : "bad";
}

std::string run_table(std::vector<ComparisonRow> comparison) {
  const std::size_t count = comparison.size();
  comparison = most_severe(std::move(comparison), kMostRows);
  std::vector<std::vector<HtmlCell>> rows;
  std::vector<std::string> notes;
  for (const ComparisonRow& row : comparison) {
    rows.push_back(
        {{row.name, ""},
         {row.reference, ""},
         {row.median, ""},
         {row.spread, ""},
         {row.worst, row.verdict == Verdict::deviates ? "bad" : ""},
         {row.tolerance, ""},
         {std::string(symbol_of(row.verdict)) + " " + word_of(row.verdict), ink_of(row.verdict)}});
    if (!row.note.empty()) notes.push_back(row.name + ": " + row.note);
  }
  if (count > rows.size())
    notes.push_back(fmt::format("{} rows more, none more severe", count - rows.size()));
  if (rows.empty()) return {};
  return html_table("",
                    {{"observable", ""},
                     {"reference", "n"},
                     {"median", "n"},
                     {"min … max", "n"},
                     {"max error", "n"},
                     {"tolerance", "n"},
                     {"verdict", ""}},
                    rows) +
         html_list("faint", "Notes", notes);
}

std::string expectations_table(const EngineRecord& run) {
  std::vector<std::vector<HtmlCell>> rows;
  std::vector<std::string> notes;
  for (const ExpectationRow& row : expectation_rows(run)) {
    rows.push_back({{row.name, ""},
                    {row.statistic, ""},
                    {row.value, row.met ? "" : "bad"},
                    {row.limits, ""},
                    {std::string(symbol_of(row.met ? Verdict::within : Verdict::deviates)) + " " +
                         expectation_word(row.met),
                     row.met ? "good" : "bad"}});
    if (!row.note.empty()) notes.push_back(row.name + ": " + row.note);
  }
  if (rows.empty()) return {};
  return html_table(
             "What is expected of " + run_name(run),
             {{"of this engine", ""}, {"", ""}, {"value", "n"}, {"expected", "n"}, {"verdict", ""}},
             rows) +
         html_list("faint", "Notes", notes);
}

/// "i-j.effective_restitution off by up to 0.141", of what is worst by its tolerance.
std::string worst_text(const std::vector<ComparisonRow>& rows) {
  const ComparisonRow* worst = nullptr;
  for (const ComparisonRow& row : rows)
    if (row.severity > (worst ? worst->severity : 0)) worst = &row;
  if (!worst) return {};
  if (worst->worst == "–") return fmt::format("{} is not shown", worst->name);
  return fmt::format("{} off by up to {}", worst->name, worst->worst);
}

}  // namespace

std::string html_run(const SceneRecord& scene, std::size_t k, const std::vector<std::string>& names,
                     const SharedSettings& shared) {
  const EngineRecord& run = scene.runs[k];
  const bool ok = run.status == RunStatus::ok;
  const Verdict verdict = run.verdict();
  std::vector<ComparisonRow> rows;
  if (ok) rows = comparison_rows(scene, run, names);
  std::string html = fmt::format(
      "<section class=\"run\" data-run=\"{}\" data-engine=\"{}\" data-precision=\"{}\" "
      "data-profile=\"{}\" data-rate=\"{:g}\" data-verdict=\"{}\">\n<details{}><summary><h4>{} "
      "<span class=\"{}\">{} {}</span></h4> <span class=\"faint\">{}</span></summary>\n",
      k, escaped(run.engine), escaped(run.precision), escaped(run.profile), run.rate,
      class_of(verdict), verdict <= Verdict::within ? "" : " open=\"\"", escaped(run_name(run)),
      ink_of(verdict), symbol_of(verdict), escaped(outcome_text(run)), escaped(worst_text(rows)));
  if (ok) {
    std::string cost = fmt::format("{} phase{}", run.phases, run.phases == 1 ? "" : "s");
    if (const std::string each = step_cost(run); !each.empty()) cost += ", " + each;
    html +=
        html_paragraph("faint", "", cost) + run_table(std::move(rows)) + expectations_table(run);
  } else {
    html += html_paragraph("reason", status_text(run.status) + ":",
                           run.reason.empty() ? "not known why" : run.reason);
  }
  html += html_paragraph(
      "", "Not represented:", fmt::format("{}", fmt::join(run.applied.not_represented, ", ")));
  html += html_list("warnings", "Warnings", run.warnings);
  return html + html_settings("Settings of this run [SI]:", shared.others(run, scene)) +
         "</details></section>\n";
}

}  // namespace slipcheck
