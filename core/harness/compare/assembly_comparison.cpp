#include "harness/compare/assembly_comparison.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "harness/observe/blocking.h"

namespace slipcheck {
namespace {

using SamplePair = std::pair<std::size_t, std::size_t>;

/// Of the second half of the engine's run, with the reference's sample nearest to each.
std::vector<SamplePair> pairs_in_second_half(const std::vector<double>& reference,
                                             const std::vector<double>& engine) {
  std::vector<SamplePair> pairs;
  if (reference.empty() || engine.size() < 2) return pairs;
  const double end = engine.back(), apart = end / static_cast<double>(engine.size() - 1);
  std::size_t k = 0;
  for (std::size_t n = 0; n < engine.size(); ++n) {
    if (engine[n] < 0.5 * end) continue;
    const auto distance = [&](std::size_t at) { return std::abs(reference[at] - engine[n]); };
    while (k + 1 < reference.size() && distance(k + 1) <= distance(k)) ++k;
    if (distance(k) <= 0.5 * apart) pairs.emplace_back(k, n);
  }
  return pairs;
}

AssemblyMean mean_of(const std::vector<double>& series) {
  const BlockedMean mean = blocked_mean(series);
  return {mean.mean, mean.standard_error};
}

}  // namespace

std::vector<AssemblyDifference> assembly_differences(const Assembly& reference,
                                                     const Assembly& engine) {
  const std::vector<SamplePair> pairs = pairs_in_second_half(reference.time, engine.time);
  std::vector<AssemblyDifference> all;
  if (pairs.empty()) return all;
  for (const AssemblyQuantity& quantity : assembly_quantities()) {
    std::vector<double> first, second, off;
    for (const auto& [k, n] : pairs) {
      first.push_back(quantity.of(reference.states[k]));
      second.push_back(quantity.of(engine.states[n]));
      off.push_back(second.back() - first.back());
    }
    all.push_back({&quantity, mean_of(first), mean_of(second), mean_of(off)});
  }
  return all;
}

}  // namespace slipcheck
