#include "harness/observe/steady_state.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "harness/observe/blocking.h"

namespace slipcheck {
namespace {

constexpr std::size_t kBatch = 5;

/// Batches of which half may be dropped.
std::size_t most_dropped(std::size_t samples) { return samples / kBatch / 2; }

/// Standard errors that a difference may have.
constexpr double kAlarm = 3;

/// Student's factor over the normal one, 1 for many degrees of freedom.
double for_few_blocks(std::size_t degrees_of_freedom) {
  return student_factor95(degrees_of_freedom) / student_factor95(1'000'000'000);
}

}  // namespace

std::size_t mser5_truncation(std::span<const double> series) {
  const std::size_t batches = series.size() / kBatch;
  if (batches < 2) return 0;
  // From the end, so that each truncation adds one batch to the sums (Welford).
  double mean = 0, squares = 0, count = 0;
  double least = 0;
  std::size_t best = most_dropped(series.size());
  for (std::size_t batch = batches; batch-- > 0;) {
    double sum = 0;
    for (std::size_t k = 0; k < kBatch; ++k) sum += series[batch * kBatch + k];
    const double value = sum / kBatch;
    count += 1;
    const double off = value - mean;
    mean += off / count;
    squares += off * (value - mean);
    const double error = squares / (count * count);
    if (batch > most_dropped(series.size())) continue;
    // Of equals the one that keeps more.
    if (batch == most_dropped(series.size()) || error <= least) {
      least = error;
      best = batch;
    }
  }
  return best * kBatch;
}

bool is_steady(std::span<const double> series) {
  const std::size_t half = series.size() / 2;
  if (half < kFewestForAnError) return false;
  const double early = blocked_mean(series.first(half)).mean;
  const BlockedMean late = blocked_mean(series.last(half));
  if (late.plateau)
    return std::abs(early - late.mean) <=
           kAlarm * std::numbers::sqrt2 * late.standard_error * for_few_blocks(late.blocks - 1);

  std::vector<double> rest;
  rest.reserve(2 * half);
  for (double x : series.first(half)) rest.push_back(x - early);
  for (double x : series.last(half)) rest.push_back(x - late.mean);
  const BlockedMean noise = blocked_mean(rest);
  // Of a difference of two means of half as many samples each: √2 √2 times that of all. Both means
  // were taken from the blocks.
  return noise.plateau && std::abs(early - late.mean) <=
                              kAlarm * 2 * noise.standard_error * for_few_blocks(noise.blocks - 2);
}

SteadyState steady_state(std::span<const std::vector<double>> series) {
  SteadyState result;
  if (series.empty()) return result;
  const std::size_t samples = series.front().size();
  for (const auto& one : series) {
    assert(one.size() == samples);
    result.dropped = std::max(result.dropped, mser5_truncation(one));
  }
  result.reached = result.dropped < kBatch * most_dropped(samples) &&
                   std::all_of(series.begin(), series.end(), [&](const auto& one) {
                     return is_steady(std::span(one).subspan(result.dropped));
                   });
  return result;
}

}  // namespace slipcheck
