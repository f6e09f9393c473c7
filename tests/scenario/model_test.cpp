#include "scenes.h"

// Every model of the format's table loads, with each of its ways to be written.

namespace slipcheck {
namespace {

using namespace testing;

Scenario with_materials(std::string text) {
  return parse_scenario(
      with(text, "{density: 7850}", "{density: 7850, young_modulus: 2e11, poisson_ratio: 0.3}"),
      "s.yaml");
}
Scenario with_normal(const std::string& normal) {
  const std::string text = with(kHard,
                                "tangential: {model: hard, friction: 0.1, "
                                "tangential_restitution: 0.5}",
                                "");
  return with_materials(with(text, "{model: hard, restitution: 0.9}", normal));
}
Scenario with_tangential(const std::string& tangential) {
  const std::string text =
      with(kHard, "{model: hard, friction: 0.1, tangential_restitution: 0.5}", tangential);
  return with_materials(with(text, "{model: hard, restitution: 0.9}",
                             "{model: linear, restitution: 0.9, collision_time: 1e-4}"));
}
template <class T>
T normal(const std::string& text) {
  return std::get<T>(with_normal(text).contacts[0].normal);
}
template <class T>
T tangential(const std::string& text) {
  return std::get<T>(with_tangential(text).contacts[0].tangential);
}
MaterialOnSubstrate on_substrate(const std::string& keys) {
  return with_materials(with(kHard, "friction: 0.2", keys)).substrate_contacts[0];
}
Motion motion(const std::string& text) {
  const Scenario scene =
      parse_scenario(with(kHard, "substrate: {}", "substrate: {motion: " + text + "}"), "s.yaml");
  return std::get<Substrate>(scene.surroundings).motion;
}

TEST(Models, HardNormal) {
  EXPECT_EQ(std::get<double>(normal<HardNormal>("{model: hard, restitution: 1}").restitution), 1);
  const auto law = std::get<BridgesRestitution>(
      normal<HardNormal>("{model: hard, restitution: {bridges: {exponent: 0.2, speed: 1 cm/s}}}")
          .restitution);
  EXPECT_EQ(law.coefficient, BridgesRestitution{}.coefficient);
  EXPECT_EQ(law.exponent, 0.2);
  EXPECT_EQ(law.speed, 0.01);
  EXPECT_TRUE(std::holds_alternative<ViscoelasticRestitution>(
      normal<HardNormal>("{model: hard, restitution: viscoelastic}").restitution));
}

TEST(Models, LinearNormal) {
  const auto model = normal<LinearNormal>(
      "{model: linear, damping_rate: 30, stiffness: 1e5 N/m, ends_at: zero_force}");
  EXPECT_EQ(model.damping_rate, 30);
  EXPECT_EQ(model.stiffness, 1e5);
  EXPECT_EQ(model.ends_at, EndsAt::zero_force);
}

TEST(Models, HertzNormal) {
  EXPECT_EQ(normal<HertzNormal>("{model: hertz}").ends_at, EndsAt::zero_overlap);
  EXPECT_EQ(normal<HertzNormal>("hertz").ends_at, EndsAt::zero_overlap);
}

TEST(Models, PowerNormal) {
  const auto model =
      normal<PowerNormal>("{model: power, modulus: 1e9, viscosity: 10, alpha: 1, gamma: 0}");
  EXPECT_EQ(model.modulus, 1e9);
  EXPECT_EQ(model.viscosity, 10);
  EXPECT_EQ(model.alpha, 1);
  EXPECT_EQ(model.gamma, 0);
}

TEST(Models, UnitsOfPowerNormalFollowItsExponents) {
  EXPECT_DOUBLE_EQ(
      normal<PowerNormal>("{model: power, modulus: 1e9 dyn/cm^2, viscosity: 0, alpha: 2}").modulus,
      1e8);
  expect_fault(with(kHard, "{model: hard, restitution: 0.9}",
                    "{model: power, modulus: 1e8 N/m^1.5, viscosity: 0, alpha: 1.25}"),
               "s.yaml:8:37: contacts[0].normal.modulus: must be a force over length^alpha, as in "
               "\"1e9 N/m^1.25\", got 1e8 N/m^1.5");
}

TEST(Models, RestitutionAtASpeed) {
  const auto power =
      normal<PowerNormal>("{model: power, modulus: 1e9, restitution: 0.9, at_speed: 10 cm/s}");
  EXPECT_FALSE(power.viscosity);
  EXPECT_EQ(power.restitution, 0.9);
  EXPECT_EQ(power.at_speed, 0.1);
  const auto viscoelastic =
      normal<ViscoelasticNormal>("{model: viscoelastic, at_speed: 2, restitution: 1}");
  EXPECT_FALSE(viscoelastic.dissipation_time);
  EXPECT_EQ(viscoelastic.restitution, 1);
  EXPECT_EQ(viscoelastic.at_speed, 2);
}

TEST(Models, DissipationTimeOfAMaterial) {
  const auto time = [](const std::string& keys) {
    return parse_scenario(with(kHard, "{density: 7850}", "{density: 7850" + keys + "}"), "s.yaml")
        .materials.at("steel")
        .dissipation_time;
  };
  EXPECT_EQ(time(", dissipation_time: 2 us"), 2e-6);
  EXPECT_EQ(time(", dissipation_time: 0"), 0);
  EXPECT_FALSE(time(""));
}

TEST(Models, ViscoelasticNormal) {
  using Form = ViscoelasticNormal::Form;
  const auto one = normal<ViscoelasticNormal>("{model: viscoelastic, dissipation_time: 1e-6}");
  EXPECT_EQ(one.dissipation_time, 1e-6);
  EXPECT_EQ(one.form, Form::expanded);
  const auto other =
      normal<ViscoelasticNormal>("{model: viscoelastic, viscosity: [1e3, 2 kPa s], form: compact}");
  EXPECT_EQ(other.viscosity, std::make_pair(1e3, 2e3));
  EXPECT_EQ(other.form, Form::compact);
}

TEST(Models, SpringsThatGiveWay) {
  const auto ratios = tangential<SpringTangential>(
      "{model: spring, stiffness_ratio: 0.25, damping_ratio: 0.5, friction: {static: 0.4, kinetic: "
      "0.3}}");
  EXPECT_EQ(ratios.stiffness_ratio, 0.25);
  EXPECT_EQ(ratios.damping_ratio, 0.5);
  EXPECT_EQ(ratios.friction.static_, 0.4);
  EXPECT_EQ(ratios.friction.kinetic, 0.3);
  const auto plain = tangential<SpringTangential>(
      "{model: spring, stiffness: 2 kN/m, damping_rate: 3, friction: 0.5}");
  EXPECT_EQ(plain.stiffness, 2000);
  EXPECT_EQ(plain.damping_rate, 3);
  EXPECT_EQ(plain.friction.static_, 0.5);
  EXPECT_EQ(plain.friction.kinetic, 0.5);
}

/// Hertz's contact of the materials, with these keys beside it.
Scenario with_hertz(const std::string& tangential, const std::string& normal = "hertz") {
  const std::string text =
      with(kHard, "{model: hard, friction: 0.1, tangential_restitution: 0.5}", tangential);
  return with_materials(with(text, "{model: hard, restitution: 0.9}", normal));
}

TEST(Models, MindlinTangential) {
  using Form = MindlinTangential::Form;
  const auto model = [](const std::string& text, const std::string& normal) {
    return std::get<MindlinTangential>(with_hertz(text, normal).contacts[0].tangential);
  };
  const auto plain = model("{model: mindlin, friction: 0.5}", "hertz");
  EXPECT_EQ(plain.friction.kinetic, 0.5);
  EXPECT_EQ(plain.damping_ratio, 0);
  EXPECT_EQ(plain.form, Form::passive);
  const auto damped = model(
      "{model: mindlin, friction: {static: 0.5, kinetic: 0.4}, damping_ratio: 0.7, form: "
      "displacement}",
      "{model: viscoelastic, dissipation_time: 1e-6}");
  EXPECT_EQ(damped.friction.static_, 0.5);
  EXPECT_EQ(damped.damping_ratio, 0.7);
  EXPECT_EQ(damped.form, Form::displacement);
}

TEST(Models, RollingResistance) {
  const Scenario scene =
      with_tangential("none\n    rolling: {friction: 0.02, stiffness_ratio: 0.1, damping: 0.3}");
  ASSERT_TRUE(scene.contacts[0].rolling);
  EXPECT_EQ(scene.contacts[0].rolling->friction, 0.02);
  EXPECT_EQ(scene.contacts[0].rolling->stiffness_ratio, 0.1);
  EXPECT_EQ(scene.contacts[0].rolling->damping, 0.3);
}

TEST(Models, SpringsThatCannotBe) {
  const auto faults_of = [](const std::string& tangential, const std::string& normal) {
    std::vector<std::string> said;
    for (const Fault& fault : test::faults_of([&] { with_hertz(tangential, normal); }))
      said.push_back(fault.message());
    return said;
  };
  const std::string linear = "{model: linear, restitution: 0.9, collision_time: 1e-4}";
  const auto expect_said = [&](const std::string& tangential, const std::string& normal,
                               const std::string& part) {
    const auto said = faults_of(tangential, normal);
    ASSERT_EQ(said.size(), 1u) << tangential << " beside " << normal;
    EXPECT_NE(said[0].find(part), std::string::npos) << said[0];
  };
  expect_said("{model: spring, friction: 0.5}", linear,
              "contacts[0].tangential: needs exactly one of stiffness or stiffness_ratio");
  expect_said("{model: spring, stiffness: 0, friction: 0.5}", linear,
              "contacts[0].tangential.stiffness: must be");
  expect_said("{model: spring, stiffness: 1e5}", linear,
              "contacts[0].tangential: needs the key friction");
  expect_said("{model: spring, stiffness: 1e5, friction: -1}", linear,
              "contacts[0].tangential.friction: must be");
  expect_said("{model: spring, stiffness: 1e5, friction: {static: 0.2, kinetic: 0.3}}", linear,
              "contacts[0].tangential.friction.static: must be at least the kinetic friction 0.3");
  expect_said("{model: spring, stiffness: 1e5, friction: 0.5, damping_ratio: 1, damping_rate: 2}",
              linear, "contacts[0].tangential.damping_ratio: must not stand beside damping_rate");
  expect_said("{model: spring, stiffness_ratio: 0.3, friction: 0.5}", "hertz",
              "contacts[0].tangential.stiffness_ratio: needs the normal model linear");
  expect_said("{model: spring, stiffness: 1e5, friction: 0.5, damping_ratio: 1}", "hertz",
              "contacts[0].tangential.damping_ratio: needs the normal model linear, power");
  expect_said("{model: mindlin, friction: 0.5}", linear,
              "contacts[0].tangential.model: mindlin needs the normal model hertz");
  expect_said("none\n    rolling: {friction: 0.1, stiffness_ratio: 0.1}", "hertz",
              "contacts[0].rolling.stiffness_ratio: needs the normal model linear");
  expect_said("none\n    rolling: {friction: -0.1, stiffness: 10}", linear,
              "contacts[0].rolling.friction: must be");
  expect_said("none\n    rolling: {friction: 0.1, stiffness: 10}",
              "{model: hard, restitution: 0.9}",
              "contacts[0].rolling: needs a normal model whose contacts last");
}

TEST(Models, Tangential) {
  tangential<NoTangential>("none");
  tangential<NoTangential>("{model: none}");
  EXPECT_EQ(tangential<ViscousTangential>("{model: viscous, damping_rate: 3, friction: 0.5}")
                .damping_rate,
            3);
  using Form = AsperityTangential::Form;
  const auto asperity = tangential<AsperityTangential>(
      "{model: asperity, roughness_factor: 1 cm^-0.5, asperity_size: {relative: 2e-4}}");
  EXPECT_DOUBLE_EQ(asperity.roughness_factor.value(), 10);
  EXPECT_EQ(asperity.relative_asperity_size, 2e-4);
  EXPECT_EQ(asperity.form, Form::printed);
  const auto passive = tangential<AsperityTangential>(
      "{model: asperity, friction: 0.3, asperity_size: 1 um, form: passive}");
  EXPECT_EQ(passive.friction, 0.3);
  EXPECT_EQ(passive.asperity_size, 1e-6);
  EXPECT_EQ(passive.form, Form::passive);
  const Scenario hard = parse_scenario(kHard, "s.yaml");
  EXPECT_EQ(std::get<HardTangential>(hard.contacts[0].tangential).tangential_restitution, 0.5);
}

TEST(Models, RollingFriction) {
  using Table = decltype(RollingLaw::table);
  EXPECT_EQ(on_substrate("friction: 0.2\n    rolling: 0.1").rolling.table, (Table{{0, 0.1}}));
  EXPECT_EQ(on_substrate("friction: 0.2\n    rolling: [[0, 0.1], [1, 0.2]]").rolling.table,
            (Table{{0, 0.1}, {1, 0.2}}));
  const auto law = on_substrate(
      "friction: 0.2\n    rolling: {coefficient: [[0, 0.1], [1, 0.2]], while_sliding: true}");
  EXPECT_EQ(law.rolling.table.size(), 2u);
  EXPECT_TRUE(law.rolling.while_sliding);
}

TEST(Models, Drilling) {
  using Model = Drilling::Model;
  EXPECT_EQ(on_substrate("drilling: none").drilling.model, Model::none);
  EXPECT_EQ(on_substrate("drilling: {model: none}").drilling.model, Model::none);
  const auto coupled = on_substrate("drilling: {model: coupled, contact_radius: 1 mm}").drilling;
  EXPECT_EQ(coupled.model, Model::coupled);
  EXPECT_EQ(coupled.contact_radius, 1e-3);
  const auto hertz = on_substrate("drilling: {model: uncoupled, contact_radius: hertz}").drilling;
  EXPECT_EQ(hertz.model, Model::uncoupled);
  EXPECT_FALSE(hertz.contact_radius);
}

TEST(Models, Motion) {
  EXPECT_TRUE(std::holds_alternative<StillMotion>(motion("still")));
  EXPECT_TRUE(std::holds_alternative<StillMotion>(motion("{kind: still}")));
  EXPECT_EQ(std::get<ConstantMotion>(motion("{kind: constant, velocity: [1, 2]}")).velocity,
            Vector2(1, 2));
  const auto table = std::get<TableMotion>(motion("{kind: table, table: [[0, 1, 2], [3, 4, 5]]}"));
  ASSERT_EQ(table.table.size(), 2u);
  EXPECT_EQ(table.table[1].time, 3);
  EXPECT_EQ(table.table[1].position, Vector2(4, 5));
}

TEST(Models, Inertia) {
  const auto factor = [](const std::string& inertia) {
    return parse_scenario(with(kHard, "{radius: 0.1}", "{radius: 0.1, inertia: " + inertia + "}"),
                          "s.yaml")
        .bodies[0]
        .sphere.shape_factor;
  };
  EXPECT_EQ(factor("solid"), 2.0 / 5);
  EXPECT_EQ(factor("shell"), 2.0 / 3);
  EXPECT_EQ(factor("disk"), 1.0 / 2);
  EXPECT_EQ(factor("ring"), 1);
  EXPECT_EQ(factor("0.35"), 0.35);
}

TEST(Models, MassInPlaceOfDensity) {
  std::string text = with(kHard, "steel: {density: 7850}", "steel: {}");
  text = with(text, "sphere: {radius: 0.1}", "mass: 5 g, sphere: {radius: 0.1}");
  text = with(text, "material: steel, sphere", "material: steel, mass: 6, sphere");
  const Scenario scene = parse_scenario(text, "s.yaml");
  EXPECT_EQ(scene.bodies[0].sphere.mass, 0.005);
  EXPECT_EQ(scene.bodies[1].sphere.mass, 6);
}

}  // namespace
}  // namespace slipcheck
