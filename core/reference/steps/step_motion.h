#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "base/flatten.h"
#include "physics/frame.h"
#include "physics/numbers.h"
#include "reference/steps/step_body.h"
#include "reference/steps/step_kernel.h"

namespace slipcheck {

/// How bodies go on in a step, whatever their contacts are.
template <class Substrate>
struct StepMotion {
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
      b.forget_forces();  // here, where they lie in the nearest cache
      const double way2 = (b.position - before).squaredNorm();
      longest2 = way2 <= longest2 ? longest2 : std::isnan(way2) ? kNever : way2;
    }
    return longest2;
  }

  /// Those stored from `begin` to before `end` in the scene's order, and where `impulses` are
  /// wanted what the substrate does to them [N s].
  SLIPCHECK_FLATTEN static void show(const StepWorld& world, const StepSurroundings& around,
                                     std::size_t begin, std::size_t end,
                                     std::vector<BodyState>& shown, std::vector<double>& impulses) {
    for (std::size_t k = begin; k < end; ++k) {
      StepBody body = world.bodies[k];
      const double half =
          world.n > 0 ? kick<Substrate>(body, *body.kind, around, 0.5 * world.step) : 0;
      const std::size_t i = world.number_of(k);
      shown[i] = {body.position, body.velocity, body.angular_velocity};
      if (!impulses.empty()) impulses[i] = 2 * half;
    }
  }
};

}  // namespace slipcheck
