#include "studies/stability/scene_variation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../support/bundled.h"
#include "harness/run/prepared_scene.h"
#include "scenario/load.h"
#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

using test::bundled;

ReferenceResult reference_of(const Scenario& scenario) {
  return prepare_scenes({scenario}).front().reference;
}

double value(const ReferenceResult& reference, const std::string& name) {
  return reference.observables.at(name).value;
}

/// What the scaled scene's reference should show, by the dimension of each observable that these
/// scenes have; every one is compared.
void expect_similar(const Scenario& scenario, double lambda, double tolerance) {
  const ReferenceResult before = reference_of(scenario);
  const ReferenceResult after = reference_of(scaled_lengths(scenario, lambda));
  const double time = std::sqrt(lambda);
  ASSERT_EQ(before.observables.size(), after.observables.size());
  std::size_t compared = 0;
  const auto expect = [&](const std::string& name, double factor) {
    for (const auto& [full, seen] : before.observables) {
      if (observable_key(full).observable != name) continue;
      ++compared;
      const double scaled = seen.value * factor;
      // What is zero but for rounding is so on the scale of what happens.
      EXPECT_NEAR(value(after, full), scaled, tolerance * std::max(std::abs(scaled), factor))
          << full << " at " << lambda;
    }
  };
  for (const char* name : {"restitution", "tangential_restitution", "effective_restitution"})
    expect(name, 1);
  for (const char* name : {"sliding_time", "stopping_time", "spin_stopping_time", "contact_time",
                           "flight_time", "sliding_onset"})
    expect(name, time);
  for (const char* name : {"sliding_distance", "stopping_distance", "final_position", "jump_height",
                           "max_overlap", "energy_change_sliding"})
    expect(name, lambda);
  for (const char* name : {"velocity_after_collision", "slip_after_collision", "rolling_velocity",
                           "final_velocity", "lift_off_speed", "momentum_change_sliding"})
    expect(name, lambda / time);
  for (const char* name : {"angular_velocity_after_collision", "final_angular_velocity"})
    expect(name, 1 / time);
  EXPECT_EQ(compared, before.observables.size()) << scenario.name;
}

TEST(SceneVariation, ScaledScenesAreSimilarInTheReference) {
  // Exact phases: rounding alone, and what it moves a root by.
  for (const char* name :
       {"symmetric-30cms", "rolling-friction-table", "bouncing-ball", "oblique", "spin-to-rest"})
    for (const double lambda : {1e-6, 7.3, 1e3}) expect_similar(bundled(name), lambda, 1e-9);
}

TEST(SceneVariation, ScaledForcesAreSimilarInTheReference) {
  // Integrated at a relative tolerance of 1e-13 in metres; the worst scene asks for ten digits.
  for (const char* name : {"jump-resolved", "power-law", "ice-viscoelastic", "asperities-passive"})
    expect_similar(bundled(name), 3.7, 1e-7);
}

TEST(SceneVariation, WhatHasAUnitScalesToo) {
  Scenario scenario = bundled("symmetric-30cms");
  scenario.compare.tolerance["sliding_time"] = {0.002, true};
  scenario.compare.tolerance["sliding_distance"] = {0.003, true};
  scenario.compare.tolerance["effective_restitution"] = {0.004, false};
  scenario.compare.engines[0].expect.emplace();
  const Scenario scaled = scaled_lengths(scenario, 4);
  EXPECT_DOUBLE_EQ(scaled.compare.tolerance.at("sliding_time").value, 0.004);
  EXPECT_DOUBLE_EQ(scaled.compare.tolerance.at("sliding_distance").value, 0.012);
  EXPECT_DOUBLE_EQ(scaled.compare.tolerance.at("effective_restitution").value, 0.004);
  EXPECT_DOUBLE_EQ(scaled.run.limit, 10);
  EXPECT_DOUBLE_EQ(scaled.compare.engines[0].rates.at(1), 120);
  EXPECT_FALSE(scaled.compare.engines[0].expect);
  EXPECT_DOUBLE_EQ(scaled.gravity.z(), scenario.gravity.z());
  EXPECT_DOUBLE_EQ(scaled.bodies[0].sphere.mass, 64 * scenario.bodies[0].sphere.mass);
}

TEST(SceneVariation, MassRatioChangesTheSharesOfTheImpulse) {
  // A ball at 0.3 m/s strikes one of q times its mass at rest, e_n = 0.9:
  // v_i = v (1 − q e)/(1 + q), v_j = v (1 + e)/(1 + q).
  const Scenario scenario = bundled("target-at-rest");
  for (const double q : {1.0, 7.0, 1e6}) {
    const ReferenceResult seen = reference_of(with_mass_ratio(scenario, q));
    EXPECT_NEAR(value(seen, "i.velocity_after_collision.x"), 0.3 * (1 - 0.9 * q) / (1 + q), 1e-12);
    EXPECT_NEAR(value(seen, "j.velocity_after_collision.x"), 0.3 * 1.9 / (1 + q), 1e-12);
  }
}

TEST(SceneVariation, SpeedKeepsTheTimeOfMeeting) {
  // K (21): balls that meet at ±v and roll slide for 2 v (1 + e_n)/(7 μ g) after it, and e_eff does
  // not depend on v.
  const Scenario scenario = bundled("symmetric-30cms");
  for (const double speed : {1e-3, 0.3, 10.0}) {
    const Scenario varied = with_speed(scenario, speed);
    const ReferenceResult seen = reference_of(varied);
    // Gap 1.5 cm at 30 cm/s.
    EXPECT_NEAR(seen.first_contact, 0.05, 1e-10) << speed;
    EXPECT_NEAR(value(seen, "i.sliding_time"), speed * 1.9 / (7 * 0.1 * 9.81), 1e-10 * speed);
    EXPECT_NEAR(value(seen, "i-j.effective_restitution"), 1.25 / 3.5, 1e-9);
    EXPECT_NEAR((varied.bodies[0].initial.position + varied.bodies[1].initial.position).norm(),
                2 * 0.002, 1e-15);
  }
}

TEST(SceneVariation, RestitutionOfHardAndLinearContacts) {
  const Scenario hard = bundled("symmetric-30cms");
  for (const double e : {0.5, 1.0})
    EXPECT_NEAR(value(reference_of(with_restitution(hard, e)), "i-j.restitution"), e, 1e-12);
  const Scenario linear = bundled("unlike-masses");
  EXPECT_NEAR(value(reference_of(with_restitution(linear, 0.6)), "i-j.restitution"), 0.6, 2e-4);
}

TEST(SceneVariation, StiffnessSetsTheContactTime) {
  // π/ω with ω² = k/m̄ − γ²/4 and e_n = exp(−γ t/2): t = √((π² + ln² e_n) m̄/k). The substrate's
  // friction takes 1e-4 of it.
  const Scenario scenario = bundled("unlike-masses");
  const double m = scenario.bodies[0].sphere.mass, other = scenario.bodies[1].sphere.mass;
  const double reduced = m * other / (m + other);
  for (const double k : {1e5, 4e6}) {
    const ReferenceResult seen = reference_of(with_stiffness(scenario, k));
    const double log_e = std::log(0.9);
    const double time = std::sqrt((M_PI * M_PI + log_e * log_e) * reduced / k);
    EXPECT_NEAR(value(seen, "i-j.contact_time") / time, 1, 1e-3);
  }
}

}  // namespace
}  // namespace slipcheck
