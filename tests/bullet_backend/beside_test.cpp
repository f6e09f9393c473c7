// Surfaces beside the substrate: where Bullet meets them, and how they move.

#include <gtest/gtest.h>

#include <cmath>

#include "bullet_run.h"

namespace slipcheck {
namespace {

constexpr double kBallRadius = 0.02;

/// One ball without a substrate, and beside what it meets a plane far below as surface 0.
Scene beside(const BodyState& state, const Surface& surface, double mu, double e) {
  Scene scene = scene_of(steel_ball(kBallRadius), {state}, ground_with_friction(0));
  scene.has_substrate = false;
  scene.surfaces = {{PlaneShape{{0, 0, -10}, kUp}, {}}, surface};
  SubstrateContact ground = ground_with_friction(mu);
  ground.restitution = e;
  scene.on_surfaces.assign(2, {ground, {e, mu, 0}});
  return scene;
}

BodyState resting_at(const Vector3& place) {
  BodyState state;
  state.position = place;
  return state;
}

struct Case {
  const char* precision;
  double tolerance;  // relative: rounding of each step
  double rod;        // of normals on a rod, as GJK finds them in radii
};

class BulletBeside : public ::testing::TestWithParam<Case> {
 protected:
  std::vector<Frame> steps(const Scene& scene, const char* profile, std::size_t count) {
    return run(engine_, scene, shipped(profile), 1000, count);
  }
  /// Flies at 2 m/s along −n onto a place, without gravity, and what is left of it [m/s].
  Vector3 rebound(const Surface& surface, const Vector3& place, const Vector3& n) {
    BodyState state = resting_at(place + (kBallRadius + 0.0505) * n);
    state.velocity = -2 * n;
    Scene scene = beside(state, surface, 0, 0.8);
    scene.gravity = 0;
    const auto frames = steps(scene, "physical", 60);
    for (const Frame& frame : frames)
      for (const Touch& touch : frame.touches) EXPECT_EQ(touch.second, surface_touch(1));
    return frames.back().bodies[0].velocity;
  }
  RemoteEngine engine_{bullet_executable(GetParam().precision)};
};

TEST_P(BulletBeside, ABallLeavesEveryShapeAlongItsNormalWithE) {
  const Vector3 n(0.5, 0, std::sqrt(0.75)), along(std::sqrt(0.75), 0, -0.5);
  const RectangleShape plate{{0, 0, 0.3}, 0.5 * along, {0, 0.2, 0}};
  const Vector3 on_plate = plate.centre + 0.1 * along + Vector3(0, 0.05, 0);
  const Vector3 off_edge = (along + n).normalized();
  const RodShape rod{{-0.5, 0, 0.1}, {0.5, 0, 0.1}, 0.03};
  struct Place {
    const char* name;
    SurfaceShape shape;
    Vector3 at, normal;
    double tolerance;
  };
  const double exact = GetParam().tolerance, by_gjk = GetParam().rod;
  const Place places[] = {{"plane", PlaneShape{{0.1, 0.2, 0.3}, n}, {0.1, 0.2, 0.3}, n, exact},
                          {"face", plate, on_plate, n, exact},
                          {"other face", plate, on_plate, -n, exact},
                          {"edge", plate, plate.centre + 0.5 * along, off_edge, exact},
                          {"rod", rod, {0.05, 0, 0.13}, kUp, by_gjk},
                          {"end of a rod", rod, {0.5, 0.01, 0.1}, Vector3::UnitX(), by_gjk},
                          {"ball", BallShape{{0, 0, 0.1}, 0.03}, {0, 0, 0.13}, kUp, exact}};
  for (const Place& place : places)
    EXPECT_LT((rebound({place.shape, {}}, place.at, place.normal) - 1.6 * place.normal).norm(),
              1.6 * place.tolerance)
        << place.name;
}

TEST_P(BulletBeside, ABallRollsDownAPlateWithFiveSeventhsOfGSinTheta) {
  const Vector3 n(0.28, 0, 0.96), down(0.96, 0, -0.28);
  const RectangleShape plate{Vector3::Zero(), 0.5 * down, {0, 0.2, 0}};
  const Scene scene = beside(resting_at(kBallRadius * n), {plate, {}}, 0.4, 0);
  for (const char* profile : {"default", "physical"}) {
    const auto frames = steps(scene, profile, 300);
    const double exact = 5.0 / 7 * kGravity * 0.28 * 0.3;
    EXPECT_LT((frames.back().bodies[0].velocity / exact - down).norm(), GetParam().tolerance)
        << profile;
    double carried = 0;
    for (const Frame& frame : frames)
      for (const Touch& touch : frame.touches) carried += touch.normal_impulse;
    EXPECT_NEAR(carried / (scene.bodies[0].mass * kGravity * 0.96 * 0.3), 1, 1e-3) << profile;
  }
}

TEST_P(BulletBeside, ABeltCarriesABallAlongWithTwoSeventhsOfItsSpeed) {
  const SubstrateMotion course = SubstrateMotion::constant({0.5, 0});
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY();
  const RectangleShape plate{Vector3::Zero(), 0.5 * x, 0.2 * y};
  for (const SurfaceMotion& motion :
       {SurfaceMotion::belt(course, x, y), SurfaceMotion::moving(course, x, y)}) {
    const Scene scene = beside(resting_at(kBallRadius * kUp), {plate, motion}, 0.3, 0);
    const auto frames = steps(scene, "physical", 200);
    EXPECT_LT((frames.back().bodies[0].velocity - 0.5 * 2 / 7 * x).norm(), GetParam().tolerance);
  }
}

TEST_P(BulletBeside, WhatComesTowardsABallThrowsItWithOnePlusE) {
  const auto lift = SurfaceMotion::moving(SubstrateMotion::constant({1, 0}), kUp, Vector3::UnitX());
  const RectangleShape plate{Vector3::Zero(), 0.5 * Vector3::UnitX(), 0.2 * Vector3::UnitY()};
  Scene scene = beside(resting_at((kBallRadius + 0.0505) * kUp), {plate, lift}, 0, 0.8);
  scene.gravity = 0;
  EXPECT_LT((steps(scene, "physical", 100).back().bodies[0].velocity - 1.8 * kUp).norm(),
            1.8 * GetParam().tolerance);
}

TEST_P(BulletBeside, AFlapThatTurnsUpThrowsABallAtItsSpeedThere) {
  // About y at 1 rad/s from level: the ball at x = 0.6, lowest point 2 cm above, is met at θ with
  // 0.6 sin θ = 0.04 cos θ − 0.02, at the distance 0.6 cos θ + 0.04 sin θ from the axis.
  double theta = 0;
  for (int k = 0; k < 50; ++k) theta = std::asin((0.04 * std::cos(theta) - kBallRadius) / 0.6);
  const double arm = 0.6 * std::cos(theta) + 0.04 * std::sin(theta);
  const RectangleShape flap{{0.5, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}};
  Scene scene = beside(resting_at({0.6, 0, 0.04}),
                       {flap, SurfaceMotion::turning(Vector3::Zero(), {0, -1, 0})}, 0, 0.8);
  scene.gravity = 0;
  // Bullet lays the flap where it is when the contact's short step begins: 1e-3 of the ball's
  // radius of gap is a contact there, 2e-5 m of an arm of 0.6 m.
  EXPECT_NEAR(steps(scene, "physical", 80).back().bodies[0].velocity.norm() / (1.8 * arm), 1, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Precisions, BulletBeside,
                         ::testing::Values(Case{"double", 1e-9, 1e-3}, Case{"single", 3e-5, 2e-2}),
                         [](const auto& param) { return std::string(param.param.precision); });

TEST(BulletBesideSettings, TheCoefficientsOfSurfacesAreReadBack) {
  RemoteEngine engine(bullet_executable("double"));
  Scene scene =
      beside(resting_at(kBallRadius * kUp), {RodShape{{0, 0, -1}, {0, 0, 0}, 0.1}, {}}, 0.25, 0.5);
  scene.on_surfaces[1].lasting.rolling = RollingFriction(0.01);
  const Applied applied = engine.configure(scene, kDefault, 1e-3);
  EXPECT_EQ(number(applied, "surface_friction"), 0.25);
  EXPECT_EQ(number(applied, "surface_restitution"), 0.5);
  EXPECT_EQ(number(applied, "surface_rolling_friction[0-0]"), 0);
  EXPECT_EQ(number(applied, "surface_rolling_friction[0-1]"), 1.4 * 0.01 * kBallRadius);
  EXPECT_TRUE(lists(applied, "normals of rods"));
}

}  // namespace
}  // namespace slipcheck
