#pragma once

#include <Eigen/Geometry>

#include "bullet_backend/bullet_settings.h"
#include "scene/scene.h"

namespace slipcheck::bullet {

/// How a Bullet world lies in the scene: in which units it counts, and how it is turned. The
/// scene's z is the normal of its plane; in a world under a vertical gravity that plane is tilted.
struct WorldUnits {
  double length = 1;                                   ///< length units of Bullet's in a metre, > 0
  double time = 1;                                     ///< time units in a second, > 0
  double mass = 1;                                     ///< mass units in a kilogram, > 0
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< from the scene's axes to the world's

  double speed() const { return length / time; }
  double impulse() const { return mass * length / time; }

  BodyState to_world(const BodyState& state) const {
    return {length * (turn * state.position), speed() * (turn * state.velocity),
            (turn * state.angular_velocity) / time};
  }
  BodyState from_world(const BodyState& state) const {
    return {turn.transpose() * state.position / length, turn.transpose() * state.velocity / speed(),
            turn.transpose() * state.angular_velocity * time};
  }
};

/// What the settings ask for: the smallest radius, the largest mass, gravity.
WorldUnits world_units(const Scene& scene, const BulletSettings& settings);

/// The scene counted in the world's units, still in its own axes.
Scene in_world_units(const Scene& scene, const WorldUnits& units);

}  // namespace slipcheck::bullet
