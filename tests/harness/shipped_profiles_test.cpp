// What the profiles shipped with Bullet promise, on the bundled collision scenes, over 64 phases.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "../support/bundled.h"
#include "../support/extremes.h"
#include "harness/run/scene_run.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

/// Steps per second, 60 Hz to 16 kHz.
const std::vector<double> kRates = {60, 120, 240, 1000, 4000, 16000};
#ifdef SLIPCHECK_SANITIZE
constexpr std::size_t kPhases = 8;  // the same code, an eighth as often
#else
constexpr std::size_t kPhases = 64;
#endif

SceneRecord run(const std::string& scene, const std::string& profile) {
  setenv("SLIPCHECK_ENGINE_PATH", SLIPCHECK_BINARY_DIR, 1);
  Scenario scenario = test::bundled(scene);
  EngineRequest request;
  request.engine = "bullet";
  request.profile = profile;
  request.rates = kRates;
  scenario.compare.engines = {request};
  RunOptions options;
  options.phases = kPhases;
  return run_scenes({scenario}, options).front();
}

double value_of(const SceneRecord& scene, const std::string& name) {
  const auto found = scene.reference.observables.find(name);
  return found == scene.reference.observables.end() ? 0 : found->second.value;
}

/// The worst of all phases, absolute; infinite where a phase does not show it.
double worst(const SceneRecord& scene, const EngineRecord& run, const std::string& name) {
  const EnsembleValue& seen = run.observables.at(name);
  if (seen.missing > 0) return INFINITY;
  const double exact = value_of(scene, name);
  return test::largest_of(std::abs(seen.max - exact), std::abs(seen.min - exact));
}

class TunedCollision : public ::testing::TestWithParam<const char*> {};

// e_eff within 0.001, t^s within a step, s within 1 % and the way of a step at the larger of the
// speeds before and after sliding. Balls that roll towards each other at 60 Hz come nearer by up to
// 2.5 radii in a step; steps end at contacts, and so that is no limit.
TEST_P(TunedCollision, IsRightInEveryPhaseAtEveryRate) {
  const SceneRecord scene = run(GetParam(), "tuned");
  ASSERT_EQ(scene.runs.size(), kRates.size());
  for (const EngineRecord& record : scene.runs) {
    SCOPED_TRACE(record.rate);
    ASSERT_EQ(record.status, EngineRecord::Status::ok) << record.reason;
    EXPECT_EQ(record.phases, kPhases);
    EXPECT_LE(worst(scene, record, "i-j.effective_restitution"), 0.001);
    for (const std::string body : {"i", "j"}) {
      EXPECT_LE(worst(scene, record, body + ".sliding_time"), 1 / record.rate);
      const double speed = std::max(value_of(scene, body + ".velocity_after_collision"),
                                    value_of(scene, body + ".rolling_velocity"));
      const double exact = value_of(scene, body + ".sliding_distance");
      EXPECT_LE(worst(scene, record, body + ".sliding_distance"),
                0.01 * exact + speed / record.rate);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, TunedCollision,
                         ::testing::Values("symmetric-30cms", "symmetric-10cms", "asymmetric",
                                           "oblique", "target-at-rest"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(ShippedProfiles, DefaultIsFarOffWhereTunedIsNot) {
  const SceneRecord scene = run("symmetric-30cms", "default");
  for (const EngineRecord& record : scene.runs) {
    if (record.rate < 240) continue;  // some phases pass through each other
    EXPECT_GT(worst(scene, record, "i-j.effective_restitution"), 0.1) << record.rate;
  }
}

}  // namespace
}  // namespace slipcheck
