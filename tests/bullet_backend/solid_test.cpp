// A block and a cylinder in Bullet, against Coulomb's friction and I = m R²/2.

#include <gtest/gtest.h>

#include <cmath>

#include "bullet_run.h"
#include "engine/scene_needs.h"

namespace slipcheck {
namespace {

Scene solid_scene(Shape shape, double static_friction, double kinetic) {
  Scene scene;
  const bool is_block = shape == Shape::block;
  scene.bodies = {is_block ? Sphere{0.025, 0.7, (0.04 + 0.01) / (12 * 0.025 * 0.025), shape}
                           : Sphere{0.02, 0.5, 0.5, shape}};
  scene.extents = {is_block ? Extent{{0.2, 0.1, 0.05}, Vector2::UnitX()}
                            : Extent{{0.06, 0.04, 0.04}, Vector2(0, 1)}};
  BodyState start;
  start.position.z() = scene.bodies[0].radius;
  scene.initial = {start};
  scene.material = {0};
  SubstrateContact ground;
  ground.static_friction = static_friction;
  ground.kinetic_friction = kinetic;
  scene.substrate = {ground};
  scene.pairs = {{}};
  scene.gravity = kGravity;
  return scene;
}

TEST(BulletSolid, TakesBlocksAndCylinders) {
  const RemoteEngine engine(bullet_executable("single"));
  for (const char* part : {scene_part::kBlock, scene_part::kCylinder, scene_part::kFrictionLaw})
    EXPECT_NE(std::ranges::find(engine.info().takes, part), engine.info().takes.end());
}

TEST(BulletSolid, ABlockUnderTunedStopsAfterVSquaredOverTwoMuG) {
  RemoteEngine engine(bullet_executable("double"));
  Scene scene = solid_scene(Shape::block, 0.5, 0.3);
  scene.initial[0].velocity = {2, 0, 0};
  const auto end = run(engine, scene, shipped("tuned"), 1000, 1000).back().bodies[0];
  // Half of the speed that friction takes in a step, over the whole way: 0.1 %.
  EXPECT_NEAR(end.position.x() / (4 / (2 * 0.3 * kGravity)), 1, 1e-3);
  EXPECT_NEAR(end.velocity.norm(), 0, 1e-6);
}

TEST(BulletSolid, ABlockUnderTunedIsHeldByStaticFrictionWhereKineticCouldNot) {
  RemoteEngine engine(bullet_executable("double"));
  for (const double slope : {0.45, 0.55}) {
    Scene scene = solid_scene(Shape::block, 0.5, 0.4);
    scene.downhill = {slope * kGravity, 0};  // per unit of the normal gravity
    const double x = run(engine, scene, shipped("tuned"), 1000, 1000).back().bodies[0].position.x();
    if (slope < 0.5) {
      EXPECT_NEAR(x, 0, 1e-3);
    } else {
      EXPECT_NEAR(x / (0.5 * (slope - 0.4) * kGravity), 1, 0.1);
    }
  }
}

TEST(BulletSolid, ACylinderRollsWithTwoThirdsWhateverItsHeading) {
  RemoteEngine engine(bullet_executable("double"));
  for (const double angle : {0.0, 1.0}) {
    Scene scene = solid_scene(Shape::cylinder, 0.3, 0.3);
    const Vector2 way(std::cos(angle), std::sin(angle));
    scene.extents[0]->axis = {-way.y(), way.x()};
    scene.downhill = 0.3 * kGravity * way;
    const auto end = run(engine, scene, shipped("tuned"), 1000, 500).back().bodies[0];
    const double a = 2.0 / 3 * 0.3 * kGravity;
    // It rocks from end to end, as Bullet has one point of contact of a cylinder on a plane.
    EXPECT_NEAR(end.velocity.head<2>().dot(way) / (a * 0.5), 1, 0.02) << angle;
    EXPECT_NEAR(std::abs(across(end.velocity.head<2>(), way)), 0, 0.02) << angle;
  }
}

TEST(BulletSolid, BallsRubWithTheFrictionOfTheirSlipAsTheyMeet) {
  // The striker does not spin and hits a ball at rest at an angle at which it goes on slipping: the
  // struck ball leaves along n + μ t.
  const double R = kRadius, v = 1, phi = 60 * std::numbers::pi / 180;
  const ExponentialFriction law{0.01, 0.1, 1};
  for (const char* profile : {"physical", "tuned"}) {
    RemoteEngine engine(bullet_executable("double"));
    BodyState struck, striker;
    struck.position = Vector3(0, 0, R);
    striker.position = Vector3(-2 * R * std::cos(phi) - 0.01, 2 * R * std::sin(phi), R);
    striker.velocity = Vector3(v, 0, 0);
    Scene scene = scene_of(steel_ball(R), {striker, struck}, ground_with_friction(0),
                           PairContact{0.9, law, 0});
    const auto end = run(engine, scene, shipped(profile), 10000, 200).back().bodies[1];
    const Vector2 n(std::cos(phi), -std::sin(phi)), t(std::sin(phi), std::cos(phi));
    const Vector2 out = end.velocity.head<2>();
    const double mu = out.dot(t) / out.dot(n);
    // In a step the balls come 0.05 R closer, and n turns by that.
    EXPECT_NEAR(mu, friction_at(law, v * std::sin(phi)), 5e-3) << profile;
    EXPECT_GT(std::abs(mu - friction_at(law, 0)), 0.03) << profile;
  }
}

}  // namespace
}  // namespace slipcheck
