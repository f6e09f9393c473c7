#include <algorithm>

#include "scenes.h"

// What a user reads for each kind of mistake: place, key, rule and value.

namespace slipcheck {
namespace {

using namespace testing;

TEST(Fault, ReadsAsPlaceKeyRuleValue) {
  EXPECT_EQ((Fault{"f.yaml", {3, 7}, "a.b", "must be > 0 m", "-1"}.message()),
            "f.yaml:3:7: a.b: must be > 0 m, got -1");
  EXPECT_EQ((Fault{"f.yaml", {}, "", "must be a file", ""}.message()), "f.yaml: must be a file");
}

TEST(Fault, UnknownKey) {
  expect_fault(with(kHard, "substrate: {}", "substrate: {tillt: 5}"),
               "s.yaml:12:13: substrate.tillt: is not a key here (did you mean tilt?)");
  expect_fault(with(kHard, "substrate: {}", "substrate: {colour: 5}"),
               "s.yaml:12:13: substrate.colour: is not a key here (there are: periodic, tilt, "
               "confined or motion)");
  expect_fault(
      with(kHard, "title:", "engine: 1\ntitle:"),
      "s.yaml:3:1: engine: is not a key here (there are: slipcheck, name, title, source, "
      "units, gravity, materials, contacts, substrate, container, surfaces, bodies, fill, run or "
      "compare)");
}

TEST(Fault, MissingKey) {
  expect_fault(with(kHard, "sphere: {radius: 0.1}", "sphere: {}"),
               "s.yaml:14:40: bodies[0].sphere: needs exactly one of radius or diameter");
  expect_fault(with(kHard, "title: Two hard spheres\n", ""), "s.yaml:1:1: needs the key title");
  expect_fault(with(kHard, "{model: hard, restitution: 0.9}", "{restitution: 0.9}"),
               "s.yaml:8:13: contacts[0].normal: needs the key model: hard, linear, hertz, power "
               "or viscoelastic");
}

TEST(Fault, DuplicateKey) {
  expect_fault(
      with(kHard, "friction: 0.2", "friction: 0.2\n    friction: 0.3"),
      "s.yaml:12:5: contacts[1].friction: must stand here once, but stands in line 11 too");
  expect_fault(
      with(kHard, "steel: {density: 7850}", "steel: {density: 7850}\n  steel: {density: 1}"),
      "s.yaml:6:3: materials.steel: must stand here once");
}

TEST(Fault, WrongType) {
  expect_fault(with(kHard, "radius: 0.1", "radius: [1]"),
               "s.yaml:14:49: bodies[0].sphere.radius: must be a length in m, or with its own unit "
               "as in \"2 mm\", got [1]");
  expect_fault(with(kHard, "radius: 0.1", "radius: big"),
               "s.yaml:14:49: bodies[0].sphere.radius: must be a number, got big");
  expect_fault(with(kHard, "radius: 0.1", "radius:"),
               "s.yaml:14:48: bodies[0].sphere.radius: must be a length in m, or with its own unit "
               "as in \"2 mm\", got nothing");
  expect_fault(with(kHard, "friction: 0.2", "friction: [0.2]"),
               "s.yaml:11:15: contacts[1].friction: must be a number or {static: …, kinetic: …}, "
               "got [0.2]");
  expect_fault(with(kHard, "position: [0, 0]", "position: [0]"),
               "s.yaml:14:65: bodies[0].position: must be a list of 2 or 3 numbers, got [0]");
  expect_fault(with(kHard, "substrate: {}", "substrate: {confined: yes}"),
               "s.yaml:12:23: substrate.confined: must be true or false, got yes");
  expect_fault(with(kHard, "slipcheck: 1", "slipcheck: 2"),
               "s.yaml:1:12: slipcheck: must be 1, got 2");
  expect_fault(with(kHard, "name: hard", "name: Two Spheres"),
               "s.yaml:2:7: name: must be a name of a-z, 0-9 and -, up to 64, got Two Spheres");
  expect_fault(
      "just text",
      "s.yaml:1:1: must be a scene, a mapping that begins with slipcheck: 1, got just text");
}

TEST(Fault, WrongWord) {
  expect_fault(with(kHard, "model: hard", "model: linaer"),
               "s.yaml:8:21: contacts[0].normal.model: must be hard, linear, hertz, power or "
               "viscoelastic (did you mean linear?), got linaer");
  expect_fault(with(kHard, "{model: hard, restitution: 0.9}", "linear"),
               "s.yaml:8:13: contacts[0].normal: must be a mapping with its parameters, {model: "
               "linear, …}, got linear");
  expect_fault(
      with(kHard, "until: rolling", "until: roling"),
      "s.yaml:16:14: run.until: must be rolling or rest (did you mean rolling?), got roling");
}

TEST(Fault, OutOfRange) {
  expect_fault(with(kHard, "radius: 0.1", "radius: -0.1"),
               "s.yaml:14:49: bodies[0].sphere.radius: must be > 0 m, got -0.1");
  expect_fault(with(kHard, "radius: 0.1", "radius: -2 mm"),
               "s.yaml:14:49: bodies[0].sphere.radius: must be > 0 m, got -2 mm");
  expect_fault(with(kHard, "restitution: 0.9", "restitution: 1.1"),
               "s.yaml:8:40: contacts[0].normal.restitution: must be >= 0 and <= 1, got 1.1");
  expect_fault(with(kHard, "substrate: {}", "substrate: {tilt: 90}"),
               "s.yaml:12:19: substrate.tilt: must be >= 0 and < 90 deg, got 90");
  expect_fault(with(kHard, "substrate: {}", "substrate: {tilt: 2 rad}"),
               "s.yaml:12:19: substrate.tilt: must be >= 0 and < 90 deg, got 2 rad");
  expect_fault(with(kHard, "density: 7850", "density: nan"),
               "s.yaml:5:20: materials.steel.density: must be a finite number, got nan");
  expect_fault(with(kHard, "density: 7850", "density: -inf"),
               "s.yaml:5:20: materials.steel.density: must be a finite number, got -inf");
  expect_fault(with(kHard, "density: 7850", "density: .inf"),
               "s.yaml:5:20: materials.steel.density: must be a number, got .inf");
  expect_fault(with(kHard, "density: 7850", "density: 1e400"),
               "s.yaml:5:20: materials.steel.density: must be in the range of double precision, "
               "got 1e400");
  expect_fault(
      with(kHard, "density: 7850", "density: 1e200"),
      "s.yaml:5:20: materials.steel.density: must be 0 or of a magnitude between 1e-30 and "
      "1e30 in SI units, got 1e200");
}

TEST(Fault, WrongUnit) {
  expect_fault(
      with(kHard, "radius: 0.1", "radius: \"2 s\""),
      "s.yaml:14:49: bodies[0].sphere.radius: must be a length, as in \"2 mm\", got \"2 s\"");
  expect_fault(with(kHard, "friction: 0.2", "friction: 5 deg"),
               "s.yaml:11:15: contacts[1].friction: must be a number, as in \"1 %\", got 5 deg");
}

TEST(Fault, ExactlyOneOf) {
  expect_fault(
      with(kExample, "restitution: 0.9, ", "restitution: 0.9, damping_rate: 1, "),
      "s.yaml:13:13: contacts[0].normal: needs exactly one of restitution or damping_rate");
  expect_fault(
      with(kExample, "collision_time: 2.55e-5, ", ""),
      "s.yaml:13:13: contacts[0].normal: needs exactly one of collision_time or stiffness");
  expect_fault(with(kHard, "substrate: {}\n", ""),
               "s.yaml:1:1: needs at least one of substrate, container or surfaces");
}

TEST(Fault, Tolerance) {
  const auto scene = [](const std::string& tolerance) {
    return kHard + "compare: {tolerance: {" + tolerance + "}}\n";
  };
  expect_fault(scene("slidin_time: 1 %"),
               "s.yaml:17:23: compare.tolerance.slidin_time: is not a key here (did you mean "
               "sliding_time?)");
  expect_fault(scene("sliding_time: 1 mm"),
               "s.yaml:17:37: compare.tolerance.sliding_time: must be a number, a share as in \"1 "
               "%\" or a time as in \"3 ms\", got 1 mm");
  expect_fault(scene("sliding_time: -1"),
               "s.yaml:17:37: compare.tolerance.sliding_time: must be >= 0, got -1");
  const auto tolerance =
      parse_scenario(scene("sliding_time: 2 ms, final_velocity.x: 3 %, energy_drift: 1e-3"),
                     "s.yaml")
          .compare.tolerance;
  EXPECT_TRUE(tolerance.at("sliding_time").absolute);
  EXPECT_EQ(tolerance.at("sliding_time").value, 0.002);
  EXPECT_FALSE(tolerance.at("final_velocity.x").absolute);
  EXPECT_EQ(tolerance.at("final_velocity.x").value, 0.03);
  EXPECT_EQ(tolerance.at("energy_drift").value, 0.001);
}

TEST(Fault, ShowsLongAndStrangeValues) {
  expect_fault(
      with(kHard, "radius: 0.1", "radius: " + std::string(500, 'x')),
      "s.yaml:14:49: bodies[0].sphere.radius: must be a number, got " + std::string(60, 'x') + "…");
  expect_fault(with(kHard, "radius: 0.1", R"(radius: "\e[31m\0\x9b\n")"),
               "s.yaml:14:49: bodies[0].sphere.radius: must be a number, got "
               R"("\x1b[31m\x00\x9b\n")");
  expect_fault(with(kHard, "substrate: {}", R"(substrate: {"\e[31m": 1})"),
               R"(s.yaml:12:13: substrate.\x1b[31m: is not a key here (there are: periodic, tilt, )"
               "confined or motion)");
}

TEST(Fault, AllFaultsInOneGo) {
  std::string text = with(kHard, "density: 7850", "density: -1");
  text = with(text, "friction: 0.2", "frictoin: 0.2");
  text = with(text, "restitution: 0.9", "restitution: 2");
  text = with(text, "name: b, material: steel", "name: a, material: steal");
  text = with(text, "velocity: [-1, 0]", "velocity: [-1, x]");
  EXPECT_EQ(messages(text),
            (std::vector<std::string>{
                "s.yaml:5:20: materials.steel.density: must be > 0 kg/m3, got -1",
                "s.yaml:8:40: contacts[0].normal.restitution: must be >= 0 and <= 1, got 2",
                "s.yaml:11:5: contacts[1].frictoin: is not a key here (did you mean friction?)",
                "s.yaml:15:88: bodies[1].velocity[1]: must be a number, got x",
                "s.yaml:15:12: bodies[1].name: must be unique, but is also bodies[0], got a",
                "s.yaml:15:25: bodies[1].material: must be one of the materials (did you mean "
                "steel?), got steal"}));
  const auto all = test::refusal_of<BadScenario>([&] { parse_scenario(text, "s.yaml"); });
  EXPECT_EQ(std::ranges::count(all, '\n'), 5);
}

}  // namespace
}  // namespace slipcheck
