#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace slipcheck {

/// Where a series that starts far from its steady state has come to it.
struct SteadyState {
  std::size_t dropped = 0;  ///< samples at the start that still remember it
  /// The rest holds no trend that its errors would show, and is long enough to tell.
  bool reached = false;
};

/// How many samples to drop: MSER-5 (White, Simulation 69, 323 (1997); White, Cobb and Spratt,
/// Winter Simulation Conference 2000). Over the means of batches of 5 samples, the truncation that
/// makes the squared standard error of the remaining mean, taken as independent, smallest. A
/// multiple of 5, at most half of the series; a minimum that sits at this end is no steady state,
/// and steady_state() says so.
std::size_t mser5_truncation(std::span<const double> series);

/// Whether the means of both halves agree, as Geweke (Bayesian Statistics 4, 169 (1992)) compares
/// the ends of a chain: within 3 standard errors of their difference, widened as Student's factor
/// for few blocks. The errors are by blocking (blocking.h) of the late half, which the start spoils
/// least; where it is too short for a plateau, of both halves in a row, each less its mean. A trend
/// keeps either from a plateau: then, and below 64 samples, false. A difference that one sample
/// could make does not count.
bool is_steady(std::span<const double> series);

/// Of several series of one run, sampled together and of one length: the largest truncation that
/// one of them asks for, and whether all are steady behind it.
SteadyState steady_state(std::span<const std::vector<double>> series);

}  // namespace slipcheck
