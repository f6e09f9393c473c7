#include <utility>

#include "scenario/record_keys.h"
#include "scenario/rules/contact_parts.h"

namespace slipcheck {
namespace {

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

}  // namespace

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

}  // namespace slipcheck
