// Blocks and cylinders: what they are made of, and what is refused.

#include <cmath>

#include "scenes.h"

namespace slipcheck {
namespace {

using namespace testing;

const std::string kBlock = R"(slipcheck: 1
name: block
title: A block
materials:
  wood: {density: 700}
contacts:
  - {between: [wood, substrate], friction: {static: 0.5, kinetic: 0.4}}
substrate: {tilt: 20}
bodies:
  - {name: a, material: wood, block: {size: [0.2, 0.1, 0.05]}, position: [0, 0], velocity: [1, 0]}
run: {until: 1}
)";

std::string cylinder(const std::string& rest = "") {
  return with(
      with(kBlock, "block: {size: [0.2, 0.1, 0.05]}", "cylinder: {radius: 0.02, length: 0.1}"),
      ", velocity: [1, 0]", rest);
}

TEST(Solid, ABlockHasTheMassOfItsVolumeAndLiesOnItsFace) {
  const Scenario scene = parse_scenario(kBlock, "s.yaml");
  const Body& block = scene.bodies[0];
  EXPECT_EQ(block.sphere.shape, Shape::block);
  EXPECT_NEAR(block.sphere.mass, 0.7, 1e-15);
  EXPECT_EQ(block.initial.position.z(), 0.025);
  EXPECT_EQ(block.sphere.inverse_shape_factor(), 0);
  // m (x² + y²)/12.
  EXPECT_NEAR(block.sphere.moment_of_inertia(), 0.7 * (0.04 + 0.01) / 12, 1e-17);
}

TEST(Solid, ACylinderLiesAcrossItsWay) {
  const Body down = parse_scenario(cylinder(), "s.yaml").bodies[0];
  EXPECT_NEAR(down.sphere.mass, 700 * M_PI * 4e-4 * 0.1, 1e-15);
  EXPECT_EQ(down.sphere.shape_factor, 0.5);
  EXPECT_NEAR(std::abs(down.extent->axis.x()), 1, 1e-15);
  const Body along =
      parse_scenario(with(cylinder(", velocity: [3, 4]"), "tilt: 20", "tilt: 0"), "s.yaml")
          .bodies[0];
  EXPECT_NEAR(across(along.extent->axis, Vector2(4, -3)), 0, 1e-15);
}

TEST(Solid, IsOfOneShape) {
  expect_fault(with(kBlock, "block:", "sphere: {radius: 1}, block:"),
               "s.yaml:10:5: bodies[0]: needs exactly one of sphere, block or cylinder");
  expect_fault(with(kBlock, "[0.2, 0.1, 0.05]", "[0.2, 0.1]"),
               "s.yaml:10:45: bodies[0].block.size: must be a list of 3 numbers, got [0.2, 0.1]");
}

TEST(Solid, StaysOnThePlaneAlone) {
  expect_fault(with(kBlock, "position: [0, 0]", "position: [0, 0, 0.1]"),
               "s.yaml:10:74: bodies[0].position: must lie on the substrate: only spheres fly, got "
               "[0, 0, 0.1]");
  expect_fault(
      with(with(kBlock, "run:",
                "  - {name: b, material: wood, sphere: {radius: 0.1}, position: [1, 0]}\nrun:"),
           "contacts:",
           "contacts:\n  - {between: [wood, wood], normal: {model: hard, restitution: 1}}"),
      "s.yaml:11:38: bodies[0].block: must be the scene's only body: only spheres collide");
}

TEST(Solid, ABlockNeitherSpinsNorRollsNorTips) {
  expect_fault(with(kBlock, "velocity: [1, 0]", "spin: [0, 0, 1]"),
               "s.yaml:10:88: bodies[0].spin: must be none for a block, which does not turn, got "
               "[0, 0, 1]");
  expect_fault(with(kBlock, "0.4}}", "0.4}, rolling: 0.01}"),
               "s.yaml:7:82: contacts[0].rolling: must be 0 for a block, which does not roll, got "
               "0.01");
  // Sliding with μ_k = 0.4 it stands up to h = l/0.4: 0.25 m across, where it is 0.1 m long.
  EXPECT_NO_THROW(parse_scenario(with(kBlock, "0.05]", "0.2499]"), "s.yaml"));
  expect_fault(with(kBlock, "0.05]", "0.2501]"),
               "s.yaml:10:56: bodies[0].block.size[2]: must be at most 0.25 m: a block on which "
               "friction is 0.4 of the normal force tips where it is higher than 2.5 times its "
               "length along y, got 0.2501");
  // At rest below static friction only tan θ counts: 0.1/tan 20° = 0.2747 m.
  const std::string at_rest = with(kBlock, ", velocity: [1, 0]", "");
  EXPECT_NO_THROW(parse_scenario(with(at_rest, "0.05]", "0.2747]"), "s.yaml"));
  EXPECT_THROW(parse_scenario(with(at_rest, "0.05]", "0.2748]"), "s.yaml"), BadScenario);
}

TEST(Solid, ACylinderDoesNotTurnAboutTheVertical) {
  expect_fault(cylinder(", velocity: [1, 0]"),
               "s.yaml:10:41: bodies[0].cylinder: must move along one line, across its axis: its "
               "velocity, the slope and the substrate's motion have several");
  expect_fault(cylinder(", spin: [0, 0, 3]"),
               "s.yaml:10:94: bodies[0].spin: must be about the axis of the cylinder, which lies "
               "across its way, got [0, 0, 3]");
}

}  // namespace
}  // namespace slipcheck
