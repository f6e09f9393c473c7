#include "studies/stability/energy_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "watched_runs.h"

namespace slipcheck {
namespace {

using namespace test;

TEST(EnergyWatch, ASymplecticFlightWithACoarseStepGainsNothing) {
  // With v half a step behind the exact x, E of the last frame exceeds that of the first by
  // (h/2) g v = 0.5*0.05*10*3.75 = 0.94 J of the scale of 8 J, the fall until 0.4 s: 12 %.
  const PreparedScene scene = falling(0.5);
  const ReferencePath path(scene);
  EXPECT_NEAR(path.energy_scale(), 8, 1e-9);  // m g (g t²/2), t = 0.4 s
  const double h = 0.05;
  OutcomeWatch late(path, {}, h), euler(path, {}, h);
  late.begin(0, scene.contact->hard.initial);
  euler.begin(0, scene.contact->hard.initial);
  BodyState a = scene.contact->hard.initial[0], b = a;
  double highest = 0;
  for (int n = 1; n <= 8; ++n) {
    const double t = n * h;
    a.position.z() = 1.01 - 5 * t * t;
    a.velocity.z() = -10 * (t + 0.5 * h);  // ahead: E higher
    b.velocity.z() -= 10 * h;
    b.position.z() += h * b.velocity.z();
    late.take(t, frame_of({a}));
    euler.take(t, frame_of({b}));
    highest = 0.5 * a.velocity.z() * a.velocity.z() + 10 * (a.position.z() - 0.01) - 10;
  }
  EXPECT_GT(highest / path.energy_scale(), 0.1);
  EXPECT_EQ(outcome_of(late), Outcome::accurate);
  // What is left is (h/2)²g²/2 = 0.03 J, that of the very first half step.
  EXPECT_LE(late.phases()[0].energy_gain, 0.0313 / 8);
  EXPECT_EQ(outcome_of(euler), Outcome::accurate);
  EXPECT_EQ(euler.phases()[0].energy_gain, 0);
}

TEST(EnergyWatch, ARestitutionAboveOneGrows) {
  const PreparedScene scene = meeting();
  const ReferencePath path(scene);
  EXPECT_NEAR(path.energy_scale(), 1, 1e-12);  // 2 × ½ × 1 kg × (1 m/s)²
  EXPECT_NEAR(path.energy_range(), 0.19, 1e-12);
  EXPECT_EQ(outcome_of(parted(path, 0.81 - 1)), Outcome::accurate);
  const WatchedPhase grown = parted(path, 1.21 - 1).phases()[0];
  EXPECT_EQ(grown.outcome.outcome, Outcome::energy_growing);
  EXPECT_EQ(grown.outcome.why, "gains 21 % of the scene's energy out of nothing");
  EXPECT_NEAR(grown.outcome.time, 0.04, 0.006);
  EXPECT_NEAR(grown.energy_gain, 0.21, 1e-12);
  EXPECT_EQ(outcome_of(parted(path, 0.0499)), Outcome::accurate);
  EXPECT_EQ(outcome_of(parted(path, 0.0501)), Outcome::energy_growing);
}

TEST(EnergyWatch, AnEnergyThatIsKeptMayNotBeLost) {
  const PreparedScene elastic = meeting("{model: hard, restitution: 1}");
  const ReferencePath kept(elastic);
  EXPECT_LT(kept.energy_range(), 1e-12);
  EXPECT_EQ(outcome_of(parted(kept, -0.0499)), Outcome::accurate);
  EXPECT_EQ(outcome_of(parted(kept, -0.0501)), Outcome::drifting);
  const PreparedScene inelastic = meeting();
  EXPECT_EQ(outcome_of(parted(ReferencePath(inelastic), -0.5)), Outcome::accurate);
}

TEST(EnergyWatch, WhatAContactHoldsForAFewFramesIsNotLost) {
  // An engine that gives way: half the energy is not shown in five frames, then given back.
  const PreparedScene scene = meeting("{model: hard, restitution: 1}");
  const ReferencePath path(scene);
  for (const bool says : {true, false}) {
    OutcomeWatch watch(path, {}, 0.001);
    std::vector<BodyState> s = path.states().front();
    watch.begin(0, s);
    for (int n = 1; n <= 20; ++n) {
      const bool touches = n >= 10 && n < 15;
      s[0].velocity.x() = touches ? 0.5 : n < 10 ? 1 : -1;
      std::vector<Touch> touching;
      if (touches && says) touching.push_back({0, 1, 1});
      watch.take(0.001 * n, frame_of(s, touching));
    }
    EXPECT_EQ(outcome_of(watch), says ? Outcome::accurate : Outcome::energy_growing);
  }
}

TEST(EnergyWatch, LyingALittleHigherIsNoEnergy) {
  // 0.9 % and 20 % of the radius, for the scale m g R of a ball that only lies there.
  const PreparedScene scene =
      prepared(plain_scene(ball("a", "[0, 0]", "[0, 0, 0]"), "friction: 0.5", "{until: 1}"));
  const ReferencePath path(scene);
  EXPECT_NEAR(path.energy_scale(), 1 * 10 * 0.01, 1e-12);
  for (const double height : {0.009, 0.2}) {
    OutcomeWatch watch(path, {}, 0.01);
    std::vector<BodyState> s = path.states().front();
    watch.begin(0, s);
    s[0].position.z() = 0.01 * (1 + height);
    watch.take(0.01, frame_of(s));
    EXPECT_NEAR(watch.phases()[0].energy_gain, std::max(0.0, height - 0.01), 1e-9);
    EXPECT_EQ(outcome_of(watch), height < 0.1 ? Outcome::accurate : Outcome::energy_growing);
  }
}

}  // namespace
}  // namespace slipcheck
