#pragma once

#include <stdexcept>

#include "physics/sphere.h"

// The independent integration that tests compare with: classical fourth-order Runge-Kutta with
// equal steps, for any vector s with ṡ = rate(t, s).

namespace slipcheck::test {

/// s at t + h.
template <class Rate, class State>
State runge_kutta_step(const Rate& rate, double t, const State& s, double h) {
  const State k1 = rate(t, s);
  const State k2 = rate(t + h / 2, State(s + h / 2 * k1));
  const State k3 = rate(t + h / 2, State(s + h / 2 * k2));
  const State k4 = rate(t + h, State(s + h * k3));
  return s + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

/// s at `end` if it is `s` at `begin`.
template <class Rate, class State>
State integrate(const Rate& rate, State s, double begin, double end, int steps) {
  const double h = (end - begin) / steps;
  for (int n = 0; n < steps; ++n) s = runge_kutta_step(rate, begin + n * h, s, h);
  return s;
}

/// s where over(s) begins to hold, not before the first step h; found by halving the last one down
/// to `shortest`. Shows seen(s) each on the way. The rate depends on s alone. Throws
/// std::runtime_error where it does not within 10⁷ steps.
template <class Rate, class State, class Over, class Seen>
State integrate_until(const Over& over, const Rate& rate, State s, double h, double shortest,
                      const Seen& seen) {
  int steps = 0;
  for (bool first = true; h > shortest; first = false) {
    if (++steps > 10'000'000) throw std::runtime_error("what ends the integration never holds");
    const State next = runge_kutta_step(rate, 0, s, h);
    if (over(next) && !first) {
      h /= 2;
      continue;
    }
    seen(s = next);
  }
  return s;
}

/// Rates of a sphere's state: acceleration and angular acceleration.
struct Rates {
  Vector3 acceleration = Vector3::Zero();
  Vector3 angular_acceleration = Vector3::Zero();
};

/// A sphere after `duration` from time 0, with rates(t, state).
template <class RatesOf>
BodyState integrate(const BodyState& start, double duration, int steps, const RatesOf& rates) {
  const auto body = [](const Matrix3& s) { return BodyState{s.col(0), s.col(1), s.col(2)}; };
  const auto columns = [](const Vector3& a, const Vector3& b, const Vector3& c) {
    return (Matrix3() << a, b, c).finished();
  };
  const auto rate = [&](double t, const Matrix3& s) {
    const Rates r = rates(t, body(s));
    return columns(s.col(1), r.acceleration, r.angular_acceleration);
  };
  return body(integrate(rate, columns(start.position, start.velocity, start.angular_velocity), 0,
                        duration, steps));
}

}  // namespace slipcheck::test
