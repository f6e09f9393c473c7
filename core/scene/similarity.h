#pragma once

#include <cstddef>

#include "physics/frame.h"
#include "scene/scene.h"

namespace slipcheck {

/// What makes a scene a similar one: all lengths times a factor at the same gravity and densities
/// (Froude: times and speeds times its root, masses times its cube), and a turn about the vertical
/// through the origin. What happens in the similar scene is what happens in the scene, scaled and
/// turned.
struct Similarity {
  double length = 1;                   ///< factor of lengths, > 0
  Vector2 heading = Vector2::UnitX();  ///< where x turns to, a unit vector

  double time() const;  ///< factor of times and of speeds
  bool is_identity() const { return length == 1 && heading == Vector2::UnitX(); }

  /// A state of the scene in the similar one.
  BodyState of(const BodyState& state) const;
  /// A frame of the similar scene in the scene, in its place.
  void take_back(Frame& frame) const;
};

/// The k-th of `count` >= 1 even headings; the first is x. Quarters are exact.
Vector2 even_heading(std::size_t k, std::size_t count);

/// The scene with its states, its motion and its slope turned from x to this heading. It must have
/// neither a box nor a periodic plane, which have no headings.
Scene turned(Scene scene, const Vector2& heading);

}  // namespace slipcheck
