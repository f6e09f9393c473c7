#include "report/terminal/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "engine/lacks.h"
#include "report/rows/comparison_rows.h"
#include "report/rows/expectation_rows.h"
#include "report/rows/selection.h"
#include "report/rows/summary.h"
#include "report/rows/told_verdict.h"
#include "report/rows/verdict_look.h"
#include "report/rows/whole_rows.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

constexpr std::size_t kIndent = 2;

std::string warnings_text(const std::vector<std::string>& warnings, const TableStyle& style) {
  std::string result;
  for (const std::string& warning : warnings) result += paragraph("! ", warning, Tone::bad, style);
  return result;
}

std::size_t most_rows(const TableStyle& style) {
  return style.all_observables ? std::numeric_limits<std::size_t>::max() : kMostRows;
}

std::string reference_block(const SceneRecord& scene, const std::vector<std::string>& names,
                            const TableStyle& style) {
  const ReferenceResult& reference = scene.reference;
  std::string result = paragraph("reference  ", reference_summary(reference), Tone::strong, style);
  const TextTable table = reference_table(scene, names, most_rows(style));
  if (!table.rows.empty()) result += terminal_table(table, style, 2 * kIndent);
  if (const std::size_t left_out = names.size() - table.rows.size(); left_out > 0)
    result += paragraph("  … ", fmt::format("{} observables more", left_out), Tone::faint, style);
  return result + warnings_text(reference.warnings, style);
}

std::string noted_table(const TextTable& table, const TableStyle& style) {
  if (table.rows.empty()) return {};
  std::string text = terminal_table(table, style, 2 * kIndent);
  for (const auto& [name, note] : table.notes)
    text += paragraph(name.empty() ? "  … " : "  " + name + ": ", note, Tone::faint, style);
  return text;
}

/// Why a run is not ok, or that it is although it should not be.
std::string status_block(const EngineRecord& run, const TableStyle& style) {
  const Verdict verdict = run.verdict();
  const bool ok = run.status == RunStatus::ok;
  return paragraph(
      "  " + std::string(symbol_of(verdict)) + " " + outcome_text(run) + (ok ? "" : ": "),
      ok                   ? " "
      : run.reason.empty() ? "not known why"
                           : run.reason,
      tone_of(verdict), style);
}

std::string run_block(const SceneRecord& scene, const EngineRecord& run,
                      const std::vector<std::string>& names, const TableStyle& style) {
  const bool ok = run.status == RunStatus::ok;
  std::string head = run_name(run);
  if (ok) head += ", " + ensemble_text(run);
  if (const std::string cost = step_cost(run); ok && !cost.empty()) head += ", " + cost;

  std::string result = "\n";
  const auto width = static_cast<std::size_t>(std::max(style.width, 1));
  for (const std::string& line : wrapped(head, width > kIndent ? width - kIndent : 1))
    result += std::string(kIndent, ' ') + inked(line, Tone::strong, style) + '\n';
  if (!ok || (run.expect && run.expect->status)) result += status_block(run, style);
  if (ok) {
    result +=
        noted_table(comparison_table(comparison_rows(scene, run, names), most_rows(style)), style);
    if (run.assembly) result += noted_table(whole_table(scene, run), style);
    TextTable expected = expectation_table(run);
    expected.columns[3].right = false;  // beside the verdict
    result += noted_table(expected, style);
  }
  if (!run.applied.not_represented.empty())
    result += paragraph("  not represented: ",
                        fmt::format("{}", fmt::join(texts_of(run.applied.not_represented), ", ")),
                        Tone::faint, style);
  return result + warnings_text(run.warnings, style);
}

std::string verdict_text(const SceneRecord& scene, const TableStyle& style) {
  const Verdict verdict = told_verdict(scene);
  const std::string name = verdict_name(scene), loud = word_of(verdict);
  return inked(fmt::format("{} {}", symbol_of(verdict),
                           name == name_of(verdict) && !loud.empty() ? loud : name),
               tone_of(verdict), style);
}

}  // namespace

std::string table_of(const SceneRecord& scene, const TableStyle& style) {
  const Scenario& scenario = scene.scenario;
  std::string result = inked(printable(scenario.name), Tone::strong, style) + "  " +
                       verdict_text(scene, style) + '\n';
  if (!scenario.title.empty()) result += paragraph("", scenario.title, Tone::plain, style);
  if (!scenario.source.empty()) result += paragraph("", scenario.source, Tone::plain, style);
  result += '\n';
  const std::vector<std::string> names = shown_observables(scene, style.all_observables);
  result += reference_block(scene, names, style);
  for (const EngineRecord& run : scene.runs) result += run_block(scene, run, names, style);
  return result;
}

std::string summary_of(const std::vector<SceneRecord>& scenes, const TableStyle& style) {
  const Summary summary = summarize(scenes, 1);
  const AllVerdicts& all = summary.counts;
  const auto list = [&](const VerdictCounts& counts) {
    return counts.list([&](Verdict verdict) {
      return inked(counts.text_of(verdict), counts.of(verdict) > 0 ? tone_of(verdict) : Tone::plain,
                   style);
    });
  };
  const std::string alone =
      all.scenes_alone > 0 ? fmt::format(", {} of the reference alone", all.scenes_alone) : "";
  const std::string runs =
      all.run_count > 0
          ? fmt::format("; {}: {}", counted(all.run_count, "engine run"), list(all.runs))
          : "";
  const std::string counts =
      fmt::format("{}: {}{}{}", counted(all.scene_count, "scene"), list(all.scenes), alone, runs);
  std::string text;
  for (const std::string& sentence : {counts, summary.finding, summary.naive})
    for (const std::string& line :
         wrapped(sentence, static_cast<std::size_t>(std::max(style.width, 1))))
      if (!line.empty()) text += line + '\n';
  return text;
}

}  // namespace slipcheck
