#include <cmath>
#include <set>

#include "scenario/rules/scene_names.h"
#include "scenes.h"

namespace slipcheck {
namespace {

using namespace testing;

const std::string kGas = R"(slipcheck: 1
name: gas
title: Many spheres
units: cgs
materials:
  steel: {density: 7.85}
contacts:
  - {between: [steel, steel], normal: {model: hard, restitution: 0.9}}
  - {between: [steel, substrate], friction: 0.2}
substrate: {periodic: [2, 2]}
fill: {prefix: g, count: 50, material: steel, radius: {uniform: [0.045, 0.055]}, area: [0, 0, 2, 2], speed: 10, seed: 7}
run: {until: 1}
)";

TEST(Fill, PutsBodiesAtRandom) {
  const Scenario scene = parse_scenario(kGas, "s.yaml");
  ASSERT_EQ(scene.bodies.size(), 50u);
  EXPECT_EQ(scene.bodies.front().name, "g1");
  EXPECT_EQ(scene.bodies.back().name, "g50");
  Vector3 drift = Vector3::Zero();
  for (std::size_t i = 0; i < 50; ++i) {
    const Body& a = scene.bodies[i];
    EXPECT_GE(a.sphere.radius, 0.00045);
    EXPECT_LE(a.sphere.radius, 0.00055);
    EXPECT_EQ(a.initial.position.z(), a.sphere.radius);
    EXPECT_NEAR(a.initial.velocity.norm(), 0.1, 1e-15);
    EXPECT_NEAR(a.sphere.mass, 7850 * 4.18879 * std::pow(a.sphere.radius, 3), 1e-10);
    drift += a.initial.velocity;
    for (std::size_t j = 0; j < i; ++j) {
      const Body& b = scene.bodies[j];
      Vector3 apart = a.initial.position - b.initial.position;
      for (int axis = 0; axis < 2; ++axis) apart[axis] -= 0.02 * std::round(apart[axis] / 0.02);
      EXPECT_GE(apart.norm(), (a.sphere.radius + b.sphere.radius) * (1 - 1e-12));
    }
  }
  // A sum of 50 random directions: sqrt(50) = 7 velocities long, five times that is never seen.
  EXPECT_LT(drift.norm(), 35 * 0.1);
}

TEST(Fill, IsTheSameOnEveryMachine) {
  // The engine's numbers are fixed by the standard (its 10000th output is), ours are made of them
  // by operations that IEEE 754 rounds exactly.
  const Scenario scene = parse_scenario(kGas, "s.yaml");
  const Scenario again = parse_scenario(kGas, "s.yaml");
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(scene.bodies[i].initial.position, again.bodies[i].initial.position);
    EXPECT_EQ(scene.bodies[i].initial.velocity, again.bodies[i].initial.velocity);
  }
  const Scenario other = parse_scenario(with(kGas, "seed: 7", "seed: 8"), "s.yaml");
  EXPECT_NE(scene.bodies[0].initial.position, other.bodies[0].initial.position);
}

TEST(Fill, StandsAmongBodiesToo) {
  const std::string entry =
      "  - fill: {prefix: g, count: 30, material: steel, radius: 0.02, area: [-0.3, -0.3, 0.3, "
      "0.3], "
      "spin: rolling, speed: 1}\n";
  const Scenario scene =
      parse_scenario(with(kHard, "  - {name: a,", entry + "  - {name: a,"), "s.yaml");
  ASSERT_EQ(scene.bodies.size(), 32u);
  EXPECT_EQ(scene.bodies[0].name, "g1");
  EXPECT_EQ(scene.bodies[30].name, "a");
  for (std::size_t i = 0; i < 30; ++i) {
    const BodyState& state = scene.bodies[i].initial;
    EXPECT_GE((state.position - scene.bodies[30].initial.position).norm(), 0.12 * (1 - 1e-12));
    EXPECT_NEAR(slip_velocity(state, 0.02).norm(), 0, 1e-15);
  }
}

TEST(Fill, FillsAContainer) {
  const Scenario scene =
      parse_scenario(with(kContainer, "run:",
                          "fill: [{prefix: g, count: 20, material: steel, radius: 0.3 mm, area: "
                          "[0, 0, 1, 8 mm], speed: 0.1}]\nrun:"),
                     "s.yaml");
  ASSERT_EQ(scene.bodies.size(), 22u);
  for (const Body& body : scene.bodies) {
    EXPECT_EQ(body.initial.position.y(), 0);
    EXPECT_EQ(body.initial.velocity.y(), 0);
    EXPECT_GE(body.initial.position.x(), body.sphere.radius);
    EXPECT_LE(body.initial.position.x(), 0.01 - body.sphere.radius);
    EXPECT_GE(body.initial.position.z(), body.sphere.radius);
  }
}

TEST(Fill, RefusesWhatDoesNotFit) {
  const auto faults = messages(with(kGas, "count: 50", "count: 1000000"));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].substr(0, 69),
            "s.yaml:11:93: fill.area: must have room for 1000000 bodies, but only ");
  expect_fault(with(kGas, "count: 50", "count: 2000000"),
               "s.yaml:11:26: fill.count: must be a whole number from 1 to 1000000, got 2000000");
  expect_fault(with(kGas, "[0, 0, 2, 2]", "[0, 0, -2, 2]"),
               "s.yaml:11:88: fill.area: must be [x0, y0, x1, y1] with x0 <= x1 and y0 <= y1, got "
               "[0, 0, -2, 2]");
  expect_fault(with(kGas, "[0.045, 0.055]", "[0.055, 0.045]"),
               "s.yaml:11:65: fill.radius.uniform: must have the smaller radius first, got [0.055, "
               "0.045]");
  expect_fault(
      with(with(kGas, "periodic: [2, 2]", ""), "[0, 0, 2, 2]", "[0, 0, 1e20, 2]"),
      "s.yaml:11:88: fill.area: must be at most 1e9 diameters across, got [0, 0, 1e20, 2]");
  expect_fault(
      with(kGas, "run:",
           "bodies: [{name: g7, material: steel, sphere: {radius: 0.1}, "
           "position: [0, 0]}]\nrun:"),
      "s.yaml:11:16: fill.prefix: must give unique names, but g7 is also in bodies[0], got g");
}

Fill named(const std::string& prefix, std::int64_t count, const std::string& path) {
  Fill fill;
  fill.prefix = prefix;
  fill.count = count;
  fill.path = path;
  fill.complete = true;
  return fill;
}

/// All that two fills and two bodies may be called, against what a list of all names tells.
TEST(Fill, KnowsNamesThatAreGivenTwice) {
  const std::vector<std::string> prefixes = {"g", "g1", "g10", "g0", "gg", "h"};
  const std::vector<std::int64_t> counts = {1, 9, 10, 12, 120};
  std::size_t shared_by_some = 0;
  for (const std::string& first : prefixes)
    for (const std::string& second : prefixes)
      for (const std::int64_t many : counts)
        for (const std::int64_t few : counts) {
          const Fill one = named(first, many, "one"), two = named(second, few, "two");
          std::set<std::string> all = {"g7", "g110"};
          for (std::int64_t k = 1; k <= many; ++k) all.insert(first + std::to_string(k));
          std::string expected;
          for (std::int64_t k = few; k >= 1; --k)
            if (all.contains(second + std::to_string(k))) expected = second + std::to_string(k);
          SceneNames names;
          names.add("g7", "a body");
          names.add("g110", "another");
          names.add(one);
          const auto shared = names.add(two);
          EXPECT_EQ(shared ? shared->name : "", expected)
              << first << ' ' << many << ", " << second << ' ' << few;
          shared_by_some += shared.has_value();
          for (const std::string& name : all) EXPECT_TRUE(names.path_of(name)) << name;
          for (const char* name : {"g", "g01", "g121", "g1a", "g99999999999999999999", "h0"})
            EXPECT_EQ(names.path_of(name) != nullptr,
                      all.contains(name) || number_in(two, name) > 0)
                << name;
        }
  EXPECT_GT(shared_by_some, 100u);
}

TEST(Fill, TakesManyBodies) {
  std::string text = with(kGas, "count: 50", "count: 100000");
  text = with(text, "periodic: [2, 2]", "periodic: [60, 60]");
  text = with(text, "[0, 0, 2, 2]", "[0, 0, 60, 60]");
  EXPECT_EQ(parse_scenario(text, "s.yaml").bodies.size(), 100'000u);
}

}  // namespace
}  // namespace slipcheck
