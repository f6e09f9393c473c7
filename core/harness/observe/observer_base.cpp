#include <algorithm>
#include <cmath>

#include "harness/observe/observer.h"

// What carries a body where there are surfaces beside the substrate.

namespace slipcheck {

NearestPoint Observer::nearest(int base, double t, const BodyState& state) const {
  return base == kSubstrate ? nearest_point(PlaneShape{}, state.position)
                            : scene_->surfaces[touched_surface(base)].nearest(t, state.position);
}

double Observer::gap(std::size_t i, double t, const BodyState& state) const {
  if (bodies_[i].base == kSubstrate && !scene_->has_substrate) return scene_->bodies[i].radius;
  return nearest(bodies_[i].base, t, state).distance - scene_->bodies[i].radius;
}

SubstrateContact Observer::contact_with(std::size_t i, int base) const {
  return base == kSubstrate ? scene_->on_substrate(i)
                            : scene_->on_surface(i, touched_surface(base)).lasting;
}

bool Observer::take_base(std::size_t i, int base, double t, const BodyState& state) {
  constexpr double kLevel = 1e-6;
  const Vector3 gravity = scene_->gravity_vector();
  const Vector3 up = nearest(base, t, state).normal;
  const double pressed = -up.dot(gravity);
  if (!(pressed > kLevel * gravity.norm())) return false;
  Body& body = bodies_[i];
  body.base = base;
  body.up = up;
  body.zero = resolution(i, contact_with(i, base), pressed);
  body.slip.reset();
  body.speed.reset();
  body.spin.reset();
  return true;
}

/// Of all that it touches at the start that which carries most of it.
void Observer::find_base(std::size_t i, double t, const BodyState& state) {
  const Vector3 gravity = scene_->gravity_vector();
  const auto look = [&](int base, double& most) {
    const NearestPoint near = nearest(base, t, state);
    const double pressed = -near.normal.dot(gravity);
    const double radius = scene_->bodies[i].radius;
    if (near.distance > radius * (1 + 1e-9) || pressed <= most) return;
    if (take_base(i, base, t, state)) most = pressed;
  };
  double most = 0;
  if (scene_->has_substrate) look(kSubstrate, most);
  for (std::size_t k = 0; k < scene_->surfaces.size(); ++k) look(surface_touch(k), most);
}

std::vector<BodyState> Observer::rolling(double time, std::vector<BodyState> states) const {
  for (std::size_t i = 0; i < states.size(); ++i) {
    BodyState& state = states[i];
    const int base = on_surfaces_ ? bodies_[i].base : kSubstrate;
    const Vector3 up = on_surfaces_ ? bodies_[i].up : kUp;
    const Vector3 ground =
        base == kSubstrate
            ? scene_->motion.velocity(time)
            : scene_->surfaces[touched_surface(base)].motion.velocity(time, state.position);
    const double radius = scene_->bodies[i].radius;
    if (base == kSubstrate)
      state.position.z() = radius;
    else
      state.position -= gap(i, time, state) * up;
    state.velocity -= up.dot(state.velocity) * up;
    const double spin = up.dot(state.angular_velocity);
    state.angular_velocity = up.cross(state.velocity - ground) / radius + spin * up;
  }
  return states;
}

void Observer::look_at_ground_of(std::size_t i, double t0, double t1, const BodyState& now) {
  const int base = bodies_[i].base;
  if (base == kSubstrate) {
    const SubstrateMotion& motion = scene_->motion;
    ground0_ = {motion.position(t0), motion.velocity(t0)};
    ground1_ = {motion.position(t1), motion.velocity(t1)};
    return;
  }
  const SurfaceMotion& motion = scene_->surfaces[touched_surface(base)].motion;
  ground0_ = {motion.way(t0), motion.velocity(t0, last_.bodies[i].position)};
  ground1_ = {motion.way(t1), motion.velocity(t1, now.position)};
}

}  // namespace slipcheck
