#include "studies/precision/work_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <string>
#include <utility>

#include "engine/worker_process.h"
#include "harness/compare/comparison.h"
#include "harness/run/cpu_time.h"
#include "studies/precision/pinned_thread.h"

namespace slipcheck {
namespace {

/// Long beside the clock's microsecond.
constexpr double kLeastSeconds = 1e-3;

}  // namespace

void time_in_turn(std::vector<TimedWork>& works, std::size_t repeats,
                  const std::atomic<bool>* stop) {
  const PinnedThread pinned;
  std::vector<std::vector<double>> seconds(works.size());
  std::vector<bool> failed(works.size(), false);
  for (std::size_t round = 0; round < repeats; ++round)
    for (std::size_t k = 0; k < works.size(); ++k) {
      if (stop != nullptr && *stop) break;
      if (failed[k]) continue;
      try {
        seconds[k].push_back(works[k].once());
      } catch (const Interrupted&) {
        break;
      } catch (const std::exception& error) {
        failed[k] = true;
        works[k].point->reason = fmt::format("not timed: {}", error.what());
      }
    }
  for (std::size_t k = 0; k < works.size(); ++k) {
    if (failed[k] || seconds[k].empty()) continue;
    const double least = std::ranges::min(seconds[k]);
    WorkCost cost;
    cost.per_step = least / works[k].steps;
    cost.per_simulated_second = cost.per_step * works[k].steps_per_second;
    cost.repeats = seconds[k].size();
    if (least > 0) cost.spread = (median(std::move(seconds[k])) - least) / least;
    works[k].point->cost = cost;
  }
}

double least_cpu_seconds(const std::function<void()>& run) {
  double least = std::numeric_limits<double>::infinity(), total = 0;
  while (total < kLeastSeconds) {
    const double begin = thread_cpu_seconds();
    run();
    const double taken = thread_cpu_seconds() - begin;
    least = std::min(least, taken);
    total += std::max(taken, 1e-7);  // ends even where the clock stands still
  }
  return least;
}

}  // namespace slipcheck
