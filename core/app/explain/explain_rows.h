#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "report/rows/quantity.h"
#include "report/terminal/text.h"

namespace slipcheck {

/// One line of `slipcheck explain`: "    t_col        25.50 µs  duration of a collision".
inline void print_row(std::string_view symbol, std::string_view value, std::string_view meaning) {
  fmt::print("    {}  {}  {}\n", padded(symbol, 12), padded(value, 14, true), meaning);
}

/// A number in an SI unit that takes no prefixes, "1.9993e+06 N/m".
inline std::string in_unit(double value, std::string_view unit) {
  return std::isinf(value) ? "∞" : fmt::format("{:.5g} {}", value, unit);
}

/// A pure number with five digits.
inline std::string pure(double value) { return fmt::format("{:.5g}", value); }

}  // namespace slipcheck
