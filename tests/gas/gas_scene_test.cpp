#include <gtest/gtest.h>

#include "../support/bundled.h"
#include "../support/refusal.h"
#include "gases.h"
#include "reference/pair/pair_batch.h"
#include "scene/contact_scene.h"
#include "scene/scene.h"
#include "studies/gas/gas_of_scene.h"

namespace slipcheck {
namespace {

TEST(GasOfScene, HardContactsAreTakenAsTheyAre) {
  const GasOfScene rolling = gas_of_scene(test::bundled("gas-rolling"));
  EXPECT_EQ(std::get<double>(rolling.law.hard.restitution), 0.9);
  EXPECT_FALSE(rolling.law.rough());
  EXPECT_EQ(rolling.sphere.radius, 2e-3);
  EXPECT_NEAR(rolling.speed, 0.2, 1e-15);
  EXPECT_EQ(rolling.speed_exponent, 0);

  const GasOfScene sticking = gas_of_scene(test::bundled("rough-sticking"));
  EXPECT_TRUE(sticking.law.rough() && sticking.law.constant());
  EXPECT_EQ(sticking.law.hard.friction, 0.3);
  EXPECT_EQ(sticking.law.hard.tangential_restitution, 0.4);

  EXPECT_FALSE(gas_of_scene(test::bundled("ice-bridges")).speed_exponent);
}

TEST(GasOfScene, ViscoelasticLawsAreTheirRestitutionOverTheSpeed) {
  const GasOfScene hard = gas_of_scene(test::bundled("ice-hard-viscoelastic"));
  EXPECT_FALSE(hard.soft);
  EXPECT_EQ(hard.speed_exponent, 0.2);
  const GasOfScene soft = gas_of_scene(test::bundled("ice-viscoelastic"));
  EXPECT_TRUE(soft.soft);
  EXPECT_FALSE(soft.law.rough());
  EXPECT_NEAR(*soft.speed_exponent, 0.2, 1e-15);
  EXPECT_NEAR(soft.law.at(0.01, 0).restitution, 0.32, 1e-5);  // at_speed of the file
}

TEST(GasOfScene, AsperitiesAndRubbingAreTheirMap) {
  for (const char* name : {"asperities-break", "asperities-passive", "haff-werner"}) {
    const Scenario scenario = test::bundled(name);
    const GasOfScene gas = gas_of_scene(scenario, 0.1);
    ASSERT_TRUE(gas.law.map) << name;
    EXPECT_TRUE(gas.law.rough());
    const SoftContact contact = *make_contact_scene(scenario).between(0, 0);
    // ε^T has corners where asperities break and where the cap begins to hold: in the mean the map
    // is right to a hundredth, and twice as many points make it better.
    std::vector<double> normal, tangential;
    for (int k = 0; k < 400; ++k) {
      normal.push_back(0.02 * std::exp(0.00713 * k));
      tangential.push_back(0.02 * std::exp(3 * std::fmod(0.618034 * k, 1.0)));
    }
    std::vector<PairCollision> out(normal.size());
    collide_batch(contact, gas.sphere, gas.sphere, normal, tangential, 256, out);
    const auto mean_error = [&](const PairMap& map) {
      double sum = 0;
      for (std::size_t k = 0; k < out.size(); ++k) {
        const PairMap::Restitution both = map.at(normal[k], tangential[k]);
        EXPECT_NEAR(both.normal, out[k].normal_restitution, 1e-3);
        sum += std::abs(both.tangential - out[k].tangential_restitution);
      }
      return sum / static_cast<double>(out.size());
    };
    const double error = mean_error(*gas.law.map);
    EXPECT_LT(error, 0.01) << name;
    EXPECT_LT(mean_error(PairMap(contact, gas.sphere, 1e-3, 1, 32)), 0.8 * error + 1e-6) << name;
  }
}

TEST(GasOfScene, GasOfAsperitiesCoolsAndSpins) {
  const GasOfScene gas = gas_of_scene(test::bundled("asperities-break"), 0.1);
  GasOptions options;
  options.setup.sphere = gas.sphere;
  options.setup.speed = 0.1;
  options.setup.particles = 8000;
  options.collisions = 20;
  const GasRun run = run_gas(options, gas.law);
  EXPECT_GT(run.samples.back().rotation.value, 0);
  const GasStatement cooling = test::stated(run, test::kCooling)[0];
  // a_2 and correlations are not in the mean field: some per cent.
  EXPECT_NEAR(cooling.measured.value, cooling.theory,
              4 * cooling.measured.error + 0.05 * cooling.theory);
}

TEST(GasOfScene, BodyThatMeetsNoneOfItsKindIsNoGas) {
  const std::string text = R"(slipcheck: 1
name: alone
title: One ball
materials:
  steel: {density: 7850}
contacts:
  - between: [steel, substrate]
    friction: 0.1
substrate: {}
bodies:
  - {name: i, material: steel, sphere: {radius: 0.01}, position: [0, 0]}
run: {until: 1}
)";
  const std::vector<Fault> faults =
      test::faults_of([&] { gas_of_scene(parse_scenario(text, "alone.yaml")); });
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(
      faults[0].message(),
      "alone.yaml:6:1: contacts: must have one between steel and steel: a gas is of the first "
      "body's kind");
}

}  // namespace
}  // namespace slipcheck
