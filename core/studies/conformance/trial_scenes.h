#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace slipcheck {

/// Radius of the checks' steel spheres [m].
inline constexpr double kTrialRadius = 0.01;
/// Kinetic and static friction on the plane.
inline constexpr double kTrialFriction = 0.3;

/// Spheres at rest on a still, level plane, in rows of 20 with gaps of a radius. Their friction is
/// kTrialFriction, e is 0.8 between them and on the plane, and there is no other law.
Scene spheres_on_plane(std::size_t bodies);

/// One sphere, its lowest point `height` [m] above the plane, with this velocity [m/s].
Scene one_sphere(double height, const Vector3& velocity = Vector3::Zero());

/// Two on the plane that meet at 2·`speed` [m/s] after 0.01 m/`speed`, without friction between
/// them.
Scene two_that_meet(double speed);

/// One at rest on a tilted plane beside another, with no substrate: surface 1, whose normal is
/// (0.6, 0, 0.8). Surface 0 is a plane far below.
Scene sphere_on_slope();

/// A wide vertical box with a shaken floor and three spheres that fall.
Scene spheres_in_box();

}  // namespace slipcheck
