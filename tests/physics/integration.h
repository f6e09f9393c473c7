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

/// The same for any vector s with ṡ = rate(t, s).
template <class State, class Rate>
State integrate(const Rate& rate, State s, double begin, double end, int steps) {
  const double h = (end - begin) / steps;
  for (int n = 0; n < steps; ++n) {
    const double t = begin + n * h;
    const State k1 = rate(t, s);
    const State k2 = rate(t + h / 2, State(s + h / 2 * k1));
    const State k3 = rate(t + h / 2, State(s + h / 2 * k2));
    const State k4 = rate(t + h, State(s + h * k3));
    s += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return s;
}

}  // namespace slipcheck::test
