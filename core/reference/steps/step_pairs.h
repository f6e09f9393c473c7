#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "base/flatten.h"
#include "base/state_archive.h"
#include "reference/steps/step_contact.h"
#include "reference/steps/step_laws.h"
#include "reference/steps/step_neighbours.h"
#include "reference/steps/step_shares.h"

namespace slipcheck {

/// The contacts of StepLoop's bodies with each other: of all pairs, or of StepNeighbours in the
/// same order, that in which bodies are stored: what is far apart adds nothing, so that both give
/// the same bits. So does any number of threads: what a share's pairs do to a body of a share
/// before comes after all pairs of that share, and is kept until it is done.
template <class Normal, class Tangential>
class StepPairs {
 public:
  using Pair = StepContact<Normal, Tangential>;
  using Law = typename Pair::Law;
  using Push = typename Pair::Push;

  /// Of all pairs of so many bodies.
  StepPairs(StepLaws<Normal, Tangential> laws, std::size_t bodies)
      : laws_(std::move(laws)), pairs_(bodies * (bodies - 1) / 2) {
    laws_.find_for_all_pairs();
  }
  /// Of neighbours, which are not found yet.
  explicit StepPairs(StepLaws<Normal, Tangential> laws) : laws_(std::move(laws)) {}

  /// Those of neighbours are found before they are read.
  void exchange(StateArchive& archive) { archive(pairs_); }

  /// After others are neighbours than before.
  void take(StepNeighbours& neighbours, const StepWorld& world) { laws_.find(neighbours, world); }

  /// What all pairs do to their bodies now, and nothing else does.
  void meet(StepWorld& world) {
    const std::span<StepBody> bodies = world.bodies;
    for (StepBody& b : bodies) b.forget_forces();
    world.touching = 0;
    StepTally tally;
    auto pair = pairs_.begin();
    for (auto b = bodies.begin(); b != bodies.end(); ++b)
      for (auto a = bodies.begin(); a != b; ++a, ++pair)
        pair->step(
            world, *a, *b, a->position - b->position,
            [&]() -> const Law& { return laws_[static_cast<std::size_t>(pair - pairs_.begin())]; },
            tally,
            [&](const Push& push) {
              push.on(*a, false);
              push.on(*b, true);
            });
    count(tally, world);
  }

  /// What neighbours do to their bodies, on which StepBodies has left no forces.
  void meet(StepWorld& world, StepNeighbours& neighbours, StepShares& shares) {
    if (!neighbours.cover()) {
      neighbours.find(world, pairs_, [](const Pair& pair) { return pair.touching(); });
      take(neighbours, world);
      shares.divide(neighbours, world.bodies.size());
    }
    outside_.resize(shares.all().size());
    shares.run(neighbours.team(), [&](StepShare& share, std::size_t begin, std::size_t end) {
      meet_share(world, neighbours.all(), share, begin, end);
    });
    world.touching = 0;
    for (const StepShare& share : shares.all()) {
      for (const OutsidePush& each : outside_[share.number].pushes)
        each.push.on(world.bodies[each.stored], each.is_second);
      count(share.tally, world);
    }
  }

  /// Adds those that push each other. neighbours: null: all pairs.
  void show(const StepWorld& world, const StepNeighbours* neighbours,
            std::vector<Touch>& touches) const {
    const auto before = static_cast<std::ptrdiff_t>(touches.size());
    std::size_t k = 0;
    const auto show_pair = [&](std::size_t i, std::size_t j) {
      const Pair& pair = pairs_[k++];
      const double impulse = std::abs(pair.normal_force()) * world.step;
      if (pair.touching() && impulse > 0)
        touches.push_back(
            {static_cast<int>(world.number_of(i)), static_cast<int>(world.number_of(j)), impulse});
    };
    if (neighbours) {
      for (const StepNeighbour& near : neighbours->all()) show_pair(near.first, near.second);
    } else {
      for (std::size_t j = 1; j < world.bodies.size(); ++j)
        for (std::size_t i = 0; i < j; ++i) show_pair(i, j);
    }
    if (world.number.empty()) return;
    std::sort(touches.begin() + before, touches.end(), [](const Touch& a, const Touch& b) {
      return std::tie(a.second, a.first) < std::tie(b.second, b.first);
    });
  }

 private:
  /// A push on a body of another share.
  struct OutsidePush {
    std::size_t stored;
    bool is_second;
    Push push;
  };
  struct alignas(64) OutsidePushes {
    std::vector<OutsidePush> pushes;
  };

  static void count(const StepTally& tally, StepWorld& world) {
    world.touching += tally.touching;
    world.collisions += tally.collisions;
  }

  /// The share's bodies are those from `begin` to before `end`.
  ///
  /// Flat, but for what begins and ends, as StepBodies is: in a large unit the compiler leaves
  /// calls for sums of vectors, which pass them through memory.
  [[gnu::noinline]] SLIPCHECK_FLATTEN void meet_share(StepWorld& world,
                                                      const std::vector<StepNeighbour>& all,
                                                      StepShare& share, std::size_t begin,
                                                      std::size_t end) {
    std::vector<OutsidePush>& outside = outside_[share.number].pushes;
    outside.clear();
    StepTally tally;
    for (std::size_t k = share.pairs; k < all.size() && all[k].further() < end; ++k) {
      const StepNeighbour& near = all[k];
      const StepBody &a = world.bodies[near.first], &b = world.bodies[near.second];
      const auto push_one = [&](const Push& push, std::size_t stored, bool is_second) {
        if (stored < begin) [[unlikely]]
          outside.push_back({stored, is_second, push});
        else
          push.on(world.bodies[stored], is_second);
      };
      Vector3 between = a.position - b.position;
      between.head<2>() -= near.shift;
      pairs_[k].step(
          world, a, b, between, [&]() -> const Law& { return laws_[k]; }, tally,
          [&](const Push& push) {
            push_one(push, near.first, false);
            push_one(push, near.second, true);
          });
    }
    share.tally = tally;
  }

  StepLaws<Normal, Tangential> laws_;
  std::vector<Pair> pairs_;             ///< by neighbours, or by (j, i) with i < j
  std::vector<OutsidePushes> outside_;  ///< by share
};

}  // namespace slipcheck
