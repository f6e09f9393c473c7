#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/vector.h"

namespace slipcheck::test {

/// A place at which a sphere is pushed by another one or by the ground.
struct ConeContact {
  int first = 0, second = -1;  ///< spheres; −1: the ground
  Vector3 point, normal;       ///< normal: from the second to the first
  double friction = 0;
};

/// The cone of Coulomb's friction as a pyramid whose edges lie on it, or whose faces touch it.
enum class Pyramid { inside, outside };

/// Whether there are forces at the contacts, each in its cone, that hold all spheres under gravity
/// along −z: a linear programme, by GLPK's simplex method.
bool can_stand(std::span<const Vector3> centres, std::span<const double> weights,
               std::span<const ConeContact> contacts, Pyramid pyramid);

}  // namespace slipcheck::test
