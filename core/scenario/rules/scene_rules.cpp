#include "scenario/rules/scene_rules.h"

#include <utility>

#include "scenario/presets.h"
#include "scenario/record_keys.h"

namespace slipcheck {
namespace {

using nlohmann::json;
using Materials = std::map<std::string, Material>;

Rule<Materials> materials_rule() {
  Record<Material> record;
  record
      .key("density", &Material::density, number(kDensity, kPositive), optional,
           "needed unless each body has a mass")
      .key("young_modulus", &Material::young_modulus, number(kPressure, kPositive), optional,
           "Y, where a model needs it")
      .key("poisson_ratio", &Material::poisson_ratio, number(kPureNumber, {{}, -1, 0.5, {}}),
           optional, "ν, where a model needs it")
      .key("dissipation_time", &Material::dissipation_time, number(kTime, kNotNegative), optional,
           "A of B (23), for the restitution viscoelastic")
      .whole("preset", preset_rule<Material>(PresetPart::material), optional,
             "brings what does not stand here");
  const Rule<Material> material = record.rule();
  const Rule<std::string> name = name_text(NameStyle::any_case);
  return {[=](const YamlNode& node, Reading& reading, Materials& target) {
            if (!is_mapping(node)) {
              reading.fault(node, "must be a mapping {name: {density: …}, …}");
              return false;
            }
            bool good = true;
            for (const YamlNode::Entry& entry : node.entries) {
              YamlNode key;
              key.kind = YamlNode::Kind::scalar;
              key.location = entry.location;
              key.text = entry.key;
              std::string text;
              if (!name.read(key, reading, text)) {
                good = false;
                continue;
              }
              const auto step = reading.key(text, entry.location, *entry.value);
              if (target.contains(text)) {
                reading.fault(entry.location, reading.path(), "must stand here once");
                good = false;
              }
              good = material.read(*entry.value, reading, target[text]) && good;
            }
            return good;
          },
          [=] {
            json names = name.schema();
            names["type"] = "string";
            return json{{"type", "object"},
                        {"propertyNames", names},
                        {"additionalProperties", material.schema()}};
          }};
}

Rule<Motion> motion_rule() {
  Record<ConstantMotion> constant;
  constant.key("velocity", &ConstantMotion::velocity, pair_of(kVelocity, kAnyNumber), required,
               "[x, y]");
  Record<OscillatingMotion> oscillate;
  oscillate
      .key("amplitude", &OscillatingMotion::amplitude, pair_of(kLength, kAnyNumber), required,
           "[x, y]")
      .key("frequency", &OscillatingMotion::frequency, number(kFrequency, kPositive), required,
           "in cycles per second")
      .key("phase", &OscillatingMotion::phase, number(kAngle, kAnyNumber), optional,
           "of the sine at time 0");
  Record<TableMotion> table;
  table.key("table", &TableMotion::table,
            made_from<std::vector<TableMotion::Point>>(
                list(row({{kTime, kAnyNumber}, {kLength, kAnyNumber}, {kLength, kAnyNumber}}), 1),
                [](const std::vector<std::vector<double>>& rows) {
                  std::vector<TableMotion::Point> points;
                  for (const auto& txy : rows) points.push_back({txy[0], Vector2(txy[1], txy[2])});
                  return points;
                }),
            required, "[[time, x, y], …] with rising times, linear in between");
  return one_of<Motion>(
      "kind", {alternative<Motion>("still", "does not move", Record<StillMotion>()),
               alternative<Motion>("constant", "constant velocity", constant),
               alternative<Motion>("oscillate", "amplitude sin(2π frequency t + phase)", oscillate),
               alternative<Motion>("table", "positions at times", table)});
}

}  // namespace

Rule<Substrate> substrate_rule() {
  Record<Substrate> substrate;
  substrate
      .key("periodic", &Substrate::periodic, pair_of(kLength, kPositive), optional,
           "[x, y] lengths of the periodic cell, at least 4 diameters each")
      .key("tilt", &Substrate::tilt, number(kAngle, {0, {}, {}, 90}), optional, "downhill along -y")
      .key("confined", &Substrate::confined, boolean(), optional,
           "true: bodies never leave the plane")
      .key("motion", &Substrate::motion, motion_rule(), optional, "of the plane in itself");
  return substrate.rule();
}

Rule<Container> container_rule() {
  using Walls = Container::Walls;
  Record<Container> floor;
  floor
      .key("amplitude", &Container::floor_amplitude, number(kLength, kNotNegative), required,
           "of z = amplitude sin(2π frequency t)")
      .key("frequency", &Container::floor_frequency, number(kFrequency, kNotNegative), required,
           "in cycles per second");
  Record<Container> container;
  container
      .key("width", &Container::width, number(kLength, kPositive), required,
           "between the walls at x = 0 and x = width")
      .whole("floor", floor.rule(), required, "its vibration")
      .key("walls", &Container::walls,
           choice<Walls>({{"fixed", Walls::fixed}, {"moving", Walls::moving}}), optional,
           "moving: up and down with the floor")
      .key("height", &Container::height, number(kLength, kPositive), optional,
           "of the lid, if there is one");
  return container.rule();
}

Rule<WrittenScene> scene_rule() {
  Record<WrittenScene> scene;
  const auto read_before = [](auto rule) {
    return Rule<WrittenScene>{[rule](const YamlNode& node, Reading& reading, WrittenScene&) {
                                typename std::remove_cvref_t<decltype(rule)>::Value ignored{};
                                return rule.read(node, reading, ignored);
                              },
                              rule.schema};
  };
  scene.whole("slipcheck", read_before(integer(1, 1)), required, "version of the format")
      .key("name", &WrittenScene::name, name_text(NameStyle::lower_case), required,
           "unique among scenarios")
      .key("title", &WrittenScene::title, free_text(), required, "for reports")
      .key("source", &WrittenScene::source, free_text(), optional, "where the scene is from")
      .whole("units", read_before(units_rule()), optional, "of bare numbers")
      .key("gravity", &WrittenScene::gravity, number(kAcceleration, kNotNegative), optional,
           "along -z")
      .key("materials", &WrittenScene::materials, materials_rule(), required, "by name")
      .key("contacts", &WrittenScene::contacts, contacts_rule(), optional,
           "by pair of materials, or material and substrate, floor, wall or lid")
      .key("substrate", &WrittenScene::substrate, substrate_rule(), optional,
           "an infinite plane z = 0 in its own frame")
      .key("container", &WrittenScene::container, container_rule(), optional,
           "a vertical two-dimensional box")
      .key("surfaces", &WrittenScene::surfaces, surfaces_rule(), optional,
           "planes, plates, rods, balls and boxes that stand or move by themselves")
      .key("bodies", &WrittenScene::bodies, bodies_rule(), optional, "the spheres")
      .key("fill", &WrittenScene::fill, fill_rule(), optional, "many spheres in an area")
      .key("run", &WrittenScene::run, run_rule(), required, "how long")
      .key("compare", &WrittenScene::compare, compare_rule(), optional,
           "what is held against the reference")
      .at_least_one_of({"substrate", "container", "surfaces"})
      .at_least_one_of({"bodies", "fill"});
  return scene.rule();
}

Rule<UnitSystem> units_rule() {
  return choice<UnitSystem>({{"si", UnitSystem::si}, {"cgs", UnitSystem::cgs}});
}

}  // namespace slipcheck
