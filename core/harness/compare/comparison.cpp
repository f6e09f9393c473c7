#include "harness/compare/comparison.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "harness/observe/observables.h"

namespace slipcheck {
namespace {

/// One statistic of the ensemble's value of an observable, which is null if no phase shows it.
ExpectationResult range_result(const std::string& name, ExpectationResult::Statistic statistic,
                               const ExpectedRange& range, const EnsembleValue* seen) {
  using Statistic = ExpectationResult::Statistic;
  ExpectationResult result{.observable = name,
                           .statistic = statistic,
                           .low = range.low,
                           .high = range.high,
                           .value = kNotObserved,
                           .reason = ""};
  if (!seen) {
    result.reason = "no phase shows it";
    return result;
  }
  result.value = statistic == Statistic::min   ? seen->min
                 : statistic == Statistic::max ? seen->max
                                               : seen->median;
  if (seen->missing > 0) result.reason = missing_phases(*seen);
  result.met = seen->missing == 0 && range.low <= result.value && result.value <= range.high;
  return result;
}

ExpectationResult none_result(const std::string& name, const EnsembleValue* seen) {
  return {.observable = name,
          .value = seen ? seen->median : kNotObserved,
          .met = !seen,
          .reason = seen ? (seen->missing > 0 ? missing_phases(*seen) : "every phase shows it")
                         : "no phase shows it"};
}

}  // namespace

double median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(half),
                   values.end());
  const double upper = values[half];
  if (values.size() % 2 == 1) return upper;
  const double lower =
      *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(half));
  return 0.5 * (lower + upper);
}

double root_mean_square(std::span<const double> values) {
  // Over the largest, that squares neither vanish nor overflow.
  double largest = 0, sum = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  if (largest == 0) return 0;
  for (const double value : values) sum += (value / largest) * (value / largest);
  return largest * std::sqrt(sum / static_cast<double>(values.size()));
}

std::map<std::string, EnsembleValue> ensemble_values(
    const std::vector<std::map<std::string, double>>& phases) {
  std::map<std::string, EnsembleValue> ensemble;
  for (std::size_t p = 0; p < phases.size(); ++p)
    for (const auto& [name, value] : phases[p]) {
      auto& values = ensemble[name].values;
      values.resize(phases.size(), kNotObserved);
      values[p] = value;
    }
  for (auto& [name, value] : ensemble) {
    std::vector<double> shown;
    for (double v : value.values)
      if (!std::isnan(v)) shown.push_back(v);
    value.missing = value.values.size() - shown.size();
    value.median = median(shown);
    const auto [low, high] = std::minmax_element(shown.begin(), shown.end());
    value.min = *low;
    value.max = *high;
  }
  return ensemble;
}

void note_heading_spreads(std::map<std::string, EnsembleValue>& ensemble, std::size_t headings) {
  if (headings < 2) return;
  for (auto& [name, value] : ensemble) {
    const std::size_t phases = value.values.size() / headings;
    for (std::size_t p = 0; p < phases; ++p) {
      double low = kNotObserved, high = kNotObserved;
      std::size_t shown = 0;
      for (std::size_t h = 0; h < headings; ++h) {
        const double seen = value.values[h * phases + p];
        shown += std::isnan(seen) ? 0 : 1;
        low = std::fmin(low, seen);
        high = std::fmax(high, seen);
      }
      if (shown < 2) continue;
      if (!value.headings || high - low > value.headings->spread)
        value.headings = {.spread = high - low, .phase = p};
    }
  }
}

std::vector<ExpectationResult> expectation_results(
    const Expectation& expectation, const std::map<std::string, EnsembleValue>& ensemble) {
  using Statistic = ExpectationResult::Statistic;
  std::vector<ExpectationResult> results;
  for (const auto& [name, expected] : expectation.observables) {
    const auto found = ensemble.find(name);
    const EnsembleValue* seen = found == ensemble.end() ? nullptr : &found->second;
    if (expected.none) results.push_back(none_result(name, seen));
    if (expected.min) results.push_back(range_result(name, Statistic::min, *expected.min, seen));
    if (expected.median)
      results.push_back(range_result(name, Statistic::median, *expected.median, seen));
    if (expected.max) results.push_back(range_result(name, Statistic::max, *expected.max, seen));
  }
  return results;
}

}  // namespace slipcheck
