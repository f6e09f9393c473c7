#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../reference/random_scene.h"
#include "../reference/soft_scenes.h"
#include "../support/bundled.h"
#include "harness/run/engine_run.h"
#include "harness/run/reference_run.h"
#include "reference/reference_solver.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

using test::bundled;

ReferenceResult reference(const Scenario& scenario, const ReferenceSettings& settings) {
  const ContactScene scene = make_contact_scene(scenario);
  return run_reference(ReferenceSolver(scene, settings), run_end(scenario), body_names(scenario));
}

class SteppedScene : public testing::TestWithParam<const char*> {};

/// What steps of fixed length say of their own error covers the distance to the integrator's result
/// at 1e-13, which has an error of its own.
TEST_P(SteppedScene, CoversTheTruthByItsUncertainty) {
  const Scenario scenario = bundled(GetParam());
  ReferenceSettings settings = reference_settings(scenario);
  settings.asked = Compare::Reference::contact;
  const ReferenceResult truth = reference(scenario, settings);
  settings.asked = Compare::Reference::steps;
  const ReferenceResult steps = reference(scenario, settings);
  EXPECT_EQ(steps.solver, "steps");
  EXPECT_EQ(steps.run.collisions, truth.run.collisions);
  std::size_t compared = 0;
  for (const auto& [name, value] : steps.observables) {
    ASSERT_TRUE(truth.observables.contains(name)) << name;
    const UncertainValue& exact = truth.observables.at(name);
    EXPECT_LE(std::abs(value.value - exact.value), value.uncertainty + exact.uncertainty)
        << name << " " << value.value << " " << exact.value;
    compared += exact.value != 0;
  }
  EXPECT_GT(compared, 5u);
}

INSTANTIATE_TEST_SUITE_P(All, SteppedScene,
                         testing::Values("rubbing-uncapped", "rubbing-capped", "oblique-resolved",
                                         "clamped-contact", "hertz-10cms", "jump-resolved"),
                         [](const auto& each) {
                           std::string name = each.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// Three balls of which two fly at the third, spinning, rubbing and hopping.
ContactScene random_impacts(unsigned seed) {
  test::Random random(seed);
  Scene hard = test::steel_scene(3);
  hard.pairs[0].restitution = random(0.3, 0.95);
  hard.substrate[0].kinetic_friction = random(0.02, 0.5);
  hard.substrate[0].static_friction = hard.substrate[0].kinetic_friction + random(0, 0.2);
  hard.substrate[0].restitution = random(0, 0.9);
  hard.confined = random.chance(0.3);
  for (std::size_t i = 1; i < 3; ++i) {
    const double angle = random(0, M_PI) + (i == 1 ? 0 : M_PI);
    const Vector3 out(std::cos(angle), std::sin(angle), 0);
    hard.initial[i].position += random(0.0045, 0.01) * out;
    hard.initial[i].velocity = -random(0.05, 0.5) * out;
    hard.initial[i].angular_velocity = {random(-60, 60), random(-60, 60), random(-60, 60)};
  }
  const double collision_time = std::pow(10, random(-4, -2.7));
  return test::soft(
      hard, collision_time, ContactEnd::zero_force,
      ViscousForce{hard.bodies[0].mass / 2 * random(0.1, 1) / collision_time, random(0, 0.6)});
}

#ifdef SLIPCHECK_SANITIZE
constexpr unsigned kImpacts = 10;
#else
constexpr unsigned kImpacts = 60;
#endif

/// Of any scenes: two runs have the same error by chance now and then.
TEST(SteppedReference, CoversNearlyAllValuesOfRandomImpacts) {
  std::size_t values = 0, beyond = 0, unknown = 0;
  for (unsigned seed = 0; seed < kImpacts; ++seed) {
    const ContactScene scene = random_impacts(seed);
    const auto observables = [&](Compare::Reference asked) {
      return run_reference(ReferenceSolver(scene, asked), until_time(0.15), {"i", "j", "k"})
          .observables;
    };
    const auto truth = observables(Compare::Reference::contact);
    for (const auto& [name, value] : observables(Compare::Reference::steps)) {
      if (value.uncertainty == 0) continue;  // never moved, in all runs
      ++values;
      unknown += std::isinf(value.uncertainty);
      const UncertainValue* exact = find_in(truth, name);
      // What is not there is covered by no uncertainty but an infinite one.
      if (!exact || std::abs(value.value - exact->value) > value.uncertainty + exact->uncertainty)
        beyond += !std::isinf(value.uncertainty);
    }
  }
  EXPECT_GT(values, 60 * kImpacts);
  const auto all = static_cast<double>(values);
  EXPECT_LT(static_cast<double>(beyond), 0.01 * all);
  EXPECT_LT(static_cast<double>(unknown), 0.01 * all);
}

std::string solver_of(const Scenario& scenario, Compare::Reference asked) {
  const ContactScene scene = make_contact_scene(scenario);
  return ReferenceSolver(scene, asked).name();
}

TEST(SteppedReference, IsChosenWhereTheIntegratorWouldNotDo) {
  using Reference = Compare::Reference;
  EXPECT_EQ(solver_of(bundled("gas-soft"), Reference::automatic), "steps");
  // Bodies' images across the edges are nothing that the integrator knows.
  EXPECT_THROW(solver_of(bundled("gas-soft"), Reference::contact), Unsupported);
  EXPECT_EQ(solver_of(bundled("gas-rolling"), Reference::automatic), "event");
  EXPECT_EQ(solver_of(bundled("rubbing-capped"), Reference::automatic), "contact");
  // Hard contacts happen at an instant.
  EXPECT_THROW(solver_of(bundled("symmetric-30cms"), Reference::steps), Unsupported);
  Scenario many = bundled("rubbing-capped");
  Body body = many.bodies[1];
  for (int k = 0; k < 199; ++k) {
    body.name = "k" + std::to_string(k);
    body.initial.position.x() += 5 * body.sphere.radius;
    many.bodies.push_back(body);
  }
  EXPECT_EQ(solver_of(many, Reference::automatic), "steps");
}

TEST(SteppedReference, BoxesHaveNone) {
  const Scenario scenario = bundled("box-viscoelastic");
  const ContactScene scene = make_contact_scene(scenario);
  EXPECT_THROW(ReferenceSolver(scene, {.asked = Compare::Reference::steps}), Unsupported);
}

/// 7 phases on 3 workers and on one: the same phases in the same order, each once.
TEST(PhaseShares, CoverAllPhasesInOrder) {
  for (const std::size_t phases : {1, 7, 32})
    for (const std::size_t workers : {1, 3, 100}) {
      const std::vector<PhaseShare> shares = phase_shares(phases, workers);
      EXPECT_EQ(shares.size(), std::min(phases, workers));
      std::size_t next = 0;
      for (const PhaseShare& share : shares) {
        EXPECT_EQ(share.first, next);
        EXPECT_GT(share.last, share.first);
        next = share.last;
      }
      EXPECT_EQ(next, phases);
    }
}

}  // namespace
}  // namespace slipcheck
