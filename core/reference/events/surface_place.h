#pragma once

#include "physics/motion/substrate_motion.h"
#include "physics/surface.h"
#include "reference/events/path_collision.h"
#include "scene/scene.h"

namespace slipcheck {

/// Right-handed, the third along a unit normal.
Matrix3 axes_about(const Vector3& normal);

/// A surface, or the substrate, as a body meets it that flies, hits it or lies on it.
struct SurfacePlace {
  /// `gravity` [m/s²]; `touch` as in frames.
  SurfacePlace(const Surface& surface, int touch, const Vector3& gravity);

  /// Beside a body at one instant.
  struct Beside {
    NearestPoint near;
    double gap = 0;      ///< [m]
    double opening = 0;  ///< its rate [m/s]
  };
  Beside beside(double radius, const PathPoint& body, double now) const;
  /// Velocity of the place, not of matter that passes by [m/s].
  Vector3 velocity(double now, const Vector3& at) const;

  /// In its axes, from its origin.
  BodyState to_local(const BodyState& state) const;
  BodyState from_local(const BodyState& state) const;

  Surface surface;
  int touch;
  /// Of a plane or plate: columns along it and its normal, and a point.
  Matrix3 axes = Matrix3::Identity();
  Vector3 origin = Vector3::Zero();
  Vector2 half = Vector2::Zero();  ///< of a plate, along the axes; 0: a plane
  bool carries = false;            ///< bodies lie, slide and roll on it
  SubstrateMotion motion;          ///< of its matter, along the axes
  double gravity = 0;              ///< against the normal [m/s²]
  Vector2 downhill = Vector2::Zero();
  double bend = 0;  ///< bound of its acceleration [m/s²]
};

}  // namespace slipcheck
