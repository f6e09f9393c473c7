#include "physics/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace slipcheck {
namespace {

const RectangleShape kPlate{Vector3(1, 2, 3), Vector3(2, 0, 0), Vector3(0, 0, 0.5)};
const RodShape kRod{Vector3(0, 0, 1), Vector3(0, 0, 3), 0.5};

double distance(const SurfaceShape& shape, const Vector3& to) {
  return nearest_point(shape, to).distance;
}

TEST(Surface, PlaneIsSolidBehind) {
  const PlaneShape plane{Vector3(0, 0, 1), Vector3(0, 0.6, 0.8)};
  EXPECT_NEAR(distance(plane, {5, 0, 2}), 0.8, 1e-15);
  EXPECT_NEAR(distance(plane, {5, 0, 0}), -0.8, 1e-15);
  EXPECT_EQ(nearest_point(plane, {5, 0, 0}).normal, plane.normal);
}

TEST(Surface, PlateHasTwoFacesEdgesAndCorners) {
  const NearestPoint above = nearest_point(kPlate, {0, 2.3, 3.1});
  EXPECT_NEAR(above.distance, 0.3, 1e-15);
  EXPECT_NEAR(above.normal.y(), 1, 1e-15);
  EXPECT_NEAR(nearest_point(kPlate, {0, 1.7, 3.1}).normal.y(), -1, 1e-15);
  EXPECT_NEAR(distance(kPlate, {3.3, 2.4, 3}), 0.5, 1e-15);          // an edge
  EXPECT_NEAR(distance(kPlate, {3 + 1, 2 + 2, 3.5 + 2}), 3, 1e-15);  // a corner
  EXPECT_NEAR(std::abs(kPlate.normal().y()), 1, 1e-15);
}

TEST(Surface, RodHasASideTwoEndsAndTheirRims) {
  EXPECT_NEAR(distance(kRod, {2, 0, 2}), 1.5, 1e-15);
  EXPECT_NEAR(distance(kRod, {0.3, 0, 3.7}), 0.7, 1e-15);
  EXPECT_NEAR(distance(kRod, {0.5 + 0.3, 0, 3.4}), 0.5, 1e-15);
  EXPECT_NEAR(distance(kRod, {0.4, 0, 2}), -0.1, 1e-15);
  EXPECT_NEAR(distance(kRod, {0, 0, 2.9}), -0.1, 1e-15);
  EXPECT_NEAR(distance(BallShape{Vector3(1, 0, 0), 2}, {1, 0, 0.5}), -1.5, 1e-15);
}

/// What is convex is nowhere nearer than at the point that is said to be nearest: against points
/// of the shape taken at random.
TEST(Surface, NothingIsNearer) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 2000; ++n) {
    const Vector3 to(5 * any(random), 5 * any(random), 5 * any(random));
    const Vector3 on_plate =
        kPlate.centre + any(random) * kPlate.half_length + any(random) * kPlate.half_width;
    EXPECT_LE(distance(kPlate, to), (to - on_plate).norm() + 1e-14);
    const double angle = std::numbers::pi * any(random), r = std::abs(any(random)) * kRod.radius;
    const Vector3 in_rod(r * std::cos(angle), r * std::sin(angle), 2 + any(random));
    EXPECT_LE(distance(kRod, to), (to - in_rod).norm() + 1e-14);
    const NearestPoint near = nearest_point(kRod, to);
    EXPECT_LT((near.point + near.distance * near.normal - to).norm(), 1e-14);
  }
}

TEST(Surface, MovesWithItsMatterUnlessItIsABelt) {
  const SubstrateMotion course = SubstrateMotion::constant(Vector2(2, 0));
  const Surface moves{PlaneShape{Vector3::Zero(), Vector3::UnitX()},
                      SurfaceMotion::moving(course, Vector3::UnitX(), Vector3::UnitY())};
  EXPECT_NEAR(moves.nearest(3, {10, 0, 0}).distance, 4, 1e-14);
  EXPECT_EQ(moves.motion.velocity(3, Vector3::Zero()), Vector3(2, 0, 0));
  const Surface belt{PlaneShape{}, SurfaceMotion::belt(course, Vector3::UnitX(), Vector3::UnitY())};
  EXPECT_NEAR(belt.nearest(3, {10, 0, 1}).distance, 1, 1e-15);
  EXPECT_EQ(belt.motion.velocity(3, Vector3::Zero()), Vector3(2, 0, 0));
}

TEST(Surface, TurnsAboutItsAxis) {
  const double rate = 0.5 * std::numbers::pi;  // a quarter in a second
  const Surface turns{BallShape{Vector3(2, 0, 0), 0.5},
                      SurfaceMotion::turning(Vector3(1, 0, 0), rate * Vector3::UnitZ())};
  EXPECT_NEAR(turns.nearest(1, {1, 3, 0}).distance, 1.5, 1e-14);
  EXPECT_NEAR(turns.nearest(1, {1, 3, 0}).normal.y(), 1, 1e-14);
  EXPECT_NEAR((turns.motion.velocity(1, {1, 1, 0}) - Vector3(-rate, 0, 0)).norm(), 0, 1e-14);
}

}  // namespace
}  // namespace slipcheck
