#include "studies/sweep/sweep_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "../support/refusal.h"
#include "sweep_text.h"

namespace slipcheck {
namespace {

using test::faults_of;
using test::with_sweep;

SweepPlan plan_of(const std::string& block, const std::string& engines = "[]") {
  return SweepPlan::parse(with_sweep(block, engines), "s.yaml");
}

std::string fault_of(const std::string& block, const std::string& engines = "[]") {
  const std::vector<Fault> faults = faults_of([&] { plan_of(block, engines); });
  return faults.empty() ? "" : faults.front().message();
}

TEST(SweepPlan, AGridIsAllCombinationsWithTheScenesOwnSlowest) {
  const SweepPlan plan = plan_of(
      "  grid:\n"
      "    engine: bullet\n"
      "    rate: [60, 240]\n"
      "    contacts.0.normal.restitution: [0.5, 0.7, 0.9]\n"
      "    settings.erp: [0.1, 0.2]\n");
  EXPECT_EQ(plan.runs(), 12u);
  EXPECT_EQ(plan.scenes(), 3u);
  std::set<std::tuple<std::uint64_t, double, double>> seen;
  for (std::uint64_t run = 0; run < 12; ++run) {
    const SweepChoice choice = plan.choice(run);
    EXPECT_EQ(choice.engine, "bullet");
    EXPECT_EQ(choice.phases, 32u);
    EXPECT_EQ(plan.scene_id(run), run / 4);
    seen.emplace(plan.scene_id(run), choice.rate, std::get<double>(choice.settings.at("erp")));
    const double expected = 0.5 + 0.2 * static_cast<double>(run / 4);
    const Scenario scene = plan.scene(run);
    EXPECT_TRUE(scene.compare.engines.empty());
    ReadNumbers numbers = {{"contacts[0].normal.restitution", std::nullopt}};
    plan.scene(run, &numbers);
    EXPECT_NEAR(numbers.at("contacts[0].normal.restitution")->value, expected, 1e-15);
  }
  EXPECT_EQ(seen.size(), 12u);
}

TEST(SweepPlan, NumbersAreInTheScenesUnitsOrInTheirOwn) {
  const SweepPlan plan =
      plan_of("  grid: {\"bodies[i].velocity[0]\": [10, 0.2 m/s], gravity: 9.81 m/s2}\n");
  EXPECT_TRUE(plan.is_reference_alone());
  EXPECT_DOUBLE_EQ(plan.scene(0).bodies[0].initial.velocity.x(), 0.1);  // 10 cm/s
  EXPECT_DOUBLE_EQ(plan.scene(1).bodies[0].initial.velocity.x(), 0.2);
  ReadNumbers numbers = {{"bodies[0].velocity[0]", std::nullopt}};
  plan.scene(0, &numbers);
  EXPECT_DOUBLE_EQ(numbers.at("bodies[0].velocity[0]")->value, 0.1);
  EXPECT_STREQ(numbers.at("bodies[0].velocity[0]")->unit, "m/s");
}

TEST(SweepPlan, AListGoesThroughItsRows) {
  const SweepPlan plan = plan_of(
      "  list:\n"
      "    - {bodies.i.velocity.0: 10, bodies.j.velocity.0: -10}\n"
      "    - {bodies.j.velocity.0: -20, bodies.i.velocity.0: 20}\n");
  ASSERT_EQ(plan.runs(), 2u);
  for (std::uint64_t run = 0; run < 2; ++run)
    EXPECT_EQ(plan.scene(run).bodies[0].initial.velocity.x(),
              -plan.scene(run).bodies[1].initial.velocity.x());
  EXPECT_DOUBLE_EQ(plan.scene(1).bodies[0].initial.velocity.x(), 0.2);
}

TEST(SweepPlan, RowsWithOneSceneShareItsReference) {
  const SweepPlan plan = plan_of(
      "  grid: {engine: bullet}\n"
      "  list:\n"
      "    - {gravity: 981, rate: 60}\n"
      "    - {gravity: 100, rate: 60}\n"
      "    - {gravity: 981, rate: 240}\n");
  EXPECT_EQ(plan.scenes(), 2u);
  EXPECT_EQ(plan.scene_id(0), plan.scene_id(1));  // put side by side
  EXPECT_NE(plan.scene_id(1), plan.scene_id(2));
}

TEST(SweepPlan, RangesReachFromEndToEnd) {
  const SweepPlan plan = plan_of(
      "  grid:\n"
      "    engine: bullet\n"
      "    rate: {from: 60, to: 16000, count: 5, scale: logarithmic}\n"
      "    settings.solver_iterations: {from: 1, to: 100, count: 4, whole: true}\n");
  const double ratio = std::pow(16000. / 60, 0.25);
  for (std::uint64_t k = 0; k < 5; ++k)
    EXPECT_NEAR(plan.choice(4 * k).rate, 60 * std::pow(ratio, static_cast<double>(k)), 1e-8);
  EXPECT_EQ(plan.choice(16).rate, 16000);
  for (std::uint64_t k = 0; k < 4; ++k)
    EXPECT_EQ(std::get<double>(plan.choice(k).settings.at("solver_iterations")),
              static_cast<double>(1 + 33 * k));
}

TEST(SweepPlan, SamplesStayInTheirRangesAndUnits) {
  for (const char* kind : {"latin_hypercube", "sobol"}) {
    const SweepPlan plan =
        plan_of(std::string("  ") + kind +
                ": {points: 40, ranges: {bodies.i.velocity.0: [10 cm/s, 20 cm/s], "
                "contacts.0.normal.restitution: {from: 0.1, to: 1, scale: logarithmic}}}\n");
    EXPECT_EQ(plan.runs(), 40u);
    EXPECT_EQ(plan.scenes(), 40u);
    for (std::uint64_t run = 0; run < 40; ++run) {
      const double speed = plan.scene(run).bodies[0].initial.velocity.x();
      EXPECT_GE(speed, 0.1);
      EXPECT_LT(speed, 0.2);
    }
  }
}

TEST(SweepPlan, WithoutAnEngineThoseOfTheSceneRun) {
  const std::string engines =
      "[{engine: bullet, precision: double, rate: [60, 240]}, "
      "{engine: bullet, precision: single, rate: 60}]";
  EXPECT_EQ(plan_of("  grid: {gravity: [981, 100]}\n", engines).runs(), 6u);
  // A rate of the sweep stands for those of the scene, and each engine runs once at it.
  const SweepPlan plan = plan_of("  grid: {rate: [30, 90]}\n", engines);
  EXPECT_EQ(plan.runs(), 4u);
  std::set<std::pair<std::string, double>> seen;
  for (std::uint64_t run = 0; run < 4; ++run)
    seen.emplace(plan.choice(run).precision, plan.choice(run).rate);
  EXPECT_EQ(seen.size(), 4u);
}

TEST(SweepPlan, TheDigestKnowsWhatIsSaidAndNotHow) {
  const std::string digest = plan_of("  grid: {gravity: [981, 100]}\n").digest();
  EXPECT_EQ(plan_of("  grid:\n    gravity:\n      - 981.0\n      - 100\n").digest(), digest);
  EXPECT_NE(plan_of("  grid: {gravity: [981, 101]}\n").digest(), digest);
}

TEST(SweepPlan, WhatIsWrongIsToldWithPlaceValueAndRule) {
  EXPECT_EQ(fault_of("  grid: {rate: []}\n", "[{engine: bullet, rate: 60}]"),
            "s.yaml:23:16: sweep.grid.rate: must be a list of at least 1, got []");
  EXPECT_EQ(fault_of("  grid: {}\n"),
            "s.yaml:23:9: sweep.grid: must be a mapping with at least one name of what varies, "
            "got {}");
  EXPECT_EQ(fault_of("  grid: {bodies.k.velocity.0: [1, 2]}\n"),
            "s.yaml:23:10: sweep.bodies.k.velocity.0: must be a path of the scene, and bodies has "
            "no item k");
  EXPECT_NE(fault_of("  grid: {bodies.i.sphere.raduis: [1, 2]}\n").find("raduis"),
            std::string::npos);
  EXPECT_EQ(fault_of("  grid: {contacts.0.normal.restitution: [0.5, 1.5]}\n"),
            "s.yaml:23:47: contacts[0].normal.restitution: must be >= 0 and <= 1, got 1.5");
  EXPECT_EQ(fault_of("  grid: {phases: [0]}\n", "[{engine: bullet, rate: 60}]"),
            "s.yaml:23:19: sweep.phases: must be a whole number from 1 to 100000, got 0");
  EXPECT_EQ(fault_of("  grid: {engine: bullet}\n"),
            "s.yaml:23:10: sweep: must give a rate where it gives engines: rate: 240 in grid");
  EXPECT_EQ(fault_of("  grid: {rate: [60, 240]}\n"),
            "s.yaml:23:10: sweep.rate: must not vary without an engine: compare.engines is empty, "
            "and the sweep names none");
  EXPECT_EQ(fault_of("  grid: {gravity: [1, 2]}\n  list: [{gravity: 3}]\n"),
            "s.yaml:24:11: sweep.gravity: must vary once, and gravity does at line 23");
  EXPECT_EQ(fault_of("  grid: {title: [a, b]}\n"),
            "s.yaml:23:10: sweep.title: must not be title, which is the same in all runs");
  EXPECT_EQ(fault_of("  grid: {run: [{until: rolling}]}\n"),
            "s.yaml:23:10: sweep.run: must be a key below run, as in run.limit");
  EXPECT_EQ(fault_of("  sobol: {points: 4, ranges: {gravity: [2, 1]}}\n"),
            "s.yaml:23:40: sweep.sobol.ranges.gravity: must be from the smaller number to the "
            "larger, got [2, 1]");
  EXPECT_EQ(fault_of("  sobol: {points: 4, ranges: {gravity: [1 m/s2, 2 cm/s2]}}\n"),
            "s.yaml:23:40: sweep.sobol.ranges.gravity: must have one unit on both numbers, written "
            "alike, got [1 m/s2, 2 cm/s2]");
}

TEST(SweepPlan, MoreRunsThanAnybodyMakesAreRefused) {
  std::string block = "  grid:\n";
  for (const char* path : {"gravity", "contacts.0.normal.restitution"})
    block += std::string("    ") + path + ": {from: 0.1, to: 1, count: 1000000}\n";
  EXPECT_EQ(fault_of(block), "s.yaml:23:3: sweep: must come to at most 100000000 runs, got 1e+12");
}

TEST(SweepPlan, AFileWithoutASweepIsRefused) {
  const std::string text = with_sweep("");
  const auto faults =
      faults_of([&] { SweepPlan::parse(text.substr(0, text.find("sweep:")), "s.yaml"); });
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].message(),
            "s.yaml:1:1: sweep: must be there, with what varies (slipcheck run runs a scene)");
}

}  // namespace
}  // namespace slipcheck
