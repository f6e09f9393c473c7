#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/piles/pile_solver.h"
#include "reference/reference_solver.h"
#include "sphere_piles.h"

// Whether piles stand: the solver beside a linear programme over the friction cones, which says
// whether there is an equilibrium at all.

namespace slipcheck {
namespace {

/// At which a collision's stiffness lets spheres of 2 mm sink by some 1e-5 of their radius.
constexpr double kCollisionTime = 4e-5;  // [s]

/// The largest way of a body from its place [radii].
double farthest(const Scene& scene, const std::vector<BodyState>& states) {
  double most = 0;
  for (std::size_t i = 0; i < states.size(); ++i)
    most = std::max(
        most, (states[i].position - scene.initial[i].position).norm() / scene.bodies[i].radius);
  return most;
}

/// A pile that falls by 1 % of its weight has gone by g t²/200 = 0.35 radii in this time.
bool stands(const Scene& scene) {
  constexpr double kTime = 0.12, kGone = 0.02;
  const ContactScene hard = with_hard_contacts(scene);
  PileSolver solver(hard, scene.initial, {.collision_time = kCollisionTime});
  const SolvedRun run = solver.run(until_time(kTime), nullptr);
  EXPECT_TRUE(run.reached) << run.reason;
  return farthest(scene, solver.states()) < kGone;
}

/// The least coefficient at which the programme finds forces for make(μ).
template <class Make>
double least_friction(Make make, test::Pyramid pyramid) {
  double low = 0, high = 1;
  for (int n = 0; n < 24; ++n) {
    const double mid = 0.5 * (low + high);
    (test::statics_holds(make(mid), pyramid) ? high : low) = mid;
  }
  return high;
}

/// The solver's limit within 1 % of the programme's.
template <class Make>
void expect_limit(Make make) {
  // The pyramids' own difference is 1/cos(π/24) − 1 = 0.9 % of each cone.
  const double inside = least_friction(make, test::Pyramid::inside);
  const double outside = least_friction(make, test::Pyramid::outside);
  EXPECT_TRUE(stands(make(1.01 * inside))) << inside;
  EXPECT_FALSE(stands(make(0.99 * outside))) << outside;
}

TEST(PileStatics, TheProgrammeKnowsTheClosedFormOfFourSpheres) {
  // sin θ = 1/√3 is the slope of the upper sphere's contacts. A lower sphere's friction F, the same
  // at both its contacts as nothing turns it, has N sin θ = F (1 + cos θ): F/N = tan(θ/2). The
  // ground carries N_g = 4/3 W, the upper contact N = W/3, and F is the same: a quarter.
  const double tan_half = std::tan(0.5 * std::asin(1 / std::sqrt(3.0)));
  const auto between = [](double mu) { return test::pile(2, mu, 1); };
  const auto on_ground = [](double mu) { return test::pile(2, 1, mu); };
  // The force lies along an edge of the pyramid inside.
  EXPECT_NEAR(least_friction(between, test::Pyramid::inside), tan_half, 1e-6);
  EXPECT_NEAR(least_friction(on_ground, test::Pyramid::inside), tan_half / 4, 1e-6);
  EXPECT_NEAR(least_friction(between, test::Pyramid::outside), tan_half, 9e-3 * tan_half);
  EXPECT_LT(least_friction(between, test::Pyramid::outside), tan_half);
}

TEST(PileStatics, FourSpheresStandAndFallByTheirFrictionOnTheGround) {
  expect_limit([](double mu) { return test::pile(2, 1, mu); });
}
#ifndef SLIPCHECK_SANITIZE  // the same code as of four
TEST(PileStatics, FourSpheresStandAndFallByTheirFrictionOnEachOther) {
  expect_limit([](double mu) { return test::pile(2, mu, 1); });
}
TEST(PileStatics, TenSpheresStandAndFallWhereTheProgrammeSays) {
  expect_limit([](double mu) { return test::pile(3, mu, mu); });
}
TEST(PileStatics, TwentySpheresStandAndFallWhereTheProgrammeSays) {
  expect_limit([](double mu) { return test::pile(4, mu, mu); });
}
#endif

TEST(PileStatics, NothingCreepsInAMinute) {
  // Softer: every step of a minute is taken, and the same is seen where the rest is skipped.
#ifdef SLIPCHECK_SANITIZE
  constexpr double kTime = 3;  // the same code, a twentieth as often
#else
  constexpr double kTime = 60;
#endif
  constexpr double kSofter = 4e-4;
  const Scene scene = test::pile(2, 0.34, 0.34);
  const ContactScene hard = with_hard_contacts(scene);
  PileSolver solver(hard, scene.initial, {.collision_time = kSofter, .skip_rest = false});
  const std::vector<BodyState> begin = solver.states();
  const SolvedRun run = solver.run(until_time(kTime), nullptr);
  ASSERT_TRUE(run.reached) << run.reason;
  PileSolver skipping(hard, scene.initial, {.collision_time = kSofter});
  ASSERT_TRUE(skipping.run(until_time(kTime), nullptr).reached);
  EXPECT_EQ(skipping.now(), solver.now());
  const std::vector<BodyState> end = solver.states(), skipped = skipping.states();
  for (std::size_t i = 0; i < end.size(); ++i) {
    const double R = scene.bodies[i].radius;
    EXPECT_LT((end[i].position - begin[i].position).norm(), 1e-9 * R) << i;
    EXPECT_LT((end[i].position - skipped[i].position).norm(), 1e-11 * R) << i;
    EXPECT_LT(R * end[i].angular_velocity.norm(), 1e-12) << i;
  }
  // The energy does not come back to itself by more than rounding in 10^7 steps either.
  EXPECT_LT(std::abs(run.balance->error()), 1e-6);
}

TEST(PileStatics, RestIsForEverAndRollingTooWhereNothingMoves) {
  const Scene scene = test::pile(2, 0.5, 0.5);
  const ContactScene hard = with_hard_contacts(scene);
  for (const Run::Until until : {Run::Until::rest, Run::Until::rolling}) {
    PileSolver solver(hard, scene.initial, {.collision_time = kCollisionTime});
    const SolvedRun run = solver.run({until, 0, 60}, nullptr);
    EXPECT_TRUE(run.reached) << run.reason;
    EXPECT_LT(run.end_time, 1);
  }
}

TEST(PileStatics, TheReferenceTakesPilesByItself) {
  const Scene scene = test::pile(2, 0.5, 0.5);
  const ContactScene hard = with_hard_contacts(scene);
  for (const Compare::Reference asked :
       {Compare::Reference::automatic, Compare::Reference::contact, Compare::Reference::steps}) {
    const ReferenceSolver solver(hard, asked);
    EXPECT_TRUE(solver.is_piled());
    EXPECT_STREQ(solver.name(), asked == Compare::Reference::steps ? "steps" : "contact");
    EXPECT_GT(solver.softened_to(), 0);
  }
  EXPECT_FALSE(ReferenceSolver(hard, Compare::Reference::event).is_piled());
  Scene apart = scene;
  apart.initial[3].position.z() += 1e-3;
  const ContactScene falling = with_hard_contacts(apart);
  EXPECT_FALSE(ReferenceSolver(falling, Compare::Reference::automatic).is_piled());
}

}  // namespace
}  // namespace slipcheck
