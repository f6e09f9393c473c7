#include "report/terminal/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/rows/comparison_rows.h"
#include "report/rows/expectation_rows.h"
#include "report/rows/selection.h"
#include "report/rows/verdict_look.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

/// A scene of many bodies would fill many screens; the most severe rows tell what there is to tell.
constexpr std::size_t kMostRows = 20;

constexpr std::size_t kIndent = 2;

std::string warnings_text(const std::vector<std::string>& warnings, const TableStyle& style) {
  std::string result;
  for (const std::string& warning : warnings) result += paragraph("! ", warning, Tone::bad, style);
  return result;
}

std::string more_rows(std::size_t count) {
  return fmt::format("{} rows more, none more severe", count);
}

std::string reference_block(const SceneRecord& scene, const std::vector<std::string>& names,
                            const TableStyle& style) {
  const ReferenceResult& reference = scene.reference;
  std::string result = paragraph("reference  ", reference_summary(reference), Tone::strong, style);

  const auto absent = absent_observables(scene);
  std::vector<std::vector<Cell>> rows;
  bool any_closed_form = false;
  for (const std::string& name : names) {
    if (!style.all_observables && rows.size() == kMostRows) break;
    const QuantityFormat format = format_for(scene, name, nullptr);
    std::string closed_form = closed_form_text(reference, name, format);
    any_closed_form |= !closed_form.empty();
    if (const auto found = absent.find(name); found != absent.end()) closed_form = found->second;
    rows.push_back({{name}, {reference_text(scene, name, format)}, {closed_form, Tone::faint}});
  }
  if (rows.empty()) return result + warnings_text(reference.warnings, style);
  const std::size_t left_out = names.size() - rows.size();
  result +=
      aligned({{"observable"}, {"value", true}, {any_closed_form ? "closed form" : "", false, 1}},
              std::move(rows), style, 2 * kIndent);
  if (left_out > 0)
    result += paragraph("  … ", fmt::format("{} observables more", left_out), Tone::faint, style);
  return result + warnings_text(reference.warnings, style);
}

std::string rows_text(const std::vector<ComparisonRow>& comparison, const TableStyle& style) {
  std::vector<std::vector<Cell>> rows;
  std::string notes;
  for (const ComparisonRow& row : comparison) {
    const Tone ink = tone_of(row.verdict);
    const Tone error_ink = row.verdict == Verdict::deviates ? Tone::bad : Tone::plain;
    rows.push_back({{row.name},
                    {row.reference},
                    {row.median},
                    {row.spread},
                    {row.worst, error_ink},
                    {row.tolerance},
                    {symbol_of(row.verdict), ink},
                    {word_of(row.verdict), ink}});
    if (!row.note.empty()) notes += paragraph("  " + row.name + ": ", row.note, Tone::faint, style);
  }
  return aligned({{"observable"},
                  {"reference", true},
                  {"median", true, 2},
                  {"min … max", true},
                  {"max error", true},
                  {"tolerance", true, 1},
                  {""},
                  {"", false, 3}},
                 std::move(rows), style, 2 * kIndent) +
         notes;
}

std::string expectations_text(const std::vector<ExpectationRow>& expectations,
                              const TableStyle& style) {
  if (expectations.empty()) return {};
  std::vector<std::vector<Cell>> rows;
  std::string notes;
  for (const ExpectationRow& row : expectations) {
    const Tone ink = row.met ? Tone::good : Tone::bad;
    rows.push_back({{row.name},
                    {row.statistic},
                    {row.value, row.met ? Tone::plain : Tone::bad},
                    {row.limits},
                    {symbol_of(row.met ? Verdict::within : Verdict::deviates), ink},
                    {expectation_word(row.met), ink}});
    if (!row.note.empty()) notes += paragraph("  " + row.name + ": ", row.note, Tone::faint, style);
  }
  return aligned({{"of this engine"}, {""}, {"value", true}, {"expected"}, {""}, {"", false, 1}},
                 std::move(rows), style, 2 * kIndent) +
         notes;
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
  if (ok) head += fmt::format(", {} phase{}", run.phases, run.phases == 1 ? "" : "s");
  if (const std::string cost = step_cost(run); ok && !cost.empty()) head += ", " + cost;

  std::string result = "\n";
  const auto width = static_cast<std::size_t>(std::max(style.width, 1));
  for (const std::string& line : wrapped(head, width > kIndent ? width - kIndent : 1))
    result += std::string(kIndent, ' ') + inked(line, Tone::strong, style) + '\n';
  if (!ok || (run.expect && run.expect->status)) result += status_block(run, style);
  if (ok) {
    std::vector<ComparisonRow> rows = comparison_rows(scene, run, names);
    const std::size_t count = rows.size();
    if (!style.all_observables) rows = most_severe(std::move(rows), kMostRows);
    const std::size_t left_out = count - rows.size();
    if (!rows.empty()) result += rows_text(rows, style);
    if (left_out > 0) result += paragraph("  … ", more_rows(left_out), Tone::faint, style);
    result += expectations_text(expectation_rows(run), style);
  }
  if (!run.applied.not_represented.empty())
    result += paragraph(
        "  not represented: ", fmt::format("{}", fmt::join(run.applied.not_represented, ", ")),
        Tone::faint, style);
  return result + warnings_text(run.warnings, style);
}

std::string verdict_text(const SceneRecord& scene, const TableStyle& style) {
  const Verdict verdict = scene.verdict();
  const std::string name = verdict_name(scene), loud = word_of(verdict);
  return inked(fmt::format("{} {}", symbol_of(verdict),
                           name == name_of(verdict) && !loud.empty() ? loud : name),
               tone_of(verdict), style);
}

std::string plural(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
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
  const AllVerdicts all = count_verdicts(scenes);
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
          ? fmt::format("; {}: {}", plural(all.run_count, "engine run"), list(all.runs))
          : "";
  return fmt::format("{}: {}{}{}\n", plural(all.scene_count, "scene"), list(all.scenes), alone,
                     runs);
}

}  // namespace slipcheck
