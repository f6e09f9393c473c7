#include <cmath>
#include <numbers>

#include "../scenario/scenes.h"
#include "../support/refusal.h"
#include "scene/contact_scene.h"

namespace slipcheck {
namespace {

using testing::kContainer;
using testing::kExample;
using testing::kHard;
using testing::with;

Scene hard_scene(const std::string& text) {
  return make_contact_scene(parse_scenario(text, "s.yaml")).hard;
}

std::string refusal(const std::string& text) {
  return test::refusal_of<Unsupported>([&] { hard_scene(text); });
}

TEST(Scene, HasTheNumbersOfTheScenario) {
  const Scene scene = hard_scene(with(kHard, "friction: 0.2",
                                      "friction: {static: 0.3, kinetic: 0.2}\n"
                                      "    rolling: [[0, 0.1], [1, 0.2]]\n"
                                      "    drilling: {model: uncoupled, contact_radius: 0.003}\n"
                                      "    restitution: 0.4"));
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.bodies[0].radius, 0.1);
  EXPECT_EQ(scene.initial[1].velocity, Vector3(-1, 0, 0));
  EXPECT_EQ(scene.gravity, 9.80665);
  EXPECT_FALSE(scene.confined);
  const SubstrateContact& ground = scene.on_substrate(0);
  EXPECT_EQ(ground.static_friction, 0.3);
  EXPECT_EQ(ground.kinetic_friction, 0.2);
  EXPECT_EQ(ground.restitution, 0.4);
  ASSERT_EQ(ground.rolling.points().size(), 2u);
  EXPECT_EQ(ground.rolling.points()[1].coefficient, 0.2);
  EXPECT_DOUBLE_EQ(ground.drilling_length, 2.0 / 3 * 0.2 * 0.003);
  const PairContact& pair = scene.between(0, 1);
  EXPECT_EQ(std::get<double>(pair.restitution), 0.9);
  EXPECT_EQ(pair.friction, 0.1);
  EXPECT_EQ(pair.tangential_restitution, 0.5);
}

TEST(Scene, WithoutTangentialModelIsSmooth) {
  const Scene scene =
      hard_scene(with(kHard, "{model: hard, friction: 0.1, tangential_restitution: 0.5}", "none"));
  EXPECT_EQ(scene.between(0, 1).friction, 0);
  EXPECT_EQ(scene.between(0, 1).tangential_restitution, -1);
}

TEST(Scene, PassesThePowerLawOn) {
  const Scene scene =
      hard_scene(with(kHard, "restitution: 0.9", "restitution: {bridges: {speed: 2 cm/s}}"));
  EXPECT_EQ(std::get<PowerLawRestitution>(scene.between(0, 1).restitution).speed, 0.02);
}

TEST(Scene, SplitsAMaterialWhereTheContactRadiusIsHertzian) {
  std::string text =
      with(kHard, "{density: 7850}", "{density: 7850, young_modulus: 2e11, poisson_ratio: 0.3}");
  text = with(text, "friction: 0.2",
              "friction: 0.2\n    drilling: {model: uncoupled, contact_radius: hertz}");
  EXPECT_EQ(hard_scene(text).substrate.size(), 1u);
  text = with(text, "radius: 0.1", "radius: 0.2");
  const Scene scene = hard_scene(text);
  ASSERT_EQ(scene.substrate.size(), 2u);
  for (const std::size_t i : {0u, 1u}) {
    // Hertz, sphere on a rigid plane: F = (4/3) E* a³/R with E* = Y/(1 − ν²).
    const Sphere& sphere = scene.bodies[i];
    const double a = scene.on_substrate(i).drilling_length / (3 * std::numbers::pi / 16 * 0.2);
    const double force = 4.0 / 3 * 2e11 / (1 - 0.09) * a * a * a / sphere.radius;
    EXPECT_NEAR(force / (sphere.mass * 9.80665), 1, 1e-14);
  }
  for (const std::size_t i : {0u, 1u}) {
    for (const std::size_t j : {0u, 1u}) EXPECT_EQ(scene.between(i, j).friction, 0.1);
  }
}

TEST(Scene, NeedsNoPairContactForASingleBody) {
  std::string text =
      with(kHard,
           "  - between: [steel, steel]\n    normal: {model: hard, restitution: 0.9}\n"
           "    tangential: {model: hard, friction: 0.1, tangential_restitution: 0.5}\n",
           "");
  text = with(text,
              "  - {name: b, material: steel, sphere: {radius: 0.1}, position: [1, 0], velocity: "
              "[-1, 0]}\n",
              "");
  EXPECT_EQ(hard_scene(text).between(0, 0).friction, 0);
}

TEST(Scene, GravityIsTurnedByTheTilt) {
  const Scene level = hard_scene(kHard);
  EXPECT_EQ(level.downhill, Vector2(0, 0));
  const Scene scene = hard_scene(with(kHard, "substrate: {}", "substrate: {tilt: 30}"));
  EXPECT_NEAR(scene.gravity, 9.80665 * std::sqrt(0.75), 1e-14);
  EXPECT_NEAR(scene.downhill.y(), -9.80665 / 2, 1e-14);
  EXPECT_EQ(scene.downhill.x(), 0);
}

TEST(Scene, PassesEveryMotionOn) {
  const auto motion = [](const std::string& keys) {
    return hard_scene(with(kHard, "substrate: {}", "substrate: {motion: {kind: " + keys + "}}"))
        .motion;
  };
  EXPECT_TRUE(motion("still").is_still());
  EXPECT_TRUE(motion("constant, velocity: [0, 0]").is_still());
  EXPECT_EQ(motion("constant, velocity: [1, 2]").velocity(5), Vector3(1, 2, 0));
  // 0.1 sin(2π 5 t + 90°) = 0.1 cos(10π t).
  const SubstrateMotion wave = motion("oscillate, amplitude: [0.1, 0], frequency: 5, phase: 90");
  EXPECT_NEAR(wave.position(0.02).x(), 0.1 * std::cos(0.2 * std::numbers::pi), 1e-15);
  const SubstrateMotion table = motion("table, table: [[0, 0, 0], [2, 1, 0]]");
  EXPECT_EQ(table.velocity(1), Vector3(0.5, 0, 0));
  EXPECT_EQ(table.velocity(3), Vector3(0, 0, 0));
}

TEST(Scene, CoupledDrillingHasItsDiscAndTheLengthOfPureDrilling) {
  const auto ground = [](const std::string& keys) {
    return hard_scene(with(with(kHard, "{density: 7850}",
                                "{density: 7850, young_modulus: 2e11, poisson_ratio: 0.3}"),
                           "friction: 0.2", "friction: 0.2\n    drilling: " + keys))
        .on_substrate(0);
  };
  const SubstrateContact uniform = ground("{model: coupled, contact_radius: 1 mm}");
  EXPECT_EQ(uniform.coupled_radius, 1e-3);
  EXPECT_FALSE(uniform.hertzian_pressure);
  EXPECT_DOUBLE_EQ(uniform.drilling_length, 2.0 / 3 * 0.2 * 1e-3);
  const SubstrateContact hertzian = ground("{model: coupled, contact_radius: hertz}");
  EXPECT_TRUE(hertzian.hertzian_pressure);
  EXPECT_DOUBLE_EQ(hertzian.drilling_length,
                   3 * std::numbers::pi / 16 * 0.2 * hertzian.coupled_radius);
  const SubstrateContact uncoupled = ground("{model: uncoupled, contact_radius: hertz}");
  EXPECT_EQ(uncoupled.coupled_radius, 0);
  EXPECT_DOUBLE_EQ(uncoupled.drilling_length, hertzian.drilling_length);
  EXPECT_EQ(ground("none").drilling_length, 0);
}

TEST(Scene, HertzianRadiusFollowsTheNormalPartOfGravity) {
  const std::string text = with(
      with(kHard, "{density: 7850}", "{density: 7850, young_modulus: 2e11, poisson_ratio: 0.3}"),
      "friction: 0.2", "friction: 0.2\n    drilling: {model: uncoupled, contact_radius: hertz}");
  const double level = hard_scene(text).on_substrate(0).drilling_length;
  const double tilted = hard_scene(with(text, "substrate: {}", "substrate: {tilt: 60}"))
                            .on_substrate(0)
                            .drilling_length;
  EXPECT_NEAR(tilted / level, std::cbrt(0.5), 1e-14);
}

TEST(Scene, RollingWhileSliding) {
  const auto ground = [](const std::string& rolling) {
    return hard_scene(with(kHard, "friction: 0.2", "friction: 0.2\n    rolling: " + rolling))
        .on_substrate(0)
        .rolling_while_sliding;
  };
  EXPECT_TRUE(ground("{coefficient: 0.1, while_sliding: true}"));
  EXPECT_FALSE(ground("{coefficient: 0, while_sliding: true}"));  // nothing to leave in
  EXPECT_FALSE(ground("{coefficient: 0.1}"));
}

TEST(Scene, NamesAllThatItCannotSolve) {
  std::string text = with(kContainer, "{density: 7850}",
                          "{density: 7850, young_modulus: 2e11, poisson_ratio: 0.3}");
  for (int i = 0; i < 2; ++i) text = with(text, "restitution: 0.9", "restitution: viscoelastic");
  EXPECT_EQ(refusal(text),
            "s.yaml:7:53: contacts[0].normal.restitution: can only be solved with "
            "materials.steel.dissipation_time, got viscoelastic\n"
            "s.yaml:8:53: contacts[1].normal.restitution: can only be solved with "
            "materials.steel.dissipation_time, got viscoelastic");
}

TEST(Scene, TakesAllSurroundings) {
  EXPECT_EQ(refusal(with(kHard, "substrate: {}", "substrate: {periodic: [9, 9]}")), "");
  EXPECT_EQ(refusal(with(kHard, "substrate: {}", "substrate: {confined: true}")), "");
  EXPECT_EQ(refusal(kHard + "compare: {reference: contact}\n"), "");
  EXPECT_EQ(refusal(kContainer), "");
}

}  // namespace
}  // namespace slipcheck
