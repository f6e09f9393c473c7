#pragma once

#include <algorithm>

#include "scene/scene.h"

namespace slipcheck::bullet {

/// Bullet looks for contacts among all pairs of bodies whose boxes, widened by 0.02 and by up to
/// 0.05 length units more, overlap. These are lengths for bodies of about one unit: among balls of
/// 0.5 mm in SI every pair in a box is such a pair, and a step of 800 takes 15 to 30 times as long.
/// In a box and on a periodic plane both are therefore taken in units of the largest radius, which
/// is this factor [-], at most 1. What comes into contact stays the same: two spheres do once they
/// overlap, and the box of a plane has no end.
inline double margin_scale(const Scene& scene) {
  if (!scene.box && scene.periodic.isZero(0)) return 1;
  const double largest = std::ranges::max_element(scene.bodies, {}, &Sphere::radius)->radius;
  return std::min(1.0, largest);
}

inline constexpr double kTreeMargin = 0.05;  ///< of the broadphase's tree, Bullet's own [m]

}  // namespace slipcheck::bullet
