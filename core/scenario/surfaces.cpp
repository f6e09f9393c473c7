#include "scenario/surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/match.h"

namespace slipcheck {
namespace {

using Side = BoxOfPlates::Side;

RectangleShape plate_of(const BoxOfPlates& box, Side side) {
  const Vector3 middle = 0.5 * (box.from + box.to), half = 0.5 * (box.to - box.from);
  const auto k = static_cast<std::size_t>(side);
  const auto normal = static_cast<Eigen::Index>(k / 2);
  const Eigen::Index first = (normal + 1) % 3, second = (normal + 2) % 3;
  RectangleShape plate;
  plate.centre = middle;
  plate.centre[normal] = k % 2 == 0 ? box.from[normal] : box.to[normal];
  plate.half_length = half[first] * Vector3::Unit(first);
  plate.half_width = half[second] * Vector3::Unit(second);
  return plate;
}

/// A unit vector along the greater of two, or any.
Vector3 unit(const Vector3& v) {
  const double length = v.norm();
  return length > 0 ? Vector3(v / length) : Vector3::UnitX();
}

/// One along `v` and one at right angles to it.
SurfaceMotion along(const Vector3& v, auto make, SubstrateMotion course) {
  const Vector3 first = unit(v);
  return make(std::move(course), first, first.unitOrthogonal());
}

}  // namespace

std::vector<NamedSurface> plates_of(const WrittenSurface& surface, const BoxOfPlates& box) {
  std::vector<NamedSurface> plates;
  for (std::size_t k = 0; k < kNamesOf<Side>.size(); ++k) {
    const auto side = static_cast<Side>(k);
    if (std::ranges::find(box.open, side) != box.open.end()) continue;
    plates.push_back({surface.name + "-" + name_of(side), surface.material, plate_of(box, side),
                      surface.motion, surface.path});
  }
  return plates;
}

bool is_of_surface(const std::string& material, const WrittenScene& written) {
  return std::ranges::any_of(written.surfaces,
                             [&](const WrittenSurface& each) { return each.material == material; });
}

std::vector<NamedSurface> named_surfaces(const WrittenScene& written) {
  std::vector<NamedSurface> all;
  for (const WrittenSurface& each : written.surfaces) {
    if (!each.complete) continue;
    if (const auto* box = std::get_if<BoxOfPlates>(&each.shape))
      std::ranges::move(plates_of(each, *box), std::back_inserter(all));
    else
      all.push_back(
          {each.name, each.material, std::get<SurfaceShape>(each.shape), each.motion, each.path});
  }
  return all;
}

Surface made_surface(const NamedSurface& surface) {
  const auto constant = [](const Vector3& v) {
    return SubstrateMotion::constant(Vector2(v.norm(), 0));
  };
  Surface made{surface.shape, {}};
  std::visit(
      Match{[](const StillMotion&) {},
            [&](const BeltMotion& belt) {
              made.motion = along(belt.velocity, SurfaceMotion::belt, constant(belt.velocity));
            },
            [&](const SurfaceTranslation& moves) {
              made.motion = along(moves.velocity, SurfaceMotion::moving, constant(moves.velocity));
            },
            [&](const SurfaceOscillation& wave) {
              made.motion = along(wave.amplitude, SurfaceMotion::moving,
                                  SubstrateMotion::oscillation(Vector2(wave.amplitude.norm(), 0),
                                                               wave.frequency, wave.phase));
            },
            [&](const SurfaceTurning& turn) {
              made.motion = SurfaceMotion::turning(turn.about, turn.rate);
            }},
      surface.motion);
  return made;
}

double highest_over(const PlaneShape& plane, const SurfaceShape& shape) {
  const auto height = [&](const Vector3& at) { return plane.normal.dot(at - plane.point); };
  const auto reach = [&](const Vector3& v) { return std::abs(plane.normal.dot(v)); };
  return std::visit(
      Match{[&](const PlaneShape& other) {
              const bool parallel = plane.normal.dot(other.normal) >= 1 - 1e-12;
              return parallel ? height(other.point) : std::numeric_limits<double>::infinity();
            },
            [&](const RectangleShape& plate) {
              return height(plate.centre) + reach(plate.half_length) + reach(plate.half_width);
            },
            [&](const RodShape& rod) {
              const double along = reach((rod.end - rod.begin).normalized());
              return std::max(height(rod.begin), height(rod.end)) +
                     rod.radius * std::sqrt(std::max(0.0, 1 - along * along));
            },
            [&](const BallShape& ball) { return height(ball.centre) + ball.radius; }},
      shape);
}

double overlap_of(const NamedSurface& surface, const Vector3& centre, double radius) {
  return radius - made_surface(surface).nearest(0, centre).distance;
}

const NamedSurface* touched_surface(const std::vector<NamedSurface>& surfaces,
                                    const Vector3& centre, double radius) {
  constexpr double kTouching = 1e-9;
  const auto found = std::ranges::find_if(surfaces, [&](const NamedSurface& each) {
    return std::abs(overlap_of(each, centre, radius)) <= kTouching * radius;
  });
  return found == surfaces.end() ? nullptr : &*found;
}

void check_surfaces(const WrittenScene& written, Reading& reading) {
  constexpr double kRightAngle = 1e-9;
  for (const WrittenSurface& each : written.surfaces) {
    if (!each.complete) continue;
    const auto* shape = std::get_if<SurfaceShape>(&each.shape);
    if (const auto* belt = std::get_if<BeltMotion>(&each.motion)) {
      const auto* plane = shape ? std::get_if<PlaneShape>(shape) : nullptr;
      const auto* plate = shape ? std::get_if<RectangleShape>(shape) : nullptr;
      if (!plane && !plate) {
        reading.fault_at(each.path + ".motion", "must be of a plane or a rectangle for a belt");
        continue;
      }
      const Vector3 normal = plane ? plane->normal : plate->normal();
      if (std::abs(normal.dot(belt->velocity)) > kRightAngle * belt->velocity.norm())
        reading.fault_at(each.path + ".motion.velocity", "must be along the surface of a belt");
    }
    if (const auto* turn = std::get_if<SurfaceTurning>(&each.motion); turn && shape) {
      const auto* plane = std::get_if<PlaneShape>(shape);
      if (plane && plane->normal.cross(turn->rate).norm() > kRightAngle * turn->rate.norm())
        reading.fault_at(each.path + ".motion.rate",
                         "must be along the normal of a plane, which has no end; a rectangle may "
                         "turn about any axis");
    }
  }
}

}  // namespace slipcheck
