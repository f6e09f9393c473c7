#include <utility>

#include "scenario/presets.h"
#include "scenario/record_keys.h"
#include "scenario/rules/scene_rules.h"

namespace slipcheck {
namespace {

using nlohmann::json;

/// A pure number is one of radii, one with a unit a length.
Rule<Offset> offset_rule() {
  const Rule<double> of_radius = number(kPureNumber, {-1, {}, 1, {}});
  const Rule<double> length = number(kLength, kAnyNumber);
  const auto is_pure = [](const YamlNode& node) {
    try {
      if (!is_scalar(node)) return false;
      parse_quantity(node.text, kPureNumber);
      return true;
    } catch (const BadQuantity&) {
      return false;
    }
  };
  const auto as_offset = [](Rule<double> rule, bool of) {
    return made_from<Offset>(std::move(rule), [of](double value) { return Offset{value, of}; });
  };
  Rule<Offset> rule = one_form_of<Offset>(
      "must be a number of radii or a length",
      {{is_pure, as_offset(of_radius, true)}, {is_scalar, as_offset(length, false)}});
  rule.schema = [] {
    return json{{"type", {"number", "string"}},
                {"description", "of the ball's radius, or a length with its unit"}};
  };
  return rule;
}

}  // namespace

Rule<Cue> cue_rule() {
  Record<Cue> cue;
  cue.key("speed", &Cue::speed, number(kVelocity, kPositive), optional, "of the cue as it strikes")
      .key("impulse", &Cue::impulse, number(kImpulse, kPositive), optional, "in place of a speed")
      .key("mass", &Cue::mass, number(kMass, kPositive), optional, "of the cue, with its speed")
      .key("restitution", &Cue::restitution, number(kPureNumber, kFraction), optional,
           "of the tip on the ball, with the cue's speed")
      .key("offset", &Cue::offset, list(offset_rule(), 2, 2), optional,
           "[a, b] of the tip to the right of the ball's centre and above it, across the cue")
      .key("elevation", &Cue::elevation, number(kAngle, {0, {}, {}, 90}), optional,
           "of the cue's butt over the plane")
      .key("heading", &Cue::heading, number(kAngle, kAnyNumber), optional,
           "of the stroke, from x towards y")
      .key("tip_friction", &Cue::tip_friction, number(kPureNumber, kNotNegative), optional,
           "of the tip on the ball: it tells how far from the centre it slips off")
      .whole("preset", preset_rule<Cue>(PresetPart::cue), optional,
             "brings what does not stand here")
      .exactly_one_of({"speed", "impulse"})
      .at_most_one_of({"impulse", "mass"});
  return cue.rule();
}

}  // namespace slipcheck
