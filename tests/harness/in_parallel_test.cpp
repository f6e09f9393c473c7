#include "base/in_parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "../support/bundled.h"
#include "../support/refusal.h"
#include "harness/run/scene_run.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

constexpr std::size_t kCalls = 100;

TEST(InParallel, EachIsCalledOnceOnAnyNumberOfThreads) {
  for (const std::size_t threads : {0, 1, 3, 200}) {
    std::vector<std::size_t> calls(kCalls);
    in_parallel(kCalls, threads, [&](std::size_t k) { ++calls[k]; });
    EXPECT_EQ(calls, std::vector<std::size_t>(kCalls, 1)) << threads;
  }
}

TEST(InParallel, TheLowestFailureIsThrownAfterAllTheRest) {
  for (const std::size_t threads : {1, 4}) {
    std::atomic<std::size_t> calls = 0;
    const auto fail = [&](std::size_t k) {
      ++calls;
      if (k % 10 == 7) throw std::runtime_error(std::to_string(k));
    };
    EXPECT_EQ(test::refusal_of<std::runtime_error>([&] { in_parallel(kCalls, threads, fail); }),
              "7");
    EXPECT_EQ(calls, kCalls);
  }
}

std::vector<SceneRecord> run(const std::vector<std::string>& names, std::size_t workers) {
  setenv("SLIPCHECK_ENGINE_PATH", SLIPCHECK_BINARY_DIR, 1);
  std::vector<Scenario> scenarios(names.size());
  in_parallel(names.size(), workers,
              [&](std::size_t k) { scenarios[k] = test::bundled(names[k]); });
  RunOptions options;
  options.phases = 5;
  options.workers = workers;
  return run_scenes(std::move(scenarios), options);
}

/// A phase that does not show an observable has NaN in both.
bool same_bits(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// Scenes and shares of their phases on several threads give, bit for bit, what each scene gives
/// alone.
TEST(InParallel, ScenesTogetherAreAsAlone) {
  const std::vector<std::string> names = {"symmetric-30cms", "slide-to-roll", "slope-rolls"};
  const std::vector<SceneRecord> together = run(names, 4);
  ASSERT_EQ(together.size(), names.size());
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::vector<SceneRecord> alone = run({names[k]}, 1);
    const auto& observables = together[k].reference.observables;
    EXPECT_FALSE(observables.empty()) << names[k];
    ASSERT_EQ(observables.size(), alone[0].reference.observables.size()) << names[k];
    for (const auto& [name, measured] : alone[0].reference.observables)
      EXPECT_EQ(observables.at(name).value, measured.value) << names[k] << ": " << name;
    ASSERT_EQ(together[k].runs.size(), alone[0].runs.size()) << names[k];
    for (std::size_t r = 0; r < alone[0].runs.size(); ++r) {
      const EngineRecord &one = alone[0].runs[r], &same = together[k].runs[r];
      EXPECT_EQ(one.status, EngineRecord::Status::ok) << names[k] << ": " << one.reason;
      EXPECT_EQ(same.status, one.status) << names[k] << ": " << same.reason;
      ASSERT_EQ(same.observables.size(), one.observables.size()) << names[k];
      for (const auto& [name, ensemble] : one.observables)
        EXPECT_TRUE(
            std::ranges::equal(same.observables.at(name).values, ensemble.values, same_bits))
            << names[k] << ": " << name;
    }
  }
}

}  // namespace
}  // namespace slipcheck
