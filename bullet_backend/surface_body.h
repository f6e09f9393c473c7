#pragma once

#include <memory>
#include <optional>

#include "bullet_backend/world_units.h"

class btRigidBody;

namespace slipcheck::bullet {

/// A surface beside the substrate as a Bullet body: a plane as a half-space, a plate as the convex
/// hull of its four corners, a rod as a cylinder, a ball as a sphere, all without a margin. A hull
/// of no thickness is met where the plate is, on either face and round its edges: Bullet looks for
/// the point of it that is nearest to a ball's centre, until that is through. Measured: normals to
/// 1e-5 rad and gaps to 3e-6 of the ball's radius in single precision, one contact each; a box is
/// off by half its thickness on both faces, two triangles are met twice along their common edge,
/// and Bullet's default margin of 0.04 length units is two radii of a ball of 2 cm.
///
/// What moves is kinematic, as in surfaces.h: where its places are, Bullet sees its velocity.
class SurfaceBody {
 public:
  /// `surface` in the world's units and the scene's axes; `index` is the body's user index. The
  /// body is not yet in a world. Its user pointer is this.
  SurfaceBody(const Surface& surface, const WorldUnits& units, const BulletSettings& settings,
              int index);
  ~SurfaceBody();

  btRigidBody& body() const;

  /// A step of length `time_step` begins at `time`.
  void begin_step(double time, double time_step);

  /// Once Bullet has made velocities of the places, puts them right, but where the settings ask for
  /// what Bullet makes. Places a short step apart differ by rounding, and an angle is twice the arc
  /// cosine of a quaternion's part there: what is below the root of the rounding is lost, 0.5 mrad
  /// in single precision.
  void tell_velocity() const;

  // All places and directions are in the world's axes.

  /// Where it is nearest to a place at a time.
  NearestPoint nearest(double time, const Vector3& to) const;
  NearestPoint nearest_now(const Vector3& to) const { return nearest(time_, to); }
  /// As the scene has it.
  Vector3 velocity(double time, const Vector3& at) const;
  /// What Bullet was told of its velocity in this step, and in the step before: what stuck to it
  /// then goes with this now.
  Vector3 told_velocity(const Vector3& at) const;
  Vector3 told_before(const Vector3& at) const;
  /// None of its matter near a place is ever faster.
  double largest_speed(const Vector3& near) const;
  bool is_still() const { return surface_.motion.is_still(); }
  double turning_rate() const { return surface_.motion.rate().norm(); }  ///< >= 0
  bool is_ball() const { return std::holds_alternative<BallShape>(surface_.shape); }

 private:
  struct Body;
  Vector3 course_velocity(double time, double time_step) const;
  Vector3 turning_at(const Vector3& at) const;

  Surface surface_;
  Matrix3 turn_;
  SurfaceVelocity told_;
  double time_ = 0;
  std::optional<Vector3> told_now_;
  Vector3 told_before_ = Vector3::Zero();
  std::unique_ptr<Body> body_;
};

}  // namespace slipcheck::bullet
