#include "reference/steps/step_neighbours.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "reference/steps/step_solver.h"

namespace slipcheck {

void StepNeighbours::move(double way, const StepWorld& world) {
  if (!(way <= largest_))
    throw StepTooLong(
        fmt::format("a body moves by more than a radius in a step, at {:.9g} s", world.time()));
  left_ -= 2 * way;
}

std::vector<StepNeighbour> StepNeighbours::search(const StepWorld& world) {
  std::vector<NearSphere> spheres;
  spheres.reserve(world.bodies.size());
  double mean = 0, fastest2 = 0;
  for (const StepBody& b : world.bodies) {
    spheres.push_back({b.position, b.radius});
    largest_ = std::max(largest_, b.radius);
    mean += b.radius / static_cast<double>(world.bodies.size());
    fastest2 = std::max(fastest2, b.velocity.squaredNorm());
  }
  const double skin = near_skin(std::sqrt(fastest2), world.step, mean);
  const std::vector<NearPair> pairs = near_pairs(spheres, skin, periodic_, &team_);
  // They come by the first: counted by the second they stay so among those of one second.
  std::vector<std::uint32_t> next(spheres.size() + 1, 0);
  for (const NearPair& pair : pairs) ++next[pair.second + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<StepNeighbour> found(pairs.size());
  for (const NearPair& pair : pairs) {
    StepNeighbour& near = found[next[pair.second]++];
    near.first = pair.first;
    near.second = pair.second;
    for (int k = 0; k < 2; ++k)
      if (periodic_[k] > 0) {
        const double apart = spheres[pair.first].position[k] - spheres[pair.second].position[k];
        near.shift[k] = periodic_[k] * std::round(apart / periodic_[k]);
      }
  }
  left_ = skin;
  return found;
}

}  // namespace slipcheck
