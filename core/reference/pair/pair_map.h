#pragma once

#include <cstddef>
#include <vector>

#include "physics/sphere.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// B's map (g^N, g^T) → (ε^N, ε^T) of two equal free spheres as a table over the logarithms of both
/// speeds, bilinear between its points and constant outside.
class PairMap {
 public:
  struct Restitution {
    double normal = 1;      ///< ε^N [-]
    double tangential = 1;  ///< ε^T [-]
  };

  /// From collide_batch(), for speeds from `slowest` to `fastest` [m/s], > 0; `per_e_fold` points
  /// for each factor e, > 0. can_batch() holds.
  PairMap(const SoftContact& contact, const Sphere& sphere, double slowest, double fastest,
          double per_e_fold = 16);

  /// Speeds [m/s], >= 0.
  Restitution at(double normal_speed, double tangential_speed) const;

 private:
  double first_;  // ln of the slowest
  double step_;   // between two points
  std::size_t across_;
  std::vector<Restitution> table_;  // by g^N, then g^T
};

}  // namespace slipcheck
