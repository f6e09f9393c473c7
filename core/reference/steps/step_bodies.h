#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "base/flatten.h"
#include "physics/numbers.h"
#include "reference/steps/step_neighbours.h"
#include "reference/steps/step_shares.h"

namespace slipcheck {

/// What a step does to each of StepLoop's bodies under the forces of the others, on a substrate of
/// that kind.
template <class Substrate>
class StepBodies {
 public:
  /// For so many, before the others.
  void resize(std::size_t bodies) { expected_.resize(bodies); }

  /// What the next step of a few bodies takes that does not depend on its forces, before these are
  /// found: its roots and divisions would else stand in the processor's queue behind those of the
  /// forces, and begin when they are done.
  void look_ahead(StepWorld& world) {
    if constexpr (std::is_same_v<Substrate, BareSubstrate>) return;
    if constexpr (std::is_same_v<Substrate, FullSubstrate>) ahead_ = ahead_of(world);
    const std::span<StepBody> bodies = world.bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (bodies[i].supported) expected_[i].set(expected_slip<Substrate>(bodies[i], ahead_));
  }

  /// A step of those, each with the forces of now, which stay.
  void move(StepWorld& world) {
    if constexpr (std::is_same_v<Substrate, FullSubstrate>) world.around = ahead_;
    const Advance advance = advance_of(world);
    const std::span<StepBody> bodies = world.bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      advance(bodies[i], [&]() -> const ExpectedSlip& { return expected_[i]; });
  }

  /// A step of bodies that have neighbours, by shares; leaves no forces.
  static void move(StepWorld& world, StepNeighbours& neighbours, StepShares& shares) {
    world.around = ahead_of(world);
    const Advance advance = advance_of(world);
    shares.run(neighbours.team(), [&](StepShare& share, std::size_t begin, std::size_t end) {
      share.longest2 = move_all(advance, std::span(world.bodies).subspan(begin, end - begin));
    });
    double longest2 = 0;
    for (const StepShare& share : shares.all()) longest2 = std::max(longest2, share.longest2);
    neighbours.move(std::sqrt(longest2), world);
  }

  /// `shown` as long as there are bodies, and `impulses`, unless it is empty: of the substrate
  /// [N s]. neighbours: null: a few bodies.
  static void show(const StepWorld& world, StepNeighbours* neighbours, StepShares& shares,
                   std::vector<BodyState>& shown, std::vector<double>& impulses) {
    StepSurroundings around = world.around;
    around.velocity = velocity_of_substrate(world, world.time());
    if (neighbours)
      shares.run(neighbours->team(), [&](StepShare&, std::size_t begin, std::size_t end) {
        show(world, around, begin, end, shown, impulses);
      });
    else
      show(world, around, 0, world.bodies.size(), shown, impulses);
  }

 private:
  struct Advance {
    StepSurroundings around;  // a copy, of which the compiler knows that no body changes it
    double step, dt, slowest_rebound;

    template <class Expected>
    void operator()(StepBody& b, const Expected& expected) const {
      const StepKind& kind = *b.kind;
      kick<Substrate>(b, kind, around, dt, expected);
      b.position += step * b.velocity;
      if constexpr (std::is_same_v<Substrate, BareSubstrate>) return;
      if (!b.supported && b.position.z() < b.radius && b.velocity.z() < 0) [[unlikely]]
        land_after_drift(b, kind, around, slowest_rebound);
    }
  };

  static Vector2 velocity_of_substrate(const StepWorld& world, double t) {
    if constexpr (std::is_same_v<Substrate, FullSubstrate>)
      return world.motion->velocity(t).template head<2>();
    else
      return Vector2::Zero();
  }

  /// What is around in the step from now on.
  static StepSurroundings ahead_of(const StepWorld& world) {
    StepSurroundings s = world.around;
    if constexpr (std::is_same_v<Substrate, FullSubstrate>) {
      s.velocity_before = s.velocity;
      s.velocity = velocity_of_substrate(world, world.time() + 0.5 * world.step);
    }
    return s;
  }

  static Advance advance_of(const StepWorld& world) {
    return {world.around, world.step, world.kick_length(), world.slowest_rebound};
  }

  /// Returns the longest way of one, squared [m²], or kNever.
  SLIPCHECK_FLATTEN static double move_all(const Advance& given, std::span<StepBody> bodies) {
    const Advance advance = given;
    double longest2 = 0;
    for (StepBody& b : bodies) {
      const Vector3 before = b.position;
      advance(b, [&] { return ExpectedSlip::along(expected_slip<Substrate>(b, advance.around)); });
      b.forget_forces();  // here, where they lie in the nearest cache
      const double way2 = (b.position - before).squaredNorm();
      longest2 = way2 <= longest2 ? longest2 : std::isnan(way2) ? kNever : way2;
    }
    return longest2;
  }

  SLIPCHECK_FLATTEN static void show(const StepWorld& world, const StepSurroundings& around,
                                     std::size_t begin, std::size_t end,
                                     std::vector<BodyState>& shown, std::vector<double>& impulses) {
    for (std::size_t k = begin; k < end; ++k) {
      StepBody body = world.bodies[k];
      const double half =
          world.n > 0 ? kick<Substrate>(body, *body.kind, around, 0.5 * world.step) : 0;
      const std::size_t i = world.number_of(k);
      shown[i] = {body.position, body.velocity, body.angular_velocity};
      const StepBody& now = world.bodies[k];
      if (!impulses.empty()) impulses[i] = 2 * half + (now.supported ? 0 : double{now.bounced});
    }
  }

  StepSurroundings ahead_;
  std::vector<ExpectedSlip> expected_;  ///< of a few bodies, in the step ahead
};

}  // namespace slipcheck
