#pragma once

#include "physics/surface.h"

namespace slipcheck::peer {

/// Where a shape's own centre and axes are: the third is the normal of a plane or plate and the
/// axis of a cylinder, the first a plate's length. The axes are right-handed.
struct SurfaceFrame {
  Vector3 centre = Vector3::Zero();
  Matrix3 axes = Matrix3::Identity();

  Eigen::Quaterniond turn() const { return Eigen::Quaterniond(axes); }
  /// The frame so far [m] behind the face of a plane: the middle of a box in its place.
  SurfaceFrame behind(double depth) const { return {centre - depth * axes.col(2), axes}; }
};

/// That of the shape of a surface at a time [s]; a belt's stays.
SurfaceFrame frame_at(const slipcheck::Surface& surface, double time);

/// Half sizes of a box in the place of a plate [m], `thickness` of its shorter side thick.
Vector3 half_sizes(const RectangleShape& plate, double thickness);

}  // namespace slipcheck::peer
