#pragma once

#include <variant>

#include "physics/motion/substrate_motion.h"
#include "physics/vector.h"

namespace slipcheck {

// Fixed or moving things that spheres touch beside each other. All lengths [m].

/// Everything behind a plane; it is touched on the side to which its normal points.
struct PlaneShape {
  Vector3 point = Vector3::Zero();
  Vector3 normal = kUp;  ///< unit
};
/// A plate without thickness: two faces, four edges, four corners.
struct RectangleShape {
  Vector3 centre = Vector3::Zero();
  Vector3 half_length = Vector3::UnitX();  ///< from the centre to the middle of an edge
  Vector3 half_width = Vector3::UnitY();   ///< the same of the next edge, at right angles to it

  Vector3 normal() const { return half_length.cross(half_width).normalized(); }
};
/// A solid cylinder with flat ends.
struct RodShape {
  Vector3 begin = Vector3::Zero(), end = kUp;  ///< of its axis, apart
  double radius = 0;                           ///< > 0
};
struct BallShape {
  Vector3 centre = Vector3::Zero();
  double radius = 0;  ///< > 0
};
using SurfaceShape = std::variant<PlaneShape, RectangleShape, RodShape, BallShape>;

/// The place of a surface that is nearest to a point.
struct NearestPoint {
  Vector3 point = Vector3::Zero();
  Vector3 normal = kUp;  ///< unit, from there to the point that is asked for
  double distance = 0;   ///< between them; of a plane, rod or ball negative inside
};
NearestPoint nearest_point(const SurfaceShape& shape, const Vector3& to);

/// How a surface moves: its matter, and unless it is a belt its place with it.
class SurfaceMotion {
 public:
  SurfaceMotion() = default;
  /// Along two unit vectors at right angles, x_S(t) of `course` in them.
  static SurfaceMotion moving(SubstrateMotion course, const Vector3& first, const Vector3& second);
  /// The same of matter that passes by, as a belt's; the shape stays where it is.
  static SurfaceMotion belt(SubstrateMotion course, const Vector3& first, const Vector3& second);
  /// About an axis through `pivot`, at |rate| [rad/s] around rate.
  static SurfaceMotion turning(const Vector3& pivot, const Vector3& rate);

  bool is_still() const { return course_.is_still() && rate_.isZero(0); }
  bool is_belt() const { return belt_; }
  const Vector3& rate() const { return rate_; }    ///< [rad/s]
  const Vector3& pivot() const { return pivot_; }  ///< [m]
  const SubstrateMotion& course() const { return course_; }
  /// The directions of the course.
  const Vector3& first() const { return first_; }
  const Vector3& second() const { return second_; }

  /// x_S(t) of the matter [m]; zero where it turns.
  Vector3 way(double t) const { return along(course_.position(t)); }
  /// Of the matter at a place [m/s].
  Vector3 velocity(double t, const Vector3& at) const;
  /// Where what is now at a place was at rest [m], and back.
  Vector3 at_rest(double t, const Vector3& now) const;
  Vector3 now(double t, const Vector3& at_rest) const;
  /// The same for directions.
  Vector3 direction_now(double t, const Vector3& at_rest) const;

 private:
  Vector3 along(const Vector3& in_plane) const {
    return in_plane.x() * first_ + in_plane.y() * second_;
  }
  Vector3 turned(double angle, const Vector3& v) const;

  SubstrateMotion course_;
  Vector3 first_ = Vector3::UnitX(), second_ = Vector3::UnitY();
  bool belt_ = false;
  Vector3 pivot_ = Vector3::Zero(), rate_ = Vector3::Zero();
};

struct Surface {
  SurfaceShape shape;  ///< at rest: where it is when nothing has moved it
  SurfaceMotion motion;

  NearestPoint nearest(double t, const Vector3& to) const;
};

}  // namespace slipcheck
