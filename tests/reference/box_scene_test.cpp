#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "../scenario/scenes.h"
#include "physics/contact/elastic_pair.h"
#include "scene/contact_scene.h"
#include "scene/impact.h"

// Scenes in a box: its surfaces are flat and do not give way.

namespace slipcheck {
namespace {

using testing::kContainer;
using testing::kHard;
using testing::with;

constexpr double kRadius = 0.0005;
const double kMass = 7850 * 4 / 3.0 * M_PI * std::pow(kRadius, 3);
/// (4/3) E* √R with E* = Y/(2 (1 − ν²)).
const double kHertz = 4.0 / 3 * 2e11 / (2 * 0.91) * std::sqrt(kRadius);

ContactScene scene_of(const std::string& text) {
  return make_contact_scene(parse_scenario(text, "s.yaml"));
}

/// kContainer of steel, with these models on the floor.
std::string on_floor(const std::string& models) {
  const std::string steel = with(kContainer, "{density: 7850}",
                                 "{density: 7850, young_modulus: 2e11, poisson_ratio: 0.3, "
                                 "dissipation_time: 3e-8}");
  return with(steel, "floor], normal: {model: hard, restitution: 0.9}}", "floor], " + models + "}");
}

TEST(BoxScene, HasTheBoxInPlaceOfTheSubstrate) {
  std::string text = with(kContainer, "floor], normal: {model: hard, restitution: 0.9}}",
                          "floor], normal: {model: hard, restitution: 0.8}, tangential: {model: "
                          "hard, friction: 0.3, tangential_restitution: 0.2}}");
  text = with(text, "wall], normal: {model: hard, restitution: 0.9}}",
              "wall], normal: {model: hard, restitution: 0.7}}\n"
              "  - {between: [lid, steel], normal: {model: hard, restitution: 0.6}}");
  text = with(text, "walls: fixed", "walls: moving, height: 2 cm");
  const ContactScene scene = scene_of(text);
  ASSERT_TRUE(scene.hard.box);
  const Box& box = *scene.hard.box;
  EXPECT_EQ(box.width, 0.01);
  EXPECT_EQ(box.floor.amplitude, 0.0005);
  EXPECT_EQ(box.floor.frequency, 100);
  EXPECT_TRUE(box.moving_walls);
  EXPECT_EQ(box.lid, 0.02);
  ASSERT_EQ(scene.hard.substrate.size(), 1u);
  ASSERT_EQ(box.on_floor.size(), 1u);
  ASSERT_EQ(box.on_wall.size(), 1u);
  ASSERT_EQ(box.on_lid.size(), 1u);
  EXPECT_EQ(std::get<double>(scene.hard.between(0, 1).restitution), 0.9);
  EXPECT_EQ(std::get<double>(box.on_floor[0].restitution), 0.8);
  EXPECT_EQ(box.on_floor[0].friction, 0.3);
  EXPECT_EQ(box.on_floor[0].tangential_restitution, 0.2);
  EXPECT_EQ(std::get<double>(box.on_wall[0].restitution), 0.7);
  EXPECT_EQ(box.on_wall[0].friction, 0);
  EXPECT_EQ(std::get<double>(box.on_lid[0].restitution), 0.6);
  EXPECT_EQ(scene.hard.gravity, 9.80665);
  EXPECT_TRUE(scene.hard.downhill.isZero(0));
  EXPECT_TRUE(scene.hard.periodic.isZero(0));
  EXPECT_TRUE(scene.hard.motion.is_still());
  EXPECT_EQ(scene.hard.on_substrate(1).kinetic_friction, 0);
  EXPECT_TRUE(scene.is_hard());
  EXPECT_EQ(scene.soft_box.on_floor.size(), 1u);
  EXPECT_FALSE(scene.soft_box.on_lid[0]);

  const ContactScene open = scene_of(kContainer);
  EXPECT_FALSE(open.hard.box->lid);
  EXPECT_FALSE(open.hard.box->moving_walls);
  EXPECT_TRUE(scene_of(kHard).soft_box.on_floor.empty());
  EXPECT_FALSE(scene_of(kHard).hard.box);
}

TEST(BoxScene, LinearFloorActsOnTheWholeMass) {
  const ContactScene scene =
      scene_of(on_floor("normal: {model: linear, restitution: 0.8, collision_time: 1e-5}, "
                        "tangential: {model: viscous, damping_rate: 2e4, friction: 0.4}"));
  EXPECT_FALSE(scene.is_hard());
  EXPECT_FALSE(scene.between(0, 1));
  EXPECT_FALSE(scene.soft_box.on_wall[0]);
  const SoftContact& soft = scene.soft_box.on_floor[0].value();
  // m ẍ = −k x − c ẋ: e = exp(−c t/(2m)) and t = π/√(k/m − c²/(4m²)).
  const auto force = std::get<LinearForce>(soft.normal);
  const double loss = -std::log(0.8);
  EXPECT_NEAR(force.damping / (kMass * 2 * loss / 1e-5), 1, 1e-13);
  EXPECT_NEAR(force.stiffness / (kMass * (M_PI * M_PI + loss * loss) * 1e10), 1, 1e-13);
  EXPECT_NEAR(std::get<ViscousForce>(soft.tangential).damping / (2e4 * kMass), 1, 1e-13);
  const PairContact& hard = scene.hard.box->on_floor[0];
  EXPECT_NEAR(std::get<double>(hard.restitution), 0.8, 1e-13);
  EXPECT_EQ(hard.friction, 0.4);
  // m u̇ = −γ m (1 + 1/q) u for 1e-5 s, q = 2/5.
  EXPECT_NEAR(hard.tangential_restitution, -std::exp(-2e4 * 3.5 * 1e-5), 1e-12);
}

TEST(BoxScene, HertzFloorIsTwiceAsStiffAsAPair) {
  const ContactScene scene = scene_of(on_floor("normal: hertz"));
  const auto force = std::get<HertzForce>(scene.soft_box.on_floor[0].value().normal);
  EXPECT_NEAR(force.modulus / kHertz, 1, 1e-14);
  EXPECT_EQ(std::get<double>(scene.hard.box->on_floor[0].restitution), 1);
}

TEST(BoxScene, ViscoelasticFloorsSoftAndHard) {
  const ContactScene soft =
      scene_of(on_floor("normal: {model: viscoelastic, dissipation_time: 3e-8}"));
  const ContactScene hard = scene_of(on_floor("normal: {model: hard, restitution: viscoelastic}"));
  EXPECT_TRUE(hard.is_hard());
  for (const double v : {0.01, 0.3, 1.0, 3.0}) {
    const double e =
        impact(ViscoelasticForce{kHertz, 3e-8}, kMass, v, ContactEnd::zero_overlap).restitution;
    EXPECT_NEAR(restitution_at(soft.hard.box->on_floor[0].restitution, v), e, 1e-6);
    EXPECT_NEAR(restitution_at(hard.hard.box->on_floor[0].restitution, v), e, 1e-6);
  }
}

TEST(BoxScene, RestitutionAtASpeedHoldsOnAWall) {
  const ContactScene scene =
      scene_of(with(on_floor("normal: hertz"), "wall], normal: {model: hard, restitution: 0.9}",
                    "wall], normal: {model: viscoelastic, restitution: 0.7, at_speed: 20 cm/s}"));
  const SoftContact& soft = scene.soft_box.on_wall[0].value();
  EXPECT_NEAR(impact(soft.normal, kMass, 0.2, soft.end).restitution, 0.7, 1e-9);
}

TEST(BoxScene, SurfacesDivideMaterialsByWhatTheyDependOn) {
  const auto two_sizes = [](const std::string& text) {
    return scene_of(with(text, "name: b, material: steel, sphere: {radius: \"0.5 mm\"}",
                         "name: b, material: steel, sphere: {radius: \"0.25 mm\"}"));
  };
  EXPECT_EQ(two_sizes(kContainer).hard.box->on_floor.size(), 1u);
  const ContactScene scene = two_sizes(on_floor("normal: hertz"));
  ASSERT_EQ(scene.hard.substrate.size(), 2u);
  ASSERT_EQ(scene.soft_box.on_floor.size(), 2u);
  EXPECT_EQ(scene.hard.box->on_wall.size(), 2u);
  const auto modulus = [&](std::size_t i) {
    return std::get<HertzForce>(scene.soft_box.on_floor[i]->normal).modulus;
  };
  EXPECT_NEAR(modulus(0) / modulus(1), std::sqrt(2), 1e-14);
}

TEST(BoxScene, WarnsOfFastFloors) {
  // V = 2π 100 Hz 0.1 m = 62.83 m/s against a body at (0.1, 0.2) m/s; transversal sound takes
  // 3130 m/s.
  const std::string fast =
      with(on_floor("normal: hertz"), "\"0.5 mm\", frequency", "0.1, frequency");
  EXPECT_EQ(scene_of(fast).warnings,
            std::vector<std::string>{
                "s.yaml:8:39: contacts[1].normal.model: impacts at up to 63 m/s are 0.02 of the "
                "transversal speed of sound; the law holds where the square of that is far below 1 "
                "(B B11)"});
  EXPECT_TRUE(scene_of(on_floor("normal: hertz")).warnings.empty());
}

TEST(BoxScene, CollapseRules) {
  const auto rule = [](const std::string& model) {
    return scene_of(with(kContainer, "discard: 500", "collapse: " + model)).hard.collapse;
  };
  using Model = CollapseRule::Model;
  EXPECT_EQ(scene_of(kContainer).hard.collapse.model, Model::slowest_rebound);
  EXPECT_EQ(rule("slowest_rebound").model, Model::slowest_rebound);
  EXPECT_EQ(rule("{model: contact_time, contact_time: 1 us}").model, Model::contact_time);
  EXPECT_EQ(rule("{model: contact_time, contact_time: 1 us}").contact_time, 1e-6);
  EXPECT_EQ(rule("{model: largest_velocity, contact_time: 2}").model, Model::largest_velocity);
  EXPECT_EQ(rule("{model: largest_velocity, contact_time: 2}").contact_time, 2);
}

TEST(BoxScene, BundledScenesOfManyBodiesAreMade) {
  const auto made = [](const std::string& name) {
    return make_contact_scene(load_scenario(SLIPCHECK_SOURCE_DIR "/scenarios/" + name + ".yaml"));
  };
  for (const std::string name : {"elastic-walls", "dissipative-walls", "rough-moving-walls",
                                 "polydisperse", "viscoelastic", "collapse-tc"}) {
    const ContactScene scene = made("box-" + name);
    EXPECT_EQ(scene.hard.bodies.size(), 50u) << name;
    EXPECT_EQ(scene.hard.box->width, 0.01);
    EXPECT_NEAR(scene.hard.box->floor.largest_speed(), name == "collapse-tc" ? 0.3 : 1, 1e-4);
    EXPECT_TRUE(scene.is_hard() && scene.warnings.empty()) << name;
    EXPECT_EQ(scene.hard.substrate.size(), 1u) << name;
  }
  EXPECT_TRUE(made("box-one-ball").hard.box->floor.is_still());
  // "0.9 or so at 1 m/s".
  const Scene viscoelastic = made("box-viscoelastic").hard;
  EXPECT_NEAR(restitution_at(viscoelastic.between(0, 1).restitution, 1), 0.9, 0.02);
  EXPECT_NEAR(restitution_at(viscoelastic.box->on_floor[0].restitution, 1), 0.9, 0.02);
  for (const char* name : {"gas-rolling", "gas-oscillating"}) {
    const Scene gas = made(name).hard;
    EXPECT_EQ(gas.bodies.size(), 200u);
    EXPECT_EQ(gas.periodic, Vector2(0.16, 0.16));
    // "0.098 of the cell".
    EXPECT_NEAR(200 * M_PI * 4e-6 / (0.16 * 0.16), 0.098, 5e-4);
  }
}

}  // namespace
}  // namespace slipcheck
