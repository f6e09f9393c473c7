#include "scenario/surfaces.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace slipcheck::testing {
namespace {

const std::string kSlope = R"(slipcheck: 1
name: slope
title: A ball on a slope
materials:
  steel: {density: 7850}
  wood: {}
contacts:
  - {between: [wood, steel], friction: {static: 0.3, kinetic: 0.2}, rolling: 0.01, restitution: 0.5}
surfaces:
  - {name: slope, material: wood, rectangle: {from: [0, 0, 3], to: [4, 0, 0], width: 2}}
  - {name: end, material: wood, plane: {point: [9, 0, 0], normal: [-2, 0, 0]}}
bodies:
  - {name: a, material: steel, sphere: {radius: 0.1}, on: slope, position: [1, 0, 2.3]}
run: {until: 1}
)";

TEST(Surfaces, AreReadAsTheyStand) {
  const Scenario scene = parse_scenario(
      with(kSlope, "steel: {density: 7850}\n", "steel: {density: 7850}\n"), "s.yaml");
  ASSERT_EQ(scene.surfaces.size(), 2u);
  EXPECT_FALSE(std::get<Substrate>(scene.surroundings).is_there);
  const auto& plate = std::get<RectangleShape>(scene.surfaces[0].shape);
  EXPECT_EQ(plate.centre, Vector3(2, 0, 1.5));
  EXPECT_EQ(plate.half_length, Vector3(2, 0, -1.5));
  EXPECT_NEAR((plate.half_width - Vector3(0, 1, 0)).norm(), 0, 1e-15);
  EXPECT_EQ(std::get<PlaneShape>(scene.surfaces[1].shape).normal, Vector3(-1, 0, 0));
  ASSERT_EQ(scene.surface_contacts.size(), 1u);
  EXPECT_EQ(scene.surface_contacts[0].material, "steel");
  EXPECT_EQ(scene.surface_contacts[0].surface, "wood");
  EXPECT_EQ(scene.surface_contacts[0].friction.static_, 0.3);
  // On the slope of 3 in 4, whose normal is (0.6, 0, 0.8).
  const Vector3 place(1, 0, 2.3), normal(0.6, 0, 0.8);
  const double above = normal.dot(place - Vector3(0, 0, 3));
  EXPECT_NEAR((scene.bodies[0].initial.position - (place + (0.1 - above) * normal)).norm(), 0,
              1e-15);
}

TEST(Surfaces, BoxIsAPlateForEachClosedSide) {
  const Scenario scene =
      parse_scenario(with(kSlope, "plane: {point: [9, 0, 0], normal: [-2, 0, 0]}",
                          "box: {from: [10, 0, 0], to: [11, 2, 3], open: [top, left]}"),
                     "s.yaml");
  ASSERT_EQ(scene.surfaces.size(), 5u);
  EXPECT_EQ(scene.surfaces[1].name, "end-right");
  const auto& right = std::get<RectangleShape>(scene.surfaces[1].shape);
  EXPECT_EQ(right.centre, Vector3(11, 1, 1.5));
  EXPECT_NEAR(std::abs(right.normal().x()), 1, 0);
  EXPECT_EQ(scene.surfaces[4].name, "end-bottom");
}

TEST(Surfaces, RollingIsOnTheSurfaceThatIsTouched) {
  const Scenario scene =
      parse_scenario(with(kSlope, "position: [1, 0, 2.3]",
                          "position: [1, 0, 2.3], velocity: [0.8, 0, -0.6], spin: rolling"),
                     "s.yaml");
  // n × v/R = (0.6, 0, 0.8) × (0.8, 0, −0.6)/0.1 = (0, 10, 0)
  EXPECT_NEAR((scene.bodies[0].initial.angular_velocity - Vector3(0, 10, 0)).norm(), 0, 1e-12);
}

TEST(Surfaces, FaultsAreNamed) {
  const auto fault_of = [](std::string_view from, std::string_view to) {
    const std::vector<std::string> found = messages(with(kSlope, from, to));
    return found.size() == 1 ? found.front() : "not one: " + std::to_string(found.size());
  };
  EXPECT_EQ(fault_of("to: [4, 0, 0]", "to: [0, 0, 0]"),
            "s.yaml:10:46: surfaces[0].rectangle: must have across in place of width, as it leads "
            "straight up, got {from: [0, 0, 3], to: [0, 0, 0], width: 2}");
  EXPECT_EQ(fault_of("width: 2", "across: [1, 0, 0]"),
            "s.yaml:10:46: surfaces[0].rectangle: must have across at right angles to the way from "
            "from to to, got {from: [0, 0, 3], to: [4, 0, 0], across: [1, 0, 0]}");
  EXPECT_EQ(fault_of("normal: [-2, 0, 0]", "normal: [0, 0, 0]"),
            "s.yaml:11:67: surfaces[1].plane.normal: must not be zero, got [0, 0, 0]");
  EXPECT_EQ(
      fault_of("on: slope", "on: slop"),
      "s.yaml:13:59: bodies[0].on: must be one of the surfaces (did you mean slope?), got slop");
  EXPECT_EQ(fault_of("name: end", "name: a"),
            "s.yaml:13:12: bodies[0].name: must be unique, but is also surfaces[1], got a");
  EXPECT_EQ(fault_of("between: [wood, steel]", "between: [steel, steel]"),
            "s.yaml:8:15: contacts[0].between: must have normal and tangential, as none of the two "
            "is of a surface, got [steel, steel]");
  EXPECT_EQ(fault_of("normal: [-2, 0, 0]}",
                     "normal: [-2, 0, 0]}, motion: {kind: belt, velocity: [1, 0, 1]}"),
            "s.yaml:11:111: surfaces[1].motion.velocity: must be along the surface of a belt, got "
            "[1, 0, 1]");
  EXPECT_EQ(fault_of("on: slope, position: [1, 0, 2.3]", "position: [9.05, 0, 1]"),
            "s.yaml:13:65: bodies[0].position: must be at least the radius away from end, but is "
            "0.15 m in it, got [9.05, 0, 1]");
  EXPECT_EQ(fault_of("on: slope, position: [1, 0, 2.3]", "position: [1, 0]"),
            "s.yaml:13:65: bodies[0].position: must be [x, y, z] without a substrate, got [1, 0]");
  EXPECT_EQ(fault_of("run: {until: 1}",
                     "container: {width: 1, floor: {amplitude: 0, frequency: 0}}\nrun: {until: 1}")
                .substr(0, 7),
            "not one");
}

TEST(Surfaces, EveryMaterialThatCanComeThereNeedsAContact) {
  const std::vector<std::string> found =
      messages(with(kSlope, "name: end, material: wood", "name: end, material: steel"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0],
            "s.yaml:8:3: contacts: needs a contact between steel and steel, which can meet");
}

TEST(Surfaces, AVolumeIsFilledBesideThem) {
  const std::string pairs =
      with(kSlope, "surfaces:\n",
           "  - {between: [steel, steel], normal: {model: hard, restitution: 0.5}}\nsurfaces:\n");
  const std::string filled = with(
      pairs,
      "  - {name: a, material: steel, sphere: {radius: 0.1}, on: slope, position: [1, 0, 2.3]}\n",
      "  - fill: {prefix: g, count: 60, material: steel, radius: 0.1, volume: [0, -1, 0, 4, 1, 3], "
      "speed: 2, seed: 3}\n");
  const Scenario scene = parse_scenario(filled, "s.yaml");
  ASSERT_EQ(scene.bodies.size(), 60u);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Vector3& at = scene.bodies[i].initial.position;
    EXPECT_NEAR(scene.bodies[i].initial.velocity.norm(), 2, 1e-12);
    for (const NamedSurface& surface : scene.surfaces)
      EXPECT_GE(made_surface(surface).nearest(0, at).distance, 0.1);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE((at - scene.bodies[j].initial.position).norm(), 0.2);
  }
  EXPECT_EQ(messages(with(filled, "seed: 3", "arrange: lattice")).front(),
            "s.yaml:14:112: bodies[0].fill.arrange: must be random in a volume, got lattice");
  EXPECT_EQ(
      messages(with(filled, "volume: [0, -1, 0, 4, 1, 3]", "area: [0, 0, 1, 1]")).front(),
      "s.yaml:14:70: bodies[0].fill.area: must be volume without a substrate, got [0, 0, 1, 1]");
}

TEST(Surfaces, HeightOverAPlaneIsThatOfTheHighestPlace) {
  const PlaneShape up;
  EXPECT_NEAR(highest_over(up, RodShape{Vector3(0, 0, 1), Vector3(3, 0, 5), 2}), 5 + 2 * 0.6,
              1e-15);
  EXPECT_NEAR(
      highest_over(up, RectangleShape{Vector3(0, 0, 1), Vector3(1, 0, 1), Vector3(0, 1, 0)}), 2, 0);
  EXPECT_EQ(highest_over(up, PlaneShape{Vector3(0, 0, -1), kUp}), -1);
  EXPECT_GT(highest_over(up, PlaneShape{Vector3(0, 0, -1), Vector3::UnitX()}), 1e300);
}

}  // namespace
}  // namespace slipcheck::testing
