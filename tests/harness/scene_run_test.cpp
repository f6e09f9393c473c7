#include "harness/run/scene_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "../support/bundled.h"
#include "../support/refusal.h"
#include "engine/profile.h"
#include "scenario/fault.h"
#include "scenario/load.h"
#include "scene/scene.h"

namespace slipcheck {
namespace {

using test::use_test_engines;

std::string pair_scene(const std::string& engines, double speed = 15) {
  return R"(slipcheck: 1
name: pair
title: A pair
units: cgs
gravity: 981
materials: {steel: {density: 7.85}}
contacts:
  - {between: [steel, steel], normal: {model: hard, restitution: 0.9}, tangential: {model: none}}
  - {between: [steel, substrate], friction: {static: 0.5, kinetic: 0.1}}
substrate: {}
bodies:
  - {name: i, material: steel, sphere: {radius: 0.2}, position: [-0.95, 0], velocity: [)" +
         std::to_string(speed) + R"(, 0], spin: rolling}
  - {name: j, material: steel, sphere: {radius: 0.2}, position: [0.95, 0], velocity: [)" +
         std::to_string(-speed) + R"(, 0], spin: rolling}
run: {until: rolling, limit: 5}
compare:
  engines: [)" +
         engines +
         R"(]
  tolerance: {effective_restitution: 0.005, sliding_time: 1 %}
)";
}

std::vector<SceneRecord> run(const std::string& text, std::size_t phases = 8) {
  use_test_engines();
  RunOptions options;
  options.phases = phases;
  options.time_limit = 60;
  options.limits.reply = 10;
  return run_scenes({parse_scenario(text, "scene.yaml")}, options);
}

TEST(SceneRun, AnOverlapAtTheStartIsRunOnce) {
  // Bullet pushes an overlap ξ out with the velocity erp2 ξ/dt, here 0.2 · 5 mm · 240 Hz.
  use_test_engines();
  RunOptions options;
  options.phases = 8;
  const auto scenes = run_scenes({test::bundled("extreme/overlap-start-half")}, options);
  EXPECT_EQ(scenes[0].reference.first_contact, 0);
  const EngineRecord& engine = scenes[0].runs[0];
  EXPECT_EQ(engine.phases, 1u);
  EXPECT_NEAR(engine.observables.at("j.velocity_after_collision").median, 0.12, 1e-6);
  EXPECT_FALSE(engine.observables.contains("i-j.restitution"));
  ASSERT_FALSE(engine.warnings.empty());
  EXPECT_EQ(engine.warnings.back(),
            "the first contact is there from the start: it has one phase only");
}

/// Balls in an elastic gas that runs for 300 years.
std::string endless_scene() {
  return R"(slipcheck: 1
name: endless
title: A gas for ever
materials: {m: {density: 1000}}
contacts:
  - {between: [m, m], normal: {model: hard, restitution: 1}}
  - {between: [m, substrate]}
substrate: {periodic: [1, 1]}
fill: {prefix: g, count: 20, material: m, radius: 0.01, area: [0, 0, 1, 1], speed: 1}
run: {until: 1e10}
compare: {engines: []}
)";
}

TEST(SceneRun, AReferenceOutOfTimeEndsItselfAndNotTheOthers) {
  use_test_engines();
  RunOptions options;
  options.phases = 1;
  options.time_limit = 0.5;
  const auto scenes = run_scenes(
      {parse_scenario(endless_scene(), "endless.yaml"),
       parse_scenario(pair_scene("{engine: bullet, precision: double, rate: 240}"), "pair.yaml")},
      options);
  ASSERT_EQ(scenes.size(), 2u);
  const ReferenceResult& endless = scenes[0].reference;
  EXPECT_TRUE(endless.run.failed);
  EXPECT_FALSE(endless.run.reached);
  EXPECT_EQ(endless.run.reason, "took longer than the time limit of 0.5 s (--time-limit)");
  EXPECT_EQ(endless.warnings,
            std::vector<std::string>{"the run did not end: " + endless.run.reason});
  EXPECT_TRUE(endless.observables.empty());
  // (2.5 e_n − 1)/3.5 of two that roll towards each other, and an engine beside it.
  EXPECT_NEAR(scenes[1].reference.observables.at("i-j.effective_restitution").value, 1.25 / 3.5,
              1e-12);
  EXPECT_EQ(scenes[1].runs.at(0).status, EngineRecord::Status::ok);
}

/// In which a reference of two balls has an end, also where each access is looked at.
#ifdef SLIPCHECK_SANITIZE
constexpr std::chrono::milliseconds kLongEnough{4000};
#else
constexpr std::chrono::milliseconds kLongEnough{300};
#endif

TEST(SceneRun, InterruptedItKeepsWhatIsFinished) {
  use_test_engines();
  std::atomic<bool> stop = false;
  RunOptions options;
  options.phases = 1;
  options.workers = 2;
  options.stop = &stop;
  const std::jthread user([&] {
    std::this_thread::sleep_for(kLongEnough);
    stop = true;
  });
  const auto scenes = run_scenes(
      {parse_scenario(pair_scene("{engine: bullet, precision: double, rate: 240}"), "pair.yaml"),
       parse_scenario(endless_scene(), "endless.yaml")},
      options);
  EXPECT_TRUE(scenes.at(0).reference.run.reached);
  EXPECT_EQ(scenes[0].runs.at(0).status, EngineRecord::Status::skipped);
  EXPECT_EQ(scenes[0].runs[0].reason, "interrupted");
  EXPECT_EQ(scenes[1].reference.run.reason, "interrupted");
}

TEST(SceneRun, BulletsRestitutionIsALotteryOverThePhases) {
  // Measured for Bullet 3.24 with its default settings in SI, double precision, 64 phases: e_eff
  // from 0.358 to 0.498 at 240 Hz and at 16 kHz alike, 56 of 64 phases more than 5 % off. The first
  // and the last of 64 strata are up to 2/64 of the lottery's 0.143 away from its ends.
  const auto scenes =
      run(pair_scene("{engine: bullet, precision: double, rate: [240, 16000]}"), 64);
  ASSERT_EQ(scenes[0].runs.size(), 2u);
  for (const EngineRecord& record : scenes[0].runs) {
    ASSERT_EQ(record.status, EngineRecord::Status::ok) << record.reason;
    EXPECT_EQ(record.phases, 64u);
    EXPECT_EQ(record.version, "3.24");
    EXPECT_GT(record.cpu_seconds, 0);
    const EnsembleValue& e_eff = record.observables.at("i-j.effective_restitution");
    EXPECT_NEAR(e_eff.min, 0.358, 0.0045);
    EXPECT_NEAR(e_eff.max, 0.498, 0.0045);
    const EnsembleValue& e_n = record.observables.at("i-j.restitution");
    EXPECT_NEAR(e_n.min, 0.900, 0.00625);
    EXPECT_NEAR(e_n.max, 1.098, 0.00625);
    int off = 0;
    for (double value : e_eff.values) off += std::abs(value / (1.25 / 3.5) - 1) > 0.05;
    EXPECT_NEAR(off, 56, 2);
  }
  EXPECT_EQ(scenes[0].verdict(), Verdict::deviates);
}

TEST(SceneRun, BelowBulletsThresholdRestitutionIsLost) {
  const auto scenes =
      run(pair_scene("{engine: bullet, precision: double, rate: [240, 16000]}", 5), 64);
  for (const EngineRecord& record : scenes[0].runs) {
    const EnsembleValue& e_n = record.observables.at("i-j.restitution");
    EXPECT_GE(e_n.min, -1e-9);
    EXPECT_LE(e_n.min, 0.2 / 16);
    EXPECT_LE(e_n.max, 0.2 + 1e-9);
    EXPECT_GE(e_n.max, 0.19);
  }
}

TEST(SceneRun, AKilledWorkerLeavesEveryOtherRunIntact) {
  const std::string healthy = "{engine: bullet, precision: double, rate: [240, 1000]}";
  const auto alone = run(pair_scene(healthy));
  const auto beside =
      run(pair_scene("{engine: faulty, precision: double, profile: kill-at-step-10,"
                     " rate: 240}, " +
                     healthy + ", {engine: faulty, precision: double, profile: hang, rate: 60}"));
  const auto& runs = beside[0].runs;
  ASSERT_EQ(runs.size(), 4u);
  EXPECT_EQ(runs[0].status, EngineRecord::Status::crashed);
  EXPECT_NE(runs[0].reason.find("killed by signal 9"), std::string::npos) << runs[0].reason;
  EXPECT_EQ(runs[3].status, EngineRecord::Status::timed_out) << runs[3].reason;
  for (std::size_t k : {0u, 1u}) {
    const EngineRecord &a = alone[0].runs[k], &b = runs[k + 1];
    ASSERT_EQ(b.status, EngineRecord::Status::ok);
    ASSERT_EQ(a.observables.size(), b.observables.size());
    for (const auto& [name, value] : a.observables)
      EXPECT_EQ(value.median, b.observables.at(name).median) << name;
  }
  EXPECT_EQ(beside[0].verdict(), Verdict::failed);
}

TEST(SceneRun, NanStatesAreUnstable) {
  const auto scenes =
      run(pair_scene("{engine: faulty, precision: double, profile: nan, rate: 240}"));
  EXPECT_EQ(scenes[0].runs[0].status, EngineRecord::Status::unstable);
  EXPECT_NE(scenes[0].runs[0].reason.find("not finite"), std::string::npos);
}

TEST(SceneRun, WhatAnEngineIsKnownToDoIsWithin) {
  // The lottery's e_eff goes up to 0.498; the last of 8 strata ends there and is 0.143/8 wide.
  const auto known = run(pair_scene(
      "{engine: bullet, precision: double, rate: 240, expect: "
      "{i-j.effective_restitution: {max: [0.475, 0.505]}}},"
      "{engine: faulty, precision: double, profile: nan, rate: 240, expect: {status: unstable}}"));
  ASSERT_EQ(known[0].runs.size(), 2u);
  EXPECT_EQ(known[0].runs[0].errors.at("i-j.effective_restitution").verdict, Verdict::deviates);
  EXPECT_EQ(known[0].verdict(), Verdict::within);
  const auto wrong =
      run(pair_scene("{engine: bullet, precision: double, rate: [240, 1000], expect: "
                     "{i-j.effective_restitution: {max: [0.352, 0.362]}}}"));
  for (const EngineRecord& record : wrong[0].runs)
    EXPECT_EQ(record.verdict(), Verdict::deviates) << record.rate;
}

TEST(SceneRun, WhatIsNotThereIsSkippedWithAReason) {
  const auto scenes = run(pair_scene("{engine: faulty, precision: single, rate: 240}"));
  EXPECT_EQ(scenes[0].runs[0].status, EngineRecord::Status::skipped);
  EXPECT_EQ(scenes[0].runs[0].reason, "faulty (single) is not installed, but double precision is");
  EXPECT_EQ(scenes[0].verdict(), Verdict::undecided);
}

TEST(SceneRun, SaysWhereThreadsHaveNothingToShare) {
  const auto told = [](std::size_t threads) {
    const auto scenes =
        prepare_scenes({parse_scenario(pair_scene(""), "scene.yaml")}, false, 1, 60, threads);
    return std::ranges::count_if(scenes[0].reference.warnings, [](const std::string& warning) {
      return warning.starts_with("one thread: only scenes of many bodies");
    });
  };
  EXPECT_EQ(told(1), 0);
  EXPECT_EQ(told(2), 1);
}

/// What no budget holds runs two of its phases, the first and one half a step from it: the first
/// and fifth of eight, so that what differs most by the phase still shows.
TEST(SceneRun, ABudgetLeavesOutPhases) {
  use_test_engines();
  const std::string engine = "{engine: bullet, precision: double, profile: default, rate: 240}";
  const EngineRecord all = run(pair_scene(engine))[0].runs.at(0);
  RunOptions options;
  options.phases = 8;
  const auto under = [&](double budget) {
    options.budget = budget;
    const std::vector<Scenario> scenes = {parse_scenario(pair_scene(engine), "scene.yaml")};
    return run_scenes(scenes, options)[0].runs.at(0);
  };
  const std::string name = "i-j.effective_restitution";
  const std::vector<double>& values = all.observables.at(name).values;
  ASSERT_EQ(values.size(), 8u);

  const EngineRecord least = under(1e-12);
  EXPECT_EQ(least.phases, 2u);
  EXPECT_EQ(least.observables.at(name).values, (std::vector<double>{values[0], values[4]}));
  EXPECT_LT(least.steps, all.steps / 3);
  ASSERT_EQ(least.warnings.size(), all.warnings.size() + 1);
  EXPECT_EQ(least.warnings.front(),
            "2 of 8 phases: more take longer than 1e-12 CPU seconds (--budget)");

  const EngineRecord most = under(1000);
  EXPECT_EQ(most.phases, 8u);
  EXPECT_EQ(most.observables.at(name).values, values);
  EXPECT_EQ(most.warnings, all.warnings);
}

TEST(SceneRun, APreparedSceneServesAnySettings) {
  use_test_engines();
  const auto scenes = prepare_scenes({parse_scenario(pair_scene(""), "scene.yaml")});
  ASSERT_EQ(scenes.size(), 1u);
  EngineRecord naive, missing;
  naive.engine = missing.engine = "bullet";
  naive.precision = "double";
  missing.precision = "half";
  naive.settings =
      load_profile(SLIPCHECK_SOURCE_DIR "/bullet_backend/profiles/naive.yaml").settings;
  ASSERT_FALSE(naive.settings.empty());
  naive.rate = missing.rate = 240;
  const std::vector<EngineTask> tasks = {{&scenes[0], &naive}, {&scenes[0], &missing}};
  RunOptions options;
  options.phases = 8;
  run_engines(tasks, options);
  EXPECT_EQ(missing.status, EngineRecord::Status::skipped);
  EXPECT_EQ(missing.reason, "bullet (half) is not installed: Debian package libbullet-dev");

  const auto whole =
      run(pair_scene("{engine: bullet, precision: double, profile: naive, rate: 240}"));
  const EngineRecord& same = whole[0].runs[0];
  ASSERT_EQ(naive.status, EngineRecord::Status::ok) << naive.reason;
  EXPECT_EQ(same.settings, naive.settings);
  ASSERT_EQ(naive.observables.size(), same.observables.size());
  for (const auto& [name, value] : same.observables)
    EXPECT_EQ(naive.observables.at(name).median, value.median) << name;
}

TEST(SceneRun, AnUnknownEngineIsRefusedAtItsPlace) {
  const auto faults =
      test::faults_of([] { run(pair_scene("{engine: bulet, precision: double, rate: 240}")); });
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].key, "compare.engines[0].engine");
  EXPECT_GT(faults[0].location.line, 0);
  EXPECT_NE(faults[0].rule.find("bullet"), std::string::npos);
}

TEST(SceneRun, AModelWithoutASolverIsRefusedByName) {
  std::string text = pair_scene("");
  const auto replace = [&](const std::string& old, const std::string& now) {
    text.replace(text.find(old), old.size(), now);
  };
  replace("{density: 7.85}", "{density: 7.85, young_modulus: 2.06e12, poisson_ratio: 0.28}");
  replace("restitution: 0.9", "restitution: viscoelastic");
  const std::string what = test::refusal_of<Unsupported>([&] { run(text); });
  EXPECT_NE(what.find("contacts[0].normal.restitution"), std::string::npos) << what;
  EXPECT_NE(what.find("materials.steel.dissipation_time"), std::string::npos) << what;
}

TEST(Surfaces, ARunGoesOnForABodyThatRollsTowardsAnEdge) {
  // Slides on a step, rolls with 5/7 of its speed over the edge, and slides again on a belt that
  // comes after it: friction along one line conserves the spin about it, whatever its course.
  use_test_engines();
  const Scenario scenario = parse_scenario(R"(slipcheck: 1
name: step
title: Over an edge onto a belt
materials: {glass: {density: 2500 kg/m^3}, wood: {}, rubber: {}}
contacts:
  - {between: [glass, wood], friction: 0.3}
  - {between: [glass, rubber], friction: 0.3}
surfaces:
  - {name: step, material: wood, rectangle: {from: [-1, 0, 0.1], to: [0.3, 0, 0.1], width: 1}}
  - {name: belt, material: rubber, plane: {point: [0, 0, 0], normal: [0, 0, 1]}, motion: {kind: belt, velocity: [0.5, 0, 0]}}
bodies:
  - {name: ball, material: glass, sphere: {radius: 10 mm}, on: step, position: [0, 0, 0.11], velocity: [1, 0, 0], spin: none}
run: {until: rolling, limit: 5}
compare:
  engines: [{engine: bullet, precision: double, profile: physical, rate: 1000}]
)",
                                           "step.yaml");
  RunOptions options;
  options.phases = 4;
  const SceneRecord record = run_scenes({scenario}, options).at(0);
  const double exact = 5.0 / 7 + 2.0 / 7 * 0.5;
  EXPECT_NEAR(record.reference.observables.at("ball.rolling_velocity").value, exact, 1e-12);
  const EngineRecord& run = record.runs.at(0);
  ASSERT_EQ(run.status, RunStatus::ok) << run.reason;
  for (const double velocity : run.observables.at("ball.rolling_velocity").values)
    EXPECT_NEAR(velocity, exact, 1e-3);  // of what friction takes in a step
}

}  // namespace
}  // namespace slipcheck
