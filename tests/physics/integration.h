#pragma once

#include <functional>

#include "physics/sphere.h"

namespace slipcheck::test {

/// Rates of a sphere's state: acceleration and angular acceleration.
struct Rates {
  Vector3 acceleration = Vector3::Zero();
  Vector3 angular_acceleration = Vector3::Zero();
};

/// The independent integration that tests compare with: classical fourth-order Runge-Kutta with
/// `steps` equal steps over `duration`.
inline BodyState integrate(BodyState state, double duration, int steps,
                           const std::function<Rates(const BodyState&)>& rates) {
  const double h = duration / steps;
  const auto moved = [](const BodyState& s, const BodyState& d, double dt) {
    return BodyState{s.position + dt * d.position, s.velocity + dt * d.velocity,
                     s.angular_velocity + dt * d.angular_velocity};
  };
  const auto slope = [&](const BodyState& s) {
    const Rates r = rates(s);
    return BodyState{s.velocity, r.acceleration, r.angular_acceleration};
  };
  for (int n = 0; n < steps; ++n) {
    const BodyState k1 = slope(state), k2 = slope(moved(state, k1, h / 2)),
                    k3 = slope(moved(state, k2, h / 2)), k4 = slope(moved(state, k3, h));
    state = moved(moved(moved(moved(state, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
  }
  return state;
}

}  // namespace slipcheck::test
