#pragma once

#include <vector>

namespace slipcheck {

inline constexpr double kCentimetre = 1e-2;  ///< [m]

// Columns of a figure's table.

/// `count` numbers, >= 2, from `first` to `last`, equally far apart, or their logarithms.
std::vector<double> equally_spaced(double first, double last, std::size_t count);
std::vector<double> logarithmically_spaced(double first, double last, std::size_t count);

/// a − b, row by row.
std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b);
std::vector<double> scaled(std::vector<double> values, double factor);

}  // namespace slipcheck
