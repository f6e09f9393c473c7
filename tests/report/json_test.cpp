#include <gtest/gtest.h>

#include <array>

#include "records.h"
#include "report/json/json_report.h"

namespace slipcheck::testing {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> result;
  for (const auto& [key, value] : object.items()) result.push_back(key);
  return result;
}

/// What any reader of the file gets.
Json read_back(const SceneRecord& scene) { return Json::parse(json_of(scene).dump()); }

TEST(JsonReport, HasTheKeysOfTheContract) {
  const Json json = read_back(lottery_scene());
  EXPECT_EQ(json["schema"], "slipcheck-result/1");
  EXPECT_EQ(keys(json["slipcheck"]), (std::vector<std::string>{"version", "commit", "build"}));
  EXPECT_EQ(keys(json["machine"]),
            (std::vector<std::string>{"processor", "hardware_threads", "system", "compiler"}));
  EXPECT_EQ(json["scenario"]["name"], "symmetric-steel");
  EXPECT_EQ(json["scenario"]["file"], "scenarios/symmetric-steel.yaml");
  EXPECT_EQ(json["scenario"]["sha256"], std::string(64, 'a'));
  EXPECT_EQ(json["scenario"]["text"], "");
  EXPECT_EQ(json["reference"]["solver"], "event");
  EXPECT_EQ(json["reference"]["cpu_seconds"], 1.2e-6);
  EXPECT_EQ(json["reference"]["reached"], true);
  EXPECT_EQ(json["reference"]["first_contact"], 0);
  EXPECT_EQ(json["reference"]["observables"]["i.sliding_time"]["value"], 0.1 / 3.6);
  EXPECT_EQ(json["reference"]["observables"]["i.sliding_time"]["uncertainty"], 1e-17);
  EXPECT_EQ(json["reference"]["closed_form"]["i-j.effective_restitution"], 5.0 / 14);
  const Json& run = json["runs"][0];
  EXPECT_EQ(run["engine"], "bullet");
  EXPECT_EQ(run["version"], "3.24");
  EXPECT_EQ(run["precision"], "double");
  EXPECT_EQ(run["profile"], "default");
  EXPECT_EQ(run["settings"], nlohmann::json({{"body", "multibody"}, {"erp", 0.25}}));
  EXPECT_EQ(run["rate"], 240);
  EXPECT_EQ(run["status"], "ok");
  EXPECT_FALSE(run.contains("reason"));
  EXPECT_EQ(run["cpu_seconds"], 3.1e-6 * 100);
  EXPECT_EQ(run["steps"], 100);
  EXPECT_EQ(run["phases"], 64);
  EXPECT_EQ(run["not_represented"], Json({"static friction", "coupled drilling"}));
  EXPECT_EQ(run["not_represented_kinds"], Json({"friction", ""}));
  EXPECT_EQ(run["applied"]["friction"], 0.1);
  EXPECT_EQ(run["applied"]["split_impulse"], true);
  EXPECT_EQ(run["applied"]["solver"], "sequential");
  EXPECT_EQ(json["verdict"], "deviates");
}

TEST(JsonReport, KeepsEveryBitOfAValue) {
  SceneRecord scene = lottery_scene(3);
  const Json json = read_back(scene);
  const auto& values = scene.runs[0].observables["i-j.effective_restitution"].values;
  const Json& written = json["runs"][0]["observables"]["i-j.effective_restitution"]["values"];
  ASSERT_EQ(written.size(), values.size());
  for (std::size_t p = 0; p < values.size(); ++p) EXPECT_EQ(written[p].get<double>(), values[p]);
}

TEST(JsonReport, TellsErrorsRelativeAndAbsolute) {
  const Json errors = read_back(lottery_scene())["runs"][0]["errors"];
  EXPECT_EQ(keys(errors["i.sliding_time"]),
            (std::vector<std::string>{"median", "max", "rms", "tolerance", "within", "verdict"}));
  EXPECT_EQ(errors["i.sliding_time"]["within"], true);
  EXPECT_EQ(errors["i.sliding_time"]["rms"], 0);
  EXPECT_EQ(errors["i-j.effective_restitution"]["absolute"], true);
  EXPECT_EQ(errors["i-j.effective_restitution"]["max"], 0.141);
  EXPECT_EQ(errors["i-j.effective_restitution"]["tolerance"], 0.005);
  EXPECT_EQ(errors["i-j.effective_restitution"]["within"], false);
}

TEST(JsonReport, GivesNoToleranceWhereThereIsNone) {
  SceneRecord scene = lottery_scene();
  scene.runs[0].errors["i-j.restitution"] = {0.1, 0.2, std::nullopt, true, Verdict::unjudged, ""};
  const Json error = read_back(scene)["runs"][0]["errors"]["i-j.restitution"];
  EXPECT_FALSE(error.contains("tolerance"));
  EXPECT_EQ(error["within"], true);
}

TEST(JsonReport, GivesValuesByPhaseOnlyWhereThereIsATolerance) {
  SceneRecord scene = lottery_scene();
  scene.runs[0].observables["i-j.restitution"] = {0.9, 0.9, 0.9, {0.9, 0.9}, 0};
  const Json observables = read_back(scene)["runs"][0]["observables"];
  EXPECT_EQ(observables["i.sliding_time"]["values"].size(), 64u);
  EXPECT_FALSE(observables["i-j.restitution"].contains("values"));
  EXPECT_FALSE(observables["i.sliding_time"].contains("missing"));
}

TEST(JsonReport, GivesValuesOfAVectorsComponentsAndOfWhatIsExpected) {
  SceneRecord scene = expected_lottery();
  scene.scenario.compare.tolerance = {{"final_velocity", {0.01, false}}};
  for (const char* name : {"i.final_velocity.y", "j.jump_height", "j.sliding_time"})
    scene.runs[0].observables[name] = {0.9, 0.9, 0.9, {0.9, 0.9}, 0};
  const Json observables = read_back(scene)["runs"][0]["observables"];
  EXPECT_EQ(observables["i.final_velocity.y"]["values"].size(), 2u);
  EXPECT_EQ(observables["j.jump_height"]["values"].size(), 2u);
  EXPECT_FALSE(observables["j.sliding_time"].contains("values"));
}

TEST(JsonReport, SaysHowTheReferenceEnded) {
  SceneRecord scene = lottery_scene();
  scene.reference.run.reached = false;
  scene.reference.run.reason = "the time limit";
  scene.reference.run.collapses = 3;
  scene.reference.first_contact = kInfinity;
  const Json reference = read_back(scene)["reference"];
  EXPECT_EQ(reference["reached"], false);
  EXPECT_EQ(reference["reason"], "the time limit");
  EXPECT_EQ(reference["collapses"], 3);
  EXPECT_FALSE(reference.contains("first_contact"));  // there is none
  EXPECT_FALSE(reference.contains("failed"));
  scene.reference.run.failed = true;
  EXPECT_EQ(read_back(scene)["reference"]["failed"], true);
  EXPECT_FALSE(read_back(lottery_scene())["reference"].contains("collapses"));
}

TEST(JsonReport, SaysWhichPhasesAreMissing) {
  SceneRecord scene = lottery_scene(3);
  EnsembleValue& ensemble = scene.runs[0].observables["i.sliding_time"];
  ensemble.values[1] = kNaN;
  ensemble.missing = 1;
  const Json json = read_back(scene)["runs"][0]["observables"]["i.sliding_time"];
  EXPECT_EQ(json["missing"], 1);
  EXPECT_TRUE(json["values"][1].is_null());
  EXPECT_EQ(json["values"][2], ensemble.values[2]);
  EXPECT_EQ(json["reason"], "null where a phase does not show it");
}

TEST(JsonReport, WritesNullWithAReasonForWhatIsNotFinite) {
  SceneRecord scene = lottery_scene();
  scene.reference.observables["i.sliding_time"] = {1.0, kInfinity};
  scene.reference.closed_form["i.sliding_time"] = kNaN;
  scene.runs[0].cpu_seconds = kInfinity;
  scene.runs[0].observables["i.sliding_time"].max = kInfinity;
  scene.runs[0].errors["i.sliding_time"] = {
      kNaN, kNaN, 0.01, false, Verdict::deviates, "the reference is 0"};
  scene.runs[0].errors["j.sliding_time"] = {0.1, kInfinity, 0.01, false, Verdict::deviates, ""};
  scene.runs[0].applied.settings["limit"] = kInfinity;
  const Json json = read_back(scene);

  const Json& reference = json["reference"];
  EXPECT_TRUE(reference["observables"]["i.sliding_time"]["uncertainty"].is_null());
  EXPECT_NE(reference["observables"]["i.sliding_time"]["reason"], nullptr);
  EXPECT_TRUE(reference["closed_form"]["i.sliding_time"].is_null());
  EXPECT_EQ(reference["closed_form"]["reason"], "i.sliding_time is not a number");
  const Json& run = json["runs"][0];
  EXPECT_TRUE(run["cpu_seconds"].is_null());
  EXPECT_EQ(run["reason"], "cpu_seconds is infinite");
  EXPECT_TRUE(run["observables"]["i.sliding_time"]["max"].is_null());
  EXPECT_EQ(run["observables"]["i.sliding_time"]["reason"], "max is infinite");
  EXPECT_TRUE(run["errors"]["i.sliding_time"]["median"].is_null());
  EXPECT_EQ(run["errors"]["i.sliding_time"]["reason"], "the reference is 0");
  EXPECT_TRUE(run["errors"]["j.sliding_time"]["max"].is_null());
  EXPECT_EQ(run["errors"]["j.sliding_time"]["reason"], "the error is infinite");
  EXPECT_TRUE(run["applied"]["limit"].is_null());
  EXPECT_EQ(run["applied"]["reason"], "limit is infinite");

  const Json& sliding = reference["observables"]["i.sliding_time"];
  EXPECT_EQ(sliding["nulls"], Json({{"uncertainty", "infinite"}}));
  EXPECT_EQ(reference["closed_form"]["nulls"], Json({{"i.sliding_time", "nan"}}));
  EXPECT_EQ(run["nulls"], Json({{"cpu_seconds", "infinite"}}));
  EXPECT_FALSE(run.contains("own_reason"));  // it is of cpu_seconds alone
  EXPECT_EQ(run["errors"]["i.sliding_time"]["own_reason"], "the reference is 0");
  EXPECT_FALSE(run["errors"]["j.sliding_time"].contains("own_reason"));
  EXPECT_EQ(run["applied"]["nulls"], Json({{"limit", "infinite"}}));
}

TEST(JsonReport, SaysWhatTheReferenceDoesNotShow) {
  SceneRecord scene = lottery_scene();
  scene.scenario.compare.tolerance["jump_height"] = {1e-3, true};
  const Json entry = read_back(scene)["reference"]["observables"]["j.jump_height"];
  EXPECT_TRUE(entry["value"].is_null());
  EXPECT_TRUE(entry["uncertainty"].is_null());
  EXPECT_EQ(entry["reason"], "it does not occur in the reference");
  EXPECT_EQ(entry["nulls"], Json({{"value", "absent"}, {"uncertainty", "absent"}}));

  scene.reference.observables.erase("i-j.restitution");
  scene.reference.observables.erase("i-j.effective_restitution");
  EXPECT_EQ(read_back(scene)["reference"]["observables"]["effective_restitution"]["reason"],
            "nothing of it occurs in the reference");
}

TEST(JsonReport, TellsHowTheMeansOverABoxCameAbout) {
  SceneRecord scene = box_scene();
  const Json statistics = read_back(scene)["reference"]["statistics"];
  EXPECT_EQ(keys(statistics), (std::vector<std::string>{"samples", "discarded_periods", "steady",
                                                        "stride", "series"}));
  EXPECT_EQ(statistics["samples"], 250);
  EXPECT_EQ(statistics["discarded_periods"], 50);
  EXPECT_EQ(statistics["steady"], true);
  EXPECT_EQ(statistics["stride"], 1);
  EXPECT_EQ(keys(statistics["series"]),
            (std::vector<std::string>{"time", "height", "kinetic_energy", "rotational_energy",
                                      "collision_rate"}));
  const BoxSeries& series = scene.reference.box->series;
  EXPECT_EQ(statistics["series"]["time"].get<std::vector<double>>(), series.time);
  EXPECT_EQ(statistics["series"]["height"].get<std::vector<double>>(), series.height);
  EXPECT_EQ(statistics["series"]["collision_rate"].get<std::vector<double>>(),
            series.collision_rate);
  EXPECT_FALSE(read_back(lottery_scene())["reference"].contains("statistics"));
}

TEST(JsonReport, ThinsALongSeries) {
  for (const auto& [samples, stride, kept] :
       {std::array<std::size_t, 3>{2000, 1, 2000}, {2001, 2, 1001}, {6100, 4, 1525}}) {
    const SceneRecord scene = box_scene(samples);
    const Json statistics = read_back(scene)["reference"]["statistics"];
    EXPECT_EQ(statistics["stride"], stride);
    EXPECT_EQ(statistics["samples"], samples);
    for (const auto& [name, values] : statistics["series"].items())
      ASSERT_EQ(values.size(), kept) << name;
    EXPECT_EQ(statistics["series"]["height"][7], scene.reference.box->series.height[7 * stride]);
  }
}

TEST(JsonReport, SaysWhyAMeanHasNoError) {
  SceneRecord scene = box_scene(20);
  scene.reference.observables["all.height"].uncertainty = kInfinity;
  const Json height = read_back(scene)["reference"]["observables"]["all.height"];
  EXPECT_TRUE(height["uncertainty"].is_null());
  EXPECT_EQ(height["reason"],
            "the uncertainty is not known: of fewer than 32 samples a mean has no error");
}

TEST(JsonReport, TellsTheStatusAndItsReason) {
  using Status = EngineRecord::Status;
  SceneRecord scene = lottery_scene();
  scene.runs = {failed_run(Status::unstable, "not finite"),
                failed_run(Status::crashed, "signal 11"), failed_run(Status::timed_out, "60 s"),
                failed_run(Status::skipped, "")};
  const Json json = read_back(scene);
  const std::vector<std::string> names = {"unstable", "crashed", "timed_out", "skipped"};
  const std::vector<std::string> reasons = {"not finite", "signal 11", "60 s", "not known"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    EXPECT_EQ(json["runs"][k]["status"], names[k]);
    EXPECT_EQ(json["runs"][k]["reason"], reasons[k]);
    EXPECT_TRUE(json["runs"][k]["observables"].is_object());
    EXPECT_TRUE(json["runs"][k]["errors"].is_object());
    EXPECT_TRUE(json["runs"][k]["not_represented"].is_array());
  }
  EXPECT_EQ(json["verdict"], "failed");
}

TEST(JsonReport, SetsWhatIsExpectedBesideWhatIs) {
  SceneRecord scene = expected_lottery();
  Json json = read_back(scene);
  const Json& run = json["runs"][0];
  EXPECT_FALSE(run.contains("expected_status"));
  ASSERT_EQ(run["expected"].size(), 2u);
  EXPECT_EQ(keys(run["expected"][0]),
            (std::vector<std::string>{"observable", "statistic", "low", "high", "value", "met"}));
  EXPECT_EQ(run["expected"][0]["observable"], "i-j.effective_restitution");
  EXPECT_EQ(run["expected"][0]["statistic"], "max");
  EXPECT_EQ(run["expected"][0]["low"], 0.49);
  EXPECT_EQ(run["expected"][0]["high"], 0.5);
  EXPECT_EQ(run["expected"][0]["value"], 0.358 + 0.14);
  EXPECT_EQ(run["expected"][0]["met"], true);
  EXPECT_EQ(run["expected"][1], Json({{"observable", "j.jump_height"},
                                      {"statistic", "none"},
                                      {"value", nullptr},
                                      {"nulls", {{"value", "nan"}}},
                                      {"met", true},
                                      {"reason", "no phase shows it"},
                                      {"own_reason", "no phase shows it"}}));
  // Errors are as ever, but the verdict is not theirs.
  EXPECT_EQ(run["errors"]["i-j.effective_restitution"]["within"], false);
  EXPECT_EQ(json["verdict"], "within");

  scene.runs[0].expect = Expectation{RunStatus::timed_out, {}};
  json = read_back(scene);
  EXPECT_EQ(json["runs"][0]["expected_status"], "timed_out");
  EXPECT_FALSE(json["runs"][0].contains("expected"));
  EXPECT_EQ(json["verdict"], "deviates");
  EXPECT_FALSE(read_back(lottery_scene())["runs"][0].contains("expected"));
}

TEST(JsonReport, SurvivesTextThatIsNotUtf8) {
  SceneRecord scene = lottery_scene();
  scene.scenario.title = "broken \xff\xfe title";
  scene.runs[0] = failed_run(EngineRecord::Status::crashed, "last words: \xc3(");
  const Json json = read_back(scene);
  EXPECT_EQ(json["scenario"]["title"], "broken \uFFFD\uFFFD title");
  EXPECT_EQ(json["runs"][0]["reason"], "last words: \uFFFD(");
}

TEST(JsonReport, IsTheSameTextForTheSameRecord) {
  EXPECT_EQ(json_of(lottery_scene()).dump(), json_of(lottery_scene()).dump());
}

TEST(JsonReport, WrapsSeveralScenes) {
  const SceneRecord scene = lottery_scene();
  EXPECT_EQ(json_of(std::vector{scene})["schema"], "slipcheck-result/1");
  const Json two = json_of(std::vector{scene, scene});
  EXPECT_EQ(two["schema"], "slipcheck-results/1");
  EXPECT_EQ(two["results"].size(), 2u);
  EXPECT_EQ(two["results"][1], json_of(scene));
  EXPECT_EQ(json_of(std::vector<SceneRecord>{})["results"].size(), 0u);
}

}  // namespace
}  // namespace slipcheck::testing
