// Surfaces in engines that are built here, each through its worker, beside closed forms. An engine
// whose package is not there is not asked.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <utility>

#include "engine/profile.h"
#include "worker_run.h"

namespace slipcheck::test {
namespace {

constexpr double kRadius = 0.02, kGravityHere = 9.81, kStep = 1e-3;

/// What an engine is bad at, by its page in docs/engines.
struct Peer {
  std::string name;
  bool plates = true, swings = true;  ///< plates; motions of other than constant velocity
};

std::vector<Peer> peers() {
  const std::vector<Peer> all = {{"ode"},
                                 {"dart"},
                                 {"mujoco"},
                                 {"lammps"},
                                 {"siconos", true, false},
                                 {"simbody", false, false}};
  std::vector<Peer> there;
  for (const Peer& peer : all)
    if (std::filesystem::exists(peer_executable(peer.name))) there.push_back(peer);
  return there;
}

/// LAMMPS's steps are parts of a collision, which need not be as short here.
Settings physical(const std::string& engine) {
  Settings settings = load_profile(std::string(SLIPCHECK_SOURCE_DIR) + "/peer_backends/" + engine +
                                   "/profiles/physical.yaml")
                          .settings;
  if (engine == "lammps") settings["collision_time"] = 2e-4;
  return settings;
}

/// One steel ball of 2 cm and surfaces that are alike.
Scene ball_and(std::vector<Surface> surfaces, const Vector3& position, double friction,
               double restitution) {
  Scene scene = ball_on({}, kRadius, position, Vector3::Zero());
  scene.has_substrate = false;
  SurfaceContact contact;
  contact.lasting.static_friction = contact.lasting.kinetic_friction = friction;
  contact.lasting.restitution = contact.impact.restitution.emplace<double>(restitution);
  contact.impact.friction = friction;
  contact.impact.tangential_restitution = friction > 0 ? 0 : -1;
  scene.on_surfaces.assign(surfaces.size(), contact);
  scene.surfaces = std::move(surfaces);
  return scene;
}

SurfaceMotion constant(const Vector3& velocity, bool belt) {
  const Vector3 first = velocity.normalized(), second = first.unitOrthogonal();
  const auto course = SubstrateMotion::constant({velocity.norm(), 0});
  return belt ? SurfaceMotion::belt(course, first, second)
              : SurfaceMotion::moving(course, first, second);
}

class PeerSurfaces : public ::testing::TestWithParam<Peer> {
 protected:
  /// At the ends of steps, with all touches since the one before.
  std::vector<Frame> run(const Scene& scene, std::size_t steps) {
    RemoteEngine worker(peer_executable(GetParam().name), kPatient);
    std::vector<Frame> ends;
    std::vector<Touch> since;
    for (Frame& frame : peer_run(worker, {scene}, physical(GetParam().name), kStep, steps)) {
      since.insert(since.end(), frame.touches.begin(), frame.touches.end());
      if (frame.part < 1) continue;
      frame.touches = std::exchange(since, {});
      ends.push_back(std::move(frame));
    }
    return ends;
  }
  /// Why it does not take a scene; empty where it does.
  std::string refusal(const Scene& scene) {
    RemoteEngine worker(peer_executable(GetParam().name), kPatient);
    try {
      worker.configure({scene}, physical(GetParam().name), kStep);
    } catch (const Refused& refused) {
      return refused.what();
    }
    return "";
  }
};

/// n sin 0.28379: sin θ = 0.28, cos θ = 0.96.
const Vector3 kSlopeNormal(0.28, 0, 0.96), kDownhill(0.96, 0, -0.28);

TEST_P(PeerSurfaces, ABallRollsDownATiltedPlaneWithFiveSeventhsOfGravityAlongIt) {
  const Scene scene =
      ball_and({{PlaneShape{Vector3::Zero(), kSlopeNormal}, {}}}, kRadius * kSlopeNormal, 0.4, 0);
  const auto frames = run(scene, 200);
  const double exact = 5.0 / 7 * kGravityHere * 0.28 * 0.2;
  // Soft contacts slip: Simbody below its transition velocity, MuJoCo by its time constant.
  EXPECT_NEAR(frames.back().bodies[0].velocity.dot(kDownhill), exact, 0.02 * exact);
  double carried = 0;
  for (const Frame& frame : frames)
    for (const Touch& touch : frame.touches) {
      EXPECT_EQ(touch.second, surface_touch(0));
      carried += touch.normal_impulse;
    }
  EXPECT_NEAR(carried / (scene.bodies[0].mass * kGravityHere * 0.96 * 0.2), 1, 0.03);
}

TEST_P(PeerSurfaces, ABallLeavesTheEdgeOfAPlateAndFalls) {
  RectangleShape plate;
  plate.half_length = 0.1 * kDownhill;
  plate.half_width = 0.1 * Vector3::UnitY();
  const Scene scene = ball_and({{plate, {}}}, 0.05 * kDownhill + kRadius * kSlopeNormal, 0.4, 0);
  if (!GetParam().plates) {
    EXPECT_NE(refusal(scene).find("surface 0 is a plate"), std::string::npos);
    return;
  }
  // 5 cm down the plate take √(2 s/a) = 0.226 s; from 0.3 s on it falls freely.
  const auto frames = run(scene, 400);
  const Vector3 early = frames[299].bodies[0].velocity, late = frames[399].bodies[0].velocity;
  EXPECT_NEAR(late.z() - early.z(), -kGravityHere * 0.1, 1e-3 * kGravityHere * 0.1);
  EXPECT_NEAR(late.x(), early.x(), 1e-6);
  EXPECT_GT(early.x(), 0.3);
  EXPECT_FALSE(frames[100].touches.empty() && frames[101].touches.empty());
  EXPECT_TRUE(frames[350].touches.empty());
}

TEST_P(PeerSurfaces, ABallAtRestOnABeltRollsInTheEndWithTwoSeventhsOfItsVelocity) {
  const Vector3 belt(0.6, 0.8, 0);
  for (const bool passes : {true, false}) {
    const Scene scene = ball_and({{PlaneShape{}, constant(belt, passes)}}, {0, 0, kRadius}, 0.3, 0);
    // It slides for 2 V/(7 μ g) = 97 ms.
    const Vector3 end = run(scene, 200).back().bodies[0].velocity;
    EXPECT_NEAR((Vector3(end.x(), end.y(), 0) - 2.0 / 7 * belt).norm(), 0, 0.015);
  }
}

TEST_P(PeerSurfaces, AWallThatComesThrowsABallOff) {
  const double speed = 0.5, restitution = 0.6;
  Scene scene =
      ball_and({{PlaneShape{{-0.1, 0, 0}, Vector3::UnitX()}, constant({speed, 0, 0}, false)}},
               Vector3::Zero(), 0, restitution);
  scene.gravity = 0;
  // 8 cm at 0.5 m/s are 0.16 s.
  const double thrown = run(scene, 300).back().bodies[0].velocity.x();
  EXPECT_NEAR(thrown / ((1 + restitution) * speed), 1, 0.03);
}

TEST_P(PeerSurfaces, WhatSwingsIsFollowedOrRefused) {
  const double amplitude = 0.01, frequency = 3;
  const auto course = SubstrateMotion::oscillation({amplitude, 0}, frequency, 0);
  const Scene scene =
      ball_and({{PlaneShape{}, SurfaceMotion::moving(course, Vector3::UnitZ(), Vector3::UnitX())}},
               {0, 0, kRadius}, 0, 0);
  if (!GetParam().swings) {
    EXPECT_NE(refusal(scene).find("surface 0 turns or swings"), std::string::npos);
    return;
  }
  // A ω² = 3.6 m/s² is less than g: the ball goes with it, √(m/k) behind where the contact is soft.
  for (const std::size_t step : {100UL, 250UL, 400UL}) {
    const auto frames = run(scene, step);
    const double t = kStep * static_cast<double>(step);
    EXPECT_NEAR(frames.back().bodies[0].position.z() - kRadius,
                amplitude * std::sin(2 * M_PI * frequency * t), 0.1 * amplitude);
  }
}

TEST_P(PeerSurfaces, CylindersAreTakenOrRefusedByTheirNumber) {
  const Scene scene = ball_and({{PlaneShape{}, {}}, {RodShape{{1, 0, 0}, {1, 1, 0}, 0.1}, {}}},
                               {0, 0, kRadius}, 0.3, 0);
  const bool round = GetParam().name != "dart" && GetParam().plates;
  EXPECT_EQ(refusal(scene).find("surface 1 is a") != std::string::npos, !round) << refusal(scene);
  EXPECT_EQ(refusal(scene).empty(), round);
}

INSTANTIATE_TEST_SUITE_P(Engines, PeerSurfaces, ::testing::ValuesIn(peers()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace slipcheck::test
