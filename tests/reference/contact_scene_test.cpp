#include "scene/contact_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "../scenario/scenes.h"
#include "../support/runge_kutta.h"
#include "physics/contact/elastic_pair.h"
#include "physics/contact/linear_contact.h"
#include "scenario/fault.h"
#include "scene/impact.h"

namespace slipcheck {
namespace {

using testing::kExample;
using testing::kHard;
using testing::with;

const std::string kSteel =
    with(kHard, "{density: 7850}", "{density: 7850, young_modulus: 2e11, poisson_ratio: 0.3}");
const std::string kTangential = "{model: hard, friction: 0.1, tangential_restitution: 0.5}";

/// Two steel spheres with these models between them.
std::string pair_text(const std::string& normal, const std::string& tangential = "none") {
  return with(with(kSteel, "{model: hard, restitution: 0.9}", normal), kTangential, tangential);
}
/// Of 0.1 m and 0.05 m radius.
std::string unlike_text(const std::string& normal, const std::string& tangential = "none") {
  return with(pair_text(normal, tangential), "name: b, material: steel, sphere: {radius: 0.1}",
              "name: b, material: steel, sphere: {radius: 0.05}");
}
ContactScene scene_of(const std::string& text) {
  return make_contact_scene(parse_scenario(text, "s.yaml"));
}
double mass_of(const ContactScene& scene) {
  return effective_mass(scene.hard.bodies[0], scene.hard.bodies[1]);
}
template <class Force>
Force normal_of(const ContactScene& scene) {
  return std::get<Force>(scene.between(0, 1).value().normal);
}
std::string refusal(const std::string& text) {
  try {
    scene_of(text);
  } catch (const Unsupported& unsupported) {
    return unsupported.what();
  } catch (const BadScenario& bad) {
    return std::string("bad: ") + bad.what();
  }
  return "";
}

TEST(ContactScene, LinearHasWhatWasAskedForUnderBothEndRules) {
  for (const std::string end : {"zero_overlap", "zero_force"}) {
    for (const std::string one : {"restitution: 0.8", "damping_rate: 4000"}) {
      for (const std::string two : {"collision_time: 1e-4", "stiffness: 1e10"}) {
        const ContactScene scene = scene_of(
            unlike_text("{model: linear, " + one + ", " + two + ", ends_at: " + end + "}"));
        const SoftContact& soft = scene.between(0, 1).value();
        const double m = mass_of(scene);
        const auto force = std::get<LinearForce>(soft.normal);
        EXPECT_EQ(soft.end,
                  end == "zero_force" ? ContactEnd::zero_force : ContactEnd::zero_overlap);
        const Impact found = impact(soft.normal, m, 1, soft.end);
        if (one[0] == 'r') {
          EXPECT_NEAR(found.restitution, 0.8, 1e-10);
        } else {
          EXPECT_NEAR(force.damping, 4000 * m, 1e-9 * m);
        }
        if (two[0] == 'c') {
          EXPECT_NEAR(found.duration, 1e-4, 1e-13);
        } else {
          EXPECT_DOUBLE_EQ(force.stiffness, 1e10);
        }
        EXPECT_NEAR(std::get<double>(scene.hard.between(0, 1).restitution), found.restitution,
                    1e-10);
        EXPECT_FALSE(scene.is_hard());
      }
    }
  }
}

TEST(ContactScene, LinearMayBeOverCritical) {
  const std::string text = "{model: linear, damping_rate: 1e6, stiffness: 1e9, ends_at: ";
  const ContactScene stays = scene_of(pair_text(text + "zero_overlap}"));
  EXPECT_EQ(std::get<double>(stays.hard.between(0, 1).restitution), 0);
  const ContactScene ends = scene_of(pair_text(text + "zero_force}"));
  EXPECT_GT(std::get<double>(ends.hard.between(0, 1).restitution), 0);
}

TEST(ContactScene, HertzFromUnlikeMaterials) {
  std::string text = with(unlike_text("hertz"), "substrate: {}",
                          "  - {between: [glass, steel], normal: hertz}\n"
                          "  - {between: [glass, substrate]}\nsubstrate: {}");
  text = with(text, "contacts:",
              "  glass: {density: 2500, young_modulus: 7e10, poisson_ratio: 0.2}\ncontacts:");
  text = with(text, "name: b, material: steel", "name: b, material: glass");
  const ContactScene scene = scene_of(text);
  // (4/3) E* √R_eff, 1/E* = 0.91/2e11 + 0.96/7e10, R_eff = 1/30 m.
  const double modulus = 1 / (0.91 / 2e11 + 0.96 / 7e10);
  EXPECT_NEAR(normal_of<HertzForce>(scene).modulus / (4.0 / 3 * modulus * std::sqrt(1 / 30.0)), 1,
              1e-14);
  EXPECT_EQ(std::get<double>(scene.hard.between(0, 1).restitution), 1);
  EXPECT_EQ(std::get<double>(scene.hard.between(1, 0).restitution), 1);
}

TEST(ContactScene, ViscoelasticFromTimeOrViscosities) {
  const auto time = normal_of<ViscoelasticForce>(
      scene_of(pair_text("{model: viscoelastic, dissipation_time: 1e-6}")));
  EXPECT_EQ(time.dissipation_time, 1e-6);
  EXPECT_NEAR(time.modulus / (2 * 2e11 * std::sqrt(0.05) / (3 * 0.91)), 1, 1e-14);
  const auto viscous = normal_of<CompactViscoelasticForce>(
      scene_of(pair_text("{model: viscoelastic, viscosity: [0, 3e5], form: compact}")));
  // B (23) corrected, with η1 = 0: η2 (1 + ν)(1 − 2ν)²/(Y (1 − ν)).
  EXPECT_NEAR(viscous.dissipation_time / (3e5 * 1.3 * 0.16 / (2e11 * 0.7)), 1, 1e-14);
}

TEST(ContactScene, RestitutionAtASpeedHoldsForEveryPairOfBodies) {
  const std::vector<std::string> models = {"power, modulus: 1e10, alpha: 1.5, gamma: 0.5",
                                           "power, modulus: 1e10, alpha: 1.5, gamma: 0",
                                           "viscoelastic", "viscoelastic, form: compact"};
  for (const std::string& model : models) {
    for (const std::string end : {"zero_overlap", "zero_force"}) {
      const ContactScene scene = scene_of(unlike_text(
          "{model: " + model + ", restitution: 0.7, at_speed: 20 cm/s, ends_at: " + end + "}"));
      ASSERT_EQ(scene.hard.substrate.size(), 2u);
      for (const std::size_t i : {0u, 1u}) {
        for (const std::size_t j : {0u, 1u}) {
          const SoftContact& soft = scene.between(i, j).value();
          const double m = effective_mass(scene.hard.bodies[i], scene.hard.bodies[j]);
          EXPECT_NEAR(impact(soft.normal, m, 0.2, soft.end).restitution, 0.7, 1e-9);
          EXPECT_NEAR(restitution_at(scene.hard.between(i, j).restitution, 0.2), 0.7, 1e-6);
          // At another speed the engines get what the law gives there.
          EXPECT_NEAR(restitution_at(scene.hard.between(i, j).restitution, 3),
                      impact(soft.normal, m, 3, soft.end).restitution, 1e-6);
        }
      }
    }
  }
}

TEST(ContactScene, RestitutionOutOfReachIsABadScenario) {
  EXPECT_EQ(refusal(pair_text(
                "{model: viscoelastic, restitution: 1e-6, at_speed: 1, ends_at: zero_force}")),
            "bad: s.yaml:8:35: contacts[0].normal.restitution: must be in [9.736e-05, 1] at 1 m/s, "
            "got 1e-06");
}

TEST(ContactScene, ViscousDampingByRateOrRatio) {
  const std::string normal = "{model: linear, damping_rate: 3000, stiffness: 1e10}";
  const ContactScene rate =
      scene_of(unlike_text(normal, "{model: viscous, damping_rate: 500, friction: 0.3}"));
  const auto force = std::get<ViscousForce>(rate.between(0, 1)->tangential);
  EXPECT_NEAR(force.damping / (500 * mass_of(rate)), 1, 1e-14);
  EXPECT_EQ(force.friction, 0.3);
  const ContactScene ratio =
      scene_of(unlike_text(normal, "{model: viscous, damping_ratio: 0.5, friction: 0.3}"));
  EXPECT_NEAR(
      std::get<ViscousForce>(ratio.between(0, 1)->tangential).damping / (1500 * mass_of(ratio)), 1,
      1e-14);
}

/// Slip of two free spheres after F = −c u acted on both for a time, by Runge-Kutta.
double slip_left(const Sphere& a, const Sphere& b, double damping, double time) {
  using State = Eigen::Vector4d;  // velocities, surface velocities from the spins
  const auto slope = [&](double, const State& s) {
    const double force = -damping * (s[0] + s[2] - s[1] - s[3]);
    return State(force / a.mass, -force / b.mass, force / (a.shape_factor * a.mass),
                 -force / (b.shape_factor * b.mass));
  };
  const State y = test::integrate(slope, State(1, 0, 0, 0), 0, time, 2000);
  return y[0] + y[2] - y[1] - y[3];
}

TEST(ContactScene, ViscousEquivalentLeavesTheSlipThatTheForceLeaves) {
  const std::string tangential = "{model: viscous, damping_rate: 2000, friction: 0.3}";
  for (const std::string normal : {"{model: linear, restitution: 0.9, collision_time: 1e-4}",
                                   "hertz", "{model: linear, damping_rate: 1e6, stiffness: 1e9}"}) {
    const ContactScene scene =
        scene_of(with(unlike_text(normal, tangential), "sphere: {radius: 0.1}",
                      "sphere: {radius: 0.1, inertia: shell}"));
    const SoftContact& soft = scene.between(0, 1).value();
    const double duration = impact(soft.normal, mass_of(scene), 1, soft.end).duration;
    const double left = std::isinf(duration) ? 0
                                             : slip_left(scene.hard.bodies[0], scene.hard.bodies[1],
                                                         2000 * mass_of(scene), duration);
    const PairContact& hard = scene.hard.between(0, 1);
    // The duration is known to 1e-8.
    EXPECT_NEAR(hard.tangential_restitution, -left, 1e-7) << normal;
    EXPECT_EQ(hard.friction, 0.3);
  }
  const ContactScene smooth =
      scene_of(pair_text("hertz", "{model: viscous, damping_rate: 0, friction: 0.3}"));
  EXPECT_EQ(smooth.hard.between(0, 1).tangential_restitution, -1);
}

TEST(ContactScene, RollingResistanceOfUnlikeSpheres) {
  const std::string normal = "{model: linear, stiffness: 1e6, damping_rate: 10}";
  for (const std::string stiffness : {"stiffness_ratio: 0.5", "stiffness: 5e5"}) {
    const ContactScene scene = scene_of(
        with(unlike_text(normal), "tangential: none",
             "tangential: none\n    rolling: {friction: 0.1, " + stiffness + ", damping: 0.3}"));
    const SpringTorque made = scene.between(0, 1).value().memory.value().rolling;
    // k_r R_eff², μ_r R_eff, and of critical damping 2 √(k I) of both inertias in series.
    const double radius = 1 / (1 / 0.1 + 1 / 0.05);
    const auto inertia = [](double r) { return 0.4 * 7850 * 4.0 / 3 * M_PI * std::pow(r, 5); };
    const double both = inertia(0.1) * inertia(0.05) / (inertia(0.1) + inertia(0.05));
    const double k = 5e5 * radius * radius;
    EXPECT_NEAR(made.stiffness / k, 1, 1e-14);
    EXPECT_NEAR(made.damping / (0.3 * 2 * std::sqrt(k * both)), 1, 1e-14);
    EXPECT_NEAR(made.length, 0.1 * radius, 1e-16);
  }
}

TEST(ContactScene, HardContactOfASpringLeavesTheSlipThatTheOscillatorLeaves) {
  // m_t u̇ = −k_t s − c u, ṡ = u for the time of a contact; critical at 8337/s.
  for (const std::string rate : {"0", "4000", "8337", "4e4"}) {
    const ContactScene scene = scene_of(
        pair_text("{model: linear, restitution: 0.8, collision_time: 1e-4}",
                  "{model: spring, stiffness: 1e9, damping_rate: " + rate + ", friction: 0.1}"));
    const SpringFriction made = scene.between(0, 1).value().memory.value().sliding;
    const double mass = mass_of(scene) / 3.5;  // of solid spheres
    EXPECT_NEAR(made.damping, std::stod(rate) * mass_of(scene), 1e-12 * made.damping);
    const auto slope = [&](double, const Eigen::Vector2d& s) {
      return Eigen::Vector2d(s[1], -(1e9 * s[0] + made.damping * s[1]) / mass);
    };
    const Eigen::Vector2d end = test::integrate(slope, Eigen::Vector2d(0, 1), 0, 1e-4, 2000);
    // The duration is known to 1e-8.
    EXPECT_NEAR(scene.hard.between(0, 1).tangential_restitution, -end[1], 1e-7) << rate;
  }
}

TEST(ContactScene, AsperitiesByFrictionOrRoughness) {
  const auto asperity = [](const std::string& keys) {
    const ContactScene scene = scene_of(pair_text("hertz", "{model: asperity, " + keys + "}"));
    return std::pair(std::get<AsperityForce>(scene.between(0, 1)->tangential),
                     scene.hard.between(0, 1));
  };
  const auto [one, hard] = asperity("friction: 0.3, asperity_size: 1 um, form: passive");
  EXPECT_EQ(one.friction, 0.3);
  EXPECT_EQ(one.size, 1e-6);
  EXPECT_EQ(one.form, AsperityForce::Form::passive);
  EXPECT_EQ(hard.friction, 0.15);
  EXPECT_EQ(hard.tangential_restitution, 0);
  // μ = α √ζ0 with ζ0 = 2e-4 · 0.05 m and α = 1 cm^−1/2: √(1e-3).
  const auto [two, unused] =
      asperity("roughness_factor: 1 cm^-0.5, asperity_size: {relative: 2e-4}");
  EXPECT_DOUBLE_EQ(two.size, 1e-5);
  EXPECT_DOUBLE_EQ(two.friction, std::sqrt(1e-3));
  EXPECT_EQ(two.form, AsperityForce::Form::printed);
}

TEST(ContactScene, ClassesDivideOnlyWhatDependsOnTheBodies) {
  const std::string hard = with(kSteel, "name: b, material: steel, sphere: {radius: 0.1}",
                                "name: b, material: steel, sphere: {radius: 0.05}");
  EXPECT_EQ(scene_of(hard).hard.substrate.size(), 1u);
  EXPECT_TRUE(scene_of(hard).is_hard());
  EXPECT_EQ(scene_of(pair_text("hertz")).hard.substrate.size(), 1u);
  const ContactScene unlike = scene_of(unlike_text("hertz"));
  EXPECT_EQ(unlike.hard.substrate.size(), 2u);
  EXPECT_EQ(unlike.soft.size(), 4u);
  EXPECT_EQ(std::get<HertzForce>(unlike.between(0, 1)->normal).modulus,
            std::get<HertzForce>(unlike.between(1, 0)->normal).modulus);
  EXPECT_EQ(scene_of(with(pair_text("hertz"), "sphere: {radius: 0.1}",
                          "sphere: {radius: 0.1, inertia: shell}"))
                .hard.substrate.size(),
            2u);
}

TEST(ContactScene, HardScenesAreThoseOfTheEventSolver) {
  const Scenario scenario = parse_scenario(kHard, "s.yaml");
  const ContactScene scene = make_contact_scene(scenario);
  EXPECT_TRUE(scene.is_hard());
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_EQ(std::get<double>(scene.hard.between(0, 1).restitution), 0.9);
}

// --- normal: {model: hard, restitution: viscoelastic} --------------------------------------------

const std::string kHardViscoelastic =
    with(with(kHard, "{density: 7850}",
              "{density: 917, young_modulus: 1e10, poisson_ratio: 0.3, dissipation_time: 2e-5}"),
         "restitution: 0.9", "restitution: viscoelastic");

TEST(ContactScene, HardViscoelasticRestitutionIsB24) {
  const ContactScene scene =
      scene_of(with(kHardViscoelastic, "name: b, material: steel, sphere: {radius: 0.1}",
                    "name: b, material: steel, sphere: {radius: 0.05}"));
  EXPECT_TRUE(scene.is_hard());
  ASSERT_EQ(scene.hard.substrate.size(), 2u);
  const ElasticMaterial ice{1e10, 0.3};
  const double rho =
      hertz_modulus(ice, ice, effective_radius(scene.hard.bodies[0], scene.hard.bodies[1]));
  for (const double v : {1e-9, 1e-4, 0.01, 1.0, 30.0, 1e5}) {
    EXPECT_NEAR(restitution_at(scene.hard.between(0, 1).restitution, v),
                impact(ViscoelasticForce{rho, 2e-5}, mass_of(scene), v, ContactEnd::zero_overlap)
                    .restitution,
                1e-6);
  }
  EXPECT_EQ(scene.hard.between(0, 1).friction, 0.1);
}

TEST(ContactScene, HardViscoelasticNeedsDissipationTimes) {
  EXPECT_EQ(refusal(with(kHardViscoelastic, ", dissipation_time: 2e-5", "")),
            "s.yaml:8:27: contacts[0].normal.restitution: can only be solved with "
            "materials.steel.dissipation_time, got viscoelastic");
}

// --- surroundings --------------------------------------------------------------------------------

TEST(ContactScene, TakesTiltMotionCoupledDrillingAndRollingWhileSliding) {
  const ContactScene scene = scene_of(kExample);
  EXPECT_NEAR(scene.hard.gravity, 9.81 * std::cos(5 * M_PI / 180), 1e-14);
  EXPECT_NEAR(scene.hard.downhill.y(), -9.81 * std::sin(5 * M_PI / 180), 1e-14);
  EXPECT_EQ(scene.hard.downhill.x(), 0);
  // 1 mm sin(2π 5 t + 90°).
  EXPECT_NEAR(scene.hard.motion.position(0).x(), 1e-3, 1e-18);
  EXPECT_NEAR(scene.hard.motion.position(0.1).x(), -1e-3, 1e-17);
}

TEST(ContactScene, TakesPeriodicSubstrates) {
  EXPECT_TRUE(scene_of(kHard).hard.periodic.isZero(0));
  const Scene scene =
      scene_of(with(with(kHard, "substrate: {}", "substrate: {periodic: [3, 800 mm]}"),
                    "position: [1, 0]", "position: [-100, 7.4]"))
          .hard;
  EXPECT_EQ(scene.periodic, Vector2(3, 0.8));
  EXPECT_EQ(scene.initial[1].position, Vector3(-100, 7.4, 0.1));  // where the file has it
  EXPECT_FALSE(scene.box);
}

TEST(ContactScene, MayBeAskedForByName) {
  EXPECT_EQ(refusal(kHard + "compare: {reference: contact}\n"), "");
}

// --- warnings ------------------------------------------------------------------------------------

TEST(ContactScene, WarnsOfImpactsThatAreNotQuasistatic) {
  // Transversal sound in steel: √(2e11/(2 7850 1.3)) = 3130 m/s, a hundredth of which is allowed.
  const std::string fast = with(pair_text("hertz"), "velocity: [-1, 0]", "velocity: [-100, 0]");
  EXPECT_EQ(
      scene_of(fast).warnings,
      std::vector<std::string>{"s.yaml:8:13: contacts[0].normal.model: impacts at up to 100 m/s "
                               "are 0.032 of the transversal speed of sound; the law holds where "
                               "the square of that is far below 1 (B B11)"});
  const auto at = [&](const char* speed) {
    return scene_of(with(pair_text("hertz"), "velocity: [-1, 0]", speed)).warnings.size();
  };
  EXPECT_EQ(at("velocity: [-31.2, 0]"), 0u);
  EXPECT_EQ(at("velocity: [-31.4, 0]"), 1u);
  EXPECT_TRUE(scene_of(pair_text("hertz")).warnings.empty());
  // The same in another law, which is not B's.
  EXPECT_TRUE(scene_of(with(pair_text("{model: linear, restitution: 1, stiffness: 1e9}"),
                            "velocity: [-1, 0]", "velocity: [-100, 0]"))
                  .warnings.empty());
}

TEST(ContactScene, WarnsOfImpactsDeeperThanARadius) {
  // m̄ v²/2 = k ξ²/2 with m̄ = 16.4 kg: ξ = 0.128 m at 1 m/s, of R = 0.1 m.
  const auto warnings = [](const std::string& stiffness) {
    return scene_of(pair_text("{model: linear, restitution: 1, stiffness: " + stiffness + "}"))
        .warnings;
  };
  ASSERT_EQ(warnings("1e3").size(), 1u);
  EXPECT_EQ(warnings("1e3")[0].find("s.yaml:8:14: contacts[0].normal.model: impacts at up to 1 m/s "
                                    "go 1.3 of the smaller radius deep"),
            0u)
      << warnings("1e3")[0];
  EXPECT_TRUE(warnings("1e4").empty());
}

TEST(ContactScene, RefusesDampingBesideWhichThereIsNoSpring) {
  EXPECT_EQ(refusal(pair_text("{model: linear, damping_rate: 1e30, collision_time: 1e-4}")),
            "bad: s.yaml:8:29: contacts[0].normal.damping_rate: must leave a restitution > 0: "
            "exp(-damping_rate collision_time/2), with 0.0001 s, got 1e+30 /s");
  // ω0 = √(k/m̄) with k = 1e10 N/m, m̄ = 16.44 kg: 24663 /s; times 6.7e7 that is 1.65e12 /s.
  const auto damped = [](const std::string& rate) {
    return refusal(pair_text("{model: linear, damping_rate: " + rate + ", stiffness: 1e10}"));
  };
  EXPECT_EQ(damped("1.6e12"), "");
  EXPECT_EQ(damped("1e30"),
            "bad: s.yaml:8:29: contacts[0].normal.damping_rate: must damp at a rate of at most "
            "1.65e+12 /s, 6.7e+07 over the time of an impact; beyond that the elastic force is "
            "lost in rounding, got a rate of 1e+30 /s");
  const auto rubbed = [](const std::string& rate) {
    return refusal(pair_text("{model: linear, restitution: 0.9, stiffness: 1e10}",
                             "{model: viscous, friction: 0.5, damping_rate: " + rate + "}"));
  };
  EXPECT_EQ(rubbed("1.6e12"), "");
  EXPECT_NE(rubbed("1e30").find("contacts[0].tangential.damping_rate: must damp"),
            std::string::npos);
  EXPECT_NE(refusal(pair_text("{model: viscoelastic, dissipation_time: 1e30}"))
                .find("contacts[0].normal.dissipation_time: must damp"),
            std::string::npos);
}

TEST(ContactScene, RefusesASpringThatStopsNothing) {
  // At 1 m/s an overlap of √(m̄/k) with m̄ = 16.44 kg, and R = 0.1 m: 2e5 m for k = 4.11e-10 N/m.
  const auto of_stiffness = [](const std::string& stiffness) {
    return refusal(pair_text("{model: linear, restitution: 0.9, stiffness: " + stiffness + "}"));
  };
  EXPECT_EQ(of_stiffness("4.2e-10"), "");
  EXPECT_EQ(of_stiffness("1.644e-23"),
            "bad: s.yaml:8:47: contacts[0].normal.stiffness: must be stiff enough to stop bodies "
            "that meet at 1 m/s within 2e+05 m, 1e+06 times the sum of their radii, got an overlap "
            "of 1e+12 m");
  EXPECT_NE(refusal(pair_text("{model: power, alpha: 1.5, modulus: 1e-23, viscosity: 0}"))
                .find("contacts[0].normal.modulus: must be stiff enough"),
            std::string::npos);
}

TEST(ContactScene, WarnsOfADissipationTimeNearTheDuration) {
  const auto warnings = [](const std::string& time) {
    return scene_of(pair_text("{model: viscoelastic, dissipation_time: " + time + "}")).warnings;
  };
  EXPECT_TRUE(warnings("1e-6").empty());
  const ElasticMaterial steel{2e11, 0.3};
  const Sphere ball{0.1, 7850 * 4 / 3.0 * M_PI * 1e-3};
  const double duration = hertz_duration(ball.mass / 2, hertz_modulus(steel, steel, 0.05), 1);
  ASSERT_EQ(warnings("1e-3").size(), 1u);
  std::array<char, 200> expected{};
  std::snprintf(expected.data(), expected.size(),
                "the dissipation time 0.001 s is %.2g of an impact's duration %.3g s",
                1e-3 / duration, duration);
  EXPECT_NE(warnings("1e-3")[0].find(expected.data()), std::string::npos) << warnings("1e-3")[0];
  const std::string hard = with(kHardViscoelastic, "2e-5", "1e-2");
  ASSERT_EQ(scene_of(hard).warnings.size(), 1u);
  EXPECT_EQ(scene_of(hard).warnings[0].find("s.yaml:8:27: contacts[0].normal.restitution: the "),
            0u);
}

TEST(ContactScene, WarnsOfPrintedAsperities) {
  const std::string asperity = "{model: asperity, friction: 0.1, asperity_size: {relative: 2e-4}}";
  const std::vector<std::string> warnings = scene_of(pair_text("hertz", asperity)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].find("s.yaml:9:5: contacts[0].tangential.form: the printed law can create "
                             "energy in impacts faster than "),
            0u)
      << warnings[0];
  EXPECT_TRUE(
      scene_of(pair_text("hertz", with(asperity, "}}", "}, form: passive}"))).warnings.empty());
  EXPECT_TRUE(scene_of(pair_text("hertz", with(asperity, "0.1", "0"))).warnings.empty());
}

}  // namespace
}  // namespace slipcheck
