#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/sphere.h"
#include "reference/steps/grain_kernels.h"
#include "scene/scene.h"

namespace slipcheck {

/// The plane's tilt and motion, in steps.
///
/// Where grains are carried along, only what they do beside that tells which can meet. So speeds
/// count from a drift w that all share: that of a grain that rolls, ẇ = V̇/(1+A) + A/(1+A) a with
/// the plane's velocity V and the acceleration a downhill. It begins with the mean of what the
/// grains roll with once their slip has gone. V̇ is left out where V jumps.
class GrainDrive {
 public:
  /// Of a scene that outlives this; step: h [s].
  GrainDrive(const Scene& scene, std::span<const BodyState> initial, double step)
      : scene_(&scene), step_(step), share_(share_of(scene.bodies[0])) {
    Vector2 sum = Vector2::Zero();
    for (std::size_t i = 0; i < initial.size(); ++i)
      sum += initial[i].velocity.head<2>() - share_of(scene.bodies[i]) * slip(initial[i], i);
    start_ = sum / static_cast<double>(std::max<std::size_t>(initial.size(), 1));
  }

  /// Of body i in the beginning, relative to the plane [m/s].
  Vector2 slip(const BodyState& state, std::size_t i) const {
    return slip_velocity(state, scene_->bodies[i].radius).head<2>() - velocity(0);
  }

  /// The plane's, of which velocities lie half a step before the positions of step n; those of
  /// step 0 with them [m/s].
  Vector2 velocity_of(std::size_t n) const { return velocity(time_of(n)); }

  /// Where speeds count from at the velocities of step n [m/s].
  Vector2 drift_of(std::size_t n) const { return drift_of(n, velocity_of(n)); }

  /// The largest acceleration of a grain beside the drift, where `friction` is what that gives it
  /// [m/s²].
  double most(double friction) const {
    return friction + share_ * (scene_->downhill.norm() +
                                (follows() ? scene_->motion.largest_acceleration() : 0));
  }

  /// The step from the velocities of step n on, and so many after it.
  void find(std::size_t n, std::size_t count, const std::vector<GrainKind>& kinds,
            GrainDriving& driving) const {
    driving.steps.clear();
    Vector2 before = velocity_of(n);
    for (std::size_t k = 1; k <= count; ++k) {
      const Vector2 after = velocity_of(n + k);
      driving.steps.push_back(push(before, after, drift_of(n + k, after)));
      before = after;
    }
    driving.rolls.clear();
    for (const GrainKind& kind : kinds) driving.rolls.push_back(roll(kind, driving.steps));
  }

  /// The half step from the velocities of step n to its positions.
  void find_half(std::size_t n, GrainDriving& driving) const {
    const Vector2 before = n > 0 ? velocity_of(n - 1) : velocity(0);
    driving.steps.assign(1, push(before, velocity(static_cast<double>(n) * step_), {0, 0}));
  }

 private:
  static double share_of(const Sphere& sphere) { return 1 / (1 + sphere.inverse_shape_factor()); }
  double time_of(std::size_t n) const {
    return n > 0 ? static_cast<double>(n - 1) * step_ + 0.5 * step_ : 0;
  }
  /// plane: velocity_of(n).
  Vector2 drift_of(std::size_t n, const Vector2& plane) const {
    Vector2 drift = start_ + (1 - share_) * time_of(n) * scene_->downhill;
    if (follows()) drift += share_ * (plane - velocity(0));
    return drift;
  }
  Vector2 velocity(double t) const { return scene_->motion.velocity(t).head<2>(); }
  /// Whether the drift follows the plane's motion, which has no jumps.
  bool follows() const { return scene_->motion.kind() == SubstrateMotion::Kind::oscillation; }
  GrainPush push(const Vector2& before, const Vector2& after, const Vector2& drift) const {
    return {before.x(),           before.y(),           after.x(), after.y(),
            scene_->downhill.x(), scene_->downhill.y(), drift.x(), drift.y()};
  }

  /// With u the slip that a step's push leaves, v gets u/(1+A) less than the push.
  GrainRoll roll(const GrainKind& kind, const std::vector<GrainPush>& steps) const {
    GrainRoll roll;
    roll.holds = 1;
    roll.radius = kind.radius;
    roll.per_radius = 1 / kind.radius;
    const double load = kind.weight * kind.inverse_mass * step_;
    const double most = kind.static_friction * load;
    roll.share = kind.share;
    roll.turn = kind.turn;
    roll.slides_by = kind.kinetic_friction * load / kind.share;
    roll.holds_by = most / kind.share;
    double pushed = 0, jumps = 0;  // the most in a step, and beside what the last two let expect
    Vector2 last(0, 0), change(0, 0);
    for (const GrainPush& push : steps) {
      const double ax = step_ * push.slope_x, ay = step_ * push.slope_y;
      const double ux = ax - (push.plane_x - push.before_x);
      const double uy = ay - (push.plane_y - push.before_y);
      const double held2 = kind.share * kind.share * (ux * ux + uy * uy);
      if (!(held2 <= most * most)) roll.holds = 0;
      const Vector2 pushes(ux, uy), changes = pushes - last;
      pushed = std::max(pushed, pushes.norm());
      if (&push - steps.data() >= 2) jumps = std::max(jumps, (changes - change).norm());
      change = changes;
      last = pushes;
      roll.last_dvx = ax - kind.share * ux;
      roll.last_dvy = ay - kind.share * uy;
      roll.dvx += roll.last_dvx;
      roll.dvy += roll.last_dvy;
      roll.x += step_ * roll.dvx;
      roll.y += step_ * roll.dvy;
    }
    // A step changes the slip by so much at most; twenty are left in the end. 1/|u| is then less
    // than 1e-3 off what its last three values let expect.
    const double each = roll.slides_by + pushed;
    roll.slides_from =
        std::max(static_cast<double>(steps.size() + kLastSlides) * each, 1e5 * jumps);
    return roll;
  }

  const Scene* scene_;
  double step_, share_;
  Vector2 start_ = Vector2::Zero();  ///< the drift's velocity in the beginning [m/s]
};

}  // namespace slipcheck
