#pragma once

#include <cstddef>
#include <optional>

#include "physics/sphere.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// The first two bodies that touch each other, just before they do.
struct Meeting {
  std::size_t first = 0, second = 0;
  double time = 0;               ///< [s]
  BodyState a, b;                ///< of `first` and `second`
  Vector3 n = Vector3::UnitX();  ///< from `first` to `second`

  /// Of the centres along n [m/s], > 0.
  double closing_speed() const { return (a.velocity - b.velocity).dot(n); }
};

/// Follows the scene, its contacts taken as hard, until two bodies touch; nothing if none do before
/// `limit` [s], nor in a box, where the first of many collisions says little.
std::optional<Meeting> first_meeting(const ContactScene& scene, double limit);

}  // namespace slipcheck
