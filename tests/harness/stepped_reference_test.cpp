#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "harness/reference_run.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

ReferenceResult reference(const Scenario& scenario, const ReferenceSettings& settings) {
  const ContactScene scene = make_contact_scene(scenario);
  return run_reference(ReferenceSolver(scene, settings), run_end(scenario), body_names(scenario));
}

class SteppedReference : public testing::TestWithParam<const char*> {};

/// What steps of fixed length say of their own error covers the distance to the integrator's result
/// at 1e-13, which has an error of its own.
TEST_P(SteppedReference, CoversTheTruthByItsUncertainty) {
  const Scenario scenario =
      load_scenario(SLIPCHECK_SOURCE_DIR "/scenarios/" + std::string(GetParam()) + ".yaml");
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

INSTANTIATE_TEST_SUITE_P(All, SteppedReference,
                         testing::Values("rubbing-uncapped", "rubbing-capped", "oblique-resolved",
                                         "clamped-contact", "hertz-10cms", "jump-resolved"),
                         [](const auto& each) {
                           std::string name = each.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace slipcheck
