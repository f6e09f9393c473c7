#include "scene/similarity.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/match.h"

namespace slipcheck {
namespace {

/// (x, y) where x is turned to this heading.
Vector2 turn(const Vector2& v, const Vector2& heading) {
  return {heading.x() * v.x() - heading.y() * v.y(), heading.y() * v.x() + heading.x() * v.y()};
}

Vector3 turn(const Vector3& v, const Vector2& heading) {
  const Vector2 flat = turn(Vector2(v.head<2>()), heading);
  return {flat.x(), flat.y(), v.z()};
}

SubstrateMotion turn(const SubstrateMotion& motion, const Vector2& heading) {
  const Vector2 vector = turn(motion.vector(), heading);
  switch (motion.kind()) {
    case SubstrateMotion::Kind::still:
      break;
    case SubstrateMotion::Kind::constant:
      return SubstrateMotion::constant(vector);
    case SubstrateMotion::Kind::oscillation:
      return SubstrateMotion::oscillation(vector, motion.frequency(), motion.phase());
    case SubstrateMotion::Kind::table: {
      std::vector<SubstrateMotion::Point> points = motion.points();
      for (SubstrateMotion::Point& point : points) point.position = turn(point.position, heading);
      return SubstrateMotion::table(std::move(points));
    }
  }
  return motion;
}

Surface turn(const Surface& surface, const Vector2& heading) {
  const auto of = [&](const Vector3& v) { return turn(v, heading); };
  Surface turned = surface;
  std::visit(Match{[&](PlaneShape& plane) {
                     plane.point = of(plane.point);
                     plane.normal = of(plane.normal);
                   },
                   [&](RectangleShape& plate) {
                     plate.centre = of(plate.centre);
                     plate.half_length = of(plate.half_length);
                     plate.half_width = of(plate.half_width);
                   },
                   [&](RodShape& rod) {
                     rod.begin = of(rod.begin);
                     rod.end = of(rod.end);
                   },
                   [&](BallShape& ball) { ball.centre = of(ball.centre); }},
             turned.shape);
  const SurfaceMotion& motion = surface.motion;
  if (!motion.rate().isZero(0)) {
    turned.motion = SurfaceMotion::turning(of(motion.pivot()), of(motion.rate()));
  } else if (!motion.is_still()) {
    const auto make = motion.is_belt() ? SurfaceMotion::belt : SurfaceMotion::moving;
    turned.motion = make(motion.course(), of(motion.first()), of(motion.second()));
  }
  return turned;
}

BodyState turn(const BodyState& state, const Vector2& heading) {
  return {turn(state.position, heading), turn(state.velocity, heading),
          turn(state.angular_velocity, heading)};
}

BodyState scale(const BodyState& state, double length, double time) {
  return {length * state.position, (length / time) * state.velocity,
          (1 / time) * state.angular_velocity};
}

}  // namespace

double Similarity::time() const { return std::sqrt(length); }

BodyState Similarity::of(const BodyState& state) const {
  return is_identity() ? state : scale(turn(state, heading), length, time());
}

void Similarity::take_back(Frame& frame) const {
  if (is_identity()) return;
  const Vector2 back(heading.x(), -heading.y());
  for (BodyState& state : frame.bodies) state = turn(scale(state, 1 / length, 1 / time()), back);
  const double impulse = length * length * length * time();  // mass times speed
  for (Touch& touch : frame.touches) touch.normal_impulse /= impulse;
}

Vector2 even_heading(std::size_t k, std::size_t count) {
  assert(k < count);
  // In quarters of a turn and what is left, so that multiples of a quarter have no rounding.
  const std::size_t quarter = 4 * k / count, left = 4 * k % count;
  const double angle =
      0.5 * std::numbers::pi * static_cast<double>(left) / static_cast<double>(count);
  Vector2 heading(left == 0 ? 1 : std::cos(angle), left == 0 ? 0 : std::sin(angle));
  for (std::size_t q = 0; q < quarter; ++q) heading = Vector2(0 - heading.y(), heading.x());
  return heading;
}

Scene turned(Scene scene, const Vector2& heading) {
  assert(!scene.box && scene.periodic.isZero(0));
  for (BodyState& state : scene.initial) state = turn(state, heading);
  for (std::optional<Extent>& extent : scene.extents)
    if (extent) extent->axis = turn(extent->axis, heading);
  scene.downhill = turn(scene.downhill, heading);
  scene.motion = turn(scene.motion, heading);
  for (Surface& surface : scene.surfaces) surface = turn(surface, heading);
  return scene;
}

}  // namespace slipcheck
