#include "reference/steps/step_neighbours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "reference/space_curve.h"
#include "reference/steps/step_solver.h"

namespace slipcheck {
namespace {

/// So many bodies no longer fit into the caches next to a core.
constexpr std::size_t kOrderedFrom = 1000;
/// In which none comes far.
constexpr std::size_t kSearchesInAnOrder = 32;

/// Kinds as their bodies will be stored, taken `from` these places: where each has its own they are
/// read one after the other.
void put_kinds_in_order(StepWorld& world, const std::vector<std::uint32_t>& from) {
  if (world.kinds.size() < world.bodies.size() / 8) return;  // a few, which stay in the caches
  std::vector<StepKind> kinds;
  kinds.reserve(world.kinds.size());
  std::vector<const StepKind*> to(world.kinds.size(), nullptr);
  for (const std::uint32_t k : from) {
    const StepKind*& of = to[static_cast<std::size_t>(world.bodies[k].kind - world.kinds.data())];
    if (!of) {
      kinds.push_back(*world.bodies[k].kind);
      of = &kinds.back();
    }
    world.bodies[k].kind = of;
  }
  world.kinds = std::move(kinds);
}

/// Those that are near each other near each other.
void put_in_order(StepWorld& world, const Vector2& periodic) {
  const std::size_t bodies = world.bodies.size();
  double largest = 0;
  for (const StepBody& b : world.bodies) largest = std::max(largest, b.radius);
  const std::vector<std::uint64_t> curve = on_space_curve(world.bodies, periodic, 2 * largest);
  std::vector<std::uint32_t> from(bodies);
  std::iota(from.begin(), from.end(), 0);
  std::ranges::sort(from, {}, [&](std::uint32_t k) { return std::pair(curve[k], k); });
  std::vector<std::uint32_t> number(bodies);
  for (std::size_t k = 0; k < bodies; ++k)
    number[k] = static_cast<std::uint32_t>(world.number_of(from[k]));
  world.number = std::move(number);
  world.place.resize(bodies);
  for (std::size_t k = 0; k < bodies; ++k)
    world.place[world.number[k]] = static_cast<std::uint32_t>(k);
  put_kinds_in_order(world, from);
  // Round by round of the permutation, without a second array of bodies.
  for (std::uint32_t k = 0; k < bodies; ++k) {
    if (from[k] == k) continue;
    const StepBody held = world.bodies[k];
    std::uint32_t to = k;
    while (from[to] != k) {
      world.bodies[to] = world.bodies[from[to]];
      to = std::exchange(from[to], to);
    }
    world.bodies[to] = held;
    from[to] = to;
  }
}

}  // namespace

void StepNeighbours::move(double way, const StepWorld& world) {
  if (!(way <= largest_))
    throw StepTooLong(
        fmt::format("a body moves by more than a radius in a step, at {:.9g} s", world.time()));
  left_ -= 2 * way;
}

void StepNeighbours::search(StepWorld& world) {
  if (world.bodies.size() >= kOrderedFrom && searches_++ % kSearchesInAnOrder == 0)
    put_in_order(world, periodic_);
  const std::vector<StepBody>& bodies = world.bodies;
  double mean = 0, fastest2 = 0;
  for (const StepBody& b : bodies) {
    largest_ = std::max(largest_, b.radius);
    mean += b.radius / static_cast<double>(bodies.size());
    fastest2 = std::max(fastest2, b.velocity.squaredNorm());
  }
  const double skin = near_skin(std::sqrt(fastest2), world.step, mean);
  const NearSpheres spheres{bodies.size(), [&](std::size_t k) {
                              return NearSphere{bodies[k].position, bodies[k].radius};
                            }};
  const std::vector<NearPair> pairs = near_pairs(spheres, skin, periodic_, &team_);
  // They come by the first: counted by the second they stay so among those of one second.
  std::vector<std::uint32_t> next(bodies.size() + 1, 0);
  for (const NearPair& pair : pairs) ++next[pair.second + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  all_.resize(pairs.size());
  for (const NearPair& pair : pairs) {
    StepNeighbour& near = all_[next[pair.second]++];
    near.first = pair.first;
    near.second = pair.second;
    if (world.number_of(near.first) > world.number_of(near.second))
      std::swap(near.first, near.second);
    near.shift.setZero();
    for (int k = 0; k < 2; ++k)
      if (periodic_[k] > 0) {
        const double apart = bodies[near.first].position[k] - bodies[near.second].position[k];
        near.shift[k] = periodic_[k] * std::round(apart / periodic_[k]);
      }
  }
  left_ = skin;
}

}  // namespace slipcheck
