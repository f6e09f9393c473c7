#include "studies/sweep/sweep_samples.h"

#include <boost/random/sobol.hpp>
#include <numeric>
#include <random>
#include <utility>

namespace slipcheck {
namespace {

/// In [0, 1): the upper 53 bits, as no standard distribution is the same everywhere.
double unit_interval(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

}  // namespace

std::vector<double> latin_hypercube(std::size_t points, std::size_t dimensions,
                                    std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> cube(points * dimensions);
  std::vector<std::size_t> order(points);
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t k = points; k > 1; --k) {
      const double place = unit_interval(random()) * static_cast<double>(k);
      std::swap(order[k - 1], order[static_cast<std::size_t>(place)]);
    }
    for (std::size_t k = 0; k < points; ++k)
      cube[k * dimensions + d] =
          (static_cast<double>(order[k]) + unit_interval(random())) / static_cast<double>(points);
  }
  return cube;
}

std::vector<double> sobol_points(std::size_t points, std::size_t dimensions) {
  boost::random::sobol sequence(dimensions);
  std::vector<double> cube(points * dimensions);
  for (double& coordinate : cube) coordinate = unit_interval(sequence());
  return cube;
}

}  // namespace slipcheck
