#include "harness/observe/motion_quantities.h"

#include <cassert>
#include <cstddef>

#include "harness/observe/observables.h"

namespace slipcheck {
namespace {

Vector3 slip_over_substrate(const Scene& scene, const Sphere& body, double time,
                            const BodyState& state) {
  if (scene.box || !is_on_substrate(body, state)) return kVectorNotObserved;
  Vector3 slip = slip_velocity(state, body) - scene.motion.velocity(time);
  slip.z() = 0;
  return slip;
}

double kinetic_energy(const Sphere& body, const BodyState& state) {
  return 0.5 * (body.mass * state.velocity.squaredNorm() +
                body.moment_of_inertia() * state.angular_velocity.squaredNorm());
}

}  // namespace

bool is_on_substrate(const Sphere& body, const BodyState& state) {
  return state.position.z() <= body.radius * (1 + 1e-3);
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
      slip.push_back(slip_over_substrate(scene, scene.bodies[i], frame.time, state));
      speed.push_back(state.velocity.norm());
      energy += kinetic_energy(scene.bodies[i], state);
    }
  }
  return quantities;
}

}  // namespace slipcheck
