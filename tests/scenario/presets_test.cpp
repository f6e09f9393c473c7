// Values with sources, and what a scene takes of them.

#include <algorithm>

#include "scenario/file_text.h"
#include "scenario/preset_data.h"
#include "scenes.h"

namespace slipcheck {
namespace {

using namespace testing;

const std::string kPool = R"(slipcheck: 1
name: pool
title: Two pool balls
materials:
  ball: {}
contacts:
  - {between: [ball, ball], preset: pool-ball}
  - {between: [ball, substrate], preset: pool-cloth}
substrate: {}
bodies:
  - {name: a, material: ball, sphere: {preset: pool-ball}, position: [0, 0]}
  - {name: b, material: ball, sphere: {preset: pool-ball}, position: [1, 0], velocity: [-1, 0]}
run: {until: rolling}
)";

const HardTangential& rubbing(const Scenario& scene) {
  return std::get<HardTangential>(scene.contacts[0].tangential);
}

const UsedPreset* used(const Scenario& scene, const std::string& path) {
  const auto found = std::ranges::find(scene.presets, path, &UsedPreset::path);
  return found == scene.presets.end() ? nullptr : &*found;
}

TEST(Presets, EveryValueOfEveryOneHasASource) {
  EXPECT_GT(presets().size(), 15u);
  for (const Preset& preset : presets()) {
    EXPECT_FALSE(preset.about.empty()) << preset.name;
    EXPECT_FALSE(preset.parts.empty()) << preset.name;
    for (const auto& [part, node] : preset.parts) {
      const std::vector<PresetValue> values = preset_values(*node);
      EXPECT_FALSE(values.empty()) << preset.name;
      for (const PresetValue& value : values)
        EXPECT_NE(preset.source_of(std::string(name_of(part)) + '.' + value.key), "")
            << preset.name << ' ' << value.key;
    }
  }
}

TEST(Presets, EveryValueIsInTheDocument) {
  const std::string document = read_file(SLIPCHECK_SOURCE_DIR "/docs/presets.md");
  for (const Preset& preset : presets())
    for (const auto& [part, node] : preset.parts)
      for (const PresetValue& value : preset_values(*node)) {
        const std::string row = "| `" + preset.name + "` | " + name_of(part) + " | `" + value.key +
                                ": " + value.value + "` |";
        EXPECT_NE(document.find(row), std::string::npos) << row;
      }
}

TEST(Presets, EveryOneStandsInAScene) {
  const std::string scene = R"(slipcheck: 1
name: one
title: One
materials:
  m: {density: 1000MATERIAL}
contacts:
  - {between: [m, m]CONTACT}
  - {between: [m, substrate], friction: 0.5SUBSTRATE}
substrate: {}
bodies:
  - {name: a, material: m, sphere: {SPHERE}, position: [0, 0]CUE}
run: {until: rolling}
)";
  for (const Preset& preset : presets()) {
    const auto named = [&](PresetPart part, const std::string& otherwise) {
      return preset.parts.contains(part) ? "preset: " + preset.name : otherwise;
    };
    const auto after = [](const std::string& text) { return text.empty() ? "" : ", " + text; };
    std::string text = scene;
    text = with(text, "MATERIAL", after(named(PresetPart::material, "")));
    text = with(text, "CONTACT",
                after(named(PresetPart::contact, "normal: {model: hard, restitution: 1}")));
    if (preset.parts.contains(PresetPart::substrate) && preset.name != "golf-green")
      text = with(text, ", friction: 0.5", "");
    text = with(text, "SUBSTRATE", after(named(PresetPart::substrate, "")));
    text = with(text, "SPHERE", named(PresetPart::sphere, "radius: 0.1"));
    const bool has_cue = preset.parts.contains(PresetPart::cue);
    text = with(text, "CUE", has_cue ? ", cue: {preset: pool-cue, speed: 1, mass: 0.5}" : "");
    EXPECT_FALSE(parse_scenario(text, "s.yaml").presets.empty()) << preset.name;
  }
}

TEST(Presets, BringWhatDoesNotStandInTheScene) {
  const Scenario scene = parse_scenario(kPool, "s.yaml");
  EXPECT_DOUBLE_EQ(scene.bodies[0].sphere.radius, 0.028575);
  EXPECT_DOUBLE_EQ(scene.bodies[1].sphere.mass, 0.17);
  EXPECT_EQ(std::get<double>(std::get<HardNormal>(scene.contacts[0].normal).restitution), 0.95);
  EXPECT_NEAR(friction_at(rubbing(scene).friction, 0.5), 0.07264, 1e-5);  // by hand
  EXPECT_EQ(scene.substrate_contacts[0].friction.kinetic, 0.2);
  EXPECT_EQ(scene.substrate_contacts[0].rolling.table[0].second, 0.01);
  const UsedPreset* rolling = used(scene, "contacts[1].rolling");
  ASSERT_TRUE(rolling);
  EXPECT_EQ(rolling->preset, "pool-cloth");
  EXPECT_EQ(rolling->value, "0.01");
  EXPECT_NE(rolling->source.find("0.005 to 0.015"), std::string::npos);
  EXPECT_TRUE(used(scene, "bodies[0].mass"));
}

TEST(Presets, WhatStandsInTheSceneCounts) {
  const std::string text =
      with(with(with(kPool, "preset: pool-cloth", "preset: pool-cloth, rolling: 0.02"),
                "ball, ball], preset: pool-ball",
                "ball, ball], preset: pool-ball, normal: {restitution: 0.9}"),
           "sphere: {preset: pool-ball}, position: [0, 0]",
           "mass: 0.2, sphere: {preset: pool-ball, radius: 0.03}, position: [0, 0]");
  const Scenario scene = parse_scenario(text, "s.yaml");
  EXPECT_EQ(scene.substrate_contacts[0].rolling.table[0].second, 0.02);
  EXPECT_EQ(scene.substrate_contacts[0].friction.kinetic, 0.2);
  EXPECT_EQ(std::get<double>(std::get<HardNormal>(scene.contacts[0].normal).restitution), 0.9);
  EXPECT_NEAR(friction_at(rubbing(scene).friction, 0), 0.117951, 1e-12);
  EXPECT_EQ(scene.bodies[0].sphere.radius, 0.03);
  EXPECT_EQ(scene.bodies[0].sphere.mass, 0.2);
  EXPECT_EQ(scene.bodies[1].sphere.mass, 0.17);
  for (const char* path : {"contacts[1].rolling", "contacts[0].normal.restitution",
                           "bodies[0].mass", "bodies[0].sphere.diameter"})
    EXPECT_FALSE(used(scene, path)) << path;
}

TEST(Presets, AModelOfOnesOwnTakesNothingOfThePresets) {
  const Scenario scene = parse_scenario(
      with(kPool, "ball, ball], preset: pool-ball",
           "ball, ball], preset: pool-ball, normal: {model: linear, restitution: 0.9, "
           "collision_time: 1e-3}, tangential: {model: none}"),
      "s.yaml");
  EXPECT_TRUE(std::holds_alternative<LinearNormal>(scene.contacts[0].normal));
  EXPECT_TRUE(std::holds_alternative<NoTangential>(scene.contacts[0].tangential));
}

TEST(Presets, ValuesCarryTheirUnitsIntoAnyFile) {
  const Scenario scene = parse_scenario(
      with(with(kPool, "title: Two", "units: cgs\ntitle: Two"), "[1, 0]", "[100, 0]"), "s.yaml");
  EXPECT_DOUBLE_EQ(scene.bodies[0].sphere.radius, 0.028575);
  EXPECT_NEAR(friction_at(rubbing(scene).friction, 0.5), 0.07264, 1e-5);
}

TEST(Presets, AnUnknownNameIsToldWithThoseOfThePlace) {
  expect_fault(with(kPool, "preset: pool-cloth", "preset: pool-cloht"),
               "s.yaml:8:42: contacts[1].preset: must be pool-cloth, snooker-cloth, golf-green, "
               "steel-on-steel, oiled-steel-on-steel, steel-on-ice, ice-on-ice, "
               "rubber-on-concrete, rubber-on-wet-concrete, wood-on-wood, metal-on-wood or "
               "glass-on-glass (did you mean pool-cloth?), got pool-cloht");
  expect_fault(
      with(kPool, "sphere: {preset: pool-ball}, position: [0, 0]",
           "sphere: {preset: pool-cloth}, position: [0, 0]"),
      "s.yaml:11:48: bodies[0].sphere.preset: must be pool-ball, snooker-ball, carom-ball, "
      "golf-ball or bowling-ball, got pool-cloth");
}

TEST(Presets, AFaultOfTheirValuesIsAtTheirName) {
  // Rolling friction of a green needs the static friction that the preset does not have.
  expect_fault(with(kPool, "preset: pool-cloth", "preset: golf-green"),
               "s.yaml:8:42: contacts[1].rolling: must be at most the static friction 0, or the "
               "body would slide and not roll (K 17), got 0.0637");
}

}  // namespace
}  // namespace slipcheck
