#include "studies/baseline/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "baselines.h"

namespace slipcheck {
namespace {

using testing::meeting;
using testing::meeting_baseline;
using Statistic = Change::Statistic;

constexpr const char* kRun = "bullet double default 240 Hz";

/// The check of a scene that was altered since its baseline.
SceneCheck after(const std::function<void(SceneRecord&)>& alter) {
  SceneRecord scene = meeting();
  alter(scene);
  return check_scene(meeting_baseline(), scene);
}

SceneCheck after_reference(const std::string& name, UncertainValue value) {
  return after([&](SceneRecord& scene) { scene.reference.observables[name] = value; });
}

/// With one statistic of the engine set to another value.
SceneCheck after_median(const std::string& name, double median) {
  return after([&](SceneRecord& scene) { scene.runs[0].observables[name].median = median; });
}

TEST(Check, NothingHasMovedInTheSameScene) {
  const SceneCheck check = after([](SceneRecord&) {});
  EXPECT_TRUE(check.is_green());
  EXPECT_TRUE(check.changes.empty());
  EXPECT_FALSE(check.failed);
  // Seven values of the reference; of three observables of the engine, the fourth having no
  // tolerance, three statistics and how many phases lack them.
  EXPECT_EQ(check.compared, 7u + 3 * 4);
  EXPECT_EQ(check.drifted, 0u);
  ASSERT_EQ(check.parts.size(), 2u);
  EXPECT_EQ(check.parts[0].label, "reference");
  EXPECT_EQ(check.parts[1].label, kRun);
}

TEST(Check, AVectorWhoseSquareOverflowsHasMoved) {
  for (const double claimed : {1e156, -1.5e308}) {
    SceneBaseline baseline = meeting_baseline();
    baseline.reference["i.final_velocity.x"].value = claimed;
    baseline.reference["i.final_velocity.y"].value = claimed;
    EXPECT_EQ(check_scene(baseline, meeting()).changes.size(), 2u) << claimed;
    EXPECT_FALSE(check_scene(baseline, meeting()).is_green()) << claimed;
  }
}

TEST(Check, TheReferenceMayMoveByABillionth) {
  EXPECT_TRUE(after_reference("i.sliding_time", {0.02 * (1 + 1e-10), 0}).is_green());
  EXPECT_EQ(after_reference("i.sliding_time", {0.02 * (1 + 1e-10), 0}).drifted, 1u);
  const SceneCheck check = after_reference("i.sliding_time", {0.02 * (1 + 1e-8), 0});
  ASSERT_EQ(check.changes.size(), 1u);
  const Change& change = check.changes[0];
  EXPECT_TRUE(change.gates);
  EXPECT_EQ(change.scene, "meeting");
  EXPECT_EQ(change.part, "reference");
  EXPECT_EQ(change.observable, "i.sliding_time");
  EXPECT_EQ(change.statistic, Statistic::value);
  EXPECT_EQ(change.before, 0.02);
  EXPECT_EQ(change.after, 0.02 * (1 + 1e-8));
  EXPECT_DOUBLE_EQ(change.allowed, 0.02e-9);
}

TEST(Check, ComponentsMoveOnTheScaleOfTheVector) {
  // |v| = 5 m/s: what is zero itself may move by 5e-9 m/s.
  EXPECT_TRUE(after_reference("i.final_velocity.z", {4e-9, 0}).is_green());
  EXPECT_FALSE(after_reference("i.final_velocity.z", {6e-9, 0}).is_green());
}

TEST(Check, APositionMovesOnTheScaleOfTheWay) {
  // 1 mm of way, 100 m from the origin.
  const auto check = [](double x) {
    SceneRecord scene = meeting();
    Body& body = scene.scenario.bodies.emplace_back();
    body.name = "i";
    body.initial.position = Vector3(100, 0, 0);
    scene.reference.observables = {{"i.final_position.x", {100.001, 0}},
                                   {"i.final_position.y", {0, 0}},
                                   {"i.final_position.z", {0, 0}}};
    const SceneBaseline baseline = baseline_of(scene, 4, "");
    scene.reference.observables["i.final_position.y"].value = x;
    return check_scene(baseline, scene).is_green();
  };
  EXPECT_TRUE(check(0.9e-12));
  EXPECT_FALSE(check(1.1e-12));
}

TEST(Check, NumbersWithoutUnitMoveAbsolutely) {
  EXPECT_TRUE(after_reference("i-j.effective_restitution", {0.4 + 0.9e-9, 0}).is_green());
  EXPECT_FALSE(after_reference("i-j.effective_restitution", {0.4 + 1.1e-9, 0}).is_green());
}

TEST(Check, AnUncertainReferenceMayMoveByBothUncertaintiesAndThatIsTold) {
  SceneRecord scene = meeting();
  scene.reference.observables["i.sliding_time"].uncertainty = 1e-5;
  const SceneBaseline baseline = baseline_of(scene, 4, "");
  const auto moved = [&](double by) {
    SceneRecord now = scene;
    now.reference.observables["i.sliding_time"] = {0.02 + by, 2e-5};
    return check_scene(baseline, now);
  };
  const SceneCheck told = moved(2.9e-5);
  EXPECT_TRUE(told.is_green());
  EXPECT_EQ(told.uncertain, 1u);
  ASSERT_EQ(told.changes.size(), 1u);
  EXPECT_FALSE(told.changes[0].gates);
  EXPECT_NEAR(told.changes[0].allowed, 3e-5, 1e-18);
  EXPECT_FALSE(moved(3.1e-5).is_green());
}

TEST(Check, WhatRoundingDecidesMayMoveAndVanishAndThatIsTold) {
  SceneRecord scene = meeting();
  scene.reference.observables["i.sliding_time"].uncertainty = INFINITY;
  const SceneBaseline baseline = baseline_of(scene, 4, "");
  scene.reference.observables["i.sliding_time"].value = 0.03;
  const SceneCheck moved = check_scene(baseline, scene);
  EXPECT_TRUE(moved.is_green());
  EXPECT_EQ(moved.uncertain, 1u);
  EXPECT_EQ(moved.changes.at(0).after, 0.03);
  scene.reference.observables.erase("i.sliding_time");
  const SceneCheck gone = check_scene(baseline, scene);
  EXPECT_TRUE(gone.is_green());
  EXPECT_EQ(gone.uncertain, 1u);
  EXPECT_EQ(gone.changes.at(0).note, "it no longer shows, but rounding decides whether it shows");
}

TEST(Check, WhatTheReferenceNoLongerShowsOrNewlyShowsIsRed) {
  const SceneCheck gone =
      after([](SceneRecord& scene) { scene.reference.observables.erase("i.stopping_time"); });
  ASSERT_EQ(gone.changes.size(), 1u);
  EXPECT_TRUE(gone.changes[0].gates);
  EXPECT_EQ(gone.changes[0].before, 0.5);
  EXPECT_TRUE(std::isnan(gone.changes[0].after));
  const SceneCheck come = after_reference("i.jump_height", {1e-3, 0});
  ASSERT_EQ(come.changes.size(), 1u);
  EXPECT_TRUE(come.changes[0].gates);
  EXPECT_TRUE(std::isnan(come.changes[0].before));
}

TEST(Check, AnEngineMayMoveByTheTolerance) {
  // Relative to the reference's 20 ms: 1 % is 0.2 ms.
  EXPECT_TRUE(after_median("i.sliding_time", 0.021 + 0.19e-3).is_green());
  const SceneCheck worse = after_median("i.sliding_time", 0.021 + 0.21e-3);
  ASSERT_EQ(worse.changes.size(), 1u);
  EXPECT_EQ(worse.changes[0].part, kRun);
  EXPECT_EQ(worse.changes[0].statistic, Statistic::median);
  EXPECT_NEAR(worse.changes[0].allowed, 0.2e-3, 1e-18);
  EXPECT_EQ(worse.changes[0].direction, Direction::worse);
  EXPECT_TRUE(worse.changes[0].gates);
}

TEST(Check, AMoveForTheBetterIsRedToo) {
  const SceneCheck better = after_median("i.sliding_time", 0.02);
  ASSERT_EQ(better.changes.size(), 1u);
  EXPECT_EQ(better.changes[0].direction, Direction::better);
  EXPECT_FALSE(better.is_green());
}

TEST(Check, EachStatisticIsLookedAt) {
  const SceneCheck check = after([](SceneRecord& scene) {
    EnsembleValue& e = scene.runs[0].observables["i-j.effective_restitution"];
    e.min -= 0.011;  // away from 0.4, then over to the other side
    e.max += 0.011;
  });
  ASSERT_EQ(check.changes.size(), 2u);
  EXPECT_EQ(check.changes[0].statistic, Statistic::min);
  EXPECT_EQ(check.changes[0].direction, Direction::better);  // 0.409 is nearer than 0.42
  EXPECT_EQ(check.changes[1].statistic, Statistic::max);
  EXPECT_EQ(check.changes[1].direction, Direction::worse);
  EXPECT_DOUBLE_EQ(check.changes[1].allowed, 0.01);
}

TEST(Check, AVectorsToleranceIsThatOfItsComponents) {
  // 10 % of 5 m/s.
  EXPECT_TRUE(after_median("i.final_velocity.x", 3.1 + 0.49).is_green());
  EXPECT_FALSE(after_median("i.final_velocity.x", 3.1 + 0.51).is_green());
}

TEST(Check, WhatHasNoToleranceDoesNotGate) {
  EXPECT_TRUE(after_median("i.stopping_time", 6).is_green());
}

TEST(Check, OfAReferenceOfZeroTheBaselineIsTheMeasure) {
  SceneRecord scene = meeting();
  scene.reference.observables["i.sliding_time"] = {0, 0};
  const SceneBaseline baseline = baseline_of(scene, 4, "");
  const auto green = [&](double median) {
    SceneRecord now = scene;
    now.runs[0].observables["i.sliding_time"].median = median;
    return check_scene(baseline, now).is_green();
  };
  EXPECT_TRUE(green(0.021 * 1.009));
  EXPECT_FALSE(green(0.021 * 1.011));
}

TEST(Check, InABoxTheReferencesUncertaintiesComeOnTop) {
  SceneRecord scene = meeting();
  scene.reference.box.emplace();
  scene.reference.observables["i.sliding_time"].uncertainty = 0.1e-3;
  const SceneBaseline baseline = baseline_of(scene, 4, "");
  const auto green = [&](double by) {
    SceneRecord now = scene;
    now.runs[0].observables["i.sliding_time"].median += by;
    return check_scene(baseline, now).is_green();
  };
  EXPECT_TRUE(green(0.39e-3));  // 1 % of 20 ms and twice 0.1 ms
  EXPECT_FALSE(green(0.41e-3));
}

TEST(Check, PhasesThatLackAnObservableAreCounted) {
  const SceneCheck check = after([](SceneRecord& scene) {
    scene.runs[0].observables["i.sliding_time"].missing = 1;
    scene.runs[0].observables.erase("i-j.effective_restitution");
  });
  ASSERT_EQ(check.changes.size(), 2u);
  EXPECT_EQ(check.changes[0].observable, "i-j.effective_restitution");
  EXPECT_EQ(check.changes[0].statistic, Statistic::missing);
  EXPECT_EQ(check.changes[0].before, 0);
  EXPECT_EQ(check.changes[0].after, 4);
  EXPECT_EQ(check.changes[0].direction, Direction::worse);
  EXPECT_EQ(check.changes[1].after, 1);
  EXPECT_FALSE(check.is_green());
}

TEST(Check, ASceneThatTheReferenceLacksIsBetterNotShown) {
  SceneRecord scene = meeting();
  scene.reference.observables.erase("i.sliding_time");
  const SceneBaseline baseline = baseline_of(scene, 4, "");
  scene.runs[0].observables.erase("i.sliding_time");
  const SceneCheck check = check_scene(baseline, scene);
  ASSERT_EQ(check.changes.size(), 1u);
  EXPECT_EQ(check.changes[0].direction, Direction::better);
}

TEST(Check, AStatusThatChangesIsRed) {
  const SceneCheck check = after([](SceneRecord& scene) {
    scene.runs[0].status = RunStatus::crashed;
    scene.runs[0].reason = "signal 11";
    scene.runs[0].observables.clear();
  });
  ASSERT_EQ(check.changes.size(), 1u);
  EXPECT_EQ(check.changes[0].statistic, Statistic::status);
  EXPECT_EQ(check.changes[0].was, "ok");
  EXPECT_EQ(check.changes[0].is, "crashed");
  EXPECT_EQ(check.changes[0].note, "signal 11");
  EXPECT_EQ(check.changes[0].direction, Direction::worse);
  EXPECT_TRUE(check.failed);
  EXPECT_FALSE(check.is_green());
}

TEST(Check, AFailureThatTheBaselineKnowsIsNoNews) {
  SceneRecord scene = meeting();
  scene.runs[0].status = RunStatus::unstable;
  const SceneCheck check = check_scene(baseline_of(scene, 4, ""), scene);
  EXPECT_TRUE(check.is_green());
  EXPECT_FALSE(check.failed);
}

TEST(Check, AVerdictThatChangesWithinTheToleranceIsToldOnly) {
  const SceneCheck check = after([](SceneRecord& scene) {
    scene.runs[0].errors["i.sliding_time"].verdict = Verdict::deviates;
  });
  ASSERT_EQ(check.changes.size(), 1u);
  EXPECT_EQ(check.changes[0].statistic, Statistic::verdict);
  EXPECT_EQ(check.changes[0].was, "within");
  EXPECT_EQ(check.changes[0].is, "deviates");
  EXPECT_FALSE(check.changes[0].gates);
  EXPECT_TRUE(check.is_green());
}

TEST(Check, WhatIsExpectedMayMoveByHalfItsRangeAndItsVerdictGates) {
  SceneRecord scene = meeting();
  Expectation& expect = scene.runs[0].expect.emplace();
  expect.observables["i.stopping_time"].median = ExpectedRange{0.5, 0.7};
  const SceneBaseline baseline = baseline_of(scene, 4, "");
  const auto moved_to = [&](double median) {
    SceneRecord now = scene;
    now.runs[0].observables["i.stopping_time"].median = median;
    return check_scene(baseline, now).changes;
  };
  EXPECT_TRUE(moved_to(0.69).empty());
  const std::vector<Change> far = moved_to(0.71);
  ASSERT_EQ(far.size(), 2u);
  EXPECT_EQ(far[0].statistic, Statistic::verdict);
  EXPECT_TRUE(far[0].gates);
  EXPECT_EQ(far[1].statistic, Statistic::median);
  EXPECT_NEAR(far[1].allowed, 0.1, 1e-15);
}

TEST(Check, RunsThatComeOrGoAreRed) {
  const SceneCheck check = after([](SceneRecord& scene) { scene.runs[0].rate = 1000; });
  ASSERT_EQ(check.changes.size(), 2u);
  EXPECT_EQ(check.changes[0].part, "bullet double default 1000 Hz");
  EXPECT_EQ(check.changes[0].note, "the baseline does not have this run");
  EXPECT_EQ(check.changes[1].part, kRun);
  EXPECT_EQ(check.changes[1].note, "the scene no longer asks for this run");
  EXPECT_TRUE(check.changes[0].gates && check.changes[1].gates);
  EXPECT_EQ(check.parts.size(), 3u);
}

TEST(Check, AnotherFileOrSolverIsRed) {
  const SceneCheck check = after([](SceneRecord& scene) {
    scene.scenario.sha256 = std::string(64, 'b');
    scene.reference.solver = "contact";
  });
  ASSERT_EQ(check.changes.size(), 2u);
  EXPECT_EQ(check.changes[0].statistic, Statistic::file);
  EXPECT_EQ(check.changes[0].part, "scene");
  EXPECT_EQ(check.changes[1].statistic, Statistic::solver);
  EXPECT_EQ(check.changes[1].is, "contact");
}

TEST(Check, AnotherVersionIsComparedAndMarked) {
  const SceneCheck check = after([](SceneRecord& scene) {
    scene.runs[0].version = "3.25";
    scene.runs[0].observables["i.sliding_time"].median = 0.03;
  });
  EXPECT_EQ(check.versions, std::vector<std::string>{"bullet 3.24, now 3.25"});
  EXPECT_EQ(check.changes.size(), 1u);
}

TEST(Check, TimesInformOnly) {
  const SceneCheck check = after([](SceneRecord& scene) {
    scene.reference.cpu_seconds = 6e-6;
    scene.runs[0].cpu_seconds = 5e-4;
  });
  EXPECT_TRUE(check.is_green());
  EXPECT_DOUBLE_EQ(check.reference_time_ratio, 3);
  EXPECT_DOUBLE_EQ(check.engine_time_ratio, 0.5);
}

TEST(Check, ScenesAndBaselinesThatStandAloneAreRed) {
  EXPECT_FALSE(scene_without_baseline("new").is_green());
  const SceneCheck gone = baseline_without_scene("old", "baselines/old.json");
  EXPECT_FALSE(gone.is_green());
  EXPECT_EQ(gone.changes.at(0).note, "no scene has this name; baselines/old.json is left over");
}

}  // namespace
}  // namespace slipcheck
