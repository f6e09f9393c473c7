#include "report/rows/conformance_rows.h"

#include <fmt/format.h>

#include "base/text.h"

namespace slipcheck {
namespace {

constexpr std::size_t kSeenWidth = 52;  // the rest is in the JSON

Cell answer_cell(CheckVerdict verdict) {
  if (verdict == CheckVerdict::passed) return {.text = "passed", .tone = Tone::good, .symbol = "✓"};
  if (verdict == CheckVerdict::failed) return {.text = "FAILED", .tone = Tone::bad, .symbol = "✗"};
  return {.text = "not judged", .tone = Tone::faint, .symbol = "–"};
}

}  // namespace

TextTable conformance_table(const ConformanceReport& report) {
  TextTable table;
  table.columns = {{"check"}, {"", false, 2}, {"seen", false, 1}};
  for (const ConformanceCheck& check : report.checks) {
    const bool failed = check.verdict == CheckVerdict::failed;
    table.rows.push_back({{check.name},
                          answer_cell(check.verdict),
                          {failed ? "" : shortened(check.why, kSeenWidth)}});
    if (failed)
      table.notes.push_back({check.name, fmt::format("{}. To mend: {}", check.why, check.mend)});
  }
  return table;
}

std::string conformance_counts(const ConformanceReport& report) {
  using enum CheckVerdict;
  return fmt::format("{} passed, {} failed, {} not judged", report.count(passed),
                     report.count(failed), report.count(not_judged));
}

}  // namespace slipcheck
