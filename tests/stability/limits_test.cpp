#include "studies/stability/limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>

#include "../support/bundled.h"
#include "studies/stability/closed_contact.h"
#include "studies/stability/fixed_step_limits.h"
#include "studies/stability/outcome_map.h"

namespace slipcheck {
namespace {

using Kind = Limit::Kind;

const Limit& limit_of(const std::vector<Limit>& limits, Kind kind, const std::string& scene,
                      const std::string& profile = "") {
  const auto found = std::ranges::find_if(limits, [&](const Limit& limit) {
    return limit.kind == kind && limit.scene == scene &&
           (profile.empty() || limit.profile == profile);
  });
  EXPECT_NE(found, limits.end()) << scene << " " << profile;
  return *found;
}

/// 2 (√(1 + ε²) − ε)/ω0, the step up to which the fixed-step solver's closed contact is stable.
double derived_step(double omega0, double damping_ratio) {
  return 2 * (std::sqrt(1 + damping_ratio * damping_ratio) - damping_ratio) / omega0;
}

TEST(ClosedContact, GrowsJustBeyondTheDerivedStep) {
  for (const double omega0 : {3.0, 2e5})
    for (const double damping_ratio : {0.0, 0.07, 0.5, 1.5}) {
      const double limit = derived_step(omega0, damping_ratio);
      const auto trial = [&](double part) {
        return closed_contact_trial(omega0, damping_ratio * omega0, part * limit);
      };
      for (const double part : {0.01, 0.5, 0.999})
        EXPECT_TRUE(trial(part).good) << omega0 << " " << damping_ratio << " " << part;
      for (const double part : {1.005, 1.5, 10.0}) {
        const Trial seen = trial(part);
        EXPECT_FALSE(seen.good) << omega0 << " " << damping_ratio << " " << part;
        EXPECT_TRUE(seen.outcome == Outcome::energy_growing || seen.outcome == Outcome::exploded);
        EXPECT_NE(seen.why, "");
      }
      EXPECT_EQ(trial(10).outcome, Outcome::exploded);
    }
}

TEST(FixedStepLimits, StableStepsAreThoseOfTheory) {
  LimitGrid grid;
  grid.ratio = 1.2;  // of the collisions; the closed contact has its own
  RunOptions options;
  options.phases = 4;
  const std::vector<Limit> limits = fixed_step_limits(grid, options);
  std::size_t compared = 0;
  for (const Limit& limit : limits) {
    if (limit.kind != Kind::stable_step) continue;
    ++compared;
    ASSERT_TRUE(limit.theory && limit.good && limit.bad) << limit.scene;
    // The bisection ends at 1.001; a mode that grows by less than 3.5e-4 a step is not seen.
    EXPECT_NEAR(limit.value() / *limit.theory, 1, 0.01) << limit.scene;
    EXPECT_TRUE(limit.islands.empty() && limit.strays.empty()) << limit.scene;
    const double damping_ratio = std::stod(limit.scene.substr(limit.scene.rfind(' ') + 1));
    EXPECT_NEAR(*limit.theory * 2e5, derived_step(1, damping_ratio), 1e-12) << limit.scene;
  }
  EXPECT_EQ(compared, 4u);

  // t_col = √((π² + ln² 0.9) m̄/k) = 36 µs. Frames tell the duration to a step at either end: 1 % of
  // it asks for at least 50 steps, and 400 are enough.
  const double mass = 7850 * 4 * M_PI / 3 * 8e-9;
  const double duration = std::hypot(M_PI, std::log(0.9)) * std::sqrt(0.5 * mass / 1e6);
  const Limit& both = limit_of(limits, Kind::accurate_step, "soft-pair");
  EXPECT_LT(both.value(), duration / 50);
  EXPECT_GT(both.value(), duration / 400);
  EXPECT_NE(both.why.find("contact_time"), std::string::npos) << both.why;
  // e_n is of second order, whatever the frames show: good to 2e-3 in 50 steps (StepSolver's test),
  // to 1 % in √5 times fewer; and not beyond the step at which the contact has two.
  const Limit& one = limit_of(limits, Kind::accurate_step, "soft-pair, restitution alone");
  EXPECT_GT(one.value(), duration / 50);
  EXPECT_LT(one.value(), duration / 2);
}

TEST(OutcomeMaps, FixedStepsGainEnergyBeyondTheory) {
  LimitGrid grid;
  grid.cells = 4;
  RunOptions options;
  options.phases = 4;
  const OutcomeMap map = step_stiffness_map(grid, options);
  EXPECT_EQ(map.name, "step-stiffness-fixed-step");
  ASSERT_EQ(map.x.values.size(), 4u);
  ASSERT_EQ(map.outcome.size(), 16u);
  ASSERT_EQ(map.theory.size(), 4u);
  EXPECT_DOUBLE_EQ(map.x.values.front(), 1e-7);
  EXPECT_NEAR(map.x.values.back(), 1e-3, 1e-15);
  const double mass = 7850 * 4 * M_PI / 3 * 8e-9;
  for (std::size_t row = 0; row < 4; ++row) {
    const double stiffness = map.y.values[row];
    EXPECT_EQ(map.theory[row].second, stiffness);
    // ε = γ/ω0 with e_n = exp(−π ε/√(4 − ε²)).
    const double log_e = std::log(0.9) / M_PI;
    const double ratio = 2 * std::abs(log_e) / std::sqrt(1 + log_e * log_e);
    const double limit = derived_step(std::sqrt(stiffness / (0.5 * mass)), ratio);
    EXPECT_NEAR(map.theory[row].first / limit, 1, 1e-6);
    for (std::size_t column = 0; column < 4; ++column) {
      const double part = map.x.values[column] / limit;
      const Outcome outcome = map.outcome[row * 4 + column];
      // Of second order: 20 steps in the contact, π/ω0, bring e_n to 1 %.
      if (part < 0.05) {
        EXPECT_EQ(outcome, Outcome::accurate) << stiffness << " " << part;
        EXPECT_LT(map.worst_error[row * 4 + column], 0.01);
      }
      if (part > 1) {
        EXPECT_GE(outcome, Outcome::energy_growing) << stiffness << " " << part;
      }
    }
  }
}

/// Few trials: what is found is known to a factor of 2.
LimitGrid coarse(std::vector<std::string> profiles) {
  test::use_test_engines();
  LimitGrid grid;
  grid.engines = {{"bullet"}, {"double"}, std::move(profiles)};
  grid.ratio = 2;
  grid.per_decade = 0.5;
  grid.least_step = 2e-3;
  grid.cells = 2;
  return grid;
}

RunOptions few_phases() {
  RunOptions options;
  options.phases = 4;
  return options;
}

TEST(FindLimits, KnowsWhatBulletDoes) {
  const LimitResults results = find_limits(coarse({"default", "physical"}), few_phases());

  // Default: e_n up to 1.1 in place of 0.9 in some phases at every rate, 15 % of the energy.
  const Limit& lottery = limit_of(results.limits, Kind::stable_step, "pair", "default");
  EXPECT_FALSE(lottery.good);
  EXPECT_EQ(lottery.bad, 2e-3);
  EXPECT_EQ(lottery.beyond, Outcome::energy_growing);
  EXPECT_TRUE(std::isnan(lottery.value()));

  // Physical: lengths are scaled so that R = 1. Bullet does not invert a moment of inertia, 0.4 m,
  // below its epsilon ε: λ³ m = 2.5 ε.
  const Limit& smallest = limit_of(results.limits, Kind::length_scale, "pair", "physical");
  const double mass = 7850 * 4 * M_PI / 3 * 8e-9;
  const double scale = std::cbrt(2.5 * std::numeric_limits<double>::epsilon() / mass);
  ASSERT_TRUE(smallest.good && smallest.bad);
  EXPECT_GE(*smallest.good, scale * 0.999);
  EXPECT_LE(*smallest.bad, scale * 1.001);
  EXPECT_LE(*smallest.good / *smallest.bad, 2);
  EXPECT_EQ(smallest.version, "3.24");
  const Limit& ratio = limit_of(results.limits, Kind::mass_ratio, "strikes-heavier", "physical");
  EXPECT_EQ(ratio.good, 1e6);
  EXPECT_FALSE(ratio.bad);

  // Speed 1 mm/s or 10 m/s, e_n 0 or 1. Default: no restitution below 0.2 m/s, but up to 0.2 of the
  // push out of the overlap (docs/bullet-facts.md); 1 cm a step at 5 m/s is through half the balls.
  ASSERT_EQ(results.maps.size(), 5u);
  const OutcomeMap& map = results.maps[0];
  EXPECT_EQ(map.name, "speed-restitution-bullet-double-default");
  EXPECT_EQ(map.y.values, (std::vector<double>{0, 1}));
  EXPECT_GE(map.worst_error[2], 0.79);
  EXPECT_LE(map.worst_error[2], 1.01);
  EXPECT_EQ(map.outcome[3], Outcome::tunnelled);
  for (const OutcomeMap* physical : {&results.maps[2], &results.maps[3]}) {
    EXPECT_EQ(physical->profile, "physical");
    for (const Outcome outcome : physical->outcome) EXPECT_EQ(outcome, Outcome::accurate);
    for (const double error : physical->worst_error) EXPECT_LT(error, 1e-9);
  }
}

TEST(FindLimits, AnEngineThatCrashesIsBadAndNothingElseIsLost) {
  const LimitResults alone = find_limits(coarse({"default"}), few_phases());
  LimitGrid grid = coarse({"default", "kill-at-step-10"});
  grid.engines.engines.push_back("faulty");
  const LimitResults beside = find_limits(grid, few_phases());

  std::size_t same = 0, crashed = 0, without = 0;
  for (const Limit& limit : beside.limits) {
    if (limit.method == "bullet" && limit.profile == "default") {
      const Limit& other = limit_of(alone.limits, limit.kind, limit.scene, "default");
      EXPECT_EQ(limit.good, other.good) << limit.scene;
      EXPECT_EQ(limit.bad, other.bad) << limit.scene;
      EXPECT_EQ(limit.why, other.why) << limit.scene;
      ++same;
    } else if (limit.method == "faulty" && limit.profile == "kill-at-step-10") {
      EXPECT_FALSE(limit.good) << limit.scene;
      EXPECT_TRUE(limit.bad) << limit.scene;
      crashed += limit.beyond == Outcome::crashed && limit.why.find("signal 9") != limit.why.npos;
    } else if (limit.method == "bullet") {
      EXPECT_NE(limit.reason.find("has no profile"), std::string::npos) << limit.reason;
      ++without;
    }
  }
  EXPECT_EQ(same, 11u);
  EXPECT_EQ(crashed, 11u);  // every scene takes more than ten steps at its good end
  EXPECT_EQ(without, 11u);
}

TEST(FindLimits, InterruptedKeepsWhatIsFinished) {
  std::atomic<bool> stop = false;
  RunOptions options = few_phases();
  options.stop = &stop;
  std::size_t last = 0, total = 0;
  options.progress = [&](std::size_t done, std::size_t of) {
    EXPECT_LE(done, of);
    last = done;
    total = of;
    if (done == 3) stop = true;
  };
  const LimitResults results = find_limits(coarse({"default"}), options);
  EXPECT_GE(last, 3u);
  EXPECT_GT(total, 3u);
  ASSERT_EQ(results.limits.size(), 11u + 6);
  for (const Limit& limit : results.limits) {
    EXPECT_EQ(limit.reason, "interrupted") << limit.scene;
    EXPECT_FALSE(limit.good || limit.bad);
  }
  EXPECT_TRUE(results.maps.empty());
}

}  // namespace
}  // namespace slipcheck
