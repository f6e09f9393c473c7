#include "bullet_backend/world_units.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace slipcheck::bullet {
namespace {

RestitutionLaw scaled(const RestitutionLaw& law, double speed) {
  return std::visit(
      [&](auto copy) -> RestitutionLaw {
        using Law = decltype(copy);
        if constexpr (std::is_same_v<Law, PowerLawRestitution>) copy.speed *= speed;
        if constexpr (std::is_same_v<Law, TabulatedRestitution>) copy.log_first += std::log(speed);
        return copy;
      },
      law);
}

RollingFriction scaled(const RollingFriction& rolling, double speed) {
  std::vector<RollingFriction::Point> points = rolling.points();
  for (auto& point : points) point.speed *= speed;
  return RollingFriction(std::move(points));
}

SubstrateMotion scaled(const SubstrateMotion& motion, const WorldUnits& units) {
  switch (motion.kind()) {
    case SubstrateMotion::Kind::still:
      break;
    case SubstrateMotion::Kind::constant:
      return SubstrateMotion::constant(motion.vector() * units.speed());
    case SubstrateMotion::Kind::oscillation:
      return SubstrateMotion::oscillation(motion.vector() * units.length,
                                          motion.frequency() / units.time, motion.phase());
    case SubstrateMotion::Kind::table: {
      std::vector<SubstrateMotion::Point> points = motion.points();
      for (auto& point : points) {
        point.time *= units.time;
        point.position *= units.length;
      }
      return SubstrateMotion::table(std::move(points));
    }
  }
  return {};
}

SurfaceShape scaled(const SurfaceShape& shape, double length) {
  return std::visit(
      [&](auto copy) -> SurfaceShape {
        using Shape = decltype(copy);
        if constexpr (std::is_same_v<Shape, PlaneShape>) copy.point *= length;
        if constexpr (std::is_same_v<Shape, RectangleShape>) {
          copy.centre *= length;
          copy.half_length *= length;
          copy.half_width *= length;
        }
        if constexpr (std::is_same_v<Shape, RodShape>) {
          copy.begin *= length;
          copy.end *= length;
          copy.radius *= length;
        }
        if constexpr (std::is_same_v<Shape, BallShape>) {
          copy.centre *= length;
          copy.radius *= length;
        }
        return copy;
      },
      shape);
}

SurfaceMotion scaled(const SurfaceMotion& motion, const WorldUnits& units) {
  if (motion.is_still()) return {};
  if (!motion.rate().isZero(0))
    return SurfaceMotion::turning(motion.pivot() * units.length, motion.rate() / units.time);
  const SubstrateMotion course = scaled(motion.course(), units);
  return motion.is_belt() ? SurfaceMotion::belt(course, motion.first(), motion.second())
                          : SurfaceMotion::moving(course, motion.first(), motion.second());
}

void scale(SubstrateContact& contact, const WorldUnits& units) {
  contact.rolling = scaled(contact.rolling, units.speed());
  contact.drilling_length *= units.length;
  contact.coupled_radius *= units.length;
}

}  // namespace

WorldUnits world_units(const Scene& scene, const BulletSettings& settings) {
  WorldUnits units;
  const auto& bodies = scene.bodies;
  if (settings.scale_radius_to > 0)
    units.length =
        settings.scale_radius_to / std::ranges::min_element(bodies, {}, &Sphere::radius)->radius;
  if (settings.scale_mass_to > 0)
    units.mass = settings.scale_mass_to / std::ranges::max_element(bodies, {}, &Sphere::mass)->mass;
  const Vector3 gravity(scene.downhill.x(), scene.downhill.y(), -scene.gravity);
  if (settings.scale_gravity_to > 0 && gravity.norm() > 0)
    units.time = std::sqrt(units.length * gravity.norm() / settings.scale_gravity_to);
  if (settings.tilt == Tilt::plane && scene.downhill != Vector2::Zero())
    units.turn = Eigen::Quaterniond::FromTwoVectors(gravity, -Vector3::UnitZ()).toRotationMatrix();
  return units;
}

Scene in_world_units(const Scene& scene, const WorldUnits& units) {
  Scene scaled_scene = scene;
  const double speed = units.speed();
  for (Sphere& body : scaled_scene.bodies) {
    body.radius *= units.length;
    body.mass *= units.mass;
  }
  for (std::optional<Extent>& extent : scaled_scene.extents)
    if (extent) extent->size *= units.length;
  for (BodyState& state : scaled_scene.initial) {
    state.position *= units.length;
    state.velocity *= speed;
    state.angular_velocity /= units.time;
  }
  for (SubstrateContact& ground : scaled_scene.substrate) scale(ground, units);
  for (SurfaceContact& contact : scaled_scene.on_surfaces) {
    scale(contact.lasting, units);
    contact.impact.restitution = scaled(contact.impact.restitution, speed);
  }
  for (Surface& surface : scaled_scene.surfaces)
    surface = {scaled(surface.shape, units.length), scaled(surface.motion, units)};
  const auto scale_pairs = [&](std::vector<PairContact>& contacts) {
    for (PairContact& contact : contacts) {
      contact.restitution = scaled(contact.restitution, speed);
      contact.friction = with_speeds_times(contact.friction, speed);
    }
  };
  scale_pairs(scaled_scene.pairs);
  const double acceleration = speed / units.time;
  scaled_scene.gravity *= acceleration;
  scaled_scene.downhill *= acceleration;
  scaled_scene.motion = scaled(scene.motion, units);
  scaled_scene.periodic *= units.length;
  if (scaled_scene.box) {
    Box& box = *scaled_scene.box;
    box.width *= units.length;
    box.floor.amplitude *= units.length;
    box.floor.frequency /= units.time;
    if (box.lid) *box.lid *= units.length;
    for (auto* contacts : {&box.on_floor, &box.on_wall, &box.on_lid}) scale_pairs(*contacts);
  }
  return scaled_scene;
}

}  // namespace slipcheck::bullet
