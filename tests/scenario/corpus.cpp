// Prints valid scenes, each changed in one place in many ways, with the loader's verdict on each:
// one JSON object {"scene": …, "accepted": …, "why": …} a line, for schema_agreement.py.
// usage: scenario_corpus [EVERY]: only each so many-th.

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenario/file_text.h"
#include "scenario/reading.h"
#include "scenario/rules/scene_rules.h"
#include "scenario/yaml_tree.h"
#include "scenes.h"
#include "studies/sweep/scene_path.h"
#include "studies/sweep/sweep_block.h"

namespace slipcheck {
namespace {

using nlohmann::json;

/// A scene that has what the others lack.
const std::string kRest = R"({slipcheck: 1, name: rest, title: 1, gravity: 0, units: si,
materials: {m: {density: 1 g/cm3, young_modulus: 1, poisson_ratio: 0.1, dissipation_time: 1}},
contacts: [
  {between: [m, m], normal: {model: hard, restitution: {bridges: {coefficient: 1, exponent: 1, speed: 1}}}, tangential: none},
  {between: [m, m], normal: {model: linear, damping_rate: 1, stiffness: 1}, tangential: {model: viscous, damping_rate: 1, friction: 1}},
  {between: [m, m], normal: hertz, tangential: {model: asperity, friction: 1, asperity_size: {relative: 1}, form: passive}},
  {between: [m, m], normal: {model: power, modulus: 1, viscosity: 1, alpha: 1, gamma: 1, ends_at: zero_force}},
  {between: [m, m], normal: {model: power, modulus: 1, restitution: 1, at_speed: 1}},
  {between: [m, m], normal: {model: viscoelastic, restitution: 0.5, at_speed: 1}},
  {between: [m, m], normal: {model: viscoelastic, viscosity: [1, 1], form: compact}, tangential: {model: asperity, roughness_factor: 1, asperity_size: 1}},
  {between: [m, substrate], rolling: {coefficient: [[1, 1]], while_sliding: true}, drilling: {model: coupled, contact_radius: hertz}}],
substrate: {periodic: [1, 1], motion: {kind: table, table: [[0, 0, 0]]}},
bodies: [{name: a, material: m, sphere: {radius: 1, inertia: shell}, mass: 1, position: [1, 2, 3], velocity: [1, 2, 3], spin: [1, 2, 3]},
  {fill: {prefix: g, count: 1, material: m, radius: {uniform: [1, 2]}, area: [0, 0, 1, 1], speed: 1, seed: 1, spin: rolling, inertia: 0.4}}],
fill: {prefix: h, count: 1, material: m, radius: 1, area: [0, 0, 1, 1], arrange: lattice},
run: {until: 3 s, limit: 4, discard: auto, most_events: 1, collapse: {model: contact_time, contact_time: 1}}, compare: {reference: steps, steps_per_contact: 50, engines: [{engine: e, rate: 1, expect: {a-substrate.restitution: {min: [1, 2], max: [1, 2]}, a.sliding_time: {median: [1 s, 2]}, g1.final_velocity.x: none, all.height: {max: [1, 2]}}},
  {engine: e, rate: 1, expect: {status: crashed}}], tolerance: {final_velocity.x: 1 mm/s}}})";

/// All that a block of a sweep may say, below the least of a scene.
const std::string kSweep = R"({slipcheck: 1, name: s, title: S, gravity: 1,
materials: {m: {density: 1}}, contacts: [{between: [m, substrate], friction: 1}], substrate: {},
bodies: [{name: a, material: m, sphere: {radius: 1}, position: [0, 0]}], run: {until: rolling, limit: 1},
sweep: {
  grid: {engine: bullet, rate: {from: 60, to: 240, count: 3, scale: logarithmic, whole: true}, gravity: [1, 2 m/s2],
         phases: 4, settings.split_impulse: true, bodies.a.velocity: [[0, 1], [1, 2]]},
  list: [{materials.m.density: 1, profile: default}, {materials.m.density: 2, profile: physical}],
  latin_hypercube: {points: 4, seed: 2, ranges: {scale: [0.1, 10], settings.erp: {from: 0.1, to: 0.2}}},
  sobol: {points: 4, ranges: {run.limit: [1 s, 2 s]}}}})";

/// A plain scalar as YAML 1.2 reads it.
json scalar(const YamlNode& node) {
  if (!node.plain) return node.text;
  if (node.text == "true" || node.text == "false") return node.text == "true";
  try {
    const double value = parse_number(node.text);
    return value == static_cast<double>(static_cast<std::int64_t>(value))
               ? json(static_cast<std::int64_t>(value))
               : json(value);
  } catch (const BadQuantity&) {
    return node.text;
  }
}

json to_json(const YamlNode& node) {
  if (is_scalar(node)) return scalar(node);
  if (is_list(node)) {
    json list = json::array();
    for (const YamlPointer& item : node.items) list.push_back(to_json(*item));
    return list;
  }
  if (is_mapping(node)) {
    json mapping = json::object();
    for (const YamlNode::Entry& entry : node.entries) mapping[entry.key] = to_json(*entry.value);
    return mapping;
  }
  return nullptr;
}

YamlPointer to_yaml(const json& value) {
  auto node = std::make_shared<YamlNode>();
  if (value.is_object()) {
    node->kind = YamlNode::Kind::mapping;
    for (const auto& [key, each] : value.items()) node->entries.push_back({key, {}, to_yaml(each)});
  } else if (value.is_array()) {
    node->kind = YamlNode::Kind::list;
    for (const json& each : value) node->items.push_back(to_yaml(each));
  } else if (!value.is_null()) {
    node->kind = YamlNode::Kind::scalar;
    node->plain = !value.is_string();
    node->text = value.is_string() ? value.get<std::string>() : value.dump();
  }
  return node;
}

/// Of the scenes, only each so many-th is judged.
std::size_t g_every = 1;

/// The loader's verdict by the table of keys alone: rules over several keys no schema can say.
void judge(const json& scene) {
  static std::size_t number = 0;
  if (number++ % g_every != 0) return;
  Reading reading("scene", UnitSystem::si);
  YamlPointer root = to_yaml(scene);
  if (is_mapping(*root))
    if (const YamlNode* block = root->find("sweep")) {
      const auto step = reading.key("sweep", block->location, *block);
      SweepBlock sweep;
      sweep_rule().read(*block, reading, sweep);
      root = without_key(root, "sweep");
    }
  WrittenScene written;
  scene_rule().read(*root, reading, written);
  const bool accepted = reading.faults().empty();
  std::cout << json{{"scene", scene},
                    {"accepted", accepted},
                    {"why", accepted ? "" : reading.faults()[0].message()}}
                   .dump()
            << '\n';
}

/// Puts each other value in the place of `here`, which is part of `scene`, and of all in it.
void change_everywhere(json& scene, json& here) {
  const json original = here;
  const json others[] = {nullptr,
                         true,
                         -1,
                         0,
                         0.5,
                         5,
                         "",
                         "other",
                         "-1",
                         "5",
                         json::array(),
                         {1, 2, 3},
                         {1, 2},
                         {{1, 2, 3}},
                         json::object(),
                         {{"other", 1}}};
  for (const json& other : others) {
    if (other == original) continue;
    here = other;
    judge(scene);
    here = original;
  }
  if (here.is_object()) {
    here["other"] = 1;
    judge(scene);
    here = original;
    for (const auto& [key, value] : original.items()) {
      here.erase(key);
      judge(scene);
      here = original;
    }
  }
  if (here.is_structured()) {
    for (json& part : here) change_everywhere(scene, part);
  }
}

json read(const std::string& text) { return to_json(*parse_yaml(text, "scene")); }

}  // namespace
}  // namespace slipcheck

int main(int argc, char** argv) {
  using namespace slipcheck;
  if (argc > 1) g_every = std::stoul(argv[1]);
  for (const std::string& text : {slipcheck::testing::kExample, slipcheck::testing::kHard,
                                  slipcheck::testing::kContainer, kRest, kSweep}) {
    json scene = read(text);
    judge(scene);
    change_everywhere(scene, scene);
  }
  for (const auto& entry : std::filesystem::directory_iterator(SLIPCHECK_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    judge(read(std::string(checked_text(read_file(entry.path()), entry.path().string()))));
  }
}
