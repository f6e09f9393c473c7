#include "studies/baseline/baseline_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../support/refusal.h"
#include "baselines.h"

namespace slipcheck {
namespace {

using testing::meeting;
using testing::meeting_baseline;

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), by);
}

/// The message of the fault in a baseline in which `old` was replaced.
std::string fault(const std::string& old, const std::string& by) {
  return test::refusal_of<BadJson>([&] {
    parse_baseline(replaced(baseline_text(meeting_baseline()), old, by), "b/meeting.json");
  });
}

TEST(BaselineFile, ReadsBackToTheLastBit) {
  SceneRecord scene = meeting();
  scene.reference.observables["i.sliding_time"] = {0.1 + 0.2, std::nextafter(1e-16, 1)};
  scene.reference.observables["i.final_velocity.z"] = {-5e-324, INFINITY};
  scene.runs[0].observables["i.sliding_time"].max = std::nextafter(0.0215, 1);
  scene.runs[0].observables["i.sliding_time"].missing = 3;
  scene.runs.push_back(scene.runs[0]);
  scene.runs[1].status = RunStatus::skipped;
  const SceneBaseline old = baseline_of(scene, 4, "0.1.0");
  const SceneBaseline read = parse_baseline(baseline_text(old), "meeting.json");
  EXPECT_EQ(read.scene, "meeting");
  EXPECT_EQ(read.sha256, std::string(64, 'a'));
  EXPECT_EQ(read.slipcheck, "0.1.0");
  EXPECT_EQ(read.phases, 4u);
  EXPECT_EQ(read.solver, "event");
  EXPECT_EQ(read.cpu_seconds, 2e-6);
  ASSERT_EQ(read.reference.size(), 7u);
  EXPECT_EQ(read.reference.at("i.sliding_time").value, 0.1 + 0.2);
  EXPECT_EQ(read.reference.at("i.sliding_time").uncertainty, std::nextafter(1e-16, 1));
  EXPECT_EQ(read.reference.at("i.final_velocity.z").value, -5e-324);
  EXPECT_TRUE(std::isnan(read.reference.at("i.final_velocity.z").uncertainty));
  ASSERT_EQ(read.runs.size(), 2u);
  EXPECT_EQ(run_label(read.runs[0]), "bullet double default 240 Hz");
  EXPECT_EQ(read.runs[0].version, "3.24");
  EXPECT_EQ(read.runs[0].status, RunStatus::ok);
  EXPECT_EQ(read.runs[0].verdict, Verdict::within);
  EXPECT_EQ(read.runs[0].phases, 4u);
  EXPECT_EQ(read.runs[0].cpu_seconds, 1e-3);
  EXPECT_EQ(read.runs[0].observables, old.runs[0].observables);
  EXPECT_EQ(read.runs[0].observables.at("i.sliding_time").max, std::nextafter(0.0215, 1));
  EXPECT_EQ(read.runs[1].verdict, Verdict::undecided);
  EXPECT_EQ(baseline_text(read), baseline_text(old));
}

TEST(BaselineFile, KeepsOfAnEngineOnlyWhatHasATolerance) {
  const auto kept = meeting_baseline().runs[0].observables;
  EXPECT_EQ(kept.size(), 3u);
  EXPECT_TRUE(kept.contains("i.final_velocity.x"));  // a component's is the vector's
  EXPECT_FALSE(kept.contains("i.stopping_time"));
}

TEST(BaselineFile, HasALineForEachObservable) {
  const std::string text = baseline_text(meeting_baseline());
  EXPECT_NE(text.find("\n      \"i.stopping_time\": {\"value\":0.5,\"uncertainty\":1e-16}\n"),
            std::string::npos)
      << text;
}

TEST(BaselineFile, FaultsHaveFilePlaceRuleAndValue) {
  const std::string file = "b/meeting.json: ";
  EXPECT_EQ(fault("slipcheck-baseline/1", "slipcheck-baseline/2"),
            file + "schema: must be slipcheck-baseline/1, got \"slipcheck-baseline/2\"");
  EXPECT_EQ(fault("\"scene\": \"meeting\"", "\"scene\": \"other\""),
            file + "scene: must be meeting, as the file is named, got \"other\"");
  EXPECT_EQ(fault("\"rate\": 240.0", "\"rate\": \"fast\""),
            file + "runs[0].rate: must be a number, got \"fast\"");
  EXPECT_EQ(fault("\"rate\": 240.0", "\"rate\": 0"), file + "runs[0].rate: must be > 0, got 0");
  EXPECT_EQ(fault("\"status\": \"ok\"", "\"status\": \"fine\""),
            file +
                "runs[0].status: must be one of ok, unstable, crashed, timed_out, skipped, got "
                "\"fine\"");
  EXPECT_EQ(
      fault("\"verdict\": \"within\"", "\"verdict\": 1"),
      file +
          "runs[0].verdict: must be one of not judged, within, undecided, deviates, failed, got 1");
  EXPECT_EQ(fault("\"phases\": 4", "\"phases\": 0"), file + "phases: must be >= 1, got 0");
  EXPECT_EQ(fault("\"phases\": 4", "\"phases\": -4"),
            file + "phases: must be a whole number >= 0, got -4");
  EXPECT_EQ(fault("\"solver\": \"event\"", "\"solver\": {}"),
            file + "reference.solver: must be a text, got an object");
  EXPECT_EQ(fault("{\"value\":0.5,\"uncertainty\":1e-16}", "0.5"),
            file + "reference.observables.i.stopping_time: must be an object, got 0.5");
  EXPECT_EQ(
      fault("{\"value\":0.5,\"uncertainty\":1e-16}", "{\"value\":0.5,\"uncertainty\":-1e-16}"),
      file + "reference.observables.i.stopping_time.uncertainty: must be >= 0, got -1e-16");
  EXPECT_EQ(fault("1e-16", "1e400"), file + "must be JSON: number overflow parsing '1e400'");
  EXPECT_EQ(fault("\"sha256\"", "\"sha\""), file + "sha256: must be there");
  EXPECT_EQ(fault("\"runs\": [", "\"runs\": {}, \"more\": ["),
            file + "runs: must be a list, got an object");
  EXPECT_TRUE(fault("{", "").starts_with(file + "must be JSON: ")) << fault("{", "");
}

}  // namespace
}  // namespace slipcheck
