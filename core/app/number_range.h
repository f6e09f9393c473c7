#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <string>

namespace slipcheck {

/// Takes numbers in [least, most] and, unlike CLI::Range, no NaN, which is neither below nor above.
/// `name` stands for the range in the help; else it is written out.
inline CLI::Validator number_range(double least, double most, const std::string& name = {}) {
  const CLI::Range range(least, most, name);
  const auto check = [range](std::string& text) {
    double value = 0;
    if (CLI::detail::lexical_cast(text, value) && std::isnan(value))
      return fmt::format("Value {} is not a number", text);
    return range(text);
  };
  return CLI::Validator(check, range.get_description());
}

/// Takes finite numbers > 0.
inline CLI::Validator positive_number() {
  return number_range(std::numeric_limits<double>::min(), std::numeric_limits<double>::max(),
                      "POSITIVE");
}

/// Takes finite numbers >= 0.
inline CLI::Validator non_negative_number() {
  return number_range(0, std::numeric_limits<double>::max(), "NONNEGATIVE");
}

}  // namespace slipcheck
