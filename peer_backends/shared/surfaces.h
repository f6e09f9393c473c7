#pragma once

#include <vector>

#include "peer_backends/shared/contact_values.h"
#include "scene/scene.h"

namespace slipcheck::peer {

/// A plane that bodies bounce off: the half-space normal·r >= offset is free.
struct Surface {
  Vector3 normal = Vector3::UnitZ();
  double offset = 0;  ///< while the box is at rest [m]
  int index = kFloor;
  bool moves = false;

  /// Of the surface at a time [m]; a plane that moves along itself stays where it is.
  Vector3 displacement(const Scene& scene, double time) const;
  /// [m/s]
  Vector3 velocity(const Scene& scene, double time) const;
};

/// The substrate where there is one, or floor, walls and lid of a box, in this order. What stands
/// beside the substrate is not among them.
std::vector<Surface> surfaces_of(const Scene& scene);

}  // namespace slipcheck::peer
