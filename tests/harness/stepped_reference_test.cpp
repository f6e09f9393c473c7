#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

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
