#include "studies/stability/scene_variation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../support/bundled.h"
#include "harness/run/prepared_scene.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

using test::bundled;

ReferenceResult reference_of(const Scenario& scenario) {
  return prepare_scenes({scenario}).front().reference;
}

double value(const ReferenceResult& reference, const std::string& name) {
  return reference.observables.at(name).value;
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
