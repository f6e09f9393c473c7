#include "report/rows/expectation_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/rows/comparison_rows.h"
#include "report/rows/quantity.h"
#include "report/rows/selection.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {
namespace {

using Statistic = ExpectationResult::Statistic;

ExpectationRow row_of(const ExpectationResult& result) {
  ExpectationRow row;
  row.name = result.observable;
  row.met = result.met;
  const bool is_seen = !std::isnan(result.value);
  row.value = {"", result.met ? Tone::plain : Tone::bad, result.value};
  if (result.statistic == Statistic::none) {
    row.limits = {"not seen"};
    row.value.text = is_seen ? quantity(result.value, dimension_of(result.observable)) : "–";
  } else {
    const double magnitude = std::max(std::abs(result.low), std::abs(result.high));
    const QuantityFormat format(magnitude, dimension_of(result.observable));
    row.statistic = name_of(result.statistic);
    row.value.text = format.number(result.value);
    row.limits = {format.number(result.low) + " … " + format.text(result.high), Tone::plain,
                  result.low};
  }
  if (!result.met) row.note = result.reason;
  return row;
}

}  // namespace

std::vector<ExpectationRow> expectation_rows(const EngineRecord& run) {
  std::vector<ExpectationRow> rows;
  if (run.status != RunStatus::ok) return rows;
  for (const ExpectationResult& result : run.expectations()) rows.push_back(row_of(result));
  return rows;
}

TextTable expectation_table(const EngineRecord& run) {
  TextTable table{
      {{"of this engine"}, {""}, {"value", true}, {"expected", true}, {"verdict", false, 1}},
      {},
      "What is expected of " + run_name(run)};
  for (const ExpectationRow& row : expectation_rows(run)) {
    table.rows.push_back(
        {{row.name},
         {row.statistic},
         row.value,
         row.limits,
         verdict_cell(row.met ? Verdict::within : Verdict::deviates, expectation_word(row.met))});
    if (!row.note.empty()) table.notes.push_back({row.name, row.note});
  }
  return table;
}

const char* expectation_word(bool met) { return met ? "as expected" : "NOT AS EXPECTED"; }

std::string outcome_text(const EngineRecord& run) {
  if (run.expect && run.expect->status) {
    const std::string ended =
        run.status == RunStatus::ok ? "ran to its end" : status_text(run.status);
    const bool met = run.verdict() == Verdict::within;
    std::string text = ended + ", " + expectation_word(met);
    return met ? text : text + " (" + status_text(*run.expect->status) + ")";
  }
  if (run.status != RunStatus::ok) return status_text(run.status);
  if (run.expect) return expectation_word(run.verdict() == Verdict::within);
  return word_of(run.verdict());
}

std::string unmet_expectation(const EngineRecord& run, bool with_limits) {
  if (!run.expect || run.verdict() == Verdict::within) return {};
  if (run.expect->status) return outcome_text(run);
  for (const ExpectationRow& row : expectation_rows(run)) {
    if (row.met) continue;
    const std::string statistic = row.statistic.empty() ? "" : " " + row.statistic;
    std::string seen = row.name + statistic + " " + row.value.text;
    if (!with_limits) return seen;
    const std::string note = row.note.empty() ? "" : " (" + row.note + ")";
    return fmt::format("{}, expected {}{}", seen, row.limits.text, note);
  }
  return {};
}

bool is_judged_by_expectations(const SceneRecord& scene) {
  return !scene.runs.empty() &&
         std::all_of(scene.runs.begin(), scene.runs.end(),
                     [](const EngineRecord& run) { return run.expect.has_value(); });
}

}  // namespace slipcheck
