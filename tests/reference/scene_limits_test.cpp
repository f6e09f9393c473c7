#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../support/extremes.h"
#include "bundled_scenes.h"
#include "scenario/observable_key.h"

// The contact solver against the event solver on bundled scenes of soft contacts: the instant that
// stands for a soft one is its limit t_col → 0.

namespace slipcheck {
namespace {

using test::bundled;
using test::play;
using test::Played;

/// Collisions `factor` times as short with the restitution as it is: k grows by its square.
Scenario stiffer(Scenario scenario, double factor) {
  for (BodyContact& contact : scenario.contacts) {
    auto& law = std::get<LinearNormal>(contact.normal);
    if (law.collision_time) *law.collision_time /= factor;
    if (law.damping_rate) *law.damping_rate *= factor;
    if (law.stiffness) *law.stiffness *= factor * factor;
  }
  return scenario;
}

/// What both solvers show of a scene.
struct Both {
  explicit Both(const Scenario& scenario)
      : contact(play(scenario, Compare::Reference::contact)),
        event(play(scenario, Compare::Reference::event)) {
    for (const auto& [name, value] : contact.seen) {
      if (ends(name, "contact_time")) collision_time = test::largest_of(collision_time, value);
      if (ends(name, ".sliding_time")) sliding_time = test::largest_of(sliding_time, value);
      if (ends(name, ".velocity_after_collision")) speed = test::largest_of(speed, value);
    }
  }
  static bool ends(const std::string& name, const std::string& end) {
    return name.size() >= end.size() &&
           name.compare(name.size() - end.size(), end.size(), end) == 0;
  }
  static bool is_velocity(const std::string& name) {
    const ObservableKey key = observable_key(name);
    return key.component != '\0' &&
           (key.observable == "rolling_velocity" || key.observable == "velocity_after_collision");
  }
  /// contact − event, of velocities and sliding times in proportion to the fastest and longest.
  std::map<std::string, double> difference() const {
    std::map<std::string, double> all;
    for (const auto& [name, value] : contact.seen) {
      if (is_velocity(name)) all[name] = (value - event[name]) / speed;
      if (ends(name, ".sliding_time")) all[name] = (value - event[name]) / sliding_time;
    }
    return all;
  }

  Played contact, event;
  double collision_time = 0, sliding_time = 0, speed = 0;
};

double largest(const std::map<std::string, double>& differences) {
  double most = 0;
  for (const auto& [name, value] : differences) most = test::largest_of(most, std::abs(value));
  return most;
}

// --- pairs that push each other along the plane --------------------------------------------------

class LevelCollision : public testing::TestWithParam<const char*> {};

TEST_P(LevelCollision, AgreesToTheShareOfTheContactInTheSlide) {
  // In t_col the substrate changes velocities by (1+A) μ_s g t_col at most while a body sticks and
  // by (1+A) μ_k g t_col while it slides, a share t_col/t^s; the line of centres of an oblique hit
  // turns by v t_col/(2R). Measured: 0.4 to 1.5 t_col/t^s.
  const Both both(bundled(GetParam()));
  EXPECT_LT(largest(both.difference()), 2 * both.collision_time / both.sliding_time);
}

INSTANTIATE_TEST_SUITE_P(Scene, LevelCollision,
                         testing::Values("clamp-on-damping", "clamped-contact",
                                         "collision-on-shaker", "collision-on-slope",
                                         "friction-in-collision", "hertz-10cms", "hertz-100cms",
                                         "ice-small-dissipation", "oblique-resolved",
                                         "onset-of-sliding", "power-law", "power-law-constant",
                                         "rolling-two-kinds", "shell-against-solid",
                                         "symmetric-steel", "unlike-masses"));

class StiffeningCollision : public testing::TestWithParam<const char*> {};

TEST_P(StiffeningCollision, DifferenceHalvesWithTheCollisionTime) {
  std::vector<std::map<std::string, double>> differences;
  for (double factor : {1, 2, 4})
    differences.push_back(Both(stiffer(bundled(GetParam()), factor)).difference());
  for (int k : {0, 1}) {
    for (const auto& [name, value] : differences[k]) {
      const double next = differences[k + 1].at(name);
      if (std::abs(next) < 1e-9) continue;  // zero by symmetry: what the integration leaves
      // Rolling velocities and times have a first order; other velocities can lack one.
      const bool first = name.find("velocity_after") == std::string::npos;
      if (first) {
        EXPECT_NEAR(value / next, 2, 0.4) << name;
      } else if (GetParam() != std::string("friction-in-collision") || k == 1) {
        EXPECT_GT(value / next, 1.6) << name;  // there orders cancel at t_col = 1 ms
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scene, StiffeningCollision,
    testing::Values("clamp-on-damping", "clamped-contact", "collision-on-shaker",
                    "collision-on-slope", "friction-in-collision", "jump-resolved",
                    "oblique-resolved", "onset-of-sliding", "rolling-two-kinds", "rubber-collision",
                    "rubbing-capped", "rubbing-uncapped", "shell-against-solid",
                    "spin-before-central-hit", "spin-before-oblique-hit", "symmetric-steel",
                    "unlike-masses", "unlike-radii", "zero-sliding-distance-rubbed"));

TEST(SceneLimit, BelowSlidingTakesAStiffContactToSlide) {
  // At 0.02 cm/s and 2.55e-5 s no sphere slides, with hard contacts both do: v_rel must be far
  // above v^b = 2 (1+A) μ_s g/ω0, which is 0.028 cm/s there and 1/64 of it here.
  const Both stiff(stiffer(bundled("below-sliding"), 64));
  const Both stiffer_still(stiffer(bundled("below-sliding"), 128));
  for (const char* name : {"i.rolling_velocity.x", "i.sliding_time"})
    EXPECT_NEAR(stiff.difference().at(name) / stiffer_still.difference().at(name), 2, 0.4) << name;
}

TEST(SceneLimit, FreeCollisionsAgreeToTheTurningOfTheLineOfCentres) {
  // Without friction on the plane there is no t^s. The hard law has the restitution of the same
  // impact, tabulated to 1e-6.
  for (const char* name : {"ice-viscoelastic", "ice-compact"})
    EXPECT_LT(largest(Both(bundled(name)).difference()), 1e-6) << name;
}

// --- pairs that press each other onto the plane --------------------------------------------------

TEST_P(StiffeningCollision, ComesToWhatTheEventSolverTakesItFor) {
  // What is left at a thousandth of the collision time, doubled, is what was left of it.
  const auto left = [](double factor) {
    return largest(Both(stiffer(bundled(GetParam()), factor)).difference());
  };
  EXPECT_LT(left(1000), 2e-3 * left(1) + 1e-8);
}

TEST(SceneLimit, RepeatedCollisionsEndAlike) {
  // together-again: each of a cascade of ever weaker collisions differs by its own t_col/t^s, so
  // that the last, as long as the slides between them, are others. What is left is as little.
  const Both both(bundled("together-again"));
  for (const Played* played : {&both.contact, &both.event})
    EXPECT_LT(std::abs((*played)["i.final_velocity.x"]), 1e-3 * 0.15);
}

}  // namespace
}  // namespace slipcheck
