#include "physics/contact/step_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../support/runge_kutta.h"

namespace slipcheck {
namespace {

struct State {
  double x, v;
};

constexpr double kOmega = 1.3e5;

/// Whether the amplitude grows over a million steps, which make a large factor even of 2.5e-5 a
/// step (explicit Euler with γ = 0.07 ω0, one per cent above its limit).
template <class Step>
bool grows(double h, Step step) {
  State s{1, 0.3 * kOmega};
  const auto size = [](const State& y) { return std::hypot(y.x, y.v / kOmega); };
  const double start = size(s);
  for (int n = 0; n < 1'000'000 && size(s) < 1e100; ++n) step(s, h);
  return size(s) > 100 * start;
}

template <class Step>
void expect_limit(double limit, Step step) {
  EXPECT_FALSE(grows(0.99 * limit, step));
  EXPECT_TRUE(grows(1.01 * limit, step));
}

double rate(const State& s, double gamma) { return -gamma * s.v - kOmega * kOmega * s.x; }

TEST(StepLimit, SymplecticEuler) {
  for (double ratio : {0.0, 0.07, 0.5, 1.9, 5.0}) {
    const double gamma = ratio * kOmega;
    expect_limit(symplectic_euler_limit(kOmega, gamma), [&](State& s, double h) {
      s.v += h * rate(s, gamma);
      s.x += h * s.v;
    });
    EXPECT_NEAR(symplectic_euler_limit(kOmega, gamma) * kOmega, std::hypot(ratio, 2) - ratio,
                1e-14);
  }
}

TEST(StepLimit, VelocityVerlet) {
  expect_limit(velocity_verlet_limit(kOmega), [](State& s, double h) {
    s.v += 0.5 * h * rate(s, 0);
    s.x += h * s.v;
    s.v += 0.5 * h * rate(s, 0);
  });
}

TEST(StepLimit, ExplicitEuler) {
  for (double ratio : {0.07, 0.5, 1.9, 2.0, 5.0}) {
    const double gamma = ratio * kOmega;
    expect_limit(explicit_euler_limit(kOmega, gamma), [&](State& s, double h) {
      const double a = rate(s, gamma);
      s.x += h * s.v;
      s.v += h * a;
    });
  }
  EXPECT_TRUE(grows(0.1 / kOmega, [](State& s, double h) {  // without damping at any step
    const double a = rate(s, 0);
    s.x += h * s.v;
    s.v += h * a;
  }));
  EXPECT_EQ(explicit_euler_limit(kOmega, 0), 0);
}

TEST(StepLimit, RungeKutta) {
  expect_limit(runge_kutta_limit(kOmega), [](State& s, double h) {
    const auto slope = [](double, const Vector2& y) {
      return Vector2(y[1], rate({y[0], y[1]}, 0));
    };
    const Vector2 next = test::runge_kutta_step(slope, 0, Vector2(s.x, s.v), h);
    s = {next[0], next[1]};
  });
}

}  // namespace
}  // namespace slipcheck
