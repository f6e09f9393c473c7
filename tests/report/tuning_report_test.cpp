#include <gtest/gtest.h>

#include <algorithm>

#include "report/files/tuning_profile.h"
#include "report/json/tuning_json.h"
#include "report/rows/context.h"
#include "report/terminal/tuning_table.h"
#include "text_search.h"

namespace slipcheck {
namespace {

using testing::contains;

/// Fitted to one scene at two rates with one held out; the error falls from 40 to 0.5, and to 0.75
/// where it was not fitted.
TuningRecord tuned() {
  TuningRecord record;
  record.engine = "bullet";
  record.version = "3.24";
  record.precision = "double";
  record.start = "/somewhere/on/this/machine/begin.yaml";
  record.profile = "tuned";
  SettingInfo erp;
  erp.name = "erp";
  erp.about = "how much of an overlap is pushed out in a step";
  erp.shipped = 0.2;
  SettingInfo body;
  body.name = "body";
  body.shipped = std::string("rigid");
  record.space.known = {erp, body};
  record.tasks = {{"one", "ab12", 240, false, 0},
                  {"one", "ab12", 1000, false, 0},
                  {"two", "cd34", 240, true, 1}};
  record.rates = {240, 1000};
  record.phases = 16;
  record.final_phases = 64;
  record.seed = 7;

  const auto finalist = [&](const Settings& settings, double error) {
    const RunScore run{error, "i.sliding_time", error / 100, 0, 0.002, 1, ""};
    TuningFinalist made{settings.empty() ? "default" : "", settings, {run, run, run}, {}, {}};
    made.runs[2].worst = 1.5 * error;
    made.training = score_of(std::span(made.runs).first(2), record.goal);
    made.held_out = score_of(std::span(made.runs).last(1), record.goal);
    return made;
  };
  record.result.finalists = {finalist({}, 40), finalist({{"erp", 0.0}}, 0.5)};
  record.result.chosen = 1;
  record.result.front = {{{{"erp", 0.0}}, {}, record.result.finalists[1].training, {}}};
  record.result.candidates = 12;
  record.result.evaluations = 34;
  record.result.converged = true;
  return record;
}

TEST(TuningProfile, TellsSettingsAndWhereTheyComeFrom) {
  const Profile profile = parse_profile(tuned_profile_yaml(tuned()), "tuned.yaml");
  EXPECT_EQ(profile.engine, "bullet");
  EXPECT_EQ(profile.name, "tuned");
  EXPECT_EQ(profile.settings, (Settings{{"erp", 0.0}}));
}

TEST(TuningProfile, ProvenanceNamesEverythingButTheMachine) {
  const std::string text = tuned_profile_yaml(tuned());
  for (const std::string part :
       {"version: \"3.24\", precision: double", "{name: one, sha256: ab12}",
        "{name: two, sha256: cd34}", "rates: [240, 1000]", "search: 16, final: 64", "seed: 7",
        "evaluations: 34", "start: 40", "profile: 0.5", "held_out: 0.75", "start: \"begin.yaml\""})
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
  EXPECT_TRUE(contains(text, context().commit));
  EXPECT_FALSE(contains(text, "somewhere"));
  EXPECT_FALSE(contains(text, context().date.substr(0, 10)));
  EXPECT_EQ(text, tuned_profile_yaml(tuned()));
  // A scene stands there once, whatever the number of rates.
  EXPECT_EQ(text.find("sha256: ab12"), text.rfind("sha256: ab12"));
}

TEST(TuningProfile, SaysWhatItMustBeWithin) {
  TuningRecord record = tuned();
  record.goal.within = 0.05;
  EXPECT_TRUE(contains(tuned_profile_yaml(record), "least CPU time within 5.00 %"));
}

TEST(TuningTable, ShowsBeforeAndAfterAndTheTradeOff) {
  TuningRecord record = tuned();
  record.start = "default";
  TableStyle style;
  style.width = 120;
  const std::string text = tuning_table(record, style);
  for (const std::string part : {"bullet 3.24 double", "240 Hz", "1000 Hz", "held out", "erp 0",
                                 "i.sliding_time", "2 ms/s", "1.5 times", "pushed out"})
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
  EXPECT_FALSE(contains(text, "overfitted"));
  // The engine's own settings are not listed.
  EXPECT_FALSE(contains(text, "rigid"));
}

TEST(TuningTable, WarnsOfOverfittingAndOfFailures) {
  TuningRecord record = tuned();
  record.result.finalists[1].held_out->worst = 1.01;  // 2.02 times 0.5
  RunScore& run = record.result.finalists[1].runs[1];
  run.failed = 0.25;
  run.reason = "unstable: not finite";
  TableStyle style;
  style.width = 140;
  const std::string text = tuning_table(record, style);
  EXPECT_TRUE(contains(text, "overfitted")) << text;
  EXPECT_TRUE(contains(text, "tuned, one at 1000 Hz: unstable: not finite")) << text;
}

TEST(TuningTable, SaysWhatKeepsASceneFailing) {
  TuningRecord record = tuned();
  for (TuningFinalist& each : record.result.finalists) {
    each.runs[1].failed = 1;
    each.runs[1].reason = "cue-substrate.restitution fails in all phases";
    each.training = score_of(std::span(each.runs).first(2), record.goal);
  }
  TableStyle style;
  style.width = 140;
  const std::string table = tuning_table(record, style);
  EXPECT_TRUE(contains(table, "one at 1000 Hz: cue-substrate.restitution fails in all phases"))
      << table;
  EXPECT_EQ(tuning_error_text(record.result.best().runs[1]),
            "cue-substrate.restitution fails in all phases");
  const std::string profile = tuned_profile_yaml(record);
  EXPECT_TRUE(contains(profile, "profile: \"one: cue-substrate.restitution fails in all phases\""))
      << profile;
  EXPECT_FALSE(contains(table + profile, "100 %"));
}

TEST(TuningProfile, SaysWhereItIsNoBetterThanWhatItBeganFrom) {
  TuningRecord record = tuned();
  EXPECT_FALSE(contains(tuned_profile_yaml(record), "no_better_than"));
  record.result.finalists[1].profile = "physical";
  TableStyle style;
  style.width = 140;
  for (const std::string& text : {tuned_profile_yaml(record), tuning_table(record, style)})
    EXPECT_TRUE(contains(text, "physical")) << text;
  EXPECT_TRUE(contains(tuned_profile_yaml(record), "no_better_than: \"physical\""));
  EXPECT_TRUE(contains(tuned_profile_yaml(record), "begun_from: \"physical\""));
  EXPECT_EQ(json_of(record)["improved"], false);
  EXPECT_EQ(json_of(record)["no_better_than"], "physical");
}

TEST(TuningJson, HoldsBothEndsAndTheTradeOff) {
  const nlohmann::ordered_json json = json_of(tuned());
  EXPECT_EQ(json["schema"], "slipcheck-tuning/1");
  EXPECT_EQ(json["start"]["training"]["worst"], 40);
  EXPECT_EQ(json["chosen"]["settings"], (nlohmann::json{{"erp", 0.0}}));
  EXPECT_EQ(json["chosen"]["held_out"]["worst"], 0.75);
  EXPECT_EQ(json["chosen"]["runs"].size(), 3u);
  EXPECT_EQ(json["chosen"]["runs"][2]["held_out"], true);
  EXPECT_EQ(json["scenes"].size(), 1u);
  EXPECT_EQ(json["trade_off"][0]["settings"]["erp"], 0);
  EXPECT_EQ(json["improved"], true);
  EXPECT_EQ(json["no_better_than"], nullptr);
  EXPECT_EQ(json["overfitted"], false);
  EXPECT_EQ(json["within"], nullptr);
}

}  // namespace
}  // namespace slipcheck
