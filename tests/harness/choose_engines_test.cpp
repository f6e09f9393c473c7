#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "../support/bundled.h"
#include "../support/refusal.h"
#include "harness/run/engine_grid.h"
#include "harness/run/requested_runs.h"
#include "scenario/fault.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

/// A ball at rest; `compare` stands there as it is.
Scenario scenario(const std::string& compare) {
  return parse_scenario(R"(slipcheck: 1
name: ball
title: A ball
materials: {steel: {density: 7850}}
contacts: [{between: [steel, substrate], friction: 0.1}]
substrate: {}
bodies:
  - {name: i, material: steel, sphere: {radius: 0.002}, position: [0, 0]}
run: {until: 1}
compare: {)" + compare + "}\n",
                        "ball.yaml");
}

/// "bullet double default 240"
std::vector<std::string> labels(const Scenario& scene) {
  test::use_test_engines();
  std::vector<std::string> labels;
  const std::vector<EngineRecord> runs = requested_runs({scene}).at(0);
  for (const EngineRecord& run : runs)
    labels.push_back(run.engine + ' ' + run.precision + ' ' + run.profile + ' ' +
                     std::to_string(static_cast<int>(run.rate)));
  return labels;
}

std::vector<std::string> chosen(const std::string& compare, const EngineChoice& choice) {
  Scenario scene = scenario(compare);
  choose_engines(scene, choice);
  return labels(scene);
}

using Labels = std::vector<std::string>;

TEST(AllEngines, AreThoseThatAreInstalledInEachPrecision) {
  const Labels all = labels(scenario("engines: all"));
  for (const char* precision : {"single", "double"})
    for (const char* profile : {"default", "physical"})
      for (const char* rate : {"240", "1000"})
        EXPECT_EQ(std::ranges::count(
                      all, std::string("bullet ") + precision + ' ' + profile + ' ' + rate),
                  1);
  // What an engine lacks is not asked of it.
  EXPECT_EQ(std::ranges::count(all, "faulty double default 240"), 1);
  EXPECT_EQ(std::ranges::count(all, "faulty double physical 240"), 0);
}

TEST(AllEngines, TakeTheirOwnProfilesAndRates) {
  const Labels all = labels(scenario("engines: {all: true, profiles: [hang], rate: 60}"));
  EXPECT_EQ(all, Labels{"faulty double hang 60"});
}

TEST(AllEngines, AProfileThatNoneHasIsAFault) {
  test::use_test_engines();
  const Scenario scene = scenario("engines: {all: true, profiles: [hnag]}");
  const auto faults = test::faults_of([&] { requested_runs({scene}); });
  ASSERT_EQ(faults.size(), 1u);
  const std::string message = faults[0].message();
  EXPECT_TRUE(message.starts_with(
      "ball.yaml:10:32: compare.engines.profiles: must be profiles of the engines, default, "))
      << message;
  EXPECT_TRUE(message.ends_with(", or paths (did you mean hang?), got hnag")) << message;
}

TEST(AllEngines, AreAWordOrAMappingThatSaysAll) {
  for (const auto& [engines, rule] :
       {std::pair{"every", "must be all"}, {"{all: false}", "must be true, or engines a list"}}) {
    const auto faults =
        test::faults_of([&, text = std::string(engines)] { scenario("engines: " + text); });
    ASSERT_EQ(faults.size(), 1u) << engines;
    EXPECT_NE(faults[0].message().find(rule), std::string::npos) << faults[0].message();
  }
}

TEST(EngineRequest, LeavesItsPrecisionToTheEngine) {
  EXPECT_EQ(labels(scenario("engines: [{engine: bullet, rate: 60}]")),
            Labels{"bullet double default 60"});
  const Scenario named = scenario("engines: [{engine: rapier@0.19.3, rate: 60}]");
  EXPECT_EQ(named.compare.engines.at(0).engine, "rapier@0.19.3");
  EXPECT_FALSE(named.compare.engines.at(0).precision);
  EXPECT_EQ(test::faults_of([] { scenario("engines: [{engine: '@1', rate: 60}]"); }).size(), 1u);
}

TEST(EngineRequest, OfANameWithoutAVersionTakesThePrecisionThatAnyVersionHas) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "of-versions";
  std::filesystem::create_directories(folder);
  for (const char* version : {"1.0", "2.0"}) {
    const auto worker = folder / fmt::format("slipcheck-engine-toy@{}-single", version);
    std::filesystem::remove(worker);
    std::filesystem::create_symlink(SLIPCHECK_BINARY_DIR "/faulty/slipcheck-engine-faulty-double",
                                    worker);
  }
  setenv("SLIPCHECK_ENGINE_PATH", folder.c_str(), 1);
  EngineGrid grid;
  grid.engines = {"toy"};
  grid.profiles = {"default"};
  const double rate = 240;
  const std::vector<EngineRequest> requests = requests_of(grid, std::span(&rate, 1));
  ASSERT_EQ(requests.size(), 1u);
  EXPECT_EQ(requests[0].engine, "toy");
  EXPECT_EQ(requests[0].precision, EngineRequest::Precision::single_);
}

TEST(ChooseEngines, PutsEnginesInPlaceOfTheScenes) {
  EXPECT_EQ(
      chosen("engines: [{engine: bullet, precision: single, rate: 60}]", {.engines = {"faulty"}}),
      (Labels{"faulty double default 240", "faulty double default 1000"}));
  EXPECT_EQ(
      chosen(
          "engines: []",
          {.engines = {"bullet"}, .precisions = {"double"}, .profiles = {"tuned"}, .rates = {100}}),
      Labels{"bullet double tuned 100"});
  EXPECT_GT(chosen("engines: []", {.engines = {"all"}}).size(), 8u);
}

TEST(ChooseEngines, ChangesWhatIsChosenAndNothingElse) {
  const std::string engines =
      "engines: [{engine: bullet, rate: [60, 240], expect: {status: unstable}}, "
      "{engine: bullet, precision: single, profile: tuned, rate: 1000}]";
  EXPECT_EQ(chosen(engines, {}), (Labels{"bullet double default 60", "bullet double default 240",
                                         "bullet single tuned 1000"}));
  EXPECT_EQ(chosen(engines, {.rates = {120}}),
            (Labels{"bullet double default 120", "bullet single tuned 120"}));
  EXPECT_EQ(chosen(engines, {.precisions = {"single"}}),
            (Labels{"bullet single default 60", "bullet single default 240",
                    "bullet single tuned 1000"}));
  // Two requests of one kind are one with the rates of both.
  EXPECT_EQ(chosen("engines: [{engine: bullet, rate: [60]}, {engine: bullet, profile: naive, rate: "
                   "[60, 240]}]",
                   {.profiles = {"tuned"}}),
            (Labels{"bullet double tuned 60", "bullet double tuned 240"}));
  Scenario scene = scenario(engines);
  choose_engines(scene, {.rates = {120}});
  EXPECT_FALSE(scene.compare.engines.at(0).expect);
}

}  // namespace
}  // namespace slipcheck
