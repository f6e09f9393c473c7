#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "../support/extremes.h"
#include "random_scene.h"
#include "scene/similarity.h"

// Symmetries: what one makes of a scene, and of the state of a body at the end. Who solves a scene
// and its image must find the image of the one's end as the other's.

namespace slipcheck::test {

struct Image {
  Scene scene;
  double end = 1;  ///< [s]
  std::function<BodyState(const BodyState&)> of;
  std::vector<std::size_t> from = {};  ///< by body of the image, the one it was; empty: the same
  double speed = 1;                    ///< what 1 m/s becomes

  std::size_t origin_of(std::size_t body) const { return from.empty() ? body : from[body]; }
};

/// y → −y: a spin is an axial vector.
inline Image mirrored(Scene scene, double end) {
  const auto of = [](BodyState state) {
    state.position.y() *= -1;
    state.velocity.y() *= -1;
    state.angular_velocity.x() *= -1;
    state.angular_velocity.z() *= -1;
    return state;
  };
  for (BodyState& state : scene.initial) state = of(state);
  return {.scene = std::move(scene), .end = end, .of = of};
}

/// About the vertical through the origin, from x to this heading.
inline Image turned_by(const Scene& scene, double end, const Vector2& heading) {
  const Similarity turn{1, heading};
  return {.scene = turned(scene, heading), .end = end, .of = [turn](const BodyState& state) {
            return turn.of(state);
          }};
}

/// On a belt, and moving with it [m/s].
inline Image on_a_belt(Scene scene, double end, const Vector2& velocity) {
  const Vector3 belt(velocity.x(), velocity.y(), 0);
  scene.motion = SubstrateMotion::constant(velocity);
  for (BodyState& state : scene.initial) state.velocity += belt;
  return {.scene = std::move(scene), .end = end, .of = [belt, end](BodyState state) {
            state.position += end * belt;
            state.velocity += belt;
            return state;
          }};
}

/// The bodies in another order.
inline Image in_another_order(const Scene& scene, double end, Random& random) {
  std::vector<std::size_t> from(scene.bodies.size());
  std::iota(from.begin(), from.end(), std::size_t{0});
  std::rotate(from.begin(), from.begin() + 1, from.end());
  if (from.size() > 2 && random.chance(0.5)) std::swap(from[0], from[1]);
  Scene other = scene;
  for (std::size_t i = 0; i < from.size(); ++i) {
    other.bodies[i] = scene.bodies[from[i]];
    other.material[i] = scene.material[from[i]];
    other.initial[i] = scene.initial[from[i]];
  }
  return {
      .scene = other, .end = end, .of = [](const BodyState& state) { return state; }, .from = from};
}

/// The largest difference of two states of a body, in its radius, in `speed` [m/s] and in that over
/// the radius.
inline double difference(const BodyState& a, const BodyState& b, double radius, double speed) {
  return largest_of((a.position - b.position).norm() / radius,
                    (a.velocity - b.velocity).norm() / speed,
                    (a.angular_velocity - b.angular_velocity).norm() * radius / speed);
}

}  // namespace slipcheck::test
