#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/alternatives_json.h"
#include "engine/contact_json.h"
#include "scene/scene.h"

/// The fields of surfaces beside the substrate in messages. Those of SubstrateMotion and
/// SubstrateContact stand in scene_json.cpp.
namespace slipcheck {

template <>
inline constexpr std::array kWordsOf<SurfaceShape> = {"plane", "rectangle", "rod", "ball"};

/// How the matter of a surface moves, in the order of kMotionWords.
enum class SurfaceCourse { still, belt, moving, turning };
template <>
inline constexpr std::array kNamesOf<SurfaceCourse> = {"still", "belt", "moving", "turning"};

/// Directions are unit vectors, and right angles right, to within this.
inline constexpr double kDirectionRounding = 1e-9;

template <class Fields>
void describe_in_space(Fields& f, const char* key, Vector3& vector) {
  if constexpr (Fields::kReads) {
    const std::vector<double> xyz = f[key].numbers(3);
    vector = {xyz[0], xyz[1], xyz[2]};
  } else {
    f(key, std::vector<double>{vector.x(), vector.y(), vector.z()});
  }
}

template <class Fields>
void describe_direction(Fields& f, const char* key, Vector3& unit) {
  describe_in_space(f, key, unit);
  if constexpr (Fields::kReads)
    if (!(std::abs(unit.norm() - 1) <= kDirectionRounding)) f[key].fault("must have the length 1");
}

/// A second one across the first.
template <class Fields>
void check_across(Fields& f, const char* key, const Vector3& first, const Vector3& second) {
  if constexpr (Fields::kReads)
    if (!(std::abs(first.dot(second)) <= kDirectionRounding * first.norm() * second.norm()))
      f[key].fault("must be at right angles to the one before");
}

template <class Fields>
void describe(Fields& f, PlaneShape& plane) {
  describe_in_space(f, "point", plane.point);
  describe_direction(f, "normal", plane.normal);
}

template <class Fields>
void describe(Fields& f, RectangleShape& plate) {
  describe_in_space(f, "centre", plate.centre);
  describe_in_space(f, "half_length", plate.half_length);
  describe_in_space(f, "half_width", plate.half_width);
  if constexpr (Fields::kReads)
    for (const auto& [key, half] :
         {std::pair{"half_length", &plate.half_length}, {"half_width", &plate.half_width}})
      if (!(half->norm() > 0)) f[key].fault("must have a length > 0");
  check_across(f, "half_width", plate.half_length, plate.half_width);
}

template <class Fields>
void describe(Fields& f, RodShape& rod) {
  describe_in_space(f, "begin", rod.begin);
  describe_in_space(f, "end", rod.end);
  f("radius", rod.radius, kAboveZero);
  if constexpr (Fields::kReads)
    if (!((rod.end - rod.begin).norm() > 0)) f["end"].fault("must be apart from begin");
}

template <class Fields>
void describe(Fields& f, BallShape& ball) {
  describe_in_space(f, "centre", ball.centre);
  f("radius", ball.radius, kAboveZero);
}

/// The three kinds that move along themselves or away.
template <class Fields>
void describe_course(Fields& f, SurfaceCourse kind, SurfaceMotion& motion) {
  // It is read into, which the check does not see.
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
  SubstrateMotion course = motion.course();
  Vector3 first = motion.first(), second = motion.second();
  f("course", course);
  describe_direction(f, "first", first);
  describe_direction(f, "second", second);
  check_across(f, "second", first, second);
  if constexpr (Fields::kReads)
    motion = kind == SurfaceCourse::belt ? SurfaceMotion::belt(course, first, second)
                                         : SurfaceMotion::moving(course, first, second);
}

template <class Fields>
void describe(Fields& f, SurfaceMotion& motion) {
  SurfaceCourse kind = motion.is_still()          ? SurfaceCourse::still
                       : !motion.rate().isZero(0) ? SurfaceCourse::turning
                       : motion.is_belt()         ? SurfaceCourse::belt
                                                  : SurfaceCourse::moving;
  f("kind", kind);
  if (kind == SurfaceCourse::turning) {
    Vector3 pivot = motion.pivot(), rate = motion.rate();
    describe_in_space(f, "pivot", pivot);
    describe_in_space(f, "rate", rate);
    if constexpr (Fields::kReads) {
      if (rate.isZero(0)) f["rate"].fault("must not be zero");
      motion = SurfaceMotion::turning(pivot, rate);
    }
  } else if (kind != SurfaceCourse::still) {
    describe_course(f, kind, motion);
  } else if constexpr (Fields::kReads) {
    motion = {};
  }
}

template <class Fields>
void describe(Fields& f, Surface& surface) {
  f.object("shape", [&](auto& fields) { describe_alternative(fields, "kind", surface.shape); });
  f("motion", surface.motion);
}

template <class Fields>
void describe(Fields& f, SurfaceContact& contact) {
  f("lasting", contact.lasting);
  f("impact", contact.impact);
}

}  // namespace slipcheck
