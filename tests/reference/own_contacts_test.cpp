#include "scene/own_contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "../support/refusal.h"
#include "engine/engine_scene.h"
#include "physics/contact/elastic_pair.h"
#include "reference/piles/pile_solver.h"
#include "reference/reference_solver.h"
#include "reference/steps/step_solver.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

/// Spheres of two materials and of drawn radii, which a floor that swings drives together.
Scenario drawn(const std::string& normal, const std::string& tangential, int count = 20) {
  const std::string model = "    normal: " + normal + "\n    tangential: " + tangential + "\n";
  const std::string side = std::to_string(30 * std::sqrt(count / 20.0)) + " mm";
  const std::string fill =
      ", radius: {uniform: [1 mm, 2 mm]}, area: [0, 0, " + side + ", " + side + "]";
  return parse_scenario(
      "slipcheck: 1\nname: drawn\ntitle: t\ngravity: 9.81\nmaterials:\n"
      "  steel: {density: 7850, young_modulus: 2e8, poisson_ratio: 0.3}\n"
      "  glass: {density: 2500, young_modulus: 6e7, poisson_ratio: 0.2}\n"
      "contacts:\n  - between: [steel, steel]\n" +
          model + "  - between: [steel, glass]\n" + model + "  - between: [glass, glass]\n" +
          model +
          "  - {between: [steel, substrate], friction: 0.1}\n"
          "  - {between: [glass, substrate], friction: 0.3}\n"
          "substrate: {motion: {kind: oscillate, amplitude: [5 mm, 0], frequency: 10}}\n"
          "fill:\n  - {prefix: s, material: steel, seed: 1, speed: 0.3, count: " +
          std::to_string(count) + fill +
          "}\n  - {prefix: g, material: glass, seed: 2, speed: 0.3, count: " +
          std::to_string(count) + fill + "}\nrun: {until: 20 ms}\ncompare: {engines: []}\n",
      "s.yaml");
}

const std::vector<std::string> kNormals = {
    "{model: linear, restitution: 0.7, collision_time: 2e-4}",
    "{model: linear, damping_rate: 500, stiffness: 1e5, ends_at: zero_force}",
    "{model: hertz}",
    "{model: power, modulus: 1e8, alpha: 1.5, gamma: 0.5, restitution: 0.8, at_speed: 0.1}",
    "{model: viscoelastic, restitution: 0.8, at_speed: 0.1}",
};
const std::string kViscous = "{model: viscous, damping_rate: 3000, friction: 0.2}";
const std::string kSpring = "{model: spring, stiffness_ratio: 0.3, friction: 0.2}";

void expect_same(const std::vector<BodyState>& a, const std::vector<BodyState>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].position, b[i].position) << i;
    ASSERT_EQ(a[i].velocity, b[i].velocity) << i;
    ASSERT_EQ(a[i].angular_velocity, b[i].angular_velocity) << i;
  }
}

TEST(OwnContacts, AreTheContactsOfTheTable) {
  for (const std::string& normal : kNormals) {
    SCOPED_TRACE(normal);
    const Scenario scenario = drawn(normal, kViscous);
    const ContactScene table = make_contact_scene(scenario), own = make_contact_scene(scenario, 3);
    ASSERT_FALSE(table.own);
    ASSERT_TRUE(own.own);
    EXPECT_EQ(own.soft.size(), 4u);
    EXPECT_EQ(table.soft.size(), 1600u);
    EXPECT_EQ(own.warnings, table.warnings);
    for (std::size_t i = 0; i < 40; ++i)
      for (std::size_t j = 0; j < 40; ++j) {
        if (i == j) continue;
        const SoftContact a = table.contact_of(i, j).value(), b = own.contact_of(i, j).value();
        EXPECT_EQ(normal_force(a.normal, 1e-5, 0.1), normal_force(b.normal, 1e-5, 0.1));
        EXPECT_EQ(a.end, b.end);
        EXPECT_EQ(std::get<ViscousForce>(a.tangential).damping,
                  std::get<ViscousForce>(b.tangential).damping);
      }
  }
}

TEST(OwnContacts, OfOneCollisionTimeAreStiffAsTheirMassesAsk) {
  const ContactScene own = make_contact_scene(drawn(kNormals[0], kViscous), 3);
  for (std::size_t i = 1; i < 40; ++i) {
    // Half a period: π/√(k/m − (γ/2)²) = t_col, with γ t_col/2 = −ln e.
    const double m = effective_mass(own.hard.bodies[0], own.hard.bodies[i]);
    const auto force = std::get<LinearForce>(own.contact_of(0, i)->normal);
    EXPECT_NEAR(force.stiffness, m * (std::pow(M_PI, 2) + std::pow(std::log(0.7), 2)) / 4e-8,
                1e-13 * force.stiffness);
  }
}

/// A hard contact of one restitution is of no two bodies' own.
TEST(OwnContacts, LeaveHardOnesInTheTable) {
  Scenario scenario = drawn(kNormals[0], kViscous);
  scenario.contacts[1].normal = HardNormal{0.6};
  scenario.contacts[1].tangential = NoTangential{};
  const ContactScene own = make_contact_scene(scenario, 3);
  ASSERT_TRUE(own.own);
  EXPECT_TRUE(own.contact_of(0, 1));
  EXPECT_FALSE(own.contact_of(0, 20));
  EXPECT_EQ(std::get<double>(own.hard.between(0, 20).restitution), 0.6);
}

TEST(OwnContacts, OfStepsGiveTheBitsOfTheTable) {
  for (const std::string& normal : kNormals) {
    SCOPED_TRACE(normal);
    const Scenario scenario = drawn(normal, kViscous);
    const ContactScene table = make_contact_scene(scenario), own = make_contact_scene(scenario, 3);
    const double step = ReferenceSolver(table, Compare::Reference::steps).step();
    // Of two pairs of one collision time, whose integrated one is good to 1e-6.
    EXPECT_NEAR(ReferenceSolver(own, Compare::Reference::steps).step(), step, 1e-6 * step);
    StepSolver in_table(table, table.hard.initial, {.step = step, .general = true});
    StepSolver by_own(own, own.hard.initial, {.step = step, .general = true});
    const SolvedRun a = in_table.run(until_time(0.02), nullptr);
    const SolvedRun b = by_own.run(until_time(0.02), nullptr);
    ASSERT_TRUE(a.reached && b.reached) << a.reason << b.reason;
    EXPECT_GT(a.collisions, 10u);
    EXPECT_EQ(a.collisions, b.collisions);
    expect_same(in_table.states(), by_own.states());
    EXPECT_EQ(in_table.energy(), by_own.energy());
  }
}

/// Of few that are far apart none is near another for a while.
TEST(OwnContacts, AreMadeOnceBodiesComeNear) {
  const Scenario scenario = drawn(kNormals[0], kViscous, 2);
  ContactScene table = make_contact_scene(scenario), own = make_contact_scene(scenario, 3);
  ASSERT_TRUE(own.own);
  for (Scene* scene : {&table.hard, &own.hard}) {
    scene->confined = true;
    for (std::size_t i = 0; i < 4; ++i)
      scene->initial[i] = {{i < 2 ? 0.025 * static_cast<double>(i) : 0,
                            i < 2 ? 0 : static_cast<double>(i), scene->bodies[i].radius},
                           {i == 0 ? 2.0 : 0, 0, 0},
                           Vector3::Zero()};
  }
  const StepSettings settings{.step = 1e-6, .general = true, .most_in_all_pairs = 2};
  StepSolver in_table(table, table.hard.initial, settings);
  StepSolver by_own(own, own.hard.initial, settings);
  const SolvedRun a = in_table.run(until_time(0.02), nullptr);
  const SolvedRun b = by_own.run(until_time(0.02), nullptr);
  EXPECT_EQ(a.collisions, 1u);
  EXPECT_EQ(b.collisions, 1u);
  expect_same(in_table.states(), by_own.states());
}

TEST(OwnContacts, AreFoundAgainByARunThatGoesOn) {
  const ContactScene own = make_contact_scene(drawn(kNormals[0], kViscous), 3);
  const StepSettings settings{.step = ReferenceSolver(own, Compare::Reference::steps).step()};
  StepSolver through(own, own.hard.initial, settings), first(own, own.hard.initial, settings),
      second(own, own.hard.initial, settings);
  ASSERT_TRUE(first.run(until_time(0.01), nullptr).reached);
  StateArchive written;
  first.exchange(written);
  const std::string bytes = written.take();
  StateArchive read(bytes);
  second.exchange(read);
  read.finish();
  ASSERT_TRUE(second.run(until_time(0.02), nullptr).reached);
  ASSERT_TRUE(through.run(until_time(0.02), nullptr).reached);
  expect_same(through.states(), second.states());
}

TEST(OwnContacts, OfPilesGiveTheBitsOfTheTable) {
  const Scenario scenario = drawn(kNormals[0], kSpring);
  const ContactScene table = make_contact_scene(scenario), own = make_contact_scene(scenario, 3);
  const PileSettings settings{.collision_time = 1e-4};
  PileSolver in_table(table, table.hard.initial, settings);
  PileSolver by_own(own, own.hard.initial, settings);
  EXPECT_EQ(in_table.step(), by_own.step());
  const SolvedRun a = in_table.run(until_time(0.02), nullptr);
  const SolvedRun b = by_own.run(until_time(0.02), nullptr);
  ASSERT_TRUE(a.reached && b.reached) << a.reason << b.reason;
  EXPECT_GT(a.collisions, 10u);
  expect_same(in_table.states(), by_own.states());
}

TEST(OwnContacts, AreSolvedInStepsAlone) {
  const ContactScene own = make_contact_scene(drawn(kNormals[0], kViscous), 3);
  EXPECT_STREQ(ReferenceSolver(own, Compare::Reference::steps).name(), "steps");
  for (const auto asked : {Compare::Reference::contact, Compare::Reference::event}) {
    ReferenceSettings settings;
    settings.asked = asked;
    EXPECT_EQ(test::refusal_of<Unsupported>([&] { ReferenceSolver(own, settings); }),
              "bodies of so many sizes that each two have a contact of their own are solved in "
              "steps alone, and not in a container; compare.reference may be steps");
  }
  EXPECT_EQ(test::refusal_of<Unsupported>([&] { EngineScene scene(own); }),
            "no engine is given bodies that have each two a contact of their own");
}

TEST(OwnContacts, AreThereBeyondATableOf300Sizes) {
  EXPECT_FALSE(has_own_contacts(drawn(kNormals[0], kViscous, 150)));
  EXPECT_TRUE(has_own_contacts(drawn(kNormals[0], kViscous, 151)));
  EXPECT_FALSE(has_own_contacts(drawn("{model: hard, restitution: 0.8}", "none", 151)));
  EXPECT_FALSE(make_contact_scene(drawn(kNormals[0], kViscous, 150)).own);
  EXPECT_TRUE(make_contact_scene(drawn(kNormals[0], kViscous, 151)).own);
}

TEST(OwnContacts, AreNotMadeOfHardOnes) {
  Scenario scenario = drawn("{model: hard, restitution: viscoelastic}", "none", 1);
  for (const char* name : {"steel", "glass"}) scenario.materials[name].dissipation_time = 1e-6;
  const Body body = scenario.bodies.front();
  scenario.bodies.assign(2001, body);
  for (std::size_t i = 0; i < 2001; ++i)
    scenario.bodies[i].sphere.radius *= 1 + 1e-6 * static_cast<double>(i);
  EXPECT_EQ(test::refusal_of<Unsupported>([&] { make_contact_scene(scenario); }),
            "s.yaml:9:5: contacts[0]: can only be solved with bodies of at most 2000 sizes, masses "
            "and shapes where contacts tell them apart and are not all soft, got 2001 of them");
}

}  // namespace
}  // namespace slipcheck
