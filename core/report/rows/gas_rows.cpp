#include "report/rows/gas_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace slipcheck {
namespace {

constexpr std::size_t kShown = 10;

/// With the digits that its error leaves, "-0.0155 ± 0.0002".
std::string with_error(const Measured& measured) {
  if (!std::isfinite(measured.value)) return "–";
  if (!(measured.error > 0)) return fmt::format("{:.6g}", measured.value);
  const int decimals = static_cast<int>(
      std::clamp(std::ceil(-std::log10(measured.error)) + (measured.error < 1 ? 1 : 0), 0.0, 15.0));
  return fmt::format("{:.{}f} ± {:.{}f}", measured.value, decimals, measured.error, decimals);
}

std::string number_or_dash(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "–";
}

}  // namespace

TextTable gas_course(const GasRun& run) {
  TextTable table;
  for (const char* head : {"collisions/particle", "time [s]", "T [J]", "T_rot [J]", "T_rot/T",
                           "a_2", "T mean field [J]"})
    table.columns.push_back({head, true});
  const std::size_t count = run.samples.size();
  const std::size_t rows = std::min(kShown, count);
  for (std::size_t r = 0; r < rows; ++r) {
    const GasSample& sample = run.samples[rows > 1 ? r * (count - 1) / (rows - 1) : 0];
    table.rows.push_back({{fmt::format("{:.2f}", sample.collisions)},
                          {fmt::format("{:.4g}", sample.time)},
                          {fmt::format("{:.5g}", sample.translation.value)},
                          {number_or_dash(sample.rotation.value, "{:.5g}")},
                          {number_or_dash(sample.ratio.value, "{:.4f}")},
                          {with_error(sample.a2)},
                          {fmt::format("{:.5g}", sample.mean_field.translation)}});
  }
  return table;
}

TextTable gas_statements(const GasRun& run) {
  TextTable table;
  table.columns = {{"statement"}, {"measured", true}, {"theory", true}, {"of"}};
  for (const GasStatement& statement : run.statements)
    table.rows.push_back({{statement.name},
                          {with_error(statement.measured)},
                          {number_or_dash(statement.theory, "{:.6g}")},
                          {statement.source}});
  return table;
}

}  // namespace slipcheck
