#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/flatten.h"
#include "base/stop_scope.h"
#include "physics/numbers.h"
#include "reference/steps/step_contact.h"
#include "reference/steps/step_laws.h"
#include "reference/steps/step_neighbours.h"
#include "reference/steps/step_shares.h"

namespace slipcheck {

/// The steps x_{n+1} = x_n + h v_{n+1/2}, v_{n+1/2} = v_{n−1/2} + (h/m) F(x_n, ṽ_n) (velocity
/// Verlet with its two half kicks in one) with ṽ_n = v_{n−1/2} + ½ (v_{n−1/2} − v_{n−3/2}), which
/// makes damped motion second order too.
///
/// A few bodies go over all pairs; more of them, and those on a periodic plane, over StepNeighbours
/// in the same order, that in which bodies are stored: what is far apart adds nothing, so that both
/// give the same bits. So does any number of threads (StepShares).
template <class Normal, class Tangential, class Substrate>
class StepLoop final : public StepKernel {
 public:
  using Pair = StepContact<Normal, Tangential>;
  using Law = typename Pair::Law;
  using Push = typename Pair::Push;
  using Share = StepShare<Push>;

  /// neighbours: null: all pairs.
  StepLoop(StepLaws<Normal, Tangential> laws, std::size_t bodies,
           std::unique_ptr<StepNeighbours> neighbours, std::vector<std::string> features)
      : features_(std::move(features)),
        laws_(std::move(laws)),
        neighbours_(std::move(neighbours)),
        pairs_(neighbours_ ? 0 : bodies * (bodies - 1) / 2) {
    if (!neighbours_) laws_.find_for_all_pairs();
  }

  void find_forces(StepWorld& world) override {
    if (!world.forces_known) neighbours_ ? forces_by_neighbours(world) : forces(world);
    world.forces_known = true;
  }

  void advance(StepWorld& world, std::size_t steps, StepStop stop) override {
    const std::size_t batch = 1 + kBodySteps / world.bodies.size();
    for (std::size_t begin = 0; begin < steps; begin += batch) {
      heed_stop();
      const std::size_t end = std::min(steps, begin + batch);
      for (std::size_t k = begin; k < end; ++k) {
        find_forces(world);
        if (stop != StepStop::never && is_met(world, stop)) return;
        move(world);
        ++world.n;
        world.forces_known = false;
      }
    }
  }

  std::vector<std::string> features() const override { return features_; }

  void exchange(StateArchive& archive, StepWorld& world) override {
    archive(world, pairs_);
    if (!neighbours_) return;
    archive(*neighbours_);
    if (archive.reads()) take_neighbours(world);
  }

  void show(const StepWorld& world, Frame& frame, bool with_touches) override {
    const std::size_t bodies = world.bodies.size();
    frame.bodies.resize(bodies);
    impulses_.resize(with_touches ? bodies : 0);
    StepSurroundings around = world.around;
    around.velocity = velocity_of_substrate(world, world.time());
    if (neighbours_)
      shares_.run(neighbours_->team(), [&](Share&, std::size_t begin, std::size_t end) {
        show(world, around, begin, end, frame.bodies);
      });
    else
      show(world, around, 0, bodies, frame.bodies);
    frame.touches.clear();
    if (!with_touches) return;
    for (std::size_t i = 0; i < bodies; ++i)
      if (impulses_[i] > 0)
        frame.touches.push_back({static_cast<int>(i), kSubstrate, impulses_[i]});
    const auto pairs = static_cast<std::ptrdiff_t>(frame.touches.size());
    for_each_pair(world, [&](std::size_t i, std::size_t j, const Pair& pair) {
      const double impulse = std::abs(pair.normal_force()) * world.step;
      if (pair.touching() && impulse > 0)
        frame.touches.push_back(
            {static_cast<int>(world.number_of(i)), static_cast<int>(world.number_of(j)), impulse});
    });
    if (world.number.empty()) return;
    std::sort(frame.touches.begin() + pairs, frame.touches.end(),
              [](const Touch& a, const Touch& b) {
                return std::tie(a.second, a.first) < std::tie(b.second, b.first);
              });
  }

  bool is_met(const StepWorld& world, StepStop stop) const override {
    if (world.touching > 0) return false;
    for (const StepBody& b : world.bodies) {
      if (!b.sticks) return false;
      if (stop == StepStop::rest &&
          (b.velocity.head<2>() != world.around.velocity || b.angular_velocity.z() != 0))
        return false;
    }
    return true;
  }

 private:
  /// Steps, times the bodies, between two looks at whether to stop.
  static constexpr std::size_t kBodySteps = 4096;

  template <class Visit>
  void for_each_pair(const StepWorld& world, const Visit& visit) const {
    std::size_t k = 0;
    if (neighbours_) {
      for (const StepNeighbour& near : neighbours_->all())
        visit(near.first, near.second, pairs_[k++]);
      return;
    }
    for (std::size_t j = 1; j < world.bodies.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) visit(i, j, pairs_[k++]);
  }

  static Vector2 velocity_of_substrate(const StepWorld& world, double t) {
    if constexpr (std::is_same_v<Substrate, FullSubstrate>)
      return world.motion->velocity(t).template head<2>();
    else
      return Vector2::Zero();
  }

  static void forget_forces(StepBody& b) {
    b.force.setZero();
    b.torque.setZero();
  }

  static void count(const StepTally& tally, StepWorld& world) {
    world.touching += tally.touching;
    world.collisions += tally.collisions;
  }

  /// Those stored from `begin` to before `end`, and what the substrate does to them.
  SLIPCHECK_FLATTEN void show(const StepWorld& world, const StepSurroundings& around,
                              std::size_t begin, std::size_t end, std::vector<BodyState>& shown) {
    for (std::size_t k = begin; k < end; ++k) {
      StepBody body = world.bodies[k];
      const double half =
          world.n > 0 ? kick<Substrate>(body, *body.kind, around, 0.5 * world.step) : 0;
      const std::size_t i = world.number_of(k);
      shown[i] = {body.position, body.velocity, body.angular_velocity};
      if (!impulses_.empty()) impulses_[i] = 2 * half;
    }
  }
  void take_neighbours(const StepWorld& world) {
    laws_.find(*neighbours_, world);
    shares_.divide(*neighbours_, world.bodies.size());
  }

  void forces_by_neighbours(StepWorld& world) {
    if (!neighbours_->cover()) {
      neighbours_->find(world, pairs_, [](const Pair& pair) { return pair.touching(); });
      take_neighbours(world);
    }
    shares_.run(neighbours_->team(), [&](Share& share, std::size_t begin, std::size_t end) {
      meet_neighbours(world, share, begin, end);
    });
    world.touching = 0;
    for (const Share& share : shares_.all()) {
      for (const OutsidePush<Push>& each : share.outside)
        each.push.on(world.bodies[each.stored], each.is_second);
      count(share.tally, world);
    }
  }

  /// The bodies from `begin` to before `end`, on which advance_all() has left no forces.
  [[gnu::noinline]] SLIPCHECK_FLATTEN void meet_neighbours(StepWorld& world, Share& share,
                                                           std::size_t begin, std::size_t end) {
    share.outside.clear();
    StepTally tally;
    const std::vector<StepNeighbour>& all = neighbours_->all();
    for (std::size_t k = share.pairs; k < all.size() && all[k].further() < end; ++k) {
      const StepNeighbour& near = all[k];
      const StepBody &a = world.bodies[near.first], &b = world.bodies[near.second];
      const auto push_one = [&](const Push& push, std::size_t stored, bool is_second) {
        if (stored < begin) [[unlikely]]
          share.outside.push_back({stored, is_second, push});
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

  /// Flat, but for what begins and ends, as move() is: in a large unit the compiler leaves calls
  /// for sums of vectors, which pass them through memory.
  SLIPCHECK_FLATTEN void forces(StepWorld& world) {
    for (StepBody& b : world.bodies) forget_forces(b);
    world.touching = 0;
    StepTally tally;
    std::size_t k = 0;
    for (std::size_t j = 1; j < world.bodies.size(); ++j) {
      StepBody& b = world.bodies[j];
      for (std::size_t i = 0; i < j; ++i, ++k) {
        StepBody& a = world.bodies[i];
        pairs_[k].step(
            world, a, b, a.position - b.position, [&]() -> const Law& { return laws_[k]; }, tally,
            [&](const Push& push) {
              push.on(a, false);
              push.on(b, true);
            });
      }
    }
    count(tally, world);
  }

  SLIPCHECK_FLATTEN void move(StepWorld& world) {
    StepSurroundings& s = world.around;
    if constexpr (std::is_same_v<Substrate, FullSubstrate>) {
      s.velocity_before = s.velocity;
      s.velocity = velocity_of_substrate(world, world.time() + 0.5 * world.step);
    }
    const Advance advance{s, world.step, world.kick_length(), world.slowest_rebound};
    if (!neighbours_) {
      for (StepBody& b : world.bodies) advance(b);
      return;
    }
    shares_.run(neighbours_->team(), [&](Share& share, std::size_t begin, std::size_t end) {
      share.longest2 = advance_all(advance, std::span(world.bodies).subspan(begin, end - begin));
    });
    double longest2 = 0;
    for (const Share& share : shares_.all()) longest2 = std::max(longest2, share.longest2);
    neighbours_->move(std::sqrt(longest2), world);
  }

  /// What a step does to a body.
  struct Advance {
    const StepSurroundings& around;
    double step, dt, slowest_rebound;

    void operator()(StepBody& b) const {
      const StepKind& kind = *b.kind;
      kick<Substrate>(b, kind, around, dt);
      b.position += step * b.velocity;
      if constexpr (std::is_same_v<Substrate, BareSubstrate>) return;
      if (!b.supported && b.position.z() < b.radius && b.velocity.z() < 0) [[unlikely]]
        land_after_drift(b, kind, around, slowest_rebound);
    }
  };

  /// Advances these and forgets their forces; the longest way of one, squared [m²], or kNever.
  SLIPCHECK_FLATTEN static double advance_all(const Advance& given, std::span<StepBody> bodies) {
    // Copies, of which the compiler knows that no body changes them.
    const StepSurroundings around = given.around;
    const Advance advance{around, given.step, given.dt, given.slowest_rebound};
    double longest2 = 0;
    for (StepBody& b : bodies) {
      const Vector3 before = b.position;
      advance(b);
      forget_forces(b);  // here, where they lie in the nearest cache
      const double way2 = (b.position - before).squaredNorm();
      longest2 = way2 <= longest2 ? longest2 : std::isnan(way2) ? kNever : way2;
    }
    return longest2;
  }

  std::vector<std::string> features_;
  StepLaws<Normal, Tangential> laws_;
  std::unique_ptr<StepNeighbours> neighbours_;  ///< null: a few bodies, all pairs
  std::vector<Pair> pairs_;                     ///< by neighbours, or by (j, i) with i < j
  StepShares<Push> shares_;                     ///< of neighbours
  std::vector<double> impulses_;                ///< of the substrate, for show() [N s]
};

}  // namespace slipcheck
