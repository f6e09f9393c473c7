#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "scenario/record_keys.h"
#include "scenario/rules/contact_parts.h"

namespace slipcheck {
namespace {

Rule<EndsAt> ends_at_rule() {
  return choice<EndsAt>(
      {{"zero_overlap", EndsAt::zero_overlap}, {"zero_force", EndsAt::zero_force}});
}
constexpr const char* kEndsAtDoc = "what ends the contact: no overlap, or no repulsion";

using HardRestitution = decltype(HardNormal::restitution);

Rule<HardRestitution> hard_restitution_rule() {
  Record<BridgesRestitution> law;
  law.key("coefficient", &BridgesRestitution::coefficient, number(kPureNumber, kPositive), optional,
          "restitution at the reference speed")
      .key("exponent", &BridgesRestitution::exponent, number(kPureNumber, kNotNegative), optional,
           "how steeply it falls with the speed")
      .key("speed", &BridgesRestitution::speed, number(kVelocity, kPositive), optional,
           "reference speed");
  Record<BridgesRestitution> bridges;
  bridges.whole("bridges", law.rule(), required,
                "min(1, coefficient (g/speed)^-exponent) at the impact speed g");
  const auto same = [](auto value) { return HardRestitution(value); };
  const Rule<std::size_t> viscoelastic = word({"viscoelastic"});
  return one_form_of<HardRestitution>(
      "must be a number in [0, 1], {bridges: …} or viscoelastic",
      {{is_word("viscoelastic"),
        made_from<HardRestitution>(
            viscoelastic, [](std::size_t) { return HardRestitution(ViscoelasticRestitution{}); })},
       {is_mapping, made_from<HardRestitution>(bridges.rule(), same)},
       {is_scalar, made_from<HardRestitution>(number(kPureNumber, kFraction), same)}});
}

/// A quantity whose dimension depends on an exponent that is a key before it: base ·
/// length^−exponent. The example of `base` ends with an exponent.
template <class Model, class Field>
Rule<Model> power_quantity(Field Model::*field, double Model::*exponent, Dimension base,
                           const Range& range) {
  return {[=](const YamlNode& node, Reading& reading, Model& target) {
            Dimension dimension = base;
            dimension.length -= target.*exponent;
            const std::string_view any = base.example;
            const std::string example =
                fmt::format("{}{:g}", any.substr(0, any.rfind('^') + 1), target.*exponent);
            dimension.example = example.c_str();
            double value = 0;
            if (!number(dimension, range).read(node, reading, value)) return false;
            target.*field = value;
            return true;
          },
          number(base, range).schema};
}

/// In place of a dissipative parameter: the restitution of an impact at one speed.
template <class Model>
void restitution_at_speed(Record<Model>& record) {
  record
      .key("restitution", &Model::restitution, number(kPureNumber, {{}, 0, 1, {}}), optional,
           "coefficient of normal restitution e_n of an impact at_speed")
      .key("at_speed", &Model::at_speed, number(kVelocity, kPositive), optional,
           "impact speed that restitution is for")
      .together({"restitution", "at_speed"});
}

}  // namespace

Rule<NormalModel> normal_rule() {
  Record<HardNormal> hard;
  hard.key("restitution", &HardNormal::restitution, hard_restitution_rule(), required,
           "coefficient of normal restitution");

  Record<LinearNormal> linear;
  linear
      .key("restitution", &LinearNormal::restitution, number(kPureNumber, {{}, 0, 1, {}}), optional,
           "coefficient of normal restitution e_n")
      .key("damping_rate", &LinearNormal::damping_rate, number(kRate, kNotNegative), optional,
           "γ_N of K (2)")
      .key("collision_time", &LinearNormal::collision_time, number(kTime, kPositive), optional,
           "duration of a collision")
      .key("stiffness", &LinearNormal::stiffness, number(kStiffness, kPositive), optional,
           "k of K (2)")
      .key("ends_at", &LinearNormal::ends_at, ends_at_rule(), optional, kEndsAtDoc)
      .exactly_one_of({"restitution", "damping_rate"})
      .exactly_one_of({"collision_time", "stiffness"});

  Record<HertzNormal> hertz;
  hertz.key("ends_at", &HertzNormal::ends_at, ends_at_rule(), optional, kEndsAtDoc);

  constexpr Dimension kForce{
      "force over length^alpha", 1, 1, -2, 0, "N/m^alpha", "dyn/cm^alpha", "1e9 N/m^1.5"};
  constexpr Dimension kForceTime{"force over velocity and length^gamma",
                                 1,
                                 0,
                                 -1,
                                 0,
                                 "N s/m^(1+gamma)",
                                 "dyn s/cm^(1+gamma)",
                                 "50 N s/m^1.5"};
  Record<PowerNormal> power;
  power
      .key("alpha", &PowerNormal::alpha, number(kPureNumber, {1, {}, 10, {}}), optional,
           "power of the overlap in the elastic force, β of K (B1)")
      .key("gamma", &PowerNormal::gamma, number(kPureNumber, {0, {}, 10, {}}), optional,
           "power of the overlap in the dissipative force")
      .whole("modulus",
             power_quantity(&PowerNormal::modulus, &PowerNormal::alpha, kForce, kPositive),
             required, "elastic force at unit overlap")
      .whole("viscosity",
             power_quantity(&PowerNormal::viscosity, &PowerNormal::gamma, kForceTime, kNotNegative),
             optional, "dissipative force at unit overlap and speed")
      .key("ends_at", &PowerNormal::ends_at, ends_at_rule(), optional, kEndsAtDoc)
      .exactly_one_of({"viscosity", "restitution"});
  restitution_at_speed(power);

  using Viscosities = std::pair<double, double>;
  using Form = ViscoelasticNormal::Form;
  Record<ViscoelasticNormal> viscoelastic;
  viscoelastic
      .key("dissipation_time", &ViscoelasticNormal::dissipation_time, number(kTime, kNotNegative),
           optional, "A of B (23)")
      .key("viscosity", &ViscoelasticNormal::viscosity,
           made_from<Viscosities>(
               numbers(kViscosity, kNotNegative, {2}),
               [](const std::vector<double>& eta) { return Viscosities(eta[0], eta[1]); }),
           optional, "η1 and η2 of B (23)")
      .key("form", &ViscoelasticNormal::form,
           choice<Form>({{"expanded", Form::expanded}, {"compact", Form::compact}}), optional,
           "B (24) or B (25)")
      .key("ends_at", &ViscoelasticNormal::ends_at, ends_at_rule(), optional, kEndsAtDoc)
      .exactly_one_of({"dissipation_time", "viscosity", "restitution"});
  restitution_at_speed(viscoelastic);

  return one_of<NormalModel>(
      "model",
      {alternative<NormalModel>("hard", "no duration, only a restitution; L (5)", hard),
       alternative<NormalModel>("linear", "spring and dashpot; K (2)", linear),
       alternative<NormalModel>("hertz", "elastic spheres, from the materials", hertz),
       alternative<NormalModel>("power", "powers of the overlap; K (B1)", power),
       alternative<NormalModel>("viscoelastic", "viscoelastic spheres; B (24)", viscoelastic)});
}

}  // namespace slipcheck
