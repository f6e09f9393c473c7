#include "studies/stability/stability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>

#include "../support/bundled.h"
#include "../support/refusal.h"
#include "studies/stability/phase_comparison.h"
#include "watched_runs.h"

namespace slipcheck {
namespace {

using test::use_test_engines;

/// Two balls that meet at 30 cm/s without friction: e_n alone.
std::string pair_scene(const std::string& name = "pair", const std::string& tolerance = "0.01") {
  std::string text = test::plain_scene(
      test::ball("i", "[-0.05, 0]", "[0.3, 0, 0]") + test::ball("j", "[0.05, 0]", "[-0.3, 0, 0]"),
      "friction: 0", "{until: 0.3}", fmt::format("tolerance: {{restitution: {}}}", tolerance));
  return text.replace(text.find("name: plain"), 11, "name: " + name);
}

Scenario scene_of(const std::string& text) { return parse_scenario(text, "scene.yaml"); }

RunOptions quick(std::size_t phases = 4) {
  RunOptions options;
  options.phases = phases;
  options.time_limit = 30;
  options.limits.reply = 10;
  options.limits.memory = std::size_t{256} << 20;
  return options;
}

StabilityGrid grid_of(const std::string& engine, std::vector<std::string> profiles,
                      std::vector<double> rates = {240}) {
  StabilityGrid grid;
  grid.engines = {{engine}, {"double"}, std::move(profiles)};
  grid.rates = std::move(rates);
  return grid;
}

// --- the reference -------------------------------------------------------------------------------

TEST(Stability, AReferenceIsAccurateWithATenthOfTheTolerance) {
  PreparedScene scene = test::prepared(pair_scene());
  UncertainValue& e = scene.reference.observables.at("i-j.restitution");
  e.uncertainty = 0.00099;
  EXPECT_TRUE(reference_outcome(scene).accurate) << reference_outcome(scene).why;
  EXPECT_NEAR(reference_outcome(scene).worst_uncertainty, 0.099, 1e-6);
  e.uncertainty = 0.00101;
  EXPECT_FALSE(reference_outcome(scene).accurate);
  EXPECT_NE(reference_outcome(scene).why.find("uncertainty of i-j.restitution"), std::string::npos);
  e.uncertainty = 0;
  e.value = INFINITY;
  EXPECT_EQ(reference_outcome(scene).why, "i-j.restitution is not finite");
  e.value = 0.9;
  scene.reference.run.reached = false;
  scene.reference.run.reason = "too hard";
  EXPECT_EQ(reference_outcome(scene).why, "the run did not end: too hard");
}

TEST(Stability, AValueLostInItsUncertaintyIsNotAccurate) {
  std::string text = pair_scene();
  text.replace(text.find("restitution: 0.01"), 17, "final_velocity: 1 %");
  PreparedScene scene = test::prepared(text);
  EXPECT_TRUE(reference_outcome(scene).accurate);  // y and z are 0 to rounding
  for (const char* axis : {"x", "y", "z"})
    scene.reference.observables.at(fmt::format("i.final_velocity.{}", axis)) = {1e-6, 1e-6};
  EXPECT_FALSE(reference_outcome(scene).accurate);
}

// --- observables ---------------------------------------------------------------------------------

TEST(Stability, ThePhaseIsHeldAgainstTheTolerance) {
  const PreparedScene scene = test::prepared(pair_scene());
  const auto compared = [&](std::map<std::string, double> shown) {
    return compare_phase(scene.scenario, scene.reference, shown);
  };
  EXPECT_TRUE(compared({{"i-j.restitution", 0.9099}}).within);
  const PhaseComparison off = compared({{"i-j.restitution", 0.92}});
  EXPECT_FALSE(off.within);
  EXPECT_NEAR(off.worst_error, 2, 1e-9);
  EXPECT_EQ(off.worst_observable, "i-j.restitution");
  EXPECT_EQ(off.why, "i-j.restitution is off by 0.02, 2 tolerances");
  const PhaseComparison missing = compared({{"i-j.restitution", NAN}});
  EXPECT_FALSE(missing.within);
  EXPECT_TRUE(std::isnan(missing.worst_error));
  EXPECT_EQ(missing.why, "i-j.restitution: no run of the engine shows it");
}

// --- engines -------------------------------------------------------------------------------------

TEST(Stability, EveryOutcomeHasItsName) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < kOutcomes; ++k) names.insert(name_of(static_cast<Outcome>(k)));
  EXPECT_EQ(names.size(), kOutcomes);
  EXPECT_TRUE(names.contains("energy growing"));
  EXPECT_TRUE(names.contains("NaN"));
}

TEST(Stability, BulletsLotteryGrowsAndItsCureIsAccurate) {
  // Default: e_n between 0.90 and 1.10, even over the phases (scene_run_test.cpp); rolling keeps
  // 2/7 of the energy, so that e_n > √(1 + 0.05·7/5) = 1.034 counts: a third of 16 phases.
  use_test_engines();
  const auto cases = run_stability({test::bundled("symmetric-30cms")},
                                   grid_of("bullet", {"default", "tuned"}), quick(16));
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_TRUE(cases[0].reference.accurate);
  ASSERT_EQ(cases[0].runs.size(), 2u);
  const StabilityRun &shipped = cases[0].runs[0], &tuned = cases[0].runs[1];
  EXPECT_EQ(shipped.outcome, Outcome::energy_growing);
  EXPECT_NEAR(static_cast<double>(shipped.phases[3]), 16 / 3.0, 1.5);
  EXPECT_LE(shipped.energy_gain, 0.21 / 1.4 + 1e-3);
  EXPECT_GE(shipped.energy_gain, 0.1);
  EXPECT_EQ(tuned.outcome, Outcome::accurate) << tuned.why;
  EXPECT_EQ(tuned.phases[0], 16u);
  EXPECT_LE(tuned.worst_error, 1);
}

TEST(Stability, WhateverOneEngineDoesTheOthersGoOn) {
  use_test_engines();
  const std::vector<Scenario> cases = {scene_of(pair_scene("one"))};
  StabilityGrid alone = grid_of("bullet", {"default", "tuned"});
  StabilityGrid beside = alone;
  beside.engines.engines = {"bullet", "faulty"};
  beside.engines.profiles = {"default", "eat-memory", "hang", "kill-at-step-10", "nan", "tuned"};
  const auto healthy = run_stability(cases, alone, quick());
  const auto all = run_stability(cases, beside, quick());
  std::map<std::string, const StabilityRun*> found;
  for (const StabilityRun& run : all[0].runs)
    found[run.record.engine + " " + run.record.profile] = &run;
  EXPECT_EQ(found.at("faulty eat-memory")->outcome, Outcome::crashed);
  EXPECT_EQ(found.at("faulty hang")->outcome, Outcome::timed_out);
  EXPECT_EQ(found.at("faulty kill-at-step-10")->outcome, Outcome::crashed);
  EXPECT_EQ(found.at("faulty nan")->outcome, Outcome::not_finite);
  EXPECT_EQ(found.at("bullet nan")->outcome, Outcome::refused);  // it has no such profile
  for (const StabilityRun& run : all[0].runs)
    EXPECT_TRUE(run.outcome == Outcome::accurate || !run.why.empty());
  for (const StabilityRun& run : healthy[0].runs) {
    const StabilityRun& same = *found.at("bullet " + run.record.profile);
    EXPECT_EQ(run.outcome, same.outcome);
    EXPECT_EQ(run.phases, same.phases);
    ASSERT_EQ(run.record.observables.size(), same.record.observables.size());
    for (const auto& [name, value] : run.record.observables)
      for (std::size_t p = 0; p < value.values.size(); ++p)
        EXPECT_EQ(value.values[p], same.record.observables.at(name).values[p]) << name;
  }
}

TEST(Stability, ARefusedCaseLeavesTheOthers) {
  use_test_engines();
  std::string refused = pair_scene("viscoelastic");
  refused.replace(refused.find("ball: {}"), 8, "ball: {young_modulus: 1e9, poisson_ratio: 0.3}");
  refused.replace(refused.find("restitution: 0.9"), 16, "restitution: viscoelastic");
  const auto cases = run_stability({scene_of(refused), scene_of(pair_scene())},
                                   grid_of("bullet", {"tuned"}), quick());
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_TRUE(cases[0].reference.refused);
  EXPECT_FALSE(cases[0].reference.accurate);
  EXPECT_NE(cases[0].reference.why.find("dissipation_time"), std::string::npos);
  ASSERT_EQ(cases[0].runs.size(), 1u);
  EXPECT_EQ(cases[0].runs[0].outcome, Outcome::refused);
  EXPECT_EQ(cases[1].runs[0].outcome, Outcome::accurate) << cases[1].runs[0].why;
}

TEST(Stability, RatesAreTheGridsOrTheScenesOr240) {
  use_test_engines();
  const auto rates = [](const Scenario& scenario, const std::vector<double>& asked) {
    const auto cases = run_stability({scenario}, grid_of("faulty", {"ok"}, asked), quick(1));
    std::vector<double> seen;
    for (const StabilityRun& run : cases[0].runs) seen.push_back(run.record.rate);
    return seen;
  };
  Scenario scenario = scene_of(pair_scene());
  EXPECT_EQ(rates(scenario, {}), std::vector<double>({240}));
  scenario.compare.engines.resize(2);
  scenario.compare.engines[0].rates = {1000, 60};
  scenario.compare.engines[1].rates = {60};
  EXPECT_EQ(rates(scenario, {}), std::vector<double>({60, 1000}));
  EXPECT_EQ(rates(scenario, {500, 100}), std::vector<double>({100, 500}));
}

TEST(Stability, ShortRunsAndNoRunsWork) {
  use_test_engines();
  std::string shorter_than_a_step = pair_scene();
  shorter_than_a_step.replace(shorter_than_a_step.find("{until: 0.3}"), 12, "{until: 1e-5}");
  const std::string over_at_once = test::plain_scene(test::ball("a", "[0, 0]", "[0, 0, 0]"),
                                                     "friction: 0.5", "{until: rest, limit: 1}");
  for (const std::string& text : {shorter_than_a_step, over_at_once}) {
    const auto cases = run_stability({scene_of(text)}, grid_of("bullet", {"tuned"}), quick());
    EXPECT_TRUE(cases[0].reference.accurate) << cases[0].reference.why;
    EXPECT_EQ(cases[0].runs[0].outcome, Outcome::accurate) << cases[0].runs[0].why;
  }
}

TEST(Stability, BoxesAreRefusedAtOnce) {
  const auto faults =
      test::faults_of([] { run_stability({test::bundled("box-one-ball")}, {}, quick()); });
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].key, "container");
  EXPECT_NE(faults[0].message().find("takes scenes on a substrate"), std::string::npos);
}

TEST(Stability, AnInterruptedRunSaysSo) {
  use_test_engines();
  const std::atomic<bool> stop = true;
  RunOptions options = quick();
  options.stop = &stop;
  const auto cases =
      run_stability({scene_of(pair_scene())}, grid_of("bullet", {"default"}), options);
  EXPECT_EQ(cases[0].reference.why, "interrupted");
  EXPECT_EQ(cases[0].runs[0].outcome, Outcome::refused);
}

}  // namespace
}  // namespace slipcheck
