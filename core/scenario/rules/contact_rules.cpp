#include <algorithm>

#include "scenario/presets.h"
#include "scenario/record_keys.h"
#include "scenario/rules/contact_parts.h"
#include "scenario/rules/scene_rules.h"

namespace slipcheck {
namespace {

using nlohmann::json;

Rule<WrittenContact> contact_rule() {
  const auto between = list(name_text(NameStyle::any_case), 2, 2);
  const auto part = [](auto WrittenContact::*side, auto field, auto rule) {
    return Rule<WrittenContact>{
        [=](const YamlNode& node, Reading& reading, WrittenContact& target) {
          return rule.read(node, reading, (target.*side).*field);
        },
        rule.schema};
  };
  Record<WrittenContact> body;
  body.key("between", &WrittenContact::between, between, required, "two materials")
      .whole("normal", part(&WrittenContact::body, &BodyContact::normal, normal_rule()), or_preset,
             "force along the line of centres")
      .whole("tangential", part(&WrittenContact::body, &BodyContact::tangential, tangential_rule()),
             optional, "force across it")
      .whole("rolling",
             part(&WrittenContact::body, &BodyContact::rolling, rolling_resistance_rule()),
             optional, "torque against rolling on each other")
      .whole("preset", preset_rule<WrittenContact>(PresetPart::contact), optional,
             "brings what does not stand here");

  constexpr auto kSide = &WrittenContact::substrate;
  Record<WrittenContact> substrate;
  substrate
      .key("between", &WrittenContact::between, between, required,
           "a material and the substrate, or that of a surface")
      .whole("friction", part(kSide, &MaterialOnSubstrate::friction, friction_rule()), optional,
             "of a sliding body; one number or both")
      .whole("rolling", part(kSide, &MaterialOnSubstrate::rolling, rolling_rule()), optional,
             "rolling friction μ_r of K (16)")
      .whole("drilling", part(kSide, &MaterialOnSubstrate::drilling, drilling_rule()), optional,
             "friction against spin about the vertical")
      .whole("restitution",
             part(kSide, &MaterialOnSubstrate::restitution, number(kPureNumber, kFraction)),
             optional, "for a body that comes down on it")
      .whole("preset", preset_rule<WrittenContact>(PresetPart::substrate), optional,
             "brings what does not stand here");

  const auto body_rule = body.rule();
  const auto substrate_rule = substrate.rule();
  // A surface beside the substrate has contacts of either form; keys of one alone tell.
  static constexpr std::array kOfSurfaces = {"friction", "rolling", "drilling", "restitution"};
  return {[=](const YamlNode& node, Reading& reading, WrittenContact& target) {
            const auto has = [&](const char* key) {
              return is_mapping(node) && node.find(key) != nullptr;
            };
            const YamlNode* names = is_mapping(node) ? node.find("between") : nullptr;
            target.on_substrate =
                (names && std::ranges::any_of(names->items,
                                              [](const YamlPointer& name) {
                                                return is_scalar(*name) &&
                                                       name->text == "substrate";
                                              })) ||
                (!has("normal") && !has("tangential") && std::ranges::any_of(kOfSurfaces, has));
            return (target.on_substrate ? substrate_rule : body_rule).read(node, reading, target);
          },
          [=] {
            const json named = {{"contains", {{"const", "substrate"}}}};
            json any = json::array();
            for (const char* key : kOfSurfaces) any.push_back({{"required", json::array({key})}});
            any.push_back(
                {{"required", json::array({"preset"})},
                 {"properties",
                  {{"preset", preset_rule<WrittenContact>(PresetPart::substrate).schema()}}}});
            const json of_surface = {
                {"anyOf", any},
                {"not",
                 {{"anyOf", json::array({{{"required", json::array({"normal"})}},
                                         {{"required", json::array({"tangential"})}}})}}}};
            const json on_substrate = {{"required", json::array({"between"})},
                                       {"properties", {{"between", named}}}};
            return json{{"if", {{"anyOf", json::array({on_substrate, of_surface})}}},
                        {"then", substrate_rule.schema()},
                        {"else", body_rule.schema()}};
          }};
}

}  // namespace

Rule<std::vector<WrittenContact>> contacts_rule() { return list(placed(contact_rule()), 0); }

}  // namespace slipcheck
