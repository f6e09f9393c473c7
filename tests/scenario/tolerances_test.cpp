#include "scenario/tolerances.h"

#include <gtest/gtest.h>

#include "scenario/content_digest.h"
#include "scenes.h"

namespace slipcheck {
namespace {

using namespace testing;

std::string scene(const std::string& tolerance) {
  return kHard + "compare: {tolerance: {" + tolerance + "}}\n";
}
Scenario scenario(const std::string& tolerance) {
  return parse_scenario(scene(tolerance), "s.yaml");
}
/// The tolerance's value, or -1 where there is none.
double value_of(const Scenario& scenario, const std::string& name) {
  const auto tolerance = tolerance_of(scenario, name);
  return tolerance ? tolerance->value : -1;
}

TEST(Tolerances, TheKeyThatSaysMostOfTheOwnerHolds) {
  const Scenario found = scenario(
      "final_position: 0.01, a.final_position: 0.02, '*.final_position': 0.03, "
      "b.final_velocity: none, final_velocity: 0.05");
  EXPECT_EQ(value_of(found, "a.final_position"), 0.02);
  EXPECT_EQ(value_of(found, "b.final_position"), 0.03);
  EXPECT_EQ(value_of(found, "a.final_velocity"), 0.05);
  EXPECT_EQ(value_of(found, "b.final_velocity"), -1);
  EXPECT_EQ(value_of(found, "a.sliding_time"), -1);
  // Of a vector's component that of the vector, but only as a part of it.
  EXPECT_EQ(value_of(found, "a.final_position.x"), -1);
  EXPECT_EQ(tolerance_of_part(found, "a.final_position.x")->value, 0.02);
}

TEST(Tolerances, AGeneralNameDoesNotJudgeAHopOnTheSubstrate) {
  const Scenario two = scenario("restitution: 0.01");
  EXPECT_EQ(value_of(two, "a-b.restitution"), 0.01);
  EXPECT_TRUE(tolerance_of(two, "a-b.restitution")->absolute);
  EXPECT_EQ(value_of(two, "a-substrate.restitution"), -1);
  const Scenario named = scenario("restitution: 0.01, '*-substrate.restitution': 0.2");
  EXPECT_EQ(value_of(named, "a-substrate.restitution"), 0.2);
  EXPECT_EQ(value_of(named, "a-b.restitution"), 0.01);
  const Scenario none = scenario("'*.restitution': 0.01, a-substrate.restitution: none");
  EXPECT_EQ(value_of(none, "a-substrate.restitution"), -1);
  EXPECT_EQ(value_of(none, "b-substrate.restitution"), 0.01);
  // A ball alone has nothing but the substrate to bounce off.
  Scenario one = two;
  one.bodies.pop_back();
  EXPECT_EQ(value_of(one, "a-substrate.restitution"), 0.01);
}

TEST(Tolerances, NameOwnersThatThereAre) {
  const auto fault = [](const std::string& key, const std::string& rule) {
    const auto found = messages(scene(key + ": 0.01"));
    ASSERT_EQ(found.size(), 1u) << key;
    EXPECT_NE(found[0].find("compare.tolerance."), std::string::npos) << found[0];
    EXPECT_NE(found[0].find(rule), std::string::npos) << found[0];
  };
  fault("c.final_position", "must be of one of the bodies, but c is none");
  fault("b-a.restitution", "must have the pair in the order of the bodies, a-b");
  fault("'c*-substrate.restitution'", "must match a pair of this scene's bodies");
  fault("a.restitution", "must be of a pair, i-j.restitution");
  fault("a.final_positon", "must be an observable (did you mean final_position?)");
  fault("restitutoin", "is not a key here (did you mean restitution?)");
  EXPECT_EQ(messages(scene("'*-substrate.restitution': 0.1, a-b.restitution: none, '*': 1")).size(),
            1u);
  EXPECT_EQ(messages(scene("'*-*.restitution': 0.1, a.final_position: 1 mm")), kNoFaults);
  EXPECT_TRUE(scenario("a.final_position: 1 mm").compare.tolerance.at("a.final_position").absolute);
}

TEST(ContentDigest, IsOfWhatTheFileSays) {
  const std::string digest = content_digest(parse_scenario(kExample, "s.yaml"));
  const auto same = [&](const std::string& text) {
    return content_digest(parse_scenario(text, "other.yaml")) == digest;
  };
  EXPECT_TRUE(same("# a comment\n" + kExample + "\n# another\n"));
  EXPECT_TRUE(same(with(kExample, "gravity: 981 ", "gravity:    981.0 ")));
  EXPECT_TRUE(same(with(kExample, "title: Two", "title: 2")));
  EXPECT_TRUE(same(with(kExample, "{static: 0.5, kinetic: 0.1}", "{kinetic: 0.1, static: 0.5}")));
  EXPECT_FALSE(same(with(kExample, "gravity: 981 ", "gravity: 980 ")));
  EXPECT_FALSE(same(with(kExample, "sliding_time: 1 %", "sliding_time: 2 %")));
  EXPECT_FALSE(same(with(kExample, "rate: [60, 240, 1000]", "rate: [60, 1000, 240]")));
}

}  // namespace
}  // namespace slipcheck
