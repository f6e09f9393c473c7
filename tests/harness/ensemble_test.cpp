#include <gtest/gtest.h>

#include <cmath>

#include "../support/bundled.h"
#include "harness/compare/comparison.h"
#include "harness/run/engine_grid.h"
#include "harness/run/scene_run.h"
#include "scenario/load.h"

// Ensembles over phases, headings and scales.

namespace slipcheck {
namespace {

using test::bundled;
using test::use_test_engines;

/// The runs of Bullet in double precision under its own settings.
std::vector<EngineRecord> runs_of(Scenario scenario, double rate, std::size_t headings,
                                  std::vector<double> scales, std::size_t phases = 4) {
  use_test_engines();
  EngineRequest request;
  request.engine = "bullet";
  request.precision = EngineRequest::Precision::double_;
  request.rates = {rate};
  scenario.compare.engines = {request};
  scenario.compare.headings = headings;
  scenario.compare.scales = std::move(scales);
  RunOptions options;
  options.phases = phases;
  return run_scenes({std::move(scenario)}, options).at(0).runs;
}

TEST(HeadingSpread, IsThatOfTheWorstPhase) {
  // Two headings of three phases: they differ by 1, 3 and, where one shows nothing, not at all.
  std::map<std::string, EnsembleValue> ensemble;
  ensemble["a"].values = {1, 2, 3, 2, 5, kNotObserved};
  ensemble["b"].values = {1, kNotObserved, kNotObserved, kNotObserved, 2, kNotObserved};
  note_heading_spreads(ensemble, 2);
  ASSERT_TRUE(ensemble["a"].headings);
  EXPECT_EQ(ensemble["a"].headings->spread, 3);
  EXPECT_EQ(ensemble["a"].headings->phase, 1u);
  EXPECT_FALSE(ensemble["b"].headings);
  ensemble["a"].headings.reset();
  note_heading_spreads(ensemble, 1);
  EXPECT_FALSE(ensemble["a"].headings);
}

TEST(Headings, TwoFixedAxesOfRollingFrictionShow) {
  // Bullet limits the torque about each of two axes: on their diagonals the two together are √2 of
  // what one is, and the ball stops after 1/√2 of the way. Headings of a quarter turn see nothing
  // but the order in which both are solved: half of what a step takes from the speed, over the run.
  Scenario scenario = bundled("roll-to-rest");
  scenario.bodies[0].initial.velocity = {0.5, 0, 0};
  scenario.bodies[0].initial.angular_velocity = {0, 50, 0};
  const EngineRecord eighths = runs_of(scenario, 240, 8, {1}).at(0);
  ASSERT_EQ(eighths.status, RunStatus::ok) << eighths.reason;
  EXPECT_EQ(eighths.headings, 8u);
  EXPECT_EQ(eighths.phases, 1u);  // nothing is met
  const EnsembleValue& way = eighths.observables.at("ball.stopping_distance");
  ASSERT_EQ(way.values.size(), 8u);
  // A step or two of 1/240 s of 2.5 s, and of the way half of that.
  EXPECT_NEAR(way.min / way.max, std::sqrt(0.5), 0.01);
  for (std::size_t h = 0; h < 8; ++h)
    EXPECT_NEAR(way.values[h], h % 2 == 0 ? way.max : way.min, 0.01 * way.max) << h;
  ASSERT_TRUE(way.headings);
  EXPECT_EQ(way.headings->spread, way.max - way.min);

  const EngineRecord quarters = runs_of(scenario, 240, 4, {1}).at(0);
  EXPECT_LE(quarters.observables.at("ball.stopping_distance").headings->spread, 1e-3);
}

TEST(Headings, AVectorComesBackInTheScenesDirections) {
  const Scenario scenario = bundled("oblique");
  const EngineRecord one = runs_of(scenario, 1000, 1, {1}, 2).at(0);
  const EngineRecord four = runs_of(scenario, 1000, 4, {1}, 2).at(0);
  ASSERT_EQ(four.status, RunStatus::ok) << four.reason;
  ASSERT_EQ(one.phases, 2u);
  EXPECT_EQ(four.phases, 2u);
  std::size_t compared = 0;
  for (const auto& [name, seen] : one.observables) {
    if (name.find("final_velocity") == std::string::npos) continue;
    const EnsembleValue& all = four.observables.at(name);
    ASSERT_EQ(all.values.size(), 8u);
    for (std::size_t p = 0; p < 2; ++p) EXPECT_EQ(all.values[p], seen.values[p]) << name;
    // Quarter turns have no rounding of their own; axes of the solver may change order.
    for (std::size_t k = 0; k < 8; ++k)
      EXPECT_NEAR(all.values[k], seen.values[k % 2], 0.02) << name << " " << k;
    ++compared;
  }
  EXPECT_EQ(compared, 8u);
}

TEST(Headings, WhatHasDirectionsOfItsOwnIsLeftOut) {
  Scenario scenario = bundled("symmetric-30cms");
  std::get<Substrate>(scenario.surroundings).periodic = Vector2(1, 1);
  const EngineRecord run = runs_of(scenario, 240, 8, {1}).at(0);
  EXPECT_EQ(run.headings, 1u);
  ASSERT_FALSE(run.warnings.empty());
  EXPECT_EQ(run.warnings.front(),
            "headings are left out: a periodic plane has directions of its own");
}

TEST(Scales, EachIsARunOfItsOwn) {
  // Two balls that close in with 30 cm/s, at a hundredth of the lengths with 3 cm/s: below Bullet's
  // threshold of 20 cm/s there is no restitution.
  const auto runs = runs_of(bundled("symmetric-30cms"), 240, 1, {0.01, 1});
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].scale, 0.01);
  EXPECT_EQ(runs[0].rate, 240);
  EXPECT_LT(runs[0].observables.at("i-j.restitution").max, 0.3);
  EXPECT_EQ(runs[1].scale, 1);
  EXPECT_GT(runs[1].observables.at("i-j.restitution").min, 0.8);
  const auto alone = runs_of(bundled("symmetric-30cms"), 240, 1, {1});
  for (const auto& [name, seen] : alone.at(0).observables)
    EXPECT_EQ(runs[1].observables.at(name).median, seen.median) << name;
}

TEST(Scales, WhatHasNoLengthOfItsOwnDoesNotChange) {
  // Sliding ends by Coulomb's friction alone. With λ = 4 factors are powers of two: no rounding.
  const auto runs = runs_of(bundled("slide-to-roll"), 1000, 1, {1, 4});
  ASSERT_EQ(runs.size(), 2u);
  for (const char* name : {"ball.sliding_time", "ball.sliding_distance", "ball.rolling_velocity"}) {
    const double one = runs[0].observables.at(name).median;
    EXPECT_NEAR(runs[1].observables.at(name).median, one, 1e-3 * one) << name;
  }
}

TEST(Scales, WhatIsExpectedIsOfTheScenesOwnSize) {
  use_test_engines();
  Scenario scenario = bundled("symmetric-30cms");
  EngineRequest request;
  request.engine = "bullet";
  request.rates = {240};
  request.expect.emplace().status = RunStatus::unstable;
  scenario.compare.engines = {request};
  scenario.compare.scales = {1, 100};
  RunOptions options;
  options.phases = 1;
  const auto runs = run_scenes({scenario}, options).at(0).runs;
  EXPECT_TRUE(runs.at(0).expect);
  EXPECT_FALSE(runs.at(1).expect);
}

}  // namespace
}  // namespace slipcheck
