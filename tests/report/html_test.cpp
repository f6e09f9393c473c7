#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "records.h"
#include "report/html_report.h"
#include "report/html_text.h"
#include "report/phase_spread.h"

namespace slipcheck::testing {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

bool contains(const std::string& text, const std::string& part) { return count(text, part) > 0; }

TEST(Html, EscapesWhatScenesAndEnginesSay) {
  const std::string evil = "<script>alert(1)</script>\"'&";
  SceneRecord scene = lottery_scene();
  scene.scenario.name = scene.scenario.title = scene.scenario.source = evil;
  scene.scenario.bodies[0].name = evil;
  scene.reference.warnings = {evil};
  scene.runs[0].profile = evil;
  scene.runs[0].warnings = {evil};
  scene.runs[0].applied.settings = {{evil, evil}};
  scene.runs[0].applied.not_represented = {evil};
  scene.runs[1] = failed_run(EngineRecord::Status::crashed, evil);
  const std::string html = html_of({scene}, evil);
  EXPECT_FALSE(contains(html, "<script"));
  EXPECT_TRUE(contains(html, "&lt;script&gt;alert(1)&lt;/script&gt;&quot;&#39;&amp;"));
}

TEST(Html, EscapesControlCharacters) {
  EXPECT_EQ(escaped(std::string("a\0\x1b", 3)), "a\uFFFD\uFFFD");
}

TEST(Html, NeedsNoNetwork) {
  const std::string html = html_of({lottery_scene()}, "slipcheck run");
  EXPECT_FALSE(contains(html, "http://"));
  EXPECT_FALSE(contains(html, "https://"));
  EXPECT_FALSE(contains(html, "url("));
  EXPECT_FALSE(contains(html, "@import"));
  EXPECT_FALSE(contains(html, " src="));
  EXPECT_TRUE(contains(html, "default-src 'none'"));
}

TEST(Html, DrawsADotForEveryPhaseOfEveryRun) {
  // Two observables have a tolerance and are shown by two runs.
  EXPECT_EQ(count(html_of({lottery_scene(64)}, ""), "<use "), 2u * 2u * 64u);
}

TEST(Html, DrawsNoDotForAMissingPhase) {
  SceneRecord scene = lottery_scene(64);
  scene.runs[0].observables["i.sliding_time"].values[7] = kNaN;
  EXPECT_EQ(count(html_of({scene}, ""), "<use "), 2u * 2u * 64u - 1);
}

TEST(Html, MarksDotsOutsideTheToleranceByShape) {
  const std::string html = html_of({lottery_scene(64)}, "");
  // Of 64 values from 0.358 to 0.498 two are within 0.3571 ± 0.005, in each of two runs; sliding
  // times all are.
  EXPECT_EQ(count(html, "href=\"#o\""), 2u * 62u);
  EXPECT_EQ(count(html, "href=\"#i\""), 2u * (2u + 64u));
}

TEST(Html, KeepsOutliersFromSqueezingTheRest) {
  SceneRecord scene = lottery_scene(64);
  for (EngineRecord& run : scene.runs) run.observables["i-j.effective_restitution"].values[0] = 1e6;
  EXPECT_EQ(count(html_of({scene}, ""), "href=\"#r\""), 2u);
}

TEST(Html, ShowsWhatAnEngineIsExpectedToDo) {
  SceneRecord scene = expected_lottery();
  std::string html = html_of({scene}, "");
  EXPECT_TRUE(contains(html, "<span class=\"verdict within\">✓ as expected</span>"));
  EXPECT_TRUE(contains(html, "240 Hz <span class=\"good\">✓ as expected</span></h4>"));
  EXPECT_TRUE(contains(html,
                       "<td>max</td><td class=\"number\">0.4980</td><td class=\"number\">0.4900 … "
                       "0.5000</td><td class=\"good\">✓ as expected</td>"));
  EXPECT_FALSE(contains(html, "Worst deviations"));
  // What the tolerance would say is still drawn.
  EXPECT_EQ(count(html, "href=\"#o\""), 62u);

  scene.runs[0].expect->observables["i-j.effective_restitution"] = expected_max(0.4, 0.45);
  html = html_of({scene}, "");
  EXPECT_TRUE(contains(html, "<span class=\"verdict deviates\">✗ NOT AS EXPECTED</span>"));
  EXPECT_TRUE(contains(html, "i-j.effective_restitution max 0.4980, expected 0.4000 … 0.4500"));

  scene.runs[0] = failed_run(EngineRecord::Status::crashed, "signal 11");
  scene.runs[0].expect = Expectation{RunStatus::crashed, {}};
  html = html_of({scene}, "");
  EXPECT_TRUE(contains(html, "<span class=\"good\">✓ crashed, as expected</span>"));
  EXPECT_TRUE(contains(html, "signal 11"));
}

TEST(Html, SaysInWordsWhatTheChartShows) {
  const SceneRecord scene = lottery_scene(64);
  const auto spread = phase_spread(scene, "i-j.effective_restitution");
  ASSERT_TRUE(spread);
  EXPECT_EQ(
      words_of(*spread, spread->runs[0]),
      "Over 64 phases i-j.effective_restitution comes out between 0.3580 and 0.4980; 0.3571 is "
      "right: 62 of 64 phases are outside the tolerance of 0.005, 56 of them more than 5 % "
      "off.");
  ASSERT_EQ(words_on_convergence(*spread).size(), 1u);
  EXPECT_EQ(words_on_convergence(*spread)[0],
            "A smaller step does not help bullet double (default): from 240 to 4000 Hz the largest "
            "error goes from 0.141 to 0.141.");
  EXPECT_TRUE(words_on_convergence(*phase_spread(scene, "i.sliding_time")).empty());
}

TEST(Html, ShowsAVectorAsItsDistanceFromTheReference) {
  SceneRecord scene = lottery_scene(1);
  scene.runs.resize(1);
  scene.scenario.compare.tolerance["final_velocity"] = {0.1, false};
  const double reference[] = {0.3, 0.4, 0}, engine[] = {0.4, 0.3, 0};  // as long, but turned
  for (int k = 0; k < 3; ++k) {
    const std::string name = std::string("i.final_velocity.") + "xyz"[k];
    scene.reference.observables[name] = {reference[k], 0};
    scene.runs[0].observables[name].values = {engine[k]};
  }
  scene.reference.observables["i.final_velocity"] = {0.5, 0};
  scene.runs[0].observables["i.final_velocity"].values = {0.5};
  scene.runs[0].errors["i.final_velocity"] = {0.283, 0.283, 0.1, false, false, ""};
  const auto spread = phase_spread(scene, "i.final_velocity");
  ASSERT_TRUE(spread);
  EXPECT_DOUBLE_EQ(spread->runs[0].values[0], 0.1 * std::sqrt(2.0));
  EXPECT_EQ(spread->runs[0].outside, 1u);
  EXPECT_EQ(words_of(*spread, spread->runs[0]),
            "i.final_velocity is off by 141.4 mm/s: outside the tolerance of 10 %.");
}

TEST(Html, DrawsTwinsOnce) {
  SceneRecord scene = lottery_scene(64);
  for (EngineRecord& run : scene.runs) {
    run.observables["j.sliding_time"] = run.observables["i.sliding_time"];
    run.errors["j.sliding_time"] = run.errors["i.sliding_time"];
  }
  const std::string html = html_of({scene}, "");
  EXPECT_EQ(count(html, "<use "), 2u * 2u * 64u);
  EXPECT_TRUE(contains(html, "It looks the same for j.sliding_time."));
}

TEST(Html, TellsWhatIsNotThere) {
  SceneRecord scene = lottery_scene();
  scene.runs[1] = failed_run(EngineRecord::Status::timed_out, "no end after 60 s");
  const std::string html = html_of({scene}, "slipcheck run x.yaml");
  EXPECT_TRUE(contains(html, "no end after 60 s"));
  EXPECT_TRUE(contains(html, "⚠ failed"));
  EXPECT_TRUE(contains(html, "static friction, coupled drilling"));
  EXPECT_TRUE(contains(html, "slipcheck run x.yaml"));
}

TEST(Html, StaysBelowThreeMegabytes) {
  // 15 scenes of many bodies that all differ, 6 runs of each.
  SceneRecord scene = lottery_scene(64);
  EngineRecord run = scene.runs[0];
  for (int body = 0; body < 50; ++body) {
    const std::string name = fmt::format("g{}.sliding_time", body);
    scene.reference.observables[name] = {0.01 * (body + 1), 0};
    run.observables[name] = run.observables["i.sliding_time"];
    run.errors[name] = run.errors["i.sliding_time"];
  }
  scene.runs.assign(6, run);
  EXPECT_LT(html_of(std::vector<SceneRecord>(15, scene), "").size(), 3'000'000u);
}

TEST(Html, DrawsWhatABoxShowsOverTime) {
  const std::string html = html_of({box_scene()}, "");
  // H, K and the collision rate; R is zero throughout.
  EXPECT_EQ(count(html, "<path class=\"trace\""), 3u);
  EXPECT_EQ(count(html, "<line class=\"mean\""), 3u);
  EXPECT_EQ(count(html, "<rect class=\"band\""), 3u);
  EXPECT_EQ(count(html, "<path class=\"trace early\""), 0u);
  EXPECT_TRUE(contains(html, "time [s]"));
  EXPECT_TRUE(contains(html, "means over 250 samples after 50 periods, steady"));
  EXPECT_EQ(count(html_of({lottery_scene()}, ""), "<path class=\"trace"), 0u);
}

TEST(Html, DrawsSamplesThatAreNotAveragedFainter) {
  SceneRecord scene = box_scene();
  scene.reference.box->samples = 200;
  const std::string html = html_of({scene}, "");
  EXPECT_EQ(count(html, "<path class=\"trace early\""), 3u);
  // 50 of 250 samples come before the mean.
  EXPECT_EQ(count(html, "<line class=\"mean\" x1=\"20.00%\""), 3u);
}

TEST(Html, DrawsABoxWithoutAnErrorOrWithFewSamples) {
  SceneRecord scene = box_scene(20);
  for (auto& [name, value] : scene.reference.observables) value.uncertainty = kInfinity;
  EXPECT_EQ(count(html_of({scene}, ""), "<rect class=\"band\""), 0u);
  EXPECT_EQ(count(html_of({scene}, ""), "<path class=\"trace\""), 3u);
  EXPECT_EQ(count(html_of({box_scene(1)}, ""), "<path class=\"trace"), 0u);
  EXPECT_EQ(count(html_of({box_scene(0)}, ""), "<path class=\"trace"), 0u);
}

TEST(Html, KeepsALongSeriesShort) {
  // 16 characters a point, two points in each of 400 columns, up to twice that where the number of
  // samples is no multiple; three strips.
  const std::size_t without = html_of({box_scene(2)}, "").size();
  EXPECT_LT(html_of({box_scene(100'000)}, "").size(), without + 3u * 2u * 2u * 400u * 16u);
}

TEST(Html, DrawsTheFloorsSwingAndAPeriodicCell) {
  EXPECT_EQ(count(html_of({box_scene()}, ""), "<path class=\"sway\""), 1u);
  SceneRecord scene = lottery_scene();
  EXPECT_EQ(count(html_of({scene}, ""), "<path class=\"cell\""), 0u);
  scene.scenario.surroundings = Substrate{.periodic = Vector2(0.02, 0.01)};
  EXPECT_EQ(count(html_of({scene}, ""), "<path class=\"cell\""), 1u);
}

TEST(Html, CanBeEmpty) {
  EXPECT_TRUE(contains(html_of({}, ""), "</html>"));
  SceneRecord scene;
  EXPECT_TRUE(contains(html_of({scene}, ""), "reference only"));
}

}  // namespace
}  // namespace slipcheck::testing
