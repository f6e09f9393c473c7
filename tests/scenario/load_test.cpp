#include <cmath>
#include <numbers>

#include "../support/text_of.h"
#include "scenario/content_digest.h"
#include "scenario/file_text.h"
#include "scenes.h"

namespace slipcheck {
namespace {

using namespace testing;

constexpr double kDegree = std::numbers::pi / 180;

TEST(Load, ReadsTheExampleOfTheDocumentation) {
  const Scenario scene = parse_scenario(kExample, "s.yaml");
  EXPECT_EQ(scene.name, "symmetric-steel");
  EXPECT_EQ(scene.title, "Two rolling steel spheres collide head-on");
  EXPECT_EQ(scene.source, "Kondic 1999, Sec. IV A");
  EXPECT_DOUBLE_EQ(scene.gravity.y(), -9.81 * std::sin(5 * kDegree));
  EXPECT_DOUBLE_EQ(scene.gravity.z(), -9.81 * std::cos(5 * kDegree));
  EXPECT_EQ(scene.materials.at("steel").density, 7850);
  EXPECT_EQ(scene.materials.at("steel").young_modulus, 2.06e11);
  EXPECT_EQ(scene.materials.at("steel").poisson_ratio, 0.28);

  ASSERT_EQ(scene.contacts.size(), 1u);
  const BodyContact& pair = scene.contacts[0];
  EXPECT_EQ(pair.first, "steel");
  EXPECT_EQ(pair.path, "contacts[0]");
  const auto& normal = std::get<LinearNormal>(pair.normal);
  EXPECT_EQ(normal.restitution, 0.9);
  EXPECT_EQ(normal.collision_time, 2.55e-5);
  EXPECT_FALSE(normal.damping_rate || normal.stiffness);
  EXPECT_EQ(std::get<ViscousTangential>(pair.tangential).damping_ratio, 0.5);

  ASSERT_EQ(scene.substrate_contacts.size(), 1u);
  const MaterialOnSubstrate& ground = scene.substrate_contacts[0];
  EXPECT_EQ(ground.material, "steel");
  EXPECT_EQ(ground.friction.static_, 0.5);
  EXPECT_EQ(ground.friction.kinetic, 0.1);
  EXPECT_EQ(ground.rolling.table, (decltype(ground.rolling.table){{0, 0.001}}));
  EXPECT_FALSE(ground.rolling.while_sliding);
  EXPECT_EQ(ground.drilling.model, Drilling::Model::uncoupled);
  EXPECT_EQ(ground.drilling.contact_radius, 2e-5);

  const auto& substrate = std::get<Substrate>(scene.surroundings);
  EXPECT_DOUBLE_EQ(substrate.tilt, 5 * kDegree);
  const auto& motion = std::get<OscillatingMotion>(substrate.motion);
  EXPECT_EQ(motion.amplitude, Vector2(1e-3, 0));
  EXPECT_EQ(motion.frequency, 5);
  EXPECT_DOUBLE_EQ(motion.phase, std::numbers::pi / 2);

  ASSERT_EQ(scene.bodies.size(), 2u);
  const Body& i = scene.bodies[0];
  EXPECT_EQ(i.sphere.radius, 2e-3);
  EXPECT_DOUBLE_EQ(i.sphere.mass, 7850 * 4 / 3. * std::numbers::pi * 8e-9);
  EXPECT_EQ(i.sphere.shape_factor, 0.4);
  EXPECT_EQ(i.initial.position, Vector3(3e-3, 0, 2e-3));
  EXPECT_EQ(i.initial.velocity, Vector3(-0.05, 0, 0));
  // Ω_y = v_x/R; at the phase of 90° the substrate is at its turning point, v_S = 0 up to cos(π/2).
  EXPECT_NEAR(i.initial.angular_velocity.y(), -25, 1e-12);

  EXPECT_EQ(scene.run.until, slipcheck::Run::Until::rolling);
  EXPECT_EQ(scene.run.limit, 1);
  EXPECT_EQ(scene.compare.reference, Compare::Reference::automatic);
  ASSERT_EQ(scene.compare.engines.size(), 2u);
  EXPECT_EQ(scene.compare.engines[0].rates, (std::vector<double>{60, 240, 1000}));
  EXPECT_EQ(scene.compare.engines[1].precision, EngineRequest::Precision::single_);
  EXPECT_EQ(scene.compare.engines[1].profile, "tuned");
  EXPECT_EQ(scene.compare.tolerance.at("sliding_time").value, 0.01);
  EXPECT_FALSE(scene.compare.tolerance.at("sliding_time").absolute);
  EXPECT_EQ(scene.compare.tolerance.at("effective_restitution").value, 0.005);
}

TEST(Load, TheDocumentationShowsThisExample) {
  const std::string document = test::text_of(SLIPCHECK_SOURCE_DIR "/docs/scenario-format.md");
  const std::string fence = "```yaml\n";
  std::size_t scenes = 0;
  for (std::size_t at = 0; (at = document.find(fence, at)) != std::string::npos;) {
    at += fence.size();
    const std::string block = document.substr(at, document.find("```", at) - at);
    if (!block.starts_with("slipcheck: 1")) continue;
    ++scenes;
    EXPECT_EQ(parse_scenario(block, "docs").title, parse_scenario(kExample, "s.yaml").title);
  }
  EXPECT_EQ(scenes, 1u);
}

TEST(Load, KnowsWhereEachKeyStands) {
  const Scenario scene = parse_scenario(kExample, "s.yaml");
  const Location model = scene.locations.at("contacts[0].normal.model");
  EXPECT_EQ(model.line, 13);
  EXPECT_EQ(model.column, 14);
  EXPECT_EQ(scene.locations.at("bodies[1]").line, 29);
  EXPECT_EQ(scene.locations.at("bodies[1].sphere.radius").column, 41);
  EXPECT_EQ(scene.file, "s.yaml");
}

TEST(Load, HashesTheBytesOfTheFile) {
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(parse_scenario("\xEF\xBB\xBF" + kHard, "s.yaml").sha256,
            sha256_hex("\xEF\xBB\xBF" + kHard));
}

TEST(Load, HasTheDefaultsOfTheStructs) {
  const Scenario scene = parse_scenario(kHard, "s.yaml");
  EXPECT_EQ(scene.gravity, Scenario{}.gravity);
  EXPECT_EQ(scene.run.limit, slipcheck::Run{}.limit);
  EXPECT_EQ(scene.substrate_contacts[0].friction.static_, 0.2);
  EXPECT_EQ(scene.substrate_contacts[0].friction.kinetic, 0.2);
  EXPECT_TRUE(scene.compare.engines.empty());
  EXPECT_TRUE(std::holds_alternative<StillMotion>(std::get<Substrate>(scene.surroundings).motion));
  EXPECT_EQ(scene.bodies[0].initial.velocity, Vector3(0, 0, 0));
}

TEST(Load, ReadsAContainer) {
  const Scenario scene = parse_scenario(kContainer, "s.yaml");
  const auto& box = std::get<Container>(scene.surroundings);
  EXPECT_EQ(box.width, 0.01);
  EXPECT_EQ(box.floor_amplitude, 0.0005);
  EXPECT_EQ(box.floor_frequency, 100);
  EXPECT_FALSE(box.height);
  EXPECT_EQ(scene.contacts[1].second, "floor");
  EXPECT_EQ(scene.bodies[0].initial.position, Vector3(0.002, 0, 0.003));
  EXPECT_EQ(scene.bodies[0].initial.angular_velocity, Vector3(0, 2, 0));
  EXPECT_EQ(scene.bodies[1].initial.velocity, Vector3(0.1, 0, 0.2));
  EXPECT_EQ(scene.run.until, slipcheck::Run::Until::time);
  EXPECT_DOUBLE_EQ(scene.run.time, 20);
  EXPECT_EQ(scene.run.periods, 2000);
  EXPECT_EQ(scene.run.discard, 500);
  EXPECT_TRUE(scene.run.sample_phase_zero);
}

TEST(Load, AcceptsByteOrderMarkAndWindowsLineEnds) {
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : kExample) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const Scenario scene = parse_scenario(windows, "s.yaml");
  EXPECT_EQ(scene.title, "Two rolling steel spheres collide head-on");
  EXPECT_EQ(scene.locations.at("contacts[0].normal.model").line, 13);
}

TEST(Load, ResolvesAliases) {
  std::string text = with(kHard, "sphere: {radius: 0.1}", "sphere: &ball {radius: 0.1}");
  text = with(text, "sphere: {radius: 0.1}", "sphere: *ball");
  EXPECT_EQ(parse_scenario(text, "s.yaml").bodies[1].sphere.radius, 0.1);
}

TEST(Load, ResolvesARollingBodyOnAMovingSubstrate) {
  // u = v + R k̂×Ω − v_S = 0 with v_S(0) = (0.5, 0): Ω_y = (v_x − 0.5)/R.
  std::string text =
      with(kHard, "substrate: {}", "substrate: {motion: {kind: constant, velocity: [0.5, 0]}}");
  text = with(text, "velocity: [-1, 0]", "velocity: [-1, 0], spin: rolling");
  EXPECT_DOUBLE_EQ(parse_scenario(text, "s.yaml").bodies[1].initial.angular_velocity.y(), -15);
  text = with(text, "{kind: constant, velocity: [0.5, 0]}",
              "{kind: table, table: [[-1, 0, 0], [1, 1, 0], [2, 0, 0]]}");
  EXPECT_DOUBLE_EQ(parse_scenario(text, "s.yaml").bodies[1].initial.angular_velocity.y(), -15);
}

TEST(Load, SiAndCgsGiveTheSameNumbers) {
  const char* const kBody = R"(
materials: {m: {density: @density, young_modulus: @young, poisson_ratio: 0.3}}
contacts:
  - between: [m, m]
    normal: {model: power, modulus: @modulus, viscosity: @viscosity, alpha: 1.5, gamma: 0.5}
    tangential: {model: asperity, roughness_factor: @rough, asperity_size: @length}
  - {between: [m, substrate], friction: 0.5, rolling: [[@speed, 0.1]], drilling: {model: coupled, contact_radius: @length}}
substrate: {periodic: [1e7, 1e7], motion: {kind: oscillate, amplitude: [@length, 0], frequency: 5, phase: 30}}
bodies:
  - {name: a, material: m, sphere: {radius: @length}, position: [@length, 0], velocity: [@speed, 0], spin: [1, 2, 3]}
  - {name: b, material: m, sphere: {radius: @length}, mass: @mass, position: [3, 3000], spin: rolling}
run: {until: 2}
)";
  const auto scene = [&](const char* units,
                         std::vector<std::pair<std::string, std::string>> values) {
    std::string text = std::string("slipcheck: 1\nname: n\ntitle: t\nunits: ") + units + kBody;
    for (const auto& [key, value] : values) {
      for (std::size_t at; (at = text.find("@" + key)) != std::string::npos;) {
        text.replace(at, key.size() + 1, value);
      }
    }
    return parse_scenario(text, "s.yaml");
  };
  const Scenario si = scene("si", {{"density", "7850"},
                                   {"young", "2.06e11"},
                                   {"modulus", "3e9"},
                                   {"viscosity", "50"},
                                   {"rough", "0.7"},
                                   {"length", "0.023"},
                                   {"speed", "0.17"},
                                   {"mass", "0.31"}});
  // N/m^1.5 = 1e5 dyn/(1e3 cm^1.5), N s/m^1.5 likewise, m^-0.5 = 0.1 cm^-0.5.
  const Scenario cgs = scene("cgs", {{"density", "7.85"},
                                     {"young", "2.06e12"},
                                     {"modulus", "3e11"},
                                     {"viscosity", "5000"},
                                     {"rough", "0.07"},
                                     {"length", "2.3"},
                                     {"speed", "17"},
                                     {"mass", "310"}});
  const Scenario text = scene("cgs", {{"density", "7.85 g/cm3"},
                                      {"young", "206 GPa"},
                                      {"modulus", "3e9 N/m^1.5"},
                                      {"viscosity", "50 N s/m^1.5"},
                                      {"rough", "0.7 m^-0.5"},
                                      {"length", "23 mm"},
                                      {"speed", "170 mm/s"},
                                      {"mass", "310 g"}});
  const auto values = [](const Scenario& from) {
    const auto& power = std::get<PowerNormal>(from.contacts[0].normal);
    const auto& asperity = std::get<AsperityTangential>(from.contacts[0].tangential);
    const auto& motion = std::get<OscillatingMotion>(std::get<Substrate>(from.surroundings).motion);
    const Body& a = from.bodies[0];
    return std::vector<double>{*from.materials.at("m").density,
                               *from.materials.at("m").young_modulus,
                               power.modulus,
                               power.viscosity.value(),
                               *asperity.roughness_factor,
                               *asperity.asperity_size,
                               from.substrate_contacts[0].rolling.table[0].first,
                               *from.substrate_contacts[0].drilling.contact_radius,
                               motion.amplitude.x(),
                               motion.frequency,
                               motion.phase,
                               a.sphere.radius,
                               a.sphere.mass,
                               a.initial.position.x(),
                               a.initial.position.z(),
                               a.initial.velocity.x(),
                               a.initial.angular_velocity.z(),
                               from.bodies[1].sphere.mass,
                               from.run.time};
  };
  for (std::size_t i = 0; i < values(si).size(); ++i) {
    EXPECT_NEAR(values(cgs)[i] / values(si)[i], 1, 1e-15) << i;
    EXPECT_NEAR(values(text)[i] / values(si)[i], 1, 1e-15) << i;
  }
}

// YAML 1.2, 5.7: \N is U+0085 and \_ is U+00A0, which yaml-cpp gives as one byte each.
TEST(Load, EscapesOfOneCharacterAreThatCharacter) {
  const Scenario scenario =
      parse_scenario(with(kHard, "title: ", R"(title: "\_a é\_\x41\u00e9 \N" #)"), "s.yaml");
  EXPECT_EQ(scenario.title, "\u00a0a \u00e9\u00a0A\u00e9 \xc2\x85");
  EXPECT_EQ(content_digest(scenario),
            content_digest(parse_scenario(
                with(kHard, "title: ", R"(title: "\xA0a é\u00A0Aé \x85" #)"), "s.yaml")));
}

}  // namespace
}  // namespace slipcheck
