#include "studies/precision/precision.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>

#include "../support/bundled.h"
#include "../support/refusal.h"
#include "scenario/fault.h"
#include "scenario/load.h"
#include "studies/precision/precision_errors.h"

namespace slipcheck {
namespace {

using Kind = Convergence::Kind;
using Method = MethodCurve::Kind;

using test::bundled;
using test::use_test_engines;

/// Next to nothing: tests add what they look at.
PrecisionGrid small_grid(std::vector<std::string> engines, std::vector<std::string> profiles) {
  use_test_engines();
  PrecisionGrid grid;
  grid.engines = {std::move(engines), {"double"}, std::move(profiles)};
  grid.rates = {240, 1000, 4000};
  grid.iterations = {};
  grid.tolerances = {1e-4};
  grid.steps_per_contact = {10};
  grid.repeats = 1;
  return grid;
}

RunOptions small_options(std::size_t phases) {
  RunOptions options;
  options.phases = phases;
  options.time_limit = 60;
  options.limits.reply = 10;
  return options;
}

const MethodCurve& curve_of(const PrecisionScene& scene, const std::string& label) {
  for (const MethodCurve& curve : scene.curves)
    if (label_of(curve) == label) return curve;
  throw std::out_of_range(label);
}

TEST(Precision, BulletsDefaultDoesNotConvergeAndTunedDoes) {
  PrecisionGrid grid = small_grid({"bullet"}, {"default", "tuned"});
  grid.iterations = {10, 50};  // 10 is its own: no curve
  grid.iterations_up_to = 1000;
  const auto scenes = run_precision({bundled("symmetric-30cms")}, grid, small_options(16));
  ASSERT_EQ(scenes.size(), 1u);
  const std::string e_eff = "i-j.effective_restitution";
  const MethodCurve& naive = curve_of(scenes[0], "bullet double default");
  EXPECT_EQ(naive.convergence.at(e_eff).kind, Kind::does_not_converge);
  for (const WorkPrecision& point : naive.points) {
    ASSERT_EQ(point.status, RunStatus::ok) << point.reason;
    EXPECT_EQ(point.phases, 16u);
    // The lottery gives up to 0.143 too much; the last of 16 strata ends there.
    EXPECT_NEAR(point.errors.at(e_eff).worst, 0.143, 0.143 / 16 + 0.002);
    EXPECT_LT(point.errors.at(e_eff).median, point.errors.at(e_eff).rms);
    EXPECT_LT(point.errors.at(e_eff).rms, point.errors.at(e_eff).worst);
    EXPECT_EQ(point.errors.at(e_eff).tolerance, 0.005);
  }
  // Its impact falls into a step of 1e-6 of the whole: errors of h times a millionth.
  const MethodCurve& tuned = curve_of(scenes[0], "bullet double tuned");
  EXPECT_NE(tuned.convergence.at(e_eff).kind, Kind::does_not_converge);
  EXPECT_LT(tuned.convergence.at(e_eff).largest, 1e-6);
  // Where the ball is at a time is as good as the steps are short.
  EXPECT_EQ(tuned.convergence.at(kTrajectory).kind, Kind::converges);
  EXPECT_NEAR(tuned.convergence.at(kTrajectory).order, 1, 0.1);
  EXPECT_EQ(naive.convergence.at(kTrajectory).kind, Kind::does_not_converge);

  EXPECT_THROW(curve_of(scenes[0], "bullet double default, 10 iterations"), std::out_of_range);
  const MethodCurve& many = curve_of(scenes[0], "bullet double default, 50 iterations");
  EXPECT_EQ(std::get<double>(many.settings.at("solver_iterations")), 50);
  EXPECT_EQ(many.points.size(), 2u);

  // Everything that ran has its cost; the events of the reference are exact and on the front.
  for (const MethodCurve& curve : scenes[0].curves)
    for (const WorkPrecision& point : curve.points)
      if (point.status == RunStatus::ok) {
        ASSERT_TRUE(point.cost) << label_of(curve) << ' ' << point.reason;
        EXPECT_GT(point.cost->per_step, 0);
        EXPECT_GE(point.cost->spread, 0);
        EXPECT_EQ(point.cost->repeats, 1u);
      }
  const MethodCurve& event = curve_of(scenes[0], "event");
  EXPECT_EQ(event.convergence.at(e_eff).kind, Kind::exact);
  EXPECT_FALSE(tuned.points[0].pareto.contains(e_eff) && naive.points[2].pareto.contains(e_eff));
  const MethodCurve& fixed = curve_of(scenes[0], "fixed step");
  ASSERT_EQ(fixed.points.size(), 1u);
  EXPECT_EQ(fixed.points[0].status, RunStatus::skipped);
  EXPECT_NE(fixed.points[0].reason.find("soft"), std::string::npos) << fixed.points[0].reason;
}

TEST(Precision, TheReferencesOwnSolversHaveTheirOrders) {
  PrecisionGrid grid = small_grid({}, {});
  grid.tolerances = {1e-4, 1e-6, 1e-8, 1e-10};
  grid.steps_per_contact = {10, 20, 40, 80};
  const auto scenes = run_precision({bundled("symmetric-steel")}, grid, small_options(4));
  ASSERT_EQ(scenes[0].curves.size(), 3u);
  const MethodCurve& fixed = curve_of(scenes[0], "fixed step");
  EXPECT_EQ(fixed.kind, Method::fixed_step);
  ASSERT_EQ(fixed.points.size(), 4u);
  EXPECT_EQ(fixed.points[0].phases, 4u);
  // Steps are tenths of K's collision time and less.
  EXPECT_NEAR(fixed.points[0].knob, 2.55e-6, 0.01e-6);
  EXPECT_NEAR(fixed.points[3].knob, 2.55e-5 / 80, 0.001e-6);
  // Second order (StepSolver) of the worst of four phases; which of them is worst may change.
  for (const char* name :
       {"i-j.restitution", "i-j.effective_restitution", "i-j.max_overlap", kTrajectory}) {
    const Convergence& found = fixed.convergence.at(name);
    EXPECT_EQ(found.kind, Kind::converges) << name;
    EXPECT_NEAR(found.order, 2, 0.25) << name;
  }
  // The ends of a contact are known to a few steps.
  EXPECT_NEAR(fixed.convergence.at("i-j.contact_time").order, 1, 0.1);
  const MethodCurve& contact = curve_of(scenes[0], "contact");
  ASSERT_EQ(contact.points.size(), 4u);
  for (const char* name : {"i-j.restitution", "i.sliding_time", kTrajectory}) {
    EXPECT_EQ(contact.convergence.at(name).kind, Kind::converges) << name;
    // A relative tolerance binds the error of a step; what it becomes over the run falls with it.
    EXPECT_NEAR(contact.convergence.at(name).order, 1, 0.35) << name;
    EXPECT_LT(contact.points[3].errors.at(name).worst, 1e-7) << name;
  }
  // Taken as hard, the contact is another model: one point with its error, above all that solves
  // the contact itself.
  const MethodCurve& event = curve_of(scenes[0], "event");
  ASSERT_EQ(event.points.size(), 1u);
  ASSERT_EQ(event.points[0].status, RunStatus::ok) << event.points[0].reason;
  EXPECT_GT(event.points[0].errors.at(kTrajectory).worst,
            100 * contact.points[3].errors.at(kTrajectory).worst);
}

TEST(Precision, AFailingEngineLeavesTheOthersAsTheyAre) {
  PrecisionGrid grid = small_grid({"bullet"}, {"default"});
  grid.rates = {240, 1000};
  const auto alone = run_precision({bundled("symmetric-30cms")}, grid, small_options(4));
  grid.engines.engines = {"faulty", "bullet"};
  grid.engines.profiles = {"default", "kill-at-step-10", "nan"};
  const auto beside = run_precision({bundled("symmetric-30cms")}, grid, small_options(4));
  const MethodCurve& killed = curve_of(beside[0], "faulty double kill-at-step-10");
  ASSERT_EQ(killed.points.size(), 2u);
  for (const WorkPrecision& point : killed.points) {
    EXPECT_EQ(point.status, RunStatus::crashed);
    EXPECT_NE(point.reason.find("killed by signal 9"), std::string::npos) << point.reason;
    EXPECT_FALSE(point.cost);
    EXPECT_TRUE(point.pareto.empty());
  }
  EXPECT_EQ(curve_of(beside[0], "faulty double nan").points[0].status, RunStatus::unstable);
  EXPECT_EQ(curve_of(beside[0], "bullet double nan").points[0].status, RunStatus::skipped);
  const std::string label = "bullet double default";
  const MethodCurve &a = curve_of(alone[0], label), &b = curve_of(beside[0], label);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    EXPECT_TRUE(b.points[k].cost);
    ASSERT_EQ(a.points[k].errors.size(), b.points[k].errors.size());
    for (const auto& [name, errors] : a.points[k].errors) {
      const PhaseErrors& same = b.points[k].errors.at(name);
      if (std::isnan(errors.worst)) continue;
      EXPECT_EQ(errors.worst, same.worst) << name;
      EXPECT_EQ(errors.median, same.median) << name;
      EXPECT_EQ(errors.rms, same.rms) << name;
    }
  }
}

TEST(Precision, InterruptedItSaysSo) {
  const std::atomic<bool> stop = true;
  RunOptions options = small_options(2);
  options.stop = &stop;
  const auto scenes =
      run_precision({bundled("symmetric-30cms")}, small_grid({"bullet"}, {"default"}), options);
  ASSERT_EQ(scenes.size(), 1u);
  const MethodCurve& curve = curve_of(scenes[0], "bullet double default");
  for (const WorkPrecision& point : curve.points) {
    EXPECT_EQ(point.status, RunStatus::skipped);
    EXPECT_EQ(point.reason, "interrupted");
  }
}

TEST(Precision, BoxesAreRefusedAtTheirPlace) {
  const auto faults = test::faults_of(
      [] { run_precision({bundled("box-one-ball")}, small_grid({}, {}), small_options(1)); });
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].key, "container");
  EXPECT_GT(faults[0].location.line, 0);
  EXPECT_NE(faults[0].rule.find("not in boxes"), std::string::npos);
}

TEST(Precision, FloorsAreOfRoundingUncertaintyAndTolerance) {
  Scenario scenario = bundled("symmetric-30cms");
  ReferenceResult reference;
  scenario.compare.tolerance = {{"effective_restitution", {0.005, false}},
                                {"sliding_time", {0.01, false}},
                                {"sliding_distance", {1e-5, true}}};
  reference.observables = {{"i-j.effective_restitution", {0.3, 1e-15}},
                           {"i.sliding_time", {0.1, 1e-5}},
                           {"i.sliding_distance", {0.002, 1e-15}},
                           {"i.stopping_time", {2, 0}}};
  const auto floors = error_floors(scenario, reference, 1e-9);
  EXPECT_DOUBLE_EQ(floors.at("i-j.effective_restitution").noise, 1e-9);
  EXPECT_DOUBLE_EQ(floors.at("i-j.effective_restitution").negligible, 5e-6);
  // Ten times 1e-5 s of 0.1 s; 1e-9 of 2 mm, as the tolerance has a unit.
  EXPECT_NEAR(floors.at("i.sliding_time").noise, 1e-3, 1e-9);
  EXPECT_DOUBLE_EQ(floors.at("i.sliding_distance").noise, 2e-12);
  EXPECT_DOUBLE_EQ(floors.at("i.sliding_distance").negligible, 1e-8);
  EXPECT_EQ(floors.at("i.stopping_time").negligible, 0);
  EXPECT_DOUBLE_EQ(floors.at(kTrajectory).noise, 1e-9);
}

TEST(Precision, FrontsAreByQuantityOverAllEnginesAndOverAllSolvers) {
  std::vector<MethodCurve> curves(3);
  const auto add = [](MethodCurve& curve, double cost, double a, double b) {
    WorkPrecision& point = curve.points.emplace_back();
    point.cost = WorkCost{1, cost, 0, 1};
    point.errors["a"].worst = a;
    point.errors["b"].worst = b;
  };
  add(curves[0], 1, 0.1, 0.1);
  add(curves[0], 2, 0.01, 0.2);
  add(curves[1], 3, 0.02, 0.001);
  add(curves[1], 0.5, 0.05, 0.001);
  curves[1].points[1].errors["b"].reason = "1 of 2 phases do not show it";
  // Cheaper and better than all engines, but none.
  curves[2].kind = MethodCurve::Kind::event;
  add(curves[2], 0.1, 0, 0);
  mark_fronts(curves);
  EXPECT_EQ(curves[2].points[0].pareto, (std::set<std::string>{"a", "b"}));
  EXPECT_EQ(curves[0].points[0].pareto, (std::set<std::string>{"b"}));
  EXPECT_EQ(curves[0].points[1].pareto, (std::set<std::string>{"a"}));
  EXPECT_EQ(curves[1].points[0].pareto, (std::set<std::string>{"b"}));
  EXPECT_EQ(curves[1].points[1].pareto, (std::set<std::string>{"a"}));
}

TEST(Precision, CurvesHaveLabels) {
  MethodCurve curve;
  curve.engine = "bullet";
  curve.precision = "double";
  curve.profile = "tuned";
  EXPECT_EQ(label_of(curve), "bullet double tuned");
  curve.iterations = 50;
  EXPECT_EQ(label_of(curve), "bullet double tuned, 50 iterations");
  curve.kind = Method::fixed_step;
  EXPECT_EQ(label_of(curve), "fixed step");
  EXPECT_STREQ(name_of(Method::fixed_step), "fixed_step");
  EXPECT_STREQ(name_of(Kind::does_not_converge), "does_not_converge");
}

}  // namespace
}  // namespace slipcheck
