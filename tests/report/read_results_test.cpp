#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "../support/refusal.h"
#include "read_records.h"
#include "report/json/json_report.h"
#include "report/json/precision_json.h"
#include "report/json/stability_json.h"
#include "study_records.h"

namespace slipcheck::testing {
namespace {

using Json = nlohmann::json;

const std::string kFile = "results/x.json";

/// As another program, or another day, finds it.
Json as_file(const nlohmann::ordered_json& json) { return Json::parse(json.dump()); }

SceneRecord read_back(const SceneRecord& scene) {
  const Json json = as_file(json_of(scene));
  return read_result(JsonNode(json, kFile));
}

/// What reading this file says.
std::string refusal(const Json& json,
                    const std::function<void(const JsonNode&)>& read = read_result) {
  return test::refusal_of<BadJson>([&] { read(JsonNode(json, kFile)); });
}

TEST(ReadResult, GivesTheSameFileAgain) {
  const SceneRecord scene = rich_record();
  EXPECT_EQ(json_of(read_back(scene)).dump(2), json_of(scene).dump(2));
}

TEST(ReadResult, KeepsWhatTheFileSays) {
  const SceneRecord scene = read_back(rich_record());
  EXPECT_EQ(scene.scenario.text, kLotteryText);
  EXPECT_EQ(scene.scenario.file, "scenes/symmetric.yaml");
  EXPECT_EQ(scene.scenario.title, "Two rolling steel spheres — \"head-on\"");
  EXPECT_EQ(scene.scenario.bodies.size(), 2u);
  const ReferenceResult& reference = scene.reference;
  EXPECT_EQ(reference.solver, "contact");
  EXPECT_EQ(reference.first_contact, 0.0125);
  EXPECT_FALSE(reference.run.reached);
  EXPECT_TRUE(reference.run.failed);
  EXPECT_EQ(reference.run.reason, "the run's limit of 5 s; it still slides");
  EXPECT_EQ(reference.run.events, 7u);
  EXPECT_EQ(reference.run.collapses, 2u);
  EXPECT_EQ(reference.run.balance->error(), rich_record().reference.run.balance->error());
  EXPECT_EQ(reference.observables.at("i.sliding_time").value, 0.1 / 3.6);
  EXPECT_EQ(reference.observables.at("i-j.restitution").uncertainty, kInfinity);
  EXPECT_TRUE(std::isnan(reference.observables.at("i.spin").uncertainty));
  EXPECT_TRUE(std::isnan(reference.observables.at("j.spin").value));
  EXPECT_EQ(reference.observables.at("j.spin").uncertainty, kInfinity);
  EXPECT_FALSE(reference.observables.contains("i.jump_height"));  // it is absent, with a reason
  EXPECT_EQ(reference.closed_form.at("j.sliding_time"), -kInfinity);
  EXPECT_EQ(reference.closed_form.size(), 3u);
  EXPECT_EQ(reference.warnings[1], "j \"rocks\"");
}

TEST(ReadResult, KeepsHeadingsAndScales) {
  SceneRecord scene = rich_record();
  scene.runs[0].scale = 0.01;
  scene.runs[0].headings = 5;
  scene.runs[0].phases = 1;
  scene.runs[0].observables["i-j.restitution"].headings = {.spread = 0.25, .phase = 3};
  const SceneRecord read = read_back(scene);
  EXPECT_EQ(json_of(read).dump(2), json_of(scene).dump(2));
  EXPECT_EQ(read.runs[0].scale, 0.01);
  EXPECT_EQ(read.runs[0].headings, 5u);
  ASSERT_TRUE(read.runs[0].observables.at("i-j.restitution").headings);
  EXPECT_EQ(read.runs[0].observables.at("i-j.restitution").headings->spread, 0.25);
  EXPECT_EQ(read.runs[0].observables.at("i-j.restitution").headings->phase, 3u);
  // What has one heading and the scene's own size says nothing of either.
  EXPECT_FALSE(json_of(scene)["runs"][1].contains("scale"));
  EXPECT_FALSE(json_of(scene)["runs"][1].contains("headings"));
  EXPECT_EQ(read.runs[1].scale, 1);
  EXPECT_EQ(read.runs[1].headings, 1u);
}

TEST(ReadResult, KeepsWhatTheFileSaysOfRuns) {
  const SceneRecord scene = read_back(rich_record());
  ASSERT_EQ(scene.runs.size(), 5u);
  const EngineRecord& fast = scene.runs[0];
  EXPECT_EQ(fast.engine, "bullet");
  EXPECT_EQ(fast.version, "3.24");
  EXPECT_EQ(fast.rate, 4000);
  EXPECT_EQ(fast.status, RunStatus::ok);
  EXPECT_EQ(fast.reason, "");  // what the file says is of cpu_seconds
  EXPECT_EQ(fast.cpu_seconds, kInfinity);
  EXPECT_EQ(fast.phases, 5u);
  EXPECT_EQ(
      fast.settings,
      (Settings{{"body", std::string("multibody")}, {"erp", 0.25}, {"threshold", kInfinity}}));
  EXPECT_EQ(fast.applied.settings.at("limit"), Setting(-kInfinity));
  EXPECT_EQ(fast.applied.settings.at("split_impulse"), Setting(true));
  EXPECT_FALSE(fast.applied.settings.contains("reason"));
  EXPECT_EQ(fast.applied.not_represented[1].text, "coupled drilling");
  EXPECT_EQ(fast.applied.not_represented[0].kind, "friction");
  const EnsembleValue& time = fast.observables.at("i.sliding_time");
  EXPECT_EQ(time.missing, 1u);
  EXPECT_TRUE(std::isnan(time.values[1]));
  EXPECT_EQ(time.values[4], 0.0276 + 0.0001);
  EXPECT_EQ(fast.observables.at("i.final_velocity.x").values[4], -0.06);  // of its vector
  EXPECT_TRUE(fast.observables.at("i-j.restitution").values.empty());     // without a tolerance
  EXPECT_EQ(fast.errors.at("i.sliding_time").rms, 0.002);
  EXPECT_EQ(fast.errors.at("i.sliding_time").reason, "1 of 5 phases do not show it");
  EXPECT_EQ(fast.errors.at("j.sliding_time").max, kInfinity);
  EXPECT_EQ(fast.errors.at("j.sliding_time").reason, "");
  EXPECT_FALSE(fast.errors.at("i-j.restitution").tolerance);
  EXPECT_EQ(scene.runs[3].reason, "10 s; cpu_seconds are 10");
  EXPECT_TRUE(std::isnan(scene.runs[3].cpu_seconds));
}

TEST(ReadResult, FindsAgainWhatIsExpected) {
  const SceneRecord scene = read_back(rich_record());
  EXPECT_FALSE(scene.runs[0].expect);
  EXPECT_FALSE(scene.runs[1].expect);  // the first of two requests alike
  const auto expectations = scene.runs[2].expectations();
  ASSERT_EQ(expectations.size(), 3u);
  EXPECT_EQ(expectations[0].low, 0.49);
  EXPECT_TRUE(expectations[0].met);
  EXPECT_FALSE(expectations[1].met);
  EXPECT_EQ(expectations[1].reason, "1 of 5 phases do not show it");
  EXPECT_EQ(scene.runs[3].verdict(), Verdict::within);  // it times out, as it should
  EXPECT_EQ(scene.runs[4].verdict(), Verdict::undecided);
}

/// As it was written once, with nothing but reasons beside nulls.
Json of_before(Json json) {
  if (json.is_object()) {
    json.erase("nulls");
    json.erase("own_reason");
  }
  if (json.is_structured())
    for (Json& each : json) each = of_before(each);
  return json;
}

TEST(ReadResult, ReadsFilesThatHaveReasonsAlone) {
  const Json old = of_before(as_file(json_of(rich_record())));
  const SceneRecord scene = read_result(JsonNode(old, kFile));
  EXPECT_EQ(of_before(as_file(json_of(scene))), old);
  const ReferenceResult& reference = scene.reference;
  EXPECT_EQ(reference.run.reason, "the run's limit of 5 s; it still slides");
  EXPECT_EQ(reference.observables.at("i-j.restitution").uncertainty, kInfinity);
  EXPECT_TRUE(std::isnan(reference.observables.at("i.spin").uncertainty));
  EXPECT_TRUE(std::isnan(reference.observables.at("j.spin").value));
  EXPECT_FALSE(reference.observables.contains("i.jump_height"));
  EXPECT_EQ(reference.closed_form.at("j.sliding_time"), -kInfinity);
  EXPECT_EQ(scene.runs[0].reason, "");
  EXPECT_EQ(scene.runs[0].cpu_seconds, kInfinity);
  EXPECT_EQ(scene.runs[0].applied.settings.at("limit"), Setting(-kInfinity));
  EXPECT_EQ(scene.runs[0].errors.at("j.sliding_time").max, kInfinity);
  EXPECT_EQ(scene.runs[0].errors.at("j.sliding_time").reason, "");
  EXPECT_EQ(scene.runs[3].reason, "10 s; cpu_seconds are 10");
}

TEST(ReadResult, KeepsASeries) {
  SceneRecord scene = box_scene(250);
  scene.scenario = rich_record().scenario;
  scene.reference.first_contact = kInfinity;
  const SceneRecord read = read_back(scene);
  EXPECT_EQ(json_of(read).dump(), json_of(scene).dump());
  EXPECT_EQ(read.reference.first_contact, kInfinity);
  EXPECT_FALSE(read.reference.run.balance);
  EXPECT_EQ(read.reference.box->series.time, scene.reference.box->series.time);
  EXPECT_EQ(read.reference.box->series.collision_rate, scene.reference.box->series.collision_rate);
}

TEST(ReadResult, GivesASeriesThatWasThinnedItsLengthAgain) {
  SceneRecord scene = box_scene(6100);
  scene.scenario = rich_record().scenario;
  const SceneRecord read = read_back(scene);
  EXPECT_EQ(json_of(read).dump(), json_of(scene).dump());
  const BoxSeries &all = scene.reference.box->series, &again = read.reference.box->series;
  ASSERT_EQ(again.time.size(), 6100u);  // 1525 of every fourth
  for (const std::size_t k : {0u, 3u, 2999u, 6099u}) {
    EXPECT_NEAR(again.time[k], all.time[k], 1e-12);  // samples 10 ms apart, but for rounding
    EXPECT_EQ(again.height[k], all.height[k - k % 4]);
  }
}

TEST(ReadResult, SaysWhatIsWrongAndWhere) {
  const Json good = as_file(json_of(rich_record()));
  const auto wrong = [&](const char* pointer, const Json& value) {
    Json json = good;
    json[Json::json_pointer(pointer)] = value;
    return refusal(json);
  };
  const auto without = [&](const char* parent, const char* key) {
    Json json = good;
    json[Json::json_pointer(parent)].erase(key);
    return refusal(json);
  };
  EXPECT_EQ(wrong("/runs/2/rate", "fast"),
            "results/x.json: runs[2].rate: must be a number, got \"fast\"");
  EXPECT_EQ(wrong("/runs/2/status", "fine"),
            "results/x.json: runs[2].status: must be one of ok, unstable, crashed, timed_out, "
            "skipped, got \"fine\"");
  EXPECT_EQ(wrong("/runs/0/steps", -1),
            "results/x.json: runs[0].steps: must be a whole number >= 0, got -1");
  EXPECT_EQ(wrong("/runs/0/phases", 1.5),
            "results/x.json: runs[0].phases: must be a whole number >= 0, got 1.5");
  EXPECT_EQ(wrong("/runs/0/warnings", {1}),
            "results/x.json: runs[0].warnings[0]: must be a text, got 1");
  EXPECT_EQ(wrong("/runs/0/errors/i.sliding_time/within", 1),
            "results/x.json: runs[0].errors.i.sliding_time.within: must be true or false, got 1");
  EXPECT_EQ(wrong("/runs/0/observables/i.sliding_time/values/3", "x"),
            "results/x.json: runs[0].observables.i.sliding_time.values[3]: must be a number, got "
            "\"x\"");
  EXPECT_EQ(wrong("/runs/0/applied/friction", Json::array()),
            "results/x.json: runs[0].applied.friction: must be a number, got a list");
  EXPECT_EQ(wrong("/runs/1", 3), "results/x.json: runs[1]: must be an object, got 3");
  EXPECT_EQ(wrong("/runs", Json::object()), "results/x.json: runs: must be a list, got an object");
  EXPECT_EQ(wrong("/reference/solver", nullptr),
            "results/x.json: reference.solver: must be a text, got null");
  EXPECT_EQ(wrong("/reference/closed_form/i.spin", "0"),
            "results/x.json: reference.closed_form.i.spin: must be a number, got \"0\"");
  EXPECT_EQ(without("/runs/2", "profile"), "results/x.json: runs[2].profile: must be there");
  EXPECT_EQ(without("/scenario", "text"), "results/x.json: scenario.text: must be there");
  EXPECT_EQ(refusal(Json::array()), "results/x.json: must be an object, got a list");
  EXPECT_EQ(wrong("/scenario/sha256", "9f2c"),
            "results/x.json: scenario.sha256: must be that of the text, got \"9f2c\"");
  const std::string text = wrong("/scenario/text", "slipcheck: 2\n");
  EXPECT_TRUE(
      text.starts_with("results/x.json: scenario.text: must be a scene that this version reads: "
                       "scenes/symmetric.yaml:1:12: slipcheck: must be 1"))
      << text;
}

TEST(ReadResult, SaysWhatIsWrongWithASeries) {
  SceneRecord scene = box_scene(5);
  scene.scenario = rich_record().scenario;
  Json json = as_file(json_of(scene));
  json["reference"]["statistics"]["stride"] = 0;
  EXPECT_EQ(refusal(json),
            "results/x.json: reference.statistics.stride: must be from 1 to 1000000, got 0");
  json["reference"]["statistics"]["stride"] = 1;
  json["reference"]["statistics"]["series"]["height"].erase(0);
  EXPECT_EQ(refusal(json),
            "results/x.json: reference.statistics.series.height: must be as long as time, got a "
            "list");
}

/// A scene of the studies with the lottery's text.
Scenario study_scenario() { return rich_record().scenario; }

TEST(ReadPrecision, GivesTheSameFileAgain) {
  std::vector<PrecisionScene> scenes = {precision_scene(), precision_scene()};
  for (PrecisionScene& scene : scenes) scene.scenario = study_scenario();
  scenes[1].path_length = kInfinity;
  MethodCurve& curve = scenes[1].curves[0];
  curve.settings["limit"] = kInfinity;
  curve.points[0].status = RunStatus::crashed;
  curve.points[0].reason = "signal 11";
  curve.points[0].errors.clear();
  curve.points[0].cost.reset();
  curve.points[1].errors[kTrajectory] = {.tolerance = 0.005, .reason = "no phase has it"};
  curve.points[2].errors[kTrajectory] = {kInfinity, kNaN, kNaN, true, {}, ""};
  curve.convergence[kTrajectory] = {};
  const nlohmann::ordered_json json = json_of(scenes, PrecisionGrid{});
  const Json file = as_file(json);
  const std::vector<PrecisionScene> read = read_precision(JsonNode(file, kFile));
  EXPECT_EQ(json_of(read, PrecisionGrid{}).dump(2), json.dump(2));

  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[1].path_length, kInfinity);
  EXPECT_EQ(read[1].curves[0].points[0].reason, "signal 11");
  EXPECT_FALSE(read[1].curves[0].points[0].cost);
  EXPECT_EQ(read[1].curves[0].points[1].errors.at(kTrajectory).reason, "no phase has it");
  EXPECT_EQ(read[1].curves[0].points[2].errors.at(kTrajectory).worst, kInfinity);
  EXPECT_EQ(read[1].curves[0].points[2].errors.at(kTrajectory).reason, "");
  EXPECT_EQ(read[0].curves[4].iterations, 50);
  EXPECT_EQ(read[0].curves[3].points[2].pareto.size(), 2u);
  EXPECT_EQ(label_of(read[0].curves[5]), "contact");
}

TEST(ReadPrecision, SaysWhatIsWrongAndWhere) {
  PrecisionScene scene = precision_scene();
  scene.scenario = study_scenario();
  const Json good = as_file(json_of({scene}, PrecisionGrid{}));
  const auto wrong = [&](const char* pointer, const Json& value) {
    Json json = good;
    json[Json::json_pointer(pointer)] = value;
    return refusal(json, read_precision);
  };
  EXPECT_EQ(wrong("/scenes/0/curves/5/kind", "cvode"),
            "results/x.json: scenes[0].curves[5].kind: must be one of engine, contact, "
            "fixed_step, event, got \"cvode\"");
  EXPECT_EQ(wrong("/scenes/0/curves/0/points/1/cost", 1e-6),
            "results/x.json: scenes[0].curves[0].points[1].cost: must be an object, got 1e-06");
  EXPECT_EQ(
      wrong("/scenes/0/curves/0/convergence/trajectory/kind", 0),
      "results/x.json: scenes[0].curves[0].convergence.trajectory.kind: must be one of exact, "
      "converges, does_not_converge, unknown, got 0");
}

/// The cases with a text, and what runs can have besides.
std::vector<StabilityCase> rich_cases() {
  std::vector<StabilityCase> cases = stability_cases();
  for (StabilityCase& scene : cases) scene.scenario = study_scenario();
  StabilityRun& run = cases[1].runs[0];
  run.record.status = RunStatus::unstable;
  run.record.reason = "NaN at step 7; it went on";
  run.record.settings = {{"erp", 0.2}, {"split_impulse", false}};
  run.energy_gain = kInfinity;
  run.creep = 0.25;
  return cases;
}

LimitResults rich_limits() {
  LimitResults limits = limit_results();
  limits.limits[0].strays = {0.05, 0.06};
  limits.limits[0].kind = Limit::Kind::mass_ratio;
  return limits;
}

TEST(ReadStability, GivesTheSameFileAgain) {
  const std::vector<StabilityCase> cases = rich_cases();
  const LimitResults limits = rich_limits();
  StabilityGrid grid;
  grid.criteria.creep = 0.02;
  grid.criteria.conserved = 3e-7;
  const nlohmann::ordered_json json = json_of(cases, grid, limits);
  const Json file = as_file(json);
  const StabilityFile read = read_stability(JsonNode(file, kFile));
  StabilityGrid same;
  same.criteria = read.criteria;
  EXPECT_EQ(json_of(read.cases, same, read.limits).dump(2), json.dump(2));

  const StabilityRun& run = read.cases[1].runs[0];
  EXPECT_EQ(run.record.reason, "NaN at step 7; it went on");
  EXPECT_EQ(run.phases, cases[1].runs[0].phases);
  EXPECT_EQ(run.outcome, Outcome::not_finite);
  EXPECT_TRUE(std::isnan(run.worst_error));
  EXPECT_EQ(run.energy_gain, kInfinity);
  EXPECT_TRUE(read.cases[2].reference.refused);
  ASSERT_EQ(read.limits.limits.size(), 4u);
  EXPECT_EQ(read.limits.limits[0].strays, (std::vector<double>{0.05, 0.06}));
  EXPECT_FALSE(read.limits.limits[1].bad);
  EXPECT_EQ(read.limits.limits[1].reason, "");  // what the file says is of `bad`
  EXPECT_EQ(read.limits.limits[2].reason, "interrupted");
  EXPECT_EQ(read.limits.limits[3].theory, 1.01e-5);
  EXPECT_EQ(read.limits.maps[0].outcome, limits.maps[0].outcome);
  EXPECT_EQ(read.limits.maps[0].worst_error[5], 0.2);
  EXPECT_EQ(read.limits.maps[0].theory, limits.maps[0].theory);
}

TEST(ReadStability, ReadsFilesThatHaveReasonsAlone) {
  const Json old = of_before(as_file(json_of(rich_cases(), StabilityGrid{}, rich_limits())));
  const StabilityFile read = read_stability(JsonNode(old, kFile));
  EXPECT_EQ(of_before(as_file(json_of(read.cases, StabilityGrid{}, read.limits))), old);
  EXPECT_EQ(read.cases[1].runs[0].record.reason, "NaN at step 7; it went on");
  EXPECT_TRUE(std::isnan(read.cases[1].runs[0].energy_gain));  // its reason is in other words
  EXPECT_FALSE(read.limits.limits[1].bad);
  EXPECT_EQ(read.limits.limits[1].reason, "");
  EXPECT_EQ(read.limits.limits[2].reason, "interrupted");
}

TEST(ReadStability, SaysWhatIsWrongAndWhere) {
  const Json good = as_file(json_of(rich_cases(), StabilityGrid{}, rich_limits()));
  const auto wrong = [&](const char* pointer, const Json& value) {
    Json json = good;
    json[Json::json_pointer(pointer)] = value;
    return refusal(json, read_stability);
  };
  EXPECT_EQ(
      wrong("/maps/0/outcome/1/2", "odd"),
      "results/x.json: maps[0].outcome[1][2]: must be one of accurate, degraded, drifting, energy "
      "growing, tunnelled, exploded, NaN, timed out, crashed, refused, got \"odd\"");
  EXPECT_EQ(wrong("/maps/0/worst_error/0/1", false),
            "results/x.json: maps[0].worst_error[0][1]: must be a number, got false");
  EXPECT_EQ(wrong("/maps/0/worst_error/1", {1, 2}),
            "results/x.json: maps[0].worst_error[1]: must be a list of 3, got a list");
  EXPECT_EQ(wrong("/maps/0/y/values", {0, 1, 2}),
            "results/x.json: maps[0].outcome: must be a list of 3, got a list");
  EXPECT_EQ(wrong("/maps/0/theory", {1}),
            "results/x.json: maps[0].theory[0]: must be a list of 2, got 1");
  EXPECT_EQ(wrong("/limits/0/kind", "speed"),
            "results/x.json: limits[0].kind: must be one of stable_step, accurate_step, "
            "length_scale, mass_ratio, got \"speed\"");
  EXPECT_EQ(wrong("/cases/2/reference/outcome", "good"),
            "results/x.json: cases[2].reference.outcome: must be one of accurate, refused, "
            "failed, got \"good\"");
}

}  // namespace
}  // namespace slipcheck::testing
