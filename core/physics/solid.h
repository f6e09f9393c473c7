#pragma once

#include <cmath>

#include "physics/sphere.h"

namespace slipcheck {

// What engines need of a block or a cylinder, whose own axes are those of its extent: the first
// along Extent::axis, the third up.

/// About its own axes, of a homogeneous body [kg m²].
inline Vector3 moments_of_inertia(const Sphere& body, const Extent& extent) {
  const Vector3 square = extent.size.cwiseAbs2();
  if (body.shape == Shape::block)
    return body.mass / 12 *
           Vector3(square.y() + square.z(), square.x() + square.z(), square.x() + square.y());
  const double across = body.mass * (square.y() / 16 + square.x() / 12);
  return {body.moment_of_inertia(), across, across};
}

/// From its own axes to the scene's.
inline Eigen::Quaterniond turn_of(const Extent& extent) {
  const double angle = std::atan2(extent.axis.y(), extent.axis.x());
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3::UnitZ()));
}

/// From the axes of a cylinder that lies along z to its own.
inline Eigen::Quaterniond turn_of_z_to_x() {
  return Eigen::Quaterniond(std::sqrt(0.5), 0, std::sqrt(0.5), 0);
}

}  // namespace slipcheck
