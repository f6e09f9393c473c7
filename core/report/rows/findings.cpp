#include "report/rows/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "report/rows/expectation_rows.h"
#include "report/rows/quantity.h"
#include "report/rows/selection.h"
#include "report/rows/told_verdict.h"
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

/// "nearest to its tolerance: i.sliding_time, 0.8 of it (bullet double tuned 240 Hz)"
std::string nearest_text(const SceneRecord& scene) {
  const std::pair<const std::string, Deviation>* nearest = nullptr;
  const EngineRecord* whose = nullptr;
  double most = -1;
  for (const EngineRecord& run : scene.runs) {
    if (run.expect || !decides(scene, run)) continue;
    for (const auto& error : run.errors) {
      const Deviation& deviation = error.second;
      if (deviation.verdict != Verdict::within || !(deviation.tolerance.value_or(0) > 0)) continue;
      const double share = deviation.max / *deviation.tolerance;
      if (!(share > most)) continue;
      most = share;
      nearest = &error;
      whose = &run;
    }
  }
  if (!nearest) return {};
  return fmt::format("nearest to its tolerance: {}, {} of it ({})", printable(nearest->first),
                     plain_number(most), run_label(*whose));
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

std::optional<Finding> worst_finding(const SceneRecord& scene) {
  std::optional<Finding> worst;
  for (const EngineRecord& run : scene.runs) {
    if (!decides(scene, run)) continue;
    if (auto row = worst_deviation(scene, run); row && (!worst || is_worse(*row, worst->row)))
      worst = Finding{&scene, &run, std::move(*row)};
  }
  return worst;
}

std::string off_text(const ComparisonRow& row) {
  if (row.worst.text == "–") return printable(fmt::format("{} ({})", row.name, row.note));
  std::string text =
      fmt::format("{} off by up to {}, tolerance {}", row.name, row.worst.text, row.tolerance.text);
  return printable(row.note.empty() ? text : fmt::format("{} ({})", text, row.note));
}

std::string worst_text(const Finding& finding) {
  return printable(fmt::format("{}, {} ({})", finding.scene->scenario.name, off_text(finding.row),
                               run_label(*finding.run)));
}

std::string scene_finding(const SceneRecord& scene) {
  if (scene.runs.empty())
    return scene.reference.run.reached
               ? "The reference alone: " + reference_summary(scene.reference)
               : "The reference did not end: " + scene.reference.run.reason;
  const Verdict verdict = told_verdict(scene);
  std::size_t within = 0;
  const EngineRecord* first = nullptr;  // that is as bad as the scene
  for (const EngineRecord& run : scene.runs) {
    within += run.verdict() == Verdict::within ? 1 : 0;
    if (!first && decides(scene, run) && run.verdict() == verdict) first = &run;
  }
  const std::string counts =
      fmt::format("{} of {} within", within, counted(scene.runs.size(), "run"));
  if (verdict == Verdict::unjudged) return "Nothing is judged";
  if (verdict == Verdict::within) {
    const std::string near = nearest_text(scene);
    return near.empty() ? counts : counts + "; " + near;
  }
  if (verdict == Verdict::deviates)
    if (const auto worst = worst_finding(scene))
      return fmt::format("{}; worst: {} ({})", counts, off_text(worst->row),
                         run_label(*worst->run));
  if (!first)
    return fmt::format("{}; the reference did not end: {}", counts,
                       printable(scene.reference.run.reason));
  return fmt::format("{}; {} ({})", counts, finding_text(scene, *first), run_label(*first));
}

std::vector<Finding> worst_findings(const std::vector<SceneRecord>& scenes, std::size_t most) {
  std::vector<Finding> findings;
  for (const SceneRecord& scene : scenes)
    if (auto worst = worst_finding(scene)) findings.push_back(std::move(*worst));
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return is_worse(a.row, b.row); });
  if (findings.size() > most) findings.resize(most);
  return findings;
}

}  // namespace slipcheck
