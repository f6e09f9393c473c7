#include "harness/comparison.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slipcheck {
namespace {

Scenario with_tolerance(const std::string& observable, double value, bool absolute = false) {
  Scenario scenario;
  scenario.bodies.push_back({"i", "steel", {}, {}});
  scenario.compare.tolerance[observable] = {value, absolute};
  return scenario;
}

ReferenceResult reference(std::map<std::string, UncertainValue> values) {
  ReferenceResult result;
  result.observables = std::move(values);
  return result;
}

TEST(Ensemble, MedianMinAndMaxOverThePhases) {
  const auto ensemble = ensemble_values({{{"a", 3}}, {{"a", 1}}, {{"a", 2}}, {{"a", 8}}});
  EXPECT_EQ(ensemble.at("a").median, 2.5);
  EXPECT_EQ(ensemble.at("a").min, 1);
  EXPECT_EQ(ensemble.at("a").max, 8);
  EXPECT_EQ(ensemble.at("a").missing, 0u);
  const auto gaps = ensemble_values({{{"a", 3}}, {}, {{"a", 2}}});
  EXPECT_EQ(gaps.at("a").missing, 1u);
  EXPECT_TRUE(std::isnan(gaps.at("a").values[1]));
  EXPECT_EQ(gaps.at("a").median, 2.5);
}

TEST(Deviations, RelativeForTimesAbsoluteForRestitution) {
  Scenario scenario = with_tolerance("sliding_time", 0.01);
  scenario.compare.tolerance["effective_restitution"] = {0.005, false};
  const auto found = deviations(
      scenario,
      reference({{"i.sliding_time", {2, 1e-15}},
                 {"i-j.effective_restitution", {0.4, 1e-15}},
                 {"i.stopping_time", {4, 1e-15}}}),
      ensemble_values(
          {{{"i.sliding_time", 2.01}, {"i-j.effective_restitution", 0.41}, {"i.stopping_time", 6}},
           {{"i.sliding_time", 1.99},
            {"i-j.effective_restitution", 0.4},
            {"i.stopping_time", 4}}}));
  EXPECT_NEAR(found.at("i.sliding_time").max, 0.005, 1e-12);
  EXPECT_TRUE(found.at("i.sliding_time").within);
  EXPECT_NEAR(found.at("i-j.effective_restitution").max, 0.01, 1e-12);
  EXPECT_TRUE(found.at("i-j.effective_restitution").absolute);
  EXPECT_FALSE(found.at("i-j.effective_restitution").within);
  // Without a tolerance there is an error but no verdict.
  EXPECT_NEAR(found.at("i.stopping_time").max, 0.5, 1e-12);
  EXPECT_FALSE(found.at("i.stopping_time").tolerance);
  EXPECT_TRUE(found.at("i.stopping_time").within);
}

TEST(Deviations, OneBadPhaseIsEnough) {
  const auto found = deviations(
      with_tolerance("sliding_time", 0.01), reference({{"i.sliding_time", {1, 0}}}),
      ensemble_values(
          {{{"i.sliding_time", 1}}, {{"i.sliding_time", 1}}, {{"i.sliding_time", 1.1}}}));
  EXPECT_EQ(found.at("i.sliding_time").median, 0);
  EXPECT_FALSE(found.at("i.sliding_time").within);
}

TEST(Deviations, PhaseThatShowsNothingIsNotWithin) {
  const auto some =
      deviations(with_tolerance("sliding_time", 0.01), reference({{"i.sliding_time", {1, 0}}}),
                 ensemble_values({{{"i.sliding_time", 1}}, {}}));
  EXPECT_FALSE(some.at("i.sliding_time").within);
  EXPECT_EQ(some.at("i.sliding_time").reason, "1 of 2 phases do not show it");
  const auto none =
      deviations(with_tolerance("sliding_time", 0.01), reference({{"i.sliding_time", {1, 0}}}), {});
  EXPECT_FALSE(none.at("i.sliding_time").within);
  EXPECT_TRUE(std::isnan(none.at("i.sliding_time").max));
}

TEST(Deviations, OfAZeroAreAbsoluteOrUndefined) {
  const auto zero = reference({{"i.sliding_distance", {1e-19, 1e-18}}});
  const auto engine = ensemble_values({{{"i.sliding_distance", 1e-5}}});
  const auto undefined = deviations(with_tolerance("sliding_distance", 0.01), zero, engine);
  EXPECT_TRUE(std::isnan(undefined.at("i.sliding_distance").max));
  EXPECT_FALSE(undefined.at("i.sliding_distance").within);
  const auto metres = deviations(with_tolerance("sliding_distance", 1e-4, true), zero, engine);
  EXPECT_NEAR(metres.at("i.sliding_distance").max, 1e-5, 1e-18);
  EXPECT_TRUE(metres.at("i.sliding_distance").within);
  // Where the engine has the zero too, there is nothing to complain about.
  const auto both = deviations(with_tolerance("sliding_distance", 0.01), zero,
                               ensemble_values({{{"i.sliding_distance", 0.0}}}));
  EXPECT_EQ(both.at("i.sliding_distance").max, 0);
  EXPECT_TRUE(both.at("i.sliding_distance").within);
}

TEST(Deviations, WhatOnlyTheEngineShowsIsNotWithin) {
  const auto found = deviations(with_tolerance("flight_time", 0.01), reference({}),
                                ensemble_values({{{"i.flight_time", 0.1}, {"i.jump_height", 1}}}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found.at("i.flight_time").within);
  EXPECT_EQ(found.at("i.flight_time").reason, "it does not occur in the reference");
}

std::map<std::string, double> vector_values(const std::string& name, double x, double y) {
  return {{name, std::hypot(x, y)}, {name + ".x", x}, {name + ".y", y}, {name + ".z", 0}};
}

TEST(Deviations, OfVectorsCountDirectionAndRelateToTheLength) {
  const std::string name = "i.final_velocity";
  std::map<std::string, UncertainValue> truth;
  for (const auto& [key, value] : vector_values(name, 3, 4)) truth[key] = {value, 1e-15};
  const auto found = deviations(with_tolerance("final_velocity", 0.5), reference(truth),
                                ensemble_values({vector_values(name, 4, 3)}));
  // Same length, turned: |(1, −1)|/5.
  EXPECT_NEAR(found.at(name).max, std::sqrt(2.0) / 5, 1e-12);
  EXPECT_NEAR(found.at(name + ".x").max, 1.0 / 5, 1e-12);
  EXPECT_EQ(found.at(name + ".z").max, 0);
}

TEST(Deviations, OfAFinalPositionRelateToTheWayFromTheStart) {
  const std::string name = "i.final_position";
  Scenario scenario = with_tolerance("final_position", 0.01);
  scenario.bodies[0].initial.position = {100, 0, 0};
  std::map<std::string, UncertainValue> truth;
  for (const auto& [key, value] : vector_values(name, 101, 0)) truth[key] = {value, 1e-15};
  const auto found =
      deviations(scenario, reference(truth), ensemble_values({vector_values(name, 101.1, 0)}));
  EXPECT_NEAR(found.at(name).max, 0.1, 1e-12);
}

}  // namespace
}  // namespace slipcheck
