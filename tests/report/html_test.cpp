#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "records.h"
#include "report/charts/scene_charts.h"
#include "report/html/html_text.h"
#include "report/html/page_scenes.h"
#include "report/html/report_page.h"
#include "report/rows/phase_spread.h"
#include "scenario/load.h"
#include "text_search.h"

namespace slipcheck::testing {
namespace {

/// The page without its script.
std::string page_of(const std::vector<SceneRecord>& scenes, const std::string& command = "") {
  ReportContent content;
  content.context = context();
  content.commands = {command};
  content.scenes = scenes;
  return report_page(content, PageScript::left_out);
}

TEST(Html, EscapesWhatScenesAndEnginesSay) {
  const std::string evil = "<script>alert(1)</script>\"'&";
  SceneRecord scene = lottery_scene();
  scene.scenario.name = scene.scenario.title = scene.scenario.source = evil;
  scene.scenario.bodies[0].name = evil;
  scene.reference.warnings = {evil};
  scene.runs[0].profile = evil;
  scene.runs[0].warnings = {evil};
  scene.runs[0].applied.settings = {{evil, evil}};
  scene.runs[0].applied.not_represented = {Lack{evil, evil}};
  scene.runs[1] = failed_run(EngineRecord::Status::crashed, evil);
  const std::string html = page_of({scene}, evil);
  EXPECT_FALSE(contains(html, "<script"));
  EXPECT_TRUE(contains(html, "&lt;script&gt;alert(1)&lt;/script&gt;&quot;&#39;&amp;"));
}

TEST(Html, EscapesControlCharacters) {
  EXPECT_EQ(escaped(std::string("a\0\x1b", 3)), "a\uFFFD\uFFFD");
}

TEST(Html, NeedsNoNetwork) {
  const std::string html = page_of({lottery_scene()}, "slipcheck run");
  EXPECT_FALSE(contains(html, "http://"));
  EXPECT_FALSE(contains(html, "https://"));
  EXPECT_FALSE(contains(html, "url("));
  EXPECT_FALSE(contains(html, "@import"));
  EXPECT_FALSE(contains(html, " src="));
  EXPECT_TRUE(contains(html, "default-src 'none'"));
}

TEST(Html, ShowsWhatAnEngineIsExpectedToDo) {
  SceneRecord scene = expected_lottery();
  std::string html = page_of({scene});
  EXPECT_TRUE(contains(html, "<span class=\"verdict within\">✓ as expected</span>"));
  EXPECT_TRUE(contains(html, "240 Hz <span class=\"good\">✓ as expected</span></h5>"));
  EXPECT_TRUE(contains(html,
                       "<td>max</td><td data-value=\"0.498\">0.4980</td><td "
                       "data-value=\"0.49\">0.4900 … 0.5000</td><td class=\"good\">✓ as "
                       "expected</td>"));
  EXPECT_FALSE(contains(html, "Worst deviations"));
  // What the tolerance would say is still told.
  EXPECT_TRUE(contains(html, "62 of 64 phases are outside the tolerance of 0.005"));

  scene.runs[0].expect->observables["i-j.effective_restitution"] = expected_max(0.4, 0.45);
  html = page_of({scene});
  EXPECT_TRUE(contains(html, "<span class=\"verdict deviates\">✗ NOT AS EXPECTED</span>"));
  EXPECT_TRUE(contains(html, "i-j.effective_restitution max 0.4980, expected 0.4000 … 0.4500"));

  scene.runs[0] = failed_run(EngineRecord::Status::crashed, "signal 11");
  scene.runs[0].expect = Expectation{RunStatus::crashed, {}};
  html = page_of({scene});
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
  scene.runs[0].errors["i.final_velocity"] = {0.283, 0.283, 0.1, false, Verdict::deviates, ""};
  const auto spread = phase_spread(scene, "i.final_velocity");
  ASSERT_TRUE(spread);
  EXPECT_DOUBLE_EQ(spread->runs[0].values[0], 0.1 * std::sqrt(2.0));
  EXPECT_EQ(spread->runs[0].outside, 1u);
  EXPECT_EQ(words_of(*spread, spread->runs[0]),
            "i.final_velocity is off by 141.4 mm/s: outside the tolerance of 10 %.");
}

TEST(Html, ChartsTwinsOnce) {
  SceneRecord scene = lottery_scene(64);
  for (EngineRecord& run : scene.runs) {
    run.observables["j.sliding_time"] = run.observables["i.sliding_time"];
    run.errors["j.sliding_time"] = run.errors["i.sliding_time"];
  }
  std::set<std::string> taken;
  const std::vector<Chart> charts = phase_charts(scene, ChartExtent::page, taken);
  ASSERT_EQ(charts.size(), 2u);
  EXPECT_EQ(charts[0].title, "i-j.effective\\_restitution");
  EXPECT_EQ(charts[1].title, "i.sliding\\_time [ms]");
  EXPECT_TRUE(contains(charts[1].caption, "It looks the same for j.sliding\\_time."));
  EXPECT_TRUE(contains(charts[0].caption, "A smaller step does not help"));
}

TEST(Html, ChartsTheWorstSixObservables) {
  SceneRecord scene = lottery_scene(1);
  scene.runs.resize(1);
  for (int body = 1; body <= 9; ++body) {
    const std::string name = fmt::format("g{}.sliding_time", body);
    scene.reference.observables[name] = {0.01, 0};
    EnsembleValue& value = scene.runs[0].observables[name];
    value.values = {0.01 * (1 + body)};
    scene.runs[0].errors[name] = {1. * body, 1. * body, 0.01, false, Verdict::deviates, ""};
  }
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const Chart& chart : phase_charts(scene, ChartExtent::page, taken))
    names.push_back(chart.name.substr(std::string("phases-symmetric-steel-").size()));
  EXPECT_EQ(names, (std::vector<std::string>{"i-j.effective_restitution", "g9.sliding_time",
                                             "g8.sliding_time", "g7.sliding_time",
                                             "g6.sliding_time", "g5.sliding_time"}));
}

TEST(Html, BeginsWithWhatWasFound) {
  SceneRecord good = lottery_scene(4);
  good.scenario.name = "good-scene";
  good.runs.resize(1);
  good.runs[0].profile = "tuned";
  good.runs[0].errors.erase("i-j.effective_restitution");
  const std::string html = page_of({lottery_scene(4), good, box_scene()}, "slipcheck run x.yaml");
  EXPECT_TRUE(contains(html,
                       "<p class=\"finding\" id=\"finding\">tuned is within all tolerances in 1 of "
                       "1 run, default in "
                       "0 of 2; worst: symmetric-steel, i-j.effective_restitution off by up to "
                       "0.141, tolerance 0.005 "
                       "(bullet double default 240 Hz).</p>"));
  EXPECT_LT(html.find("id=\"finding\""), html.find("id=\"index\""));
  EXPECT_LT(html.find("id=\"index\""), html.find("<section class=\"scene"));
  // Nothing of what the user typed stands before it.
  ASSERT_TRUE(contains(html, "<dt>command</dt><dd>slipcheck run x.yaml</dd>"));
  EXPECT_GT(html.find("<dt>command</dt>"), html.rfind("<section class=\"scene"));
  EXPECT_TRUE(
      contains(html, "<span class=\"share\">100 %</span> <span class=\"whose\">tuned</span>"));
}

TEST(Html, FoldsScenesByTopicFailuresFirst) {
  SceneRecord good = lottery_scene(4), slope = lottery_scene(4);
  good.scenario.name = "a-good-one";
  good.runs.resize(1);
  good.runs[0].errors.erase("i-j.effective_restitution");
  slope.scenario.name = "slope";
  std::get<Substrate>(slope.scenario.surroundings).tilt = 0.1;
  const std::string html = page_of({slope, good, lottery_scene(4)});
  const auto at = [&](const std::string& id) { return html.find("id=\"scene-" + id + "\""); };
  EXPECT_LT(at("symmetric-steel"), at("a-good-one"));
  EXPECT_LT(at("a-good-one"), at("slope"));
  EXPECT_TRUE(contains(html, "<h2>Slopes <span class=\"faint\">0 of 1 within</span></h2>"));
  EXPECT_TRUE(contains(html, "<h2>Collisions <span class=\"faint\">1 of 2 within</span></h2>"));
  EXPECT_TRUE(contains(html,
                       "<span class=\"says\">1 of 1 run within; nearest to its tolerance: "
                       "i.sliding_time, 0.3 of it (bullet double default 240 Hz).</span>"));
  EXPECT_EQ(count(html, "<section class=\"scene"), 3u);
  // No scene is open.
  EXPECT_EQ(count(html, "<details><summary><h3>"), 3u);
}

TEST(Html, IndexHasTheWorstPhaseOfEachRunAndLinks) {
  const std::string html = page_of({lottery_scene(4)});
  // 0.141 is 28.2 tolerances of 0.005.
  EXPECT_TRUE(contains(html, "<td data-method=\"0\" class=\"m3\" data-value=\"28.2\">28</td>"));
  EXPECT_TRUE(contains(html, "<a href=\"#scene-symmetric-steel\">symmetric-steel</a>"));
  EXPECT_TRUE(contains(html, "<span>bullet 3.24</span> <span>default</span> <span>240 Hz</span>"));
}

TEST(Html, NaiveRunsDecideNothingBesideOthers) {
  SceneRecord scene = lottery_scene(4);
  scene.runs[0].errors.erase("i-j.effective_restitution");
  scene.runs[1].profile = "naive";
  std::string html = page_of({scene});
  EXPECT_TRUE(contains(html, "<span class=\"verdict within\">✓ within</span>"));
  EXPECT_FALSE(contains(html, "Worst deviations"));
  EXPECT_TRUE(contains(html,
                       "is within in 0 of 1 run and decides no scene&#39;s verdict beside other "
                       "runs; in 1 scene only it is not within, which the exit code counts."));
  scene.runs.erase(scene.runs.begin());
  html = page_of({scene});
  EXPECT_TRUE(contains(html, "<span class=\"verdict deviates\">✗ deviates</span>"));
}

TEST(Html, SceneIdsAreDistinct) {
  EXPECT_EQ(scene_ids({lottery_scene(1), lottery_scene(1)}),
            (std::vector<std::string>{"scene-symmetric-steel", "scene-symmetric-steel-2"}));
}

TEST(Html, OpensOnlyWhatIsWrong) {
  SceneRecord scene = lottery_scene();
  EXPECT_EQ(count(page_of({scene}), "<details open"), 2u);
  for (auto& [name, error] : scene.runs[0].errors) error.verdict = Verdict::within;
  const std::string html = page_of({scene});
  EXPECT_EQ(count(html, "<details open"), 1u);
  EXPECT_TRUE(contains(html, "data-rate=\"240\" data-verdict=\"within\""));
  EXPECT_TRUE(contains(html, "data-rate=\"4000\" data-verdict=\"deviates\""));
}

TEST(Html, CellsHoldTheirNumbersInSI) {
  const std::string html = page_of({lottery_scene()});
  // The reference beside them is 27.78 ms.
  EXPECT_TRUE(contains(html,
                       "<td data-value=\"0.02765\">27.65</td><td data-value=\"0.0276\">27.60 … "
                       "27.70</td><td data-value=\"0.003\">0.300 %</td><td "
                       "data-value=\"0.01\">1 %</td>"));
  EXPECT_TRUE(contains(html, "<td>–</td>"));
}

TEST(Html, CountsWhatEnginesCannotRepresent) {
  SceneRecord first = lottery_scene(), second = lottery_scene();
  for (EngineRecord& run : first.runs)
    run.applied.not_represented = {Lack{"restitution below 0.3 m/s of approach"},
                                   Lack{"rolling (1.41 times)"}};
  for (EngineRecord& run : second.runs)
    run.applied.not_represented = {
        Lack{"slow approaches (below 1e-05 m/s)", "restitution below … m/s of approach"}};
  second.runs[0].profile = "tuned";
  const std::string html = page_of({first, second});
  EXPECT_TRUE(contains(
      html,
      "<th scope=\"col\">bullet default, of 2</th><th scope=\"col\">bullet tuned, of 1</th>"));
  EXPECT_TRUE(contains(
      html,
      "<th scope=\"row\">restitution below … m/s of approach</th><td data-value=\"2\">2</td><td "
      "data-value=\"1\">1</td>"));
  EXPECT_TRUE(contains(
      html, "<th scope=\"row\">rolling</th><td data-value=\"1\">1</td><td class=\"faint\">·</td>"));
  EXPECT_TRUE(contains(html, "rolling (1.41 times)"));
  first.runs.clear();
  EXPECT_FALSE(contains(page_of({first}), "What engines cannot represent"));
}

TEST(Html, TellsSharedSettingsOnce) {
  SceneRecord scene = lottery_scene();
  scene.runs[1].applied.settings["friction"] = 0.25;
  const std::string html = page_of({scene});
  EXPECT_TRUE(contains(html, "<tr><th scope=\"row\">solver</th><td>sequential</td></tr>"));
  EXPECT_EQ(count(html, "sequential"), 1u);
  EXPECT_TRUE(contains(html, "Settings of this run [SI]:</strong> friction 0.1</p>"));
  EXPECT_TRUE(contains(html, "Settings of this run [SI]:</strong> friction 0.25</p>"));
}

TEST(Html, TellsWhatASceneLeavesOut) {
  SceneRecord scene;
  scene.scenario = parse_scenario(R"(slipcheck: 1
name: ball
title: A ball
materials: {steel: {density: 7850}}
contacts:
  - {between: [steel, substrate], friction: 0.3, rolling: 0.02}
substrate: {}
bodies:
  - {name: ball, material: steel, sphere: {radius: 0.01}, position: [0, 0], velocity: [1, 0]}
run: {until: rest}
)",
                                  "ball.yaml");
  scene.scene = solved_scene(scene.scenario);
  const std::string html = page_of({scene});
  EXPECT_TRUE(contains(html, "<summary>Left out: 11 of 13 features</summary>"));
  EXPECT_TRUE(contains(html, "collisions of two bodies: one body; "));
  EXPECT_FALSE(contains(html, "rolling friction: "));
}

TEST(Html, TellsWhatIsNotThere) {
  SceneRecord scene = lottery_scene();
  scene.runs[1] = failed_run(EngineRecord::Status::timed_out, "no end after 60 s");
  const std::string html = page_of({scene}, "slipcheck run x.yaml");
  EXPECT_TRUE(contains(html, "no end after 60 s"));
  EXPECT_TRUE(contains(html, "⚠ failed"));
  EXPECT_TRUE(contains(html, "static friction, coupled drilling"));
  EXPECT_TRUE(contains(html, "slipcheck run x.yaml"));
}

TEST(Html, StaysBelowThreeMegabytes) {
  // 15 scenes of many bodies that all differ, 6 runs of each; the script is a third of it.
  SceneRecord scene = lottery_scene(64);
  EngineRecord run = scene.runs[0];
  for (int body = 0; body < 50; ++body) {
    const std::string name = fmt::format("g{}.sliding_time", body);
    scene.reference.observables[name] = {0.01 * (body + 1), 0};
    run.observables[name] = run.observables["i.sliding_time"];
    run.errors[name] = run.errors["i.sliding_time"];
  }
  scene.runs.assign(6, run);
  ReportContent content;
  content.scenes.assign(15, scene);
  EXPECT_LT(report_page(content).size(), 3'000'000u);
}

TEST(Html, SaysFromWhatItIsMade) {
  ReportContent content;
  content.context.cpu = "a <processor>";
  content.context.build = "release";
  content.commands = {"slipcheck run a.yaml", "slipcheck stability"};
  content.scenes = {lottery_scene()};
  const std::string html = report_page(content, PageScript::left_out);
  EXPECT_TRUE(contains(html, "<dd>a &lt;processor&gt;, 0 hardware threads</dd>"));
  EXPECT_TRUE(contains(html, "<dd>bullet 3.24</dd>"));
  EXPECT_TRUE(contains(html, "<dd>slipcheck run a.yaml</dd>"));
  EXPECT_TRUE(contains(html, "<dd>slipcheck stability</dd>"));
}

TEST(Html, DrawsTheFloorsSwingAndAPeriodicCell) {
  EXPECT_EQ(count(page_of({box_scene()}), "<path class=\"sway\""), 1u);
  SceneRecord scene = lottery_scene();
  EXPECT_EQ(count(page_of({scene}), "<path class=\"cell\""), 0u);
  scene.scenario.surroundings = Substrate{.periodic = Vector2(0.02, 0.01)};
  EXPECT_EQ(count(page_of({scene}), "<path class=\"cell\""), 1u);
}

/// No page grows with the scene.
TEST(Html, DrawsManyBodiesInPart) {
  SceneRecord scene = lottery_scene();
  const Body ball = scene.scenario.bodies[0];
  scene.scenario.bodies.clear();
  for (int k = 0; k < 1600; ++k) {
    Body& body = scene.scenario.bodies.emplace_back(ball);
    body.name = fmt::format("g{}", k);
    body.initial.position = {0.01 * (k % 40), 0.01 * (k / 40), body.sphere.radius};
    body.initial.velocity.setZero();
  }
  // Of one in the middle and one at the corner.
  scene.scenario.bodies[0].initial.velocity.x() = scene.scenario.bodies[820].initial.velocity.x() =
      1;
  const std::string html = page_of({scene});
  EXPECT_EQ(count(html, "<circle class=\"ball"), 500u);
  EXPECT_EQ(count(html, "<path class=\"arrow\""), 1u);
  EXPECT_TRUE(contains(html, "1600 bodies"));
  EXPECT_TRUE(contains(html, "Drawn are 500 in their middle."));
  scene.scenario.bodies.resize(500);
  const std::string all = page_of({scene});
  EXPECT_EQ(count(all, "<circle class=\"ball"), 500u);
  EXPECT_FALSE(contains(all, "in their middle"));
}

TEST(Html, CanBeEmpty) {
  EXPECT_TRUE(contains(page_of({}), "</html>"));
  SceneRecord scene;
  EXPECT_TRUE(contains(page_of({scene}), "? undecided"));
  scene.reference.run.reached = true;
  EXPECT_TRUE(contains(page_of({scene}), "– reference alone"));
}

}  // namespace
}  // namespace slipcheck::testing
