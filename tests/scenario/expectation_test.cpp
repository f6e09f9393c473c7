#include "scenes.h"

// What a scene expects of an engine.

namespace slipcheck {
namespace {

using namespace testing;

/// `scene` with an engine of which this is expected, from column 11 of its last line on.
std::string expecting(const std::string& expect, const std::string& scene = kHard) {
  return scene + "compare:\n  engines:\n    - engine: bullet\n      rate: 240\n" +
         "      expect:\n        " + expect + "\n";
}

Expectation expectation_of(const std::string& expect, const std::string& scene = kHard) {
  const Scenario scenario = parse_scenario(expecting(expect, scene), "s.yaml");
  return scenario.compare.engines.at(0).expect.value();
}

TEST(Expectations, AreRangesOfTheEnsembleInSi) {
  const std::string cgs = with(kHard, "materials:", "units: cgs\nmaterials:");
  const Expectation expectation = expectation_of(
      "{a-b.restitution: {min: [0.89, 0.91], max: [1.08, 1.11]}, "
      "a.sliding_time: {median: [\"80 ms\", 0.085]}, "
      "b.final_velocity.x: {max: [-20, \"-50 mm/s\"]}}",
      cgs);
  EXPECT_FALSE(expectation.status);
  ASSERT_EQ(expectation.observables.size(), 3u);
  const ExpectedObservable& restitution = expectation.observables.at("a-b.restitution");
  EXPECT_EQ(restitution.min->low, 0.89);
  EXPECT_EQ(restitution.min->high, 0.91);
  EXPECT_EQ(restitution.max->low, 1.08);
  EXPECT_EQ(restitution.max->high, 1.11);
  EXPECT_FALSE(restitution.median);
  EXPECT_FALSE(restitution.none);
  const ExpectedObservable& time = expectation.observables.at("a.sliding_time");
  EXPECT_DOUBLE_EQ(time.median->low, 0.08);
  EXPECT_EQ(time.median->high, 0.085);
  const ExpectedObservable& velocity = expectation.observables.at("b.final_velocity.x");
  EXPECT_DOUBLE_EQ(velocity.max->low, -0.2);
  EXPECT_DOUBLE_EQ(velocity.max->high, -0.05);
}

TEST(Expectations, AreThatSomethingDoesNotOccur) {
  const Expectation expectation = expectation_of("{b.stopping_time: none}");
  EXPECT_TRUE(expectation.observables.at("b.stopping_time").none);
  EXPECT_FALSE(expectation.observables.at("b.stopping_time").median);
}

TEST(Expectations, AreAStatus) {
  EXPECT_EQ(expectation_of("{status: skipped}").status, RunStatus::skipped);
  EXPECT_EQ(expectation_of("{status: unstable}").status, RunStatus::unstable);
  EXPECT_EQ(expectation_of("{status: crashed}").status, RunStatus::crashed);
  EXPECT_EQ(expectation_of("{status: timed_out}").status, RunStatus::timed_out);
  const Scenario without =
      parse_scenario(kHard + "compare: {engines: [{engine: bullet, rate: 1}]}\n", "s.yaml");
  EXPECT_FALSE(without.compare.engines.at(0).expect);
}

// Faults of keys stand in line 22; of the value, at the value.
const std::string kAt = "compare.engines[0].expect";

void expect_key_fault(const std::string& key, const std::string& rule) {
  expect_fault(expecting(key + ": none"), "s.yaml:22:9: " + kAt + "." + key + ": " + rule);
}

TEST(Expectations, NameObservables) {
  expect_key_fault("a.sliding_tim", "must be an observable (did you mean sliding_time?)");
  expect_key_fault("sliding_time", "must be of a body, i.sliding_time");
  expect_key_fault("a.restitution", "must be of a pair, i-j.restitution");
  expect_key_fault("a.height", "must be of the scene, all.height");
  expect_key_fault("a-.sliding_time", "must be of a body, i.sliding_time");
  expect_key_fault("a.sliding_time.x", "must be an observable (did you mean sliding_time?)");
  expect_key_fault("nonsense",
                   "must be an observable of a body, a pair or all, as in i.sliding_time");
}

void expect_owner_fault(const std::string& key, const std::string& rule,
                        const std::string& scene = kHard, int line = 22) {
  const std::string column = std::to_string(9 + key.size() + 2);
  expect_fault(expecting(key + ": none", scene), "s.yaml:" + std::to_string(line) + ":" + column +
                                                     ": " + kAt + "." + key + ": " + rule +
                                                     ", got none");
}

TEST(Expectations, NameBodiesAndPairsOfTheScene) {
  expect_owner_fault("c.sliding_time", "must be of one of the bodies, but c is none");
  expect_owner_fault("substrate.sliding_time",
                     "must be of one of the bodies, but substrate is none");
  expect_owner_fault("b-a.restitution", "must have the pair in the order of the bodies, a-b");
  const std::string no_pair =
      "must be of a pair of this scene's bodies, or of one and the substrate, but ";
  expect_owner_fault("a-c.restitution", no_pair + "a-c is none");
  expect_owner_fault("a-a.restitution", no_pair + "a-a is none");
  expect_owner_fault("substrate-a.restitution", no_pair + "substrate-a is none");
  expect_owner_fault("all.height", "must be of a body or a pair: all is only for a container");
  expect_owner_fault("a.sliding_time", "must be of all, as nothing else is seen in a container",
                     kContainer, 20);
  EXPECT_EQ(messages(expecting("{a-substrate.restitution: none, a-b.contact_time: none}")),
            kNoFaults);
  EXPECT_EQ(messages(expecting("all.height: {median: [1 mm, 2 mm]}", kContainer)), kNoFaults);
}

TEST(Expectations, NameBodiesOfAFill) {
  const std::string filled =
      with(kHard, "run:",
           "fill: {prefix: g, count: 12, material: steel, radius: 0.1, area: [3, 3, 9, 9]}\nrun:");
  EXPECT_EQ(messages(expecting("{g12.sliding_time: none, a-g1.restitution: none, "
                               "g2-g10.restitution: none}",
                               filled)),
            kNoFaults);
  for (const std::string name : {"g0", "g13", "g01", "g", "g1x", "g-1"})
    EXPECT_EQ(messages(expecting(name + ".sliding_time: none", filled)).size(), 1u) << name;
  expect_owner_fault("g10-g2.restitution", "must have the pair in the order of the bodies, g2-g10",
                     filled, 23);
  expect_owner_fault("g1-b.restitution", "must have the pair in the order of the bodies, b-g1",
                     filled, 23);
}

TEST(Expectations, FaultsOfValues) {
  const auto fault = [](const std::string& value, const std::string& rest) {
    const std::string key = "a.sliding_time: ";
    expect_fault(expecting(key + value), "s.yaml:22:" + rest);
  };
  const std::string at = ": " + kAt + ".a.sliding_time";
  fault("{max: [2, 1]}", "31" + at + ".max: must have the lower limit first, got [2, 1]");
  fault("{max: [1, 2, 3]}", "31" + at + ".max: must be a list of 2 numbers, got [1, 2, 3]");
  fault("{max: [1 mm, 2]}", "32" + at + ".max[0]: must be a time, as in \"3 ms\", got 1 mm");
  fault("{mean: [1, 2], max: [1, 2]}",
        "26" + at + ".mean: is not a key here (there are: min, median or max)");
  fault("{}", "25" + at + ": needs at least one of min, median or max");
  fault("never", "25" + at +
                     ": must be limits of min, median or max as in {max: [low, high]}, or none, "
                     "got never");
}

TEST(Expectations, FaultsOfTheWhole) {
  const std::string needs =
      "must be a mapping {i-j.restitution: {max: [low, high]}, …} or {status: …}, got ";
  expect_fault(expecting("{}"), "s.yaml:22:9: " + kAt + ": " + needs + "{}");
  expect_fault(expecting("none"), "s.yaml:22:9: " + kAt + ": " + needs + "none");
  expect_fault(
      expecting("status: ok"),
      "s.yaml:22:17: " + kAt + ".status: must be unstable, crashed, timed_out or skipped, got ok");
  expect_fault(expecting("{status: crashed, a.sliding_time: none}"),
               "s.yaml:22:10: " + kAt +
                   ".status: must stand alone: a run that does not end well shows no observables");
  expect_fault(expecting("{a.sliding_time: none, a.sliding_time: none}"),
               "s.yaml:22:32: " + kAt + ".a.sliding_time: must stand here once");
}

}  // namespace
}  // namespace slipcheck
