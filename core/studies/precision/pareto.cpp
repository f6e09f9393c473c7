#include "studies/precision/pareto.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace slipcheck {

std::vector<bool> pareto_front(std::span<const double> costs, std::span<const double> errors) {
  assert(costs.size() == errors.size());
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < costs.size(); ++k)
    if (std::isfinite(costs[k]) && std::isfinite(errors[k])) order.push_back(k);
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return costs[a] != costs[b] ? costs[a] < costs[b] : errors[a] < errors[b];
  });
  // From cheap to dear, only what is better than all before is on the front.
  std::vector<bool> front(costs.size(), false);
  double best = std::numeric_limits<double>::infinity(), cost_of_best = best;
  for (const std::size_t k : order) {
    if (errors[k] > best || (errors[k] == best && costs[k] > cost_of_best)) continue;
    front[k] = true;
    best = errors[k];
    cost_of_best = costs[k];
  }
  return front;
}

}  // namespace slipcheck
