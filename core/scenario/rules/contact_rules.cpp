#include <algorithm>
#include <utility>

#include "scenario/presets.h"
#include "scenario/record_keys.h"
#include "scenario/rules/scene_rules.h"

namespace slipcheck {
namespace {

using nlohmann::json;

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

/// A quantity of the power law, whose dimension depends on the exponents: base · length^−exponent.
template <class Field>
Rule<PowerNormal> power_quantity(Field PowerNormal::*field, double PowerNormal::*exponent,
                                 Dimension base, const Range& range) {
  return {[=](const YamlNode& node, Reading& reading, PowerNormal& target) {
            Dimension dimension = base;
            dimension.length -= target.*exponent;
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

Rule<FrictionCoefficients> friction_rule() {
  const Rule<double> coefficient = number(kPureNumber, kNotNegative);
  Record<FrictionCoefficients> both;
  both.key("static", &FrictionCoefficients::static_, coefficient, required, "μ_s, at least μ_k")
      .key("kinetic", &FrictionCoefficients::kinetic, coefficient, required, "μ_k");
  return one_form_of<FrictionCoefficients>(
      "must be a number or {static: …, kinetic: …}",
      {{is_mapping, both.rule()},
       {is_scalar, made_from<FrictionCoefficients>(coefficient, [](double value) {
          return FrictionCoefficients{value, value};
        })}});
}

constexpr const char* kSpringFrictionDoc =
    "Coulomb coefficient between the bodies; one number or both";

Record<SpringTangential> spring_record() {
  Record<SpringTangential> spring;
  spring
      .key("stiffness", &SpringTangential::stiffness, number(kStiffness, kPositive), optional,
           "k_t of the tangential spring")
      .key("stiffness_ratio", &SpringTangential::stiffness_ratio, number(kPureNumber, kPositive),
           optional, "k_t over the normal stiffness")
      .key("damping_rate", &SpringTangential::damping_rate, number(kRate, kNotNegative), optional,
           "γ_S as of K (4)")
      .key("damping_ratio", &SpringTangential::damping_ratio, number(kPureNumber, kNotNegative),
           optional, "tangential dashpot over the normal one")
      .key("friction", &SpringTangential::friction, friction_rule(), required, kSpringFrictionDoc)
      .exactly_one_of({"stiffness", "stiffness_ratio"});
  return spring;
}

Record<MindlinTangential> mindlin_record() {
  using Form = MindlinTangential::Form;
  Record<MindlinTangential> mindlin;
  mindlin
      .key("friction", &MindlinTangential::friction, friction_rule(), required, kSpringFrictionDoc)
      .key("damping_ratio", &MindlinTangential::damping_ratio, number(kPureNumber, kNotNegative),
           optional, "tangential dashpot over the normal one")
      .key("form", &MindlinTangential::form,
           choice<Form>({{"passive", Form::passive}, {"displacement", Form::displacement}}),
           optional, "what falls with the overlap: the force, or nothing but the stiffness");
  return mindlin;
}

Rule<std::optional<RollingResistance>> rolling_resistance_rule() {
  Record<RollingResistance> rolling;
  rolling
      .key("friction", &RollingResistance::friction, number(kPureNumber, kNotNegative), required,
           "μ_r, largest torque over F_N R_eff")
      .key("stiffness", &RollingResistance::stiffness, number(kStiffness, kPositive), optional,
           "torque over R_eff² and the angle rolled")
      .key("stiffness_ratio", &RollingResistance::stiffness_ratio, number(kPureNumber, kPositive),
           optional, "the same over the normal stiffness")
      .key("damping", &RollingResistance::damping, number(kPureNumber, kNotNegative), optional,
           "over critical damping")
      .exactly_one_of({"stiffness", "stiffness_ratio"});
  return made_from<std::optional<RollingResistance>>(
      rolling.rule(), [](const RollingResistance& each) { return std::optional(each); });
}

using SpeedTable = std::vector<std::pair<double, double>>;

/// [[speed, coefficient], …]; that the speeds rise is checked later.
Rule<SpeedTable> speed_table_rule() {
  return made_from<SpeedTable>(
      list(row({{kVelocity, kNotNegative}, {kPureNumber, kNotNegative}}), 1),
      [](const std::vector<std::vector<double>>& points) {
        SpeedTable table;
        for (const auto& point : points) table.emplace_back(point[0], point[1]);
        return table;
      });
}

Rule<FrictionLaw> friction_law_rule() {
  constexpr Dimension kPerVelocity{"inverse velocity", 0, -1, 1, 0, "s/m", "s/cm", "1.088 s/m"};
  Record<ExponentialFriction> falling;
  falling
      .key("a", &ExponentialFriction::a, number(kPureNumber, kNotNegative), required,
           "friction of fast slip")
      .key("b", &ExponentialFriction::b, number(kPureNumber, kNotNegative), required,
           "how much more there is without slip")
      .key("c", &ExponentialFriction::c, number(kPerVelocity, kNotNegative), required,
           "how steeply it falls");
  const auto same = [](auto value) { return FrictionLaw(std::move(value)); };
  return one_form_of<FrictionLaw>(
      "must be a number, a table [[speed, coefficient], …] or {a: …, b: …, c: …}",
      {{is_mapping, made_from<FrictionLaw>(falling.rule(), same)},
       {[](const YamlNode& node) { return is_list(node); },
        made_from<FrictionLaw>(speed_table_rule(),
                               [](const SpeedTable& table) {
                                 std::vector<TabulatedFriction::Point> points;
                                 for (const auto& [speed, mu] : table)
                                   points.push_back({speed, mu});
                                 return FrictionLaw(TabulatedFriction(std::move(points)));
                               })},
       {is_scalar, made_from<FrictionLaw>(number(kPureNumber, kNotNegative), same)}});
}

Rule<TangentialModel> tangential_rule() {
  const Rule<double> friction = number(kPureNumber, kNotNegative);
  constexpr const char* kFrictionDoc = "Coulomb coefficient between the bodies";

  Record<ViscousTangential> viscous;
  viscous
      .key("damping_rate", &ViscousTangential::damping_rate, number(kRate, kNotNegative), optional,
           "γ_S of K (4)")
      .key("damping_ratio", &ViscousTangential::damping_ratio, number(kPureNumber, kNotNegative),
           optional, "γ_S over the normal γ_N")
      .key("friction", &ViscousTangential::friction, friction, required, kFrictionDoc)
      .key("caps", &ViscousTangential::caps,
           choice<ViscousTangential::Caps>({{"together", ViscousTangential::Caps::together},
                                            {"apart", ViscousTangential::Caps::apart}}),
           optional, "Coulomb's on the force, or as in K (4), (6) on its part in the plane and up")
      .exactly_one_of({"damping_rate", "damping_ratio"});

  using Form = AsperityTangential::Form;
  const auto absolute = [](const Rule<double>& size) {
    return Rule<AsperityTangential>{
        [size](const YamlNode& node, Reading& reading, AsperityTangential& target) {
          return size.read(node, reading, target.asperity_size.emplace());
        },
        size.schema};
  };
  Record<AsperityTangential> relative_size;
  relative_size.key("relative", &AsperityTangential::relative_asperity_size,
                    number(kPureNumber, kPositive), required, "size over the effective radius");
  Record<AsperityTangential> asperity;
  asperity.key("friction", &AsperityTangential::friction, friction, optional, kFrictionDoc)
      .key("roughness_factor", &AsperityTangential::roughness_factor,
           number(kPerRootLength, kNotNegative), optional, "α in μ = α √ζ0")
      .whole("asperity_size",
             one_form_of<AsperityTangential>("must be a length or {relative: …}",
                                             {{is_mapping, relative_size.rule()},
                                              {is_scalar, absolute(number(kLength, kPositive))}}),
             required, "ζ0 of B (35)")
      .key("form", &AsperityTangential::form,
           choice<Form>({{"printed", Form::printed}, {"passive", Form::passive}}), optional,
           "the law as printed, or one that cannot create energy")
      .exactly_one_of({"friction", "roughness_factor"});

  Record<HardTangential> hard;
  hard.key("friction", &HardTangential::friction, friction_law_rule(), required, kFrictionDoc)
      .key("tangential_restitution", &HardTangential::tangential_restitution,
           number(kPureNumber, {-1, {}, 1, {}}), optional, "β0, largest tangential restitution");

  return one_of<TangentialModel>(
      "model",
      {alternative<TangentialModel>("none", "no tangential force", Record<NoTangential>()),
       alternative<TangentialModel>("viscous", "viscous, capped by Coulomb; K (4), B (39)",
                                    viscous),
       alternative<TangentialModel>("asperity", "breaking asperities; B (35)", asperity),
       alternative<TangentialModel>(
           "hard", "sticking or sliding collisions; L (5)-(12), of soft contacts by L App. B",
           hard),
       alternative<TangentialModel>("spring", "spring that gives way; Cundall and Strack 1979",
                                    spring_record()),
       alternative<TangentialModel>(
           "mindlin", "elastic spheres that do not slip, from the materials", mindlin_record())});
}

using RollingTable = decltype(RollingLaw::table);

Rule<RollingTable> rolling_table_rule() {
  return one_form_of<RollingTable>(
      "must be a number or a table [[speed, coefficient], …]",
      {{[](const YamlNode& node) { return is_list(node); }, speed_table_rule()},
       {is_scalar, made_from<RollingTable>(number(kPureNumber, kNotNegative), [](double value) {
          return RollingTable{{0, value}};
        })}});
}

Rule<RollingLaw> rolling_rule() {
  Record<RollingLaw> law;
  law.key("coefficient", &RollingLaw::table, rolling_table_rule(), required,
          "μ_r, or a table of it over the speed")
      .key("while_sliding", &RollingLaw::while_sliding, boolean(), optional,
           "whether it acts on a sliding body too");
  return one_form_of<RollingLaw>(
      "must be a number, a table [[speed, coefficient], …] or {coefficient: …}",
      {{is_mapping, law.rule()},
       {[](const YamlNode& node) { return is_scalar(node) || is_list(node); },
        made_from<RollingLaw>(rolling_table_rule(), [](RollingTable table) {
          return RollingLaw{std::move(table), false};
        })}});
}

Rule<Drilling> drilling_rule() {
  using Radius = std::optional<double>;
  struct None {};
  struct Uncoupled {
    Radius contact_radius;
  };
  struct Coupled {
    Radius contact_radius;
  };
  const auto radius = one_form_of<Radius>(
      "must be a length or hertz",
      {{is_word("hertz"), made_from<Radius>(word({"hertz"}), [](std::size_t) { return Radius(); })},
       {is_scalar,
        made_from<Radius>(number(kLength, kPositive), [](double a) { return Radius(a); })}});
  constexpr const char* kRadiusDoc = "a_c, or hertz: from the material and the weight";
  Record<Uncoupled> uncoupled;
  uncoupled.key("contact_radius", &Uncoupled::contact_radius, radius, required, kRadiusDoc);
  Record<Coupled> coupled;
  coupled.key("contact_radius", &Coupled::contact_radius, radius, required, kRadiusDoc);

  using Model = std::variant<None, Uncoupled, Coupled>;
  const Rule<Model> model = one_of<Model>(
      "model", {alternative<Model>("none", "no torque about the vertical", Record<None>()),
                alternative<Model>("uncoupled", "constant torque, whatever the sliding", uncoupled),
                alternative<Model>("coupled", "force and torque share the friction", coupled)});
  return made_from<Drilling>(model, [](const Model& written) {
    if (const auto* free = std::get_if<Uncoupled>(&written)) {
      return Drilling{Drilling::Model::uncoupled, free->contact_radius};
    }
    if (const auto* joint = std::get_if<Coupled>(&written)) {
      return Drilling{Drilling::Model::coupled, joint->contact_radius};
    }
    return Drilling{};
  });
}

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
