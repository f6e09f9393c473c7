#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../support/runge_kutta.h"
#include "physics/motion/driven_phase.h"

// A sphere on a tilted or moving substrate, followed by phases and by the laws themselves.

namespace slipcheck::test {

using Kind = DrivenPhase::Kind;
inline constexpr double kGravity = 9.81;
inline constexpr double kPi = std::numbers::pi;

struct Scene {
  Sphere ball{0.002, 2.6e-4, 0.4};
  SubstrateContact contact;
  Vector2 downhill = Vector2::Zero();
  SubstrateMotion motion;

  DrivenPhase phase(double time, const BodyState& state) const {
    return {ball, contact, kGravity, downhill, motion, time, state};
  }
};

inline Scene scene_with(double static_friction, double kinetic) {
  Scene scene;
  scene.contact.static_friction = static_friction;
  scene.contact.kinetic_friction = kinetic;
  return scene;
}

inline BodyState at_rest(const Scene& scene, double time = 0) {
  BodyState state;
  state.position.z() = scene.ball.radius;
  state.velocity = scene.motion.velocity(time);
  return state;
}

inline void expect_close(const Vector3& a, const Vector3& b, double tolerance) {
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " against " << b.transpose();
}

inline Vector3 slip_of(const Scene& scene, double t, const BodyState& s) {
  Vector3 slip = slip_velocity(s, scene.ball.radius) - scene.motion.velocity(t);
  slip.z() = 0;
  return slip;
}

/// Newton and Euler of each kind of motion, with forces and torques.
inline Rates rates(const Scene& scene, Kind kind, double t, const BodyState& s) {
  const Sphere& ball = scene.ball;
  const double m = ball.mass, I = ball.moment_of_inertia(), R = ball.radius;
  const Vector3 lever = -R * Vector3::UnitZ();
  const Vector3 pull(scene.downhill.x(), scene.downhill.y(), 0);
  const Vector3 shaking = scene.motion.acceleration(t);
  if (kind == Kind::resting) return {shaking, Vector3::Zero()};
  if (kind == Kind::sliding) {
    const Vector3 force =
        -scene.contact.kinetic_friction * m * kGravity * slip_of(scene, t, s).normalized();
    return {pull + force / m, lever.cross(force) / I};
  }
  // Without slip: m v̇ = m pull + f + f_R, and the surface keeps to the substrate. From f alone,
  // f (1/m + R²/I) = a_S − pull; f_R acts on the centre and turns the sphere with it, K (16).
  const Vector3 f = (shaking - pull) / (1 / m + R * R / I);
  Vector3 a = pull + f / m;
  const Vector3 w = s.velocity - scene.motion.velocity(t);
  if (w.norm() > 0) a -= scene.contact.rolling(w.norm()) * kGravity / w.norm() * w;
  return {a, Vector3::UnitZ().cross(a - shaking) / R};
}

/// A phase's kind of motion integrated from a state.
inline BodyState integrated(const Scene& scene, Kind kind, double time, const BodyState& start,
                            double duration, int steps) {
  return integrate(start, duration, steps,
                   [&](double t, const BodyState& s) { return rates(scene, kind, time + t, s); });
}

/// Follows a body by phases.
struct Follower {
  const Scene& scene;
  double time = 0;
  BodyState state;
  int phases = 0;
  int longest_standstill = 0;  // most phases in a row without a change of the time

  /// Calls seen(phase, time) for each.
  template <class Seen>
  void run(double end, const Seen& seen) {
    int standstill = 0;
    while (time < end && phases < 100000) {
      const DrivenPhase phase = scene.phase(time, state);
      seen(phase, time);
      ++phases;
      if (!(phase.duration() < end - time)) {
        state = phase.at(end - time);
        time = end;
        return;
      }
      state = phase.at_end();
      const double next = time + phase.duration();
      standstill = next > time ? 0 : standstill + 1;
      longest_standstill = std::max(longest_standstill, standstill);
      time = next;
    }
  }
  void run(double end) {
    run(end, [](const DrivenPhase&, double) {});
  }
};

}  // namespace slipcheck::test
