#pragma once

#include <concepts>
#include <limits>

namespace slipcheck::test {

/// The largest and the least of the values. std::max() and std::min() lose a NaN, or keep it, by
/// where it stands; these are NaN as soon as one value is, and no expectation holds for NaN.
template <std::floating_point... More>
double largest_of(double first, More... more) {
  double largest = first;
  for (const double value : {first, static_cast<double>(more)...})
    if (!(value <= largest))
      largest = value > largest ? value : std::numeric_limits<double>::quiet_NaN();
  return largest;
}

template <std::floating_point... More>
double least_of(double first, More... more) {
  return -largest_of(-first, -more...);
}

}  // namespace slipcheck::test
