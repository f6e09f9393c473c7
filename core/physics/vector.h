#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace slipcheck {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// The substrate's unit normal k̂; the plane is z = 0 in its own frame.
inline const Vector3 kUp = Vector3::UnitZ();

/// The z component of a × b.
inline double across(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace slipcheck
