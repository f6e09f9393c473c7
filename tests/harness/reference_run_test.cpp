#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <limits>

#include "../reference/soft_scenes.h"
#include "../support/extremes.h"
#include "hard_run.h"

namespace slipcheck {
namespace {

TEST(ReferenceRun, UncertaintyIsOfRoundingAndCoversTheClosedForm) {
  const ReferenceResult result =
      test::run_hard(test::head_on(0.15, -0.15, 0.9), {Run::Until::rolling, 0, 10}, {"i", "j"});
  const UncertainValue e = result.observables.at("i-j.effective_restitution");
  EXPECT_NEAR(e.value, (2.5 * 0.9 - 1) / 3.5, 1e-12);
  EXPECT_GT(e.uncertainty, 0);
  EXPECT_LT(e.uncertainty, 1e-13);
  EXPECT_LE(std::abs(e.value - (2.5 * 0.9 - 1) / 3.5), 4 * e.uncertainty);
  EXPECT_GT(result.cpu_seconds, 0);
  EXPECT_NEAR(result.first_contact, 0.006 / 0.3, 1e-15);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST(ReferenceRun, AChaoticSceneSaysHowLittleItKnows) {
  // A ball into a tight rack: which of the simultaneous blows comes first is up to rounding.
  Scene scene = test::steel_scene(7);
  scene.initial[0] = test::rolling_at(-0.02, 0, 0.5, 0);
  std::size_t n = 1;
  for (int row = 0; row < 3; ++row)
    for (int k = 0; k <= row; ++k, ++n)
      scene.initial[n] =
          test::rolling_at(row * 0.004 * std::sqrt(0.75), (k - 0.5 * row) * 0.004, 0, 0);
  const ReferenceResult result =
      test::run_hard(scene, {Run::Until::rolling, 0, 10}, {"cue", "a", "b", "c", "d", "e", "f"});
  double worst = 0;
  for (const auto& [name, value] : result.observables)
    if (name.find("rolling_velocity") != std::string::npos)
      worst = test::largest_of(worst, value.uncertainty);
  EXPECT_GT(worst, 1e-3);
}

/// So soft a contact that static friction keeps both rolling in it (F ≤ 3.5 μ m g): a spring and a
/// dashpot between two masses of 7/5 m, and the run ends with the contact.
TEST(ReferenceRun, BallsThatRollThroughTheirCollisionPartWithItsRestitution) {
  ContactScene scene = test::soft(test::head_on(0.015, -0.015, 0.9));
  const double mass = scene.hard.bodies[0].mass, k = 2, c = 5e-3;
  scene.soft[0] = SoftContact{LinearForce{k, c}, ContactEnd::zero_overlap, NoTangentialForce{}};
  const double damping = c / (2 * std::sqrt(k * 0.7 * mass));
  const double expected = std::exp(-M_PI * damping / std::sqrt(1 - damping * damping));
  ASSERT_LT(0.03 * std::sqrt(k * 0.7 * mass),
            3.5 * scene.hard.substrate[0].static_friction * mass * scene.hard.gravity);
  for (const auto asked : {Compare::Reference::contact, Compare::Reference::steps}) {
    const ReferenceResult result =
        run_reference(ReferenceSolver(scene, asked), {Run::Until::rolling, 0, 10}, {"i", "j"});
    EXPECT_TRUE(result.run.reached);
    for (const char* name : {"i-j.restitution", "i-j.effective_restitution"}) {
      ASSERT_TRUE(result.observables.contains(name)) << result.solver;
      const UncertainValue seen = result.observables.at(name);
      EXPECT_NEAR(seen.value, expected, seen.uncertainty + 1e-9) << result.solver << " " << name;
      EXPECT_LT(seen.uncertainty, 2e-3) << result.solver << " " << name;
    }
  }
}

TEST(ReferenceRun, SoftContactsHaveTheUncertaintyOfTheIntegration) {
  const ContactScene scene = test::soft(test::head_on(0.15, -0.15, 0.9));
  const RunEnd end{Run::Until::rolling, 0, 10};
  const ReferenceResult result =
      run_reference(ReferenceSolver(scene, Compare::Reference::automatic), end, {"i", "j"});
  EXPECT_EQ(result.solver, "contact");
  EXPECT_TRUE(result.warnings.empty());
  ASSERT_TRUE(result.run.balance);
  EXPECT_LT(std::abs(result.run.balance->error()), 1e-10);
  const UncertainValue time = result.observables.at("i-j.contact_time");
  EXPECT_GT(time.uncertainty, 0);
  EXPECT_LT(time.uncertainty, 1e-10 * time.value);
  // 4 μ_k g/(π v_rel ω0) of itself longer than the law's own (K App. D).
  EXPECT_NEAR(time.value / 2.55e-5 - 1, 3.4e-5, 0.4e-5);
}

TEST(ReferenceRun, ANaNIsAFailureAndNotNothing) {
  // A ball that spins on the spot, at no number of turns.
  Scene scene = test::steel_scene(1);
  scene.initial[0] = test::rolling_at(0, 0, 0, 0);
  scene.initial[0].angular_velocity.z() = std::sqrt(-scene.gravity);
  const ReferenceResult result = test::run_hard(scene, until_time(1), {"i"});
  EXPECT_TRUE(result.run.failed);
  EXPECT_FALSE(result.run.reached);
  EXPECT_EQ(result.run.reason, "the state of body 0 is not finite at 1 s");
  EXPECT_TRUE(result.observables.empty());
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_EQ(result.warnings[0], "the run did not end: " + result.run.reason);
}

TEST(ReferenceRun, ANaNAmongTheObservablesIsAFailureByName) {
  ReferenceResult result;
  result.run.reached = true;
  result.observables["i.final_velocity"] = {1, 0};
  fail_because_of_nan({}, result);
  EXPECT_TRUE(result.run.reached);
  fail_because_of_nan({"i.sliding_time", "j.sliding_time"}, result);
  EXPECT_TRUE(result.run.failed);
  EXPECT_FALSE(result.run.reached);
  EXPECT_EQ(result.run.reason, "NaN in i.sliding_time and 1 more observables");
  EXPECT_TRUE(result.observables.empty());
}

TEST(Observables, WhatDidNotHappenIsNotWhatCouldNotBeComputed) {
  const double zero = test::rolling_at(0, 0, 0, 0).velocity.x();
  EXPECT_TRUE(is_not_observed(kNotObserved));
  EXPECT_TRUE(is_not_observed(-kNotObserved));
  EXPECT_TRUE(is_not_observed(3 * (kNotObserved - 1)));
  EXPECT_TRUE(is_not_observed(kVectorNotObserved.norm()));
  EXPECT_FALSE(is_not_observed(zero / zero));
  EXPECT_FALSE(is_not_observed(std::sqrt(zero - 1)));
  EXPECT_FALSE(is_not_observed(std::numeric_limits<double>::infinity() * zero));
  EXPECT_FALSE(is_not_observed(zero));
}

TEST(ReferenceRun, SaysWhenEventTakesSoftContactsAsInstants) {
  const ContactScene scene = test::soft(test::head_on(0.15, -0.15, 0.9));
  const RunEnd end{Run::Until::rolling, 0, 10};
  const ReferenceResult result =
      run_reference(ReferenceSolver(scene, Compare::Reference::event), end, {"i", "j"});
  EXPECT_EQ(result.solver, "event");
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("soft contacts as instants"), std::string::npos);
  EXPECT_NEAR(result.observables.at("i-j.effective_restitution").value, (2.5 * 0.9 - 1) / 3.5,
              1e-12);
}

TEST(ReferenceRun, WarnsOfCollapseAndOfRunsThatDoNotEnd) {
  const ReferenceResult collapse =
      test::run_hard(test::head_on(0.15, -0.15, 0.2), {Run::Until::rolling, 0, 10}, {"i", "j"});
  ASSERT_EQ(collapse.warnings.size(), 1u);
  EXPECT_NE(collapse.warnings[0].find("inelastic collapse"), std::string::npos);
  Scene frictionless = test::steel_scene(1);
  frictionless.substrate[0].kinetic_friction = 0;
  frictionless.initial[0].velocity.x() = 1;
  const ReferenceResult endless = test::run_hard(frictionless, {Run::Until::rolling, 0, 2}, {"i"});
  ASSERT_EQ(endless.warnings.size(), 1u);
  EXPECT_NE(endless.warnings[0].find("did not end"), std::string::npos);
  EXPECT_FALSE(endless.observables.contains("i.sliding_time"));
}

/// A wall that nothing reaches changes no value; what contacts that last would change is part of
/// the uncertainty, and needs no more steps than they do anywhere.
TEST(ReferenceRun, CollapseBesideSurfacesIsRepeatedWithContactsThatLast) {
  Scene scene = test::head_on(0.15, -0.15, 0.2);
  const RunEnd end{Run::Until::rolling, 0, 10};
  const ReferenceResult free = test::run_hard(scene, end, {"i", "j"});
  scene.surfaces = {{PlaneShape{{1, 0, 0}, {-1, 0, 0}}, {}}};
  scene.on_surfaces.resize(1);
  const ReferenceResult walled = test::run_hard(scene, end, {"i", "j", "wall"});
  ASSERT_TRUE(walled.run.reached);
  ASSERT_GT(walled.run.collapses, 0u);
  for (const char* name : {"i.rolling_velocity", "i.sliding_time", "i-j.effective_restitution"}) {
    const UncertainValue a = free.observables.at(name), b = walled.observables.at(name);
    EXPECT_LE(std::abs(a.value - b.value), a.uncertainty + b.uncertainty) << name;
    EXPECT_GT(b.uncertainty, a.uncertainty) << name;
  }
  // Contacts that take 1e-3 of the time in which a body falls by its radius.
  const UncertainValue e = walled.observables.at("i-j.effective_restitution");
  EXPECT_NEAR(e.value, (2.5 * 0.2 - 1) / 3.5, 1e-3);
  EXPECT_LT(e.uncertainty, 1e-3);
}

/// The spring that holds a rolling ball turns with its spin, and sinks as the ball begins to press:
/// neither is a slide or keeps it from one.
TEST(ReferenceRun, ABallThatSpinsAsItRollsDownSlidesForAsLongByASpring) {
  const Vector3 up = Vector3(0.2, 0, 1).normalized(), down = Vector3(1, 0, -0.2).normalized();
  for (const double spin : {0.0, 30.0})
    for (const double rolling : {0.0, 0.04}) {
      Scene scene = test::steel_scene(1);
      scene.has_substrate = false;
      SurfaceContact contact;
      contact.lasting.static_friction = contact.lasting.kinetic_friction = 0.3;
      contact.lasting.rolling = RollingFriction(rolling);
      contact.impact = {0.0, 0.3, 0.0};
      scene.surfaces = {{PlaneShape{Vector3::Zero(), up}, {}}};
      scene.on_surfaces = {contact};
      scene.initial[0].position = scene.bodies[0].radius * up;
      scene.initial[0].velocity = 0.2 * down + 0.1 * up.cross(down);
      scene.initial[0].angular_velocity = spin * up;
      const ContactScene hard = with_hard_contacts(scene);
      const RunEnd end{Run::Until::time, 0.1, 0.1};
      const auto observed = [&](Compare::Reference by) {
        return run_reference(ReferenceSolver(hard, by), end, {"i", "slope"}).observables;
      };
      const auto exact = observed(Compare::Reference::event);
      const auto seen = observed(Compare::Reference::contact);
      for (const char* name :
           {"i.sliding_time", "i.sliding_distance", "i.rolling_velocity", "i.final_velocity"}) {
        const UncertainValue a = exact.at(name), b = seen.at(name);
        EXPECT_LE(std::abs(a.value - b.value), b.uncertainty) << name << spin << " " << rolling;
        // A slide of some thousand times as long as a collision, which tells its ends apart.
        EXPECT_LT(b.uncertainty, 0.01 * a.value) << name << spin << " " << rolling;
      }
    }
}

}  // namespace
}  // namespace slipcheck
