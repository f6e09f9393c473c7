#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "reference/events/event_solver.h"
#include "scene_images.h"

// What holds whatever the scene is: two and three bodies of any kind that the solver takes, seed by
// seed. A scene and its image under a symmetry are solved both, and the image of the one's end must
// be the other's. Rounding differs between them and grows some tenfold at each collision; of scenes
// with more than five collisions in a second nothing is asked.

namespace slipcheck {
namespace {

constexpr unsigned kSeeds = 300;
constexpr double kEnd = 1;  // [s]
constexpr std::size_t kMostCollisions = 5;
constexpr double kRounding = 1e-8;  // of 1e-16, after kMostCollisions and some dozens of events

using test::Image;

struct Ended {
  std::vector<BodyState> states;
  std::size_t collisions = 0;
  bool reached = false;
};

Ended solved(const Scene& scene, double end = kEnd) {
  EventSettings settings;
  settings.most_events = 1000;
  settings.burst = 5000;
  EventSolver solver(scene, scene.initial, settings);
  const SolvedRun run = solver.run(until_time(end), nullptr);
  return {solver.states(), run.collisions, run.reached};
}

/// Solves scenes of two and three bodies and their images. At least `least` of them must tell.
void expect_symmetry(const std::function<Image(const Scene&, test::Random&)>& image_of,
                     std::size_t least) {
  std::size_t judged = 0, collided = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = test::random_scene(seed, 2 + seed % 2);
    test::Random random(seed + 1000);
    const Image image = image_of(scene, random);
    const Ended one = solved(scene);
    if (!one.reached || one.collisions > kMostCollisions) continue;
    const Ended other = solved(image.scene, image.end);
    ASSERT_TRUE(other.reached);
    ASSERT_EQ(one.collisions, other.collisions);
    for (std::size_t i = 0; i < other.states.size(); ++i) {
      const std::size_t k = image.origin_of(i);
      EXPECT_LE(test::difference(image.of(one.states[k]), other.states[i],
                                 image.scene.bodies[i].radius, image.speed),
                kRounding)
          << "body " << i;
    }
    ++judged;
    collided += one.collisions > 0 ? 1 : 0;
  }
  EXPECT_GE(judged, least);
  EXPECT_GE(collided, least / 4);
}

TEST(SceneProperties, AMirrorImageHasTheMirroredEnd) {
  expect_symmetry([](const Scene& scene, test::Random&) { return test::mirrored(scene, kEnd); },
                  150);
}

TEST(SceneProperties, ATurnedSceneHasTheTurnedEnd) {
  expect_symmetry(
      [](const Scene& scene, test::Random& random) {
        const double angle = random(0, 2 * M_PI);
        return test::turned_by(scene, kEnd, {std::cos(angle), std::sin(angle)});
      },
      150);
}

TEST(SceneProperties, OnABeltOfTheSameSpeedEverythingIsAsOnAStillPlane) {
  expect_symmetry(
      [](const Scene& scene, test::Random& random) {
        const double x = random(-1, 1), y = random(-1, 1);
        return test::on_a_belt(scene, kEnd, {x, y});
      },
      150);
}

TEST(SceneProperties, OtherUnitsOfLengthMassAndTimeChangeNothingElse) {
  expect_symmetry(
      [](Scene scene, test::Random& random) {
        const double length = std::exp(random(-5, 5)), mass = std::exp(random(-5, 5)),
                     time = std::exp(random(-2, 2)), speed = length / time;
        scene.gravity *= speed / time;
        for (Sphere& sphere : scene.bodies) sphere.radius *= length, sphere.mass *= mass;
        const auto scaled = [=](BodyState state) {
          state.position *= length;
          state.velocity *= speed;
          state.angular_velocity /= time;
          return state;
        };
        for (BodyState& state : scene.initial) state = scaled(state);
        for (SubstrateContact& ground : scene.substrate) {
          ground.drilling_length *= length;
          std::vector<RollingFriction::Point> points = ground.rolling.points();
          for (auto& point : points) point.speed *= speed;
          ground.rolling = RollingFriction(std::move(points));
        }
        return Image{.scene = scene, .end = kEnd * time, .of = scaled, .speed = speed};
      },
      150);
}

TEST(SceneProperties, TheOrderOfTheBodiesIsNoMatter) {
  expect_symmetry([](const Scene& scene,
                     test::Random& random) { return test::in_another_order(scene, kEnd, random); },
                  150);
}

/// Linear momentum, angular momentum about the origin, and kinetic energy of all bodies.
struct Sums {
  Vector3 momentum = Vector3::Zero(), turning = Vector3::Zero();
  double energy = 0;
};
Sums sums_of(const Scene& scene, const std::vector<BodyState>& states) {
  Sums sums;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Sphere& body = scene.bodies[i];
    const BodyState& s = states[i];
    sums.momentum += body.mass * s.velocity;
    sums.turning +=
        body.mass * s.position.cross(s.velocity) + body.moment_of_inertia() * s.angular_velocity;
    sums.energy += 0.5 * body.mass * s.velocity.squaredNorm() +
                   0.5 * body.moment_of_inertia() * s.angular_velocity.squaredNorm();
  }
  return sums;
}

TEST(SceneProperties, FreeBodiesKeepTheirMomentaAndGainNoEnergy) {
  // Far above the plane, without gravity, thrown at each other in space, rough and spinning.
  std::size_t collided = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Scene scene = test::random_scene(seed, 2 + seed % 2);
    test::Random random(seed + 2000);
    scene.gravity = 0;
    scene.confined = false;
    for (std::size_t i = 0; i < scene.initial.size(); ++i) {
      BodyState& state = scene.initial[i];
      state.position.z() = 100 + 0.5 * scene.bodies[i].radius * random(-1, 1);
      const Vector3 aim = scene.initial[0].position - state.position;
      state.velocity = i == 0 ? Vector3::Zero() : Vector3(random(0.2, 1) * aim.normalized());
      state.velocity.z() += random(-0.02, 0.02);
      state.angular_velocity = Vector3(random(-9, 9), random(-9, 9), random(-9, 9));
    }
    const Ended end = solved(scene);
    ASSERT_TRUE(end.reached);
    collided += end.collisions > 0 ? 1 : 0;
    const Sums before = sums_of(scene, scene.initial), after = sums_of(scene, end.states);
    // Momenta of 1 kg m/s, at 100 m; a rounding at each collision.
    EXPECT_LE((after.momentum - before.momentum).norm(), 1e-13);
    EXPECT_LE((after.turning - before.turning).norm(), 1e-11);
    EXPECT_LE(after.energy, before.energy * (1 + 1e-12));
  }
  EXPECT_GE(collided, 200u);
}

TEST(SceneProperties, WhatIsFartherAwayIsMetLater) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random random(seed);
    Scene scene = test::random_scene(seed, 2);
    scene.confined = true;
    const double contact = scene.bodies[0].radius + scene.bodies[1].radius;
    double before = 0;
    for (double gap = 1e-6; gap < 10; gap *= random(1.5, 4)) {
      const double v = 1;
      for (std::size_t i : {0, 1}) {
        const double x = i == 0 ? 0 : contact + gap, radius = scene.bodies[i].radius;
        scene.initial[i] = test::rolling_at(x, 0, i == 0 ? v : 0, 0, radius);
      }
      // Where the radii differ the line of centres rises, and they touch a little later than `gap`.
      EventSolver solver(scene, scene.initial);
      const double t = solver.next_collision(100, 0);
      EXPECT_GE(t, gap / v * (1 - 1e-12));
      EXPECT_GT(t, before);
      if (!std::isfinite(t)) break;  // rolling friction stops it short
      before = t;
    }
    EXPECT_GT(before, 0);
  }
}

}  // namespace
}  // namespace slipcheck
