#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "../support/extremes.h"
#include "random_scene.h"
#include "reference/events/event_solver.h"
#include "scene/similarity.h"

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

/// The largest difference of two states of a body, in its radius, in `speed` and in that over the
/// radius.
double difference(const BodyState& a, const BodyState& b, double radius, double speed) {
  return test::largest_of((a.position - b.position).norm() / radius,
                          (a.velocity - b.velocity).norm() / speed,
                          (a.angular_velocity - b.angular_velocity).norm() * radius / speed);
}

/// What a symmetry makes of a scene and of the state of one body at the end.
struct Image {
  Scene scene;
  double end = kEnd;
  std::function<BodyState(const BodyState&)> of;
  std::vector<std::size_t> from = {};  ///< by body of the image, the one it was; empty: the same
  double speed = 1;                    ///< what 1 m/s becomes
};

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
      const std::size_t k = image.from.empty() ? i : image.from[i];
      EXPECT_LE(difference(image.of(one.states[k]), other.states[i], image.scene.bodies[i].radius,
                           image.speed),
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
  // y → −y: a spin is an axial vector.
  const auto mirrored = [](BodyState state) {
    state.position.y() *= -1;
    state.velocity.y() *= -1;
    state.angular_velocity.x() *= -1;
    state.angular_velocity.z() *= -1;
    return state;
  };
  expect_symmetry(
      [&](Scene scene, test::Random&) {
        for (BodyState& state : scene.initial) state = mirrored(state);
        return Image{.scene = scene, .of = mirrored};
      },
      150);
}

TEST(SceneProperties, ATurnedSceneHasTheTurnedEnd) {
  expect_symmetry(
      [](const Scene& scene, test::Random& random) {
        const double angle = random(0, 2 * M_PI);
        const Similarity turn{1, {std::cos(angle), std::sin(angle)}};
        return Image{.scene = turned(scene, turn.heading),
                     .of = [turn](const BodyState& state) { return turn.of(state); }};
      },
      150);
}

TEST(SceneProperties, OnABeltOfTheSameSpeedEverythingIsAsOnAStillPlane) {
  expect_symmetry(
      [](Scene scene, test::Random& random) {
        const Vector3 belt(random(-1, 1), random(-1, 1), 0);
        scene.motion = SubstrateMotion::constant(belt.head<2>());
        for (BodyState& state : scene.initial) state.velocity += belt;
        return Image{.scene = scene, .of = [belt](BodyState state) {
                       state.position += kEnd * belt;
                       state.velocity += belt;
                       return state;
                     }};
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
  expect_symmetry(
      [](const Scene& scene, test::Random& random) {
        std::vector<std::size_t> from(scene.bodies.size());
        std::iota(from.begin(), from.end(), std::size_t{0});
        std::rotate(from.begin(), from.begin() + 1, from.end());
        if (random.chance(0.5)) std::swap(from[0], from[1]);
        Scene other = scene;
        for (std::size_t i = 0; i < from.size(); ++i) {
          other.bodies[i] = scene.bodies[from[i]];
          other.material[i] = scene.material[from[i]];
          other.initial[i] = scene.initial[from[i]];
        }
        return Image{
            .scene = other, .of = [](const BodyState& state) { return state; }, .from = from};
      },
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
