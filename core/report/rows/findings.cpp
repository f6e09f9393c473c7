#include "report/rows/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/rows/expectation_rows.h"
#include "report/rows/selection.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

bool is_worse(const ComparisonRow& a, const ComparisonRow& b) {
  const auto rank = [](const ComparisonRow& row) {
    return std::isfinite(row.severity) ? row.severity : 0;
  };
  return rank(a) > rank(b);
}

/// The first tolerance by which nothing of a run can be judged, "flight_time: nothing of it occurs
/// in the reference"; empty where there is none.
std::string first_undecided(const EngineRecord& run) {
  if (run.expect || run.status != RunStatus::ok) return {};
  for (const auto& [name, error] : run.errors)
    if (error.verdict == Verdict::undecided) return printable(name + ": " + error.reason);
  return {};
}

}  // namespace

std::string run_label(const EngineRecord& run) {
  std::string label;
  for (const std::string& part : {run.engine, run.precision, run.profile})
    if (!part.empty()) label += part + " ";
  return printable(fmt::format("{}{}", label, run.rate_text()));
}

std::optional<ComparisonRow> worst_deviation(const SceneRecord& scene, const EngineRecord& run) {
  std::optional<ComparisonRow> worst;
  if (run.status != RunStatus::ok) return worst;
  for (ComparisonRow& row : comparison_rows(scene, run, shown_observables(scene, false)))
    if (row.verdict == Verdict::deviates && (!worst || is_worse(row, *worst)))
      worst = std::move(row);
  return worst;
}

std::string deviation_text(const ComparisonRow& row) {
  std::string text =
      fmt::format("{}: reference {}, median {}", row.name, row.reference.text, row.median.text);
  if (row.spread.text != row.median.text) text += fmt::format(" ({})", row.spread.text);
  if (row.worst.text != "–") text += ", error " + row.worst.text;
  if (row.tolerance.text != "–") text += ", tolerance " + row.tolerance.text;
  return row.note.empty() ? text : text + "; " + row.note;
}

std::string finding_text(const SceneRecord& scene, const EngineRecord& run) {
  if (run.verdict() <= Verdict::within) return {};
  if (run.expect && !run.expect->status && run.status == RunStatus::ok)
    return printable(unmet_expectation(run, true));
  if (const auto worst = worst_deviation(scene, run); worst && !run.expect)
    return printable(deviation_text(*worst));
  if (const std::string undecided = first_undecided(run); !undecided.empty())
    return "undecided: " + undecided;
  std::string text = outcome_text(run);
  return printable(run.reason.empty() ? text : text + ": " + run.reason);
}

std::vector<Finding> worst_findings(const std::vector<SceneRecord>& scenes, std::size_t most) {
  std::vector<Finding> findings;
  for (const SceneRecord& scene : scenes) {
    std::optional<Finding> worst;
    for (const EngineRecord& run : scene.runs)
      if (auto row = worst_deviation(scene, run); row && (!worst || is_worse(*row, worst->row)))
        worst = Finding{&scene, &run, std::move(*row)};
    if (worst) findings.push_back(std::move(*worst));
  }
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return is_worse(a.row, b.row); });
  if (findings.size() > most) findings.resize(most);
  return findings;
}

}  // namespace slipcheck
