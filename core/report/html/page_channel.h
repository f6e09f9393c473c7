#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>

namespace slipcheck {

/// A number for the page's script, rounded to so many significant digits; null where it is not
/// finite.
nlohmann::json page_number(double value, int digits = 6);

/// A series for the page's script: {"o": o, "s": s, "q": [q_0, …]} stands for the values o + s (q_0
/// + … + q_k), right to half of s, the `steps`-th part of their range; null in q for what is not
/// finite. A number alone where the values differ by no more than `negligible`, >= 0.
nlohmann::json page_channel(std::span<const double> values, double negligible = 0,
                            std::size_t steps = 4000);

}  // namespace slipcheck
