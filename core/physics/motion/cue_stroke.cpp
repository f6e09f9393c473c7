#include "physics/motion/cue_stroke.h"

#include <cmath>

namespace slipcheck {

Vector3 CueStroke::direction() const {
  const Vector3 h(heading.x(), heading.y(), 0);
  return std::cos(elevation) * h - std::sin(elevation) * kUp;
}

double CueStroke::impulse(const Sphere& ball, double speed, double mass, double restitution) const {
  const double off = right * right + up * up;
  return (1 + restitution) * speed / (1 / mass + 1 / ball.mass + off / ball.moment_of_inertia());
}

void CueStroke::strike(const Sphere& ball, double impulse, BodyState& state) const {
  const Vector3 d = direction();
  const Vector3 s(heading.y(), -heading.x(), 0);
  const Vector3 w = s.cross(d);
  state.velocity += (impulse / ball.mass) * d;
  state.angular_velocity += (impulse / ball.moment_of_inertia()) * (right * w - up * s);
}

double largest_offset(double tip_friction) {
  return tip_friction / std::sqrt(1 + tip_friction * tip_friction);
}

}  // namespace slipcheck
