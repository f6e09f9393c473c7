// Blocks and cylinders by the phases of spheres: closed forms of Coulomb's friction and of a rigid
// cylinder with I = m R²/2.

#include <gtest/gtest.h>

#include <cmath>

#include "physics/motion/driven_phase.h"
#include "physics/motion/substrate_phase.h"

namespace slipcheck {
namespace {

constexpr double kG = 9.81;
constexpr double kRounding = 1e-13;

const Sphere kBlock{0.05, 2, 1, Shape::block};
const Sphere kCylinder{0.02, 1, 0.5, Shape::cylinder};

SubstrateContact with_friction(double static_friction, double kinetic) {
  SubstrateContact contact;
  contact.static_friction = static_friction;
  contact.kinetic_friction = kinetic;
  return contact;
}

BodyState moving(const Sphere& body, double vx, double vy) {
  BodyState state;
  state.position.z() = body.radius;
  state.velocity = {vx, vy, 0};
  return state;
}

TEST(BlockPhase, StopsAfterVSquaredOverTwoMuG) {
  const double v = 3, mu = 0.3;
  const SubstratePhase slides(kBlock, with_friction(mu, mu), kG, moving(kBlock, v, 0));
  ASSERT_EQ(slides.kind(), SubstratePhase::Kind::sliding);
  EXPECT_NEAR(slides.duration(), v / (mu * kG), kRounding);
  const BodyState end = slides.at_end();
  EXPECT_NEAR(end.position.x(), v * v / (2 * mu * kG), kRounding);
  EXPECT_EQ(end.velocity, Vector3::Zero());
  EXPECT_EQ(end.angular_velocity, Vector3::Zero());
  EXPECT_EQ(SubstratePhase(kBlock, with_friction(mu, mu), kG, end).kind(),
            SubstratePhase::Kind::resting);
}

TEST(BlockPhase, HoldsOnASlopeUpToStaticFrictionAndSlipsBeyond) {
  const double mu_s = 0.5, mu_k = 0.4;
  for (const double share : {0.99, 1.01}) {
    const double slope = share * mu_s;  // tan θ, per unit of the normal gravity
    const DrivenPhase phase(kBlock, with_friction(mu_s, mu_k), kG, {0, -slope * kG}, {}, 0,
                            moving(kBlock, 0, 0));
    if (share < 1) {
      EXPECT_EQ(phase.kind(), DrivenPhase::Kind::resting);
      EXPECT_TRUE(std::isinf(phase.duration()));
    } else {
      ASSERT_EQ(phase.kind(), DrivenPhase::Kind::sliding);
      const double a = (slope - mu_k) * kG;
      EXPECT_NEAR(phase.at(0.7).velocity.y(), -a * 0.7, kRounding);
      EXPECT_EQ(phase.at(0.7).angular_velocity, Vector3::Zero());
    }
  }
}

TEST(BlockPhase, OnABeltItComesToTheBeltsSpeed) {
  const double mu = 0.2, belt = 1.5;
  const DrivenPhase phase(kBlock, with_friction(mu, mu), kG, Vector2::Zero(),
                          SubstrateMotion::constant({belt, 0}), 0, moving(kBlock, 0, 0));
  EXPECT_NEAR(phase.duration(), belt / (mu * kG), kRounding);
  const BodyState end = phase.at_end();
  EXPECT_EQ(end.velocity, Vector3(belt, 0, 0));
  EXPECT_EQ(end.angular_velocity, Vector3::Zero());
}

TEST(BlockPhase, GoesWithAShakenTableUpToStaticFriction) {
  const double mu = 0.3, omega = 2 * M_PI * 2;
  for (const double share : {0.9, 1.1}) {
    const double amplitude = share * mu * kG / (omega * omega);
    const auto motion = SubstrateMotion::oscillation({amplitude, 0}, 2, M_PI / 2);
    BodyState state = moving(kBlock, 0, 0);
    state.velocity = motion.velocity(0);  // of its turning point, but for rounding
    const DrivenPhase phase(kBlock, with_friction(mu, mu), kG, Vector2::Zero(), motion, 0, state);
    EXPECT_EQ(phase.kind(), share < 1 ? DrivenPhase::Kind::resting : DrivenPhase::Kind::sliding);
  }
}

TEST(CylinderPhase, SlidesIntoRollingAtTwoThirdsOfItsSpeed) {
  const double v = 1.2, mu = 0.25;
  const SubstratePhase slides(kCylinder, with_friction(mu, mu), kG, moving(kCylinder, v, 0));
  // The slip falls at (1 + A) μ g = 3 μ g.
  EXPECT_NEAR(slides.duration(), v / (3 * mu * kG), kRounding);
  const BodyState end = slides.at_end();
  EXPECT_NEAR(end.velocity.x(), 2.0 / 3 * v, kRounding);
  EXPECT_NEAR(end.angular_velocity.y(), 2.0 / 3 * v / kCylinder.radius, 1e-11);
}

TEST(CylinderPhase, RollsDownASlopeWithTwoThirdsUpToThreeTimesTheFriction) {
  const double mu = 0.2;
  for (const double share : {0.99, 1.01}) {
    const double slope = share * 3 * mu;
    const DrivenPhase phase(kCylinder, with_friction(mu, mu), kG, {0, -slope * kG}, {}, 0,
                            moving(kCylinder, 0, 0));
    const double a = share < 1 ? 2.0 / 3 * slope * kG : (slope - mu) * kG;
    EXPECT_EQ(phase.kind(), share < 1 ? DrivenPhase::Kind::rolling : DrivenPhase::Kind::sliding);
    EXPECT_NEAR(phase.at(0.5).velocity.y(), -0.5 * a, kRounding);
  }
}

}  // namespace
}  // namespace slipcheck
