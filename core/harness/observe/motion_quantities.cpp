#include "harness/observe/motion_quantities.h"

#include <cassert>
#include <cstddef>

#include "harness/observe/observables.h"

namespace slipcheck {
namespace {

constexpr double kNear = 1e-3;  ///< part of its radius that a body on a surface is off it at most

Vector3 slip_over_substrate(const Scene& scene, const Sphere& body, double time,
                            const BodyState& state) {
  Vector3 slip = slip_velocity(state, body) - scene.motion.velocity(time);
  slip.z() = 0;
  return slip;
}

/// Over that surface within R/1000 which carries most of the body.
Vector3 slip_over_surfaces(const Scene& scene, const Sphere& body, double time,
                           const BodyState& state) {
  Vector3 slip = kVectorNotObserved;
  double most = 0;
  for (const Surface& surface : scene.surfaces) {
    const NearestPoint near = surface.nearest(time, state.position);
    const double pressed = -near.normal.dot(scene.gravity_vector());
    if (near.distance > body.radius * (1 + kNear) || pressed <= most) continue;
    most = pressed;
    const Vector3 u = state.velocity + body.radius * near.normal.cross(state.angular_velocity) -
                      surface.motion.velocity(time, near.point);
    slip = u - near.normal.dot(u) * near.normal;
  }
  return slip;
}

Vector3 slip_of(const Scene& scene, std::size_t i, double time, const BodyState& state) {
  if (scene.box) return kVectorNotObserved;
  const Sphere& body = scene.bodies[i];
  return is_on_substrate(scene, i, state) ? slip_over_substrate(scene, body, time, state)
                                          : slip_over_surfaces(scene, body, time, state);
}

double kinetic_energy(const Sphere& body, const BodyState& state) {
  return 0.5 * (body.mass * state.velocity.squaredNorm() +
                body.moment_of_inertia() * state.angular_velocity.squaredNorm());
}

}  // namespace

bool is_on_substrate(const Scene& scene, std::size_t body, const BodyState& state) {
  return scene.has_substrate && state.position.z() <= scene.bodies[body].radius * (1 + kNear);
}

MotionQuantities motion_quantities(const Scene& scene, const RecordedMotion& motion) {
  MotionQuantities quantities;
  for (const MotionFrame& frame : motion.frames) {
    assert(frame.bodies.size() == scene.bodies.size());
    auto& slip = quantities.slip.emplace_back();
    auto& speed = quantities.speed.emplace_back();
    double& energy = quantities.kinetic_energy.emplace_back(0);
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
      const BodyState& state = frame.bodies[i];
      slip.push_back(slip_of(scene, i, frame.time, state));
      speed.push_back(state.velocity.norm());
      energy += kinetic_energy(scene.bodies[i], state);
    }
  }
  return quantities;
}

}  // namespace slipcheck
