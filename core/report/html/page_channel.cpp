#include "report/html/page_channel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace slipcheck {

using Json = nlohmann::json;

namespace {

double rounded(double value, int digits) {
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

}  // namespace

Json page_number(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  const double result = rounded(value, digits);
  // A whole number is shorter without its ".0".
  if (result == std::trunc(result) && std::abs(result) < 1e9)
    return static_cast<std::int64_t>(result);
  return result;
}

Json page_channel(std::span<const double> values, double negligible, std::size_t steps) {
  double low = INFINITY, high = -INFINITY;
  bool whole = true;
  for (const double value : values) {
    whole &= std::isfinite(value);
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const double range = high - low;
  // Rounding errors are no range either.
  const bool is_level = range <= std::max(negligible, 1e-12 * std::max(-low, high));
  if (whole && is_level && low <= high) return page_number(0.5 * low + 0.5 * high, 9);

  const double origin = low <= high ? rounded(low, 12) : 0;
  const double step =
      is_level || !std::isfinite(range) ? 1 : rounded(range / static_cast<double>(steps), 4);
  Json deltas = Json::array();
  std::int64_t sum = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) {
      deltas.push_back(nullptr);
      continue;
    }
    const std::int64_t level =
        is_level || !std::isfinite(range) ? 0 : std::llround((value - origin) / step);
    deltas.push_back(level - sum);
    sum = level;
  }
  return {{"o", page_number(origin, 12)}, {"s", page_number(step)}, {"q", std::move(deltas)}};
}

}  // namespace slipcheck
