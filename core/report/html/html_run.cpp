#include "report/html/html_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/lacks.h"
#include "report/html/html_text.h"
#include "report/rows/comparison_rows.h"
#include "report/rows/expectation_rows.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {
namespace {

std::string noted_part(const TextTable& table) {
  if (table.rows.empty()) return {};
  std::vector<std::string> notes;
  for (const auto& [name, note] : table.notes)
    notes.push_back(name.empty() ? note : name + ": " + note);
  return html_table(table) + html_list("faint", "Notes", notes);
}

/// "i-j.effective_restitution off by up to 0.141", of what is worst by its tolerance.
std::string worst_text(const std::vector<ComparisonRow>& rows) {
  const ComparisonRow* worst = nullptr;
  for (const ComparisonRow& row : rows)
    if (row.severity > (worst ? worst->severity : 0)) worst = &row;
  if (!worst) return {};
  if (worst->worst.text == "–") return fmt::format("{} is not shown", worst->name);
  return fmt::format("{} off by up to {}", worst->name, worst->worst.text);
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
      "data-profile=\"{}\" data-rate=\"{:g}\" data-verdict=\"{}\">\n<details{}><summary><h5>{} "
      "<span class=\"{}\">{} {}</span></h5> <span class=\"faint\">{}</span></summary>\n",
      k, escaped(run.engine), escaped(run.precision), escaped(run.profile), run.rate,
      class_of(verdict), verdict <= Verdict::within ? "" : " open=\"\"", escaped(run_name(run)),
      class_of(tone_of(verdict)), symbol_of(verdict), escaped(outcome_text(run)),
      escaped(worst_text(rows)));
  if (ok) {
    std::string cost = ensemble_text(run);
    if (const std::string each = step_cost(run); !each.empty()) cost += ", " + each;
    html += html_paragraph("faint", "", cost) +
            noted_part(comparison_table(std::move(rows), kMostRows)) +
            noted_part(expectation_table(run));
  } else {
    html += html_paragraph("reason", status_text(run.status) + ":",
                           run.reason.empty() ? "not known why" : run.reason);
  }
  html += html_paragraph("", "Not represented:",
                         fmt::format("{}", fmt::join(texts_of(run.applied.not_represented), ", ")));
  html += html_list("warnings", "Warnings", run.warnings);
  return html + html_settings("Settings of this run [SI]:", shared.others(run, scene)) +
         "</details></section>\n";
}

}  // namespace slipcheck
