#include "harness/observe/blocking.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace slipcheck {
namespace {

constexpr std::size_t kFewestBlocks = 6;

/// Variance of one sample, unbiased, and of the mean of all from blocks of `size` samples; what
/// does not fill a block is left out at the start. sums[i] is that of the first i samples less
/// `shift`.
double variance_of_mean(const std::vector<double>& sums, std::size_t size) {
  const std::size_t n = sums.size() - 1;
  const std::size_t blocks = n / size;
  const std::size_t first = n - blocks * size;
  const double mean = (sums[n] - sums[first]) / static_cast<double>(blocks * size);
  double squares = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t at = first + b * size;
    const double off = (sums[at + size] - sums[at]) / static_cast<double>(size) - mean;
    squares += off * off;
  }
  return squares / (static_cast<double>(blocks) * static_cast<double>(blocks - 1));
}

}  // namespace

double student_factor95(std::size_t degrees_of_freedom) {
  constexpr double z = 1.959963984540054;
  constexpr double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z, z9 = z7 * z * z;
  const double r = 1 / static_cast<double>(degrees_of_freedom);
  const double g1 = (z3 + z) / 4;
  const double g2 = (5 * z5 + 16 * z3 + 3 * z) / 96;
  const double g3 = (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / 384;
  const double g4 = (79 * z9 + 776 * z7 + 1482 * z5 - 1920 * z3 - 945 * z) / 92160;
  return z + r * (g1 + r * (g2 + r * (g3 + r * g4)));
}

double BlockedMean::half_width95() const {
  return blocks > 3 ? student_factor95(blocks - 1) * standard_error : kNotObserved;
}

BlockedMean blocked_mean(std::span<const double> series) {
  BlockedMean result;
  const std::size_t n = series.size();
  result.samples = n;
  if (n == 0) return result;

  // Less the first sample, so that a constant series has no scatter from rounding.
  const double shift = series.front();
  std::vector<double> sums(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) sums[i + 1] = sums[i] + (series[i] - shift);
  const auto count = static_cast<double>(n);
  result.mean = shift + sums[n] / count;
  if (n < kFewestForAnError || !std::isfinite(result.mean)) return result;

  const double uncorrelated = variance_of_mean(sums, 1);
  if (uncorrelated == 0) {
    result.standard_error = 0;
    result.correlation_time = 0.5;
    result.effective_samples = count;
    result.blocks = n;
    result.plateau = true;
    return result;
  }
  double variance = 0;
  for (double exact = 1; !result.plateau; exact *= std::sqrt(2.0)) {
    const auto size = static_cast<std::size_t>(std::lround(exact));
    if (n / size < kFewestBlocks) break;
    const double now = variance_of_mean(sums, size);
    const double g = now / uncorrelated;
    const auto b = static_cast<double>(size);
    result.plateau = b * b * b > 2 * count * g * g;
    // Without a plateau the largest error seen is the nearest to the true one.
    if (result.plateau || now > variance) {
      variance = now;
      result.blocks = n / size;
    }
  }
  variance = std::max(variance, uncorrelated / count);
  result.standard_error = std::sqrt(variance);
  const double g = variance / uncorrelated;
  result.correlation_time = 0.5 * g;
  result.effective_samples = std::min(count, count / g);
  return result;
}

}  // namespace slipcheck
