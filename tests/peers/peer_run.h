#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "../bullet_backend/bullet_run.h"
#include "../support/bundled.h"
#include "peer_worker.h"
#include "scene/contact_scene.h"

namespace slipcheck::test {

inline Settings peer_profile(const std::string& engine, const std::string& profile) {
  return load_profile(std::string(SLIPCHECK_SOURCE_DIR) + "/peer_backends/" + engine +
                      "/profiles/" + profile + ".yaml")
      .settings;
}

/// What a bundled scenario comes to.
inline Scene bundled_scene(const std::string& name) {
  return make_contact_scene(bundled(name)).hard;
}

/// States after every step of a run of an engine of its own.
using States = std::vector<std::vector<BodyState>>;

/// What a bare program yields is what the worker does with the profile `default`, for a second at
/// 240 Hz, to the last bit.
inline void expect_as_bare(const std::string& engine, const Scene& scene, const States& bare) {
  RemoteEngine worker(peer_executable(engine), kPatient);
  const auto frames = run(worker, scene, peer_profile(engine, "default"), 240, bare.size());
  ASSERT_EQ(frames.size(), bare.size());
  ASSERT_NE(std::memcmp(frames.front().bodies.data(), frames.back().bodies.data(),
                        scene.bodies.size() * sizeof(BodyState)),
            0)
      << "nothing moves";
  for (std::size_t n = 0; n < bare.size(); ++n)
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const BodyState &a = frames[n].bodies[i], &b = bare[n][i];
      ASSERT_EQ(a.position, b.position) << "step " << n << " body " << i;
      ASSERT_EQ(a.velocity, b.velocity) << "step " << n << " body " << i;
      ASSERT_EQ(a.angular_velocity, b.angular_velocity) << "step " << n << " body " << i;
    }
}

/// Frames of a scene in a worker with a profile's settings and others over them.
inline std::vector<Frame> run_peer(const std::string& engine, const Scene& scene,
                                   const std::string& profile, double rate, std::size_t steps,
                                   const Settings& over = {}) {
  RemoteEngine worker(peer_executable(engine), kPatient);
  return run(worker, scene, with(peer_profile(engine, profile), over), rate, steps);
}

/// A ball of 2 cm slides along a plate of 20 cm at z = 10 cm, over its edge, onto a peg of 5 cm
/// around x = 25 cm, z = -3 cm, and onto a belt along x at z = -10 cm.
inline Scene plate_peg_and_belt(double friction, double restitution, double belt_velocity) {
  BodyState start;
  start.position = Vector3(0, 0, 0.12);
  start.velocity = Vector3(0.8, 0, 0);
  Scene scene = scene_of(steel_ball(0.02), {start}, {});
  scene.has_substrate = false;
  RectangleShape plate;
  plate.centre = Vector3(0, 0, 0.1);
  plate.half_length = 0.1 * Vector3::UnitX();
  plate.half_width = 0.1 * Vector3::UnitY();
  const auto course = SubstrateMotion::constant({belt_velocity, 0});
  scene.surfaces = {{plate, {}},
                    {BallShape{{0.25, 0, -0.03}, 0.05}, {}},
                    {PlaneShape{{0, 0, -0.1}, Vector3::UnitZ()},
                     SurfaceMotion::belt(course, Vector3::UnitX(), Vector3::UnitY())}};
  SurfaceContact contact;
  contact.lasting.static_friction = contact.lasting.kinetic_friction = friction;
  contact.lasting.restitution = restitution;
  contact.impact.restitution = restitution;
  contact.impact.friction = friction;
  contact.impact.tangential_restitution = 0;
  scene.on_surfaces.assign(scene.surfaces.size(), contact);
  return scene;
}

/// A steel ball of 1 cm that slides along x on the plane.
inline BodyState sliding_ball(double speed) {
  BodyState state;
  state.position = Vector3(0, 0, 0.01);
  state.velocity = Vector3(speed, 0, 0);
  return state;
}

/// A ball at rest on a belt of this speed ends up rolling with 2/7 of it: the angular momentum
/// about its path on the belt stays, m v + I Ω/R = 0 with Ω R = v − V and I = 2/5 m R².
inline Scene belt(double speed) {
  Scene scene = scene_of(steel_ball(0.01), {sliding_ball(0)}, ground_with_friction(0.3));
  scene.motion = SubstrateMotion::constant(Vector2(speed, 0));
  return scene;
}

/// A ball that rolls on a shaken substrate from `begin` [s] on.
inline Scene ball_on_shaker(double begin) {
  Scene scene = scene_of(steel_ball(0.01), {sliding_ball(0)}, ground_with_friction(0.3));
  scene.motion = SubstrateMotion::oscillation({0.004, -0.003}, 5, 0.7);
  scene.initial[0].angular_velocity = rolling_angular_velocity(-scene.motion.velocity(begin), 0.01);
  return scene;
}

/// It keeps its angular momentum about its path on the substrate, so that v = 2/7 (v_S + u) + const
/// with its slip u. By how much v in any of 100 steps is not 2/7 v_S + const [m/s], and the place
/// not its integral, over the time [m/s]. The scene is configured.
inline double shaker_error(RemoteEngine& engine, const Scene& scene, double begin, double rate) {
  engine.start(scene.initial, begin);
  const SubstrateMotion& motion = scene.motion;
  const Vector3 at_first = motion.velocity(begin);
  double worst = 0, since = 0;
  int n = 0;
  engine.advance(100, [&](const Frame& frame) {
    if (frame.part < 1) return;
    since = ++n / rate;
    const Vector3 way = motion.position(begin + since) - motion.position(begin) - since * at_first;
    const Vector3 velocity = motion.velocity(begin + since) - at_first;
    const BodyState& ball = frame.bodies[0];
    worst = std::max(
        {worst, (ball.velocity - 2.0 / 7 * velocity).head<2>().norm(),
         (ball.position - scene.initial[0].position - 2.0 / 7 * way).head<2>().norm() / since});
    EXPECT_EQ(frame.touches.size(), 1u) << since;
  });
  EXPECT_EQ(n, 100);
  return worst;
}

/// A ball that spins about the vertical, on a plane of this drilling length.
inline Scene spinning_top(double drilling_length, double spin) {
  SubstrateContact ground = ground_with_friction(0.3);
  ground.drilling_length = drilling_length;
  BodyState state = sliding_ball(0);
  state.angular_velocity = Vector3(0, 0, spin);
  return scene_of(steel_ball(0.01), {state}, ground);
}

/// A ball that rolls at a heading, on a plane of rolling friction.
inline Scene rolling_ball(double mu_r, double speed, double degrees) {
  SubstrateContact ground = ground_with_friction(0.3);
  ground.rolling = RollingFriction(mu_r);
  return scene_of(steel_ball(0.01), {rolling_towards(0.01, speed, degrees)}, ground);
}

/// By how much a rolling ball is braked over so many steps, over μ_r g.
inline double rolling_ratio(const std::string& engine, const std::string& profile, double degrees,
                            const Settings& over = {}) {
  constexpr double kMuR = 0.02, kSpeed = 0.5, kRate = 1000;
  constexpr std::size_t kSteps = 500;
  const auto frames =
      run_peer(engine, rolling_ball(kMuR, kSpeed, degrees), profile, kRate, kSteps, over);
  const double lost = kSpeed - frames.back().bodies[0].velocity.norm();
  return lost / (kMuR * kGravity * static_cast<double>(kSteps) / kRate);
}

/// Two balls that meet head-on far from the plane, without gravity; where they part over where they
/// met, `phase` of a step into it.
inline double head_on_restitution(const std::string& engine, const std::string& profile,
                                  const RestitutionLaw& law, double speed, double phase,
                                  double rate, const Settings& over = {}) {
  PairContact pair;
  pair.restitution = law;
  const double x = 0.01 + (3 + phase) * speed / rate / 2;
  BodyState left, right;
  left.position = Vector3(-x, 0, 1);
  right.position = Vector3(x, 0, 1);
  left.velocity = Vector3(speed / 2, 0, 0);
  right.velocity = -left.velocity;
  Scene scene = scene_of(steel_ball(0.01), {left, right}, {}, pair);
  scene.gravity = 0;
  const auto frames = run_peer(engine, scene, profile, rate, 12, over);
  const auto& last = frames.back().bodies;
  return (last[1].velocity.x() - last[0].velocity.x()) / speed;
}

}  // namespace slipcheck::test
