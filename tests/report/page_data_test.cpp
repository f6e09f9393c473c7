#include "report/html/page_data.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "records.h"
#include "report/charts/plot_text.h"
#include "report/charts/report_charts.h"
#include "report/html/packed_text.h"
#include "report/html/page_channel.h"
#include "report/html/page_chart.h"
#include "scenario/load.h"
#include "study_records.h"

namespace slipcheck::testing {
namespace {

using Json = nlohmann::json;

/// As the page's script reads a channel.
std::vector<double> decoded(const Json& channel, std::size_t count) {
  if (channel.is_number()) return std::vector<double>(count, channel.get<double>());
  std::vector<double> values;
  std::int64_t sum = 0;
  for (const Json& delta : channel.at("q")) {
    if (!delta.is_null()) sum += delta.get<std::int64_t>();
    values.push_back(delta.is_null()
                         ? kNaN
                         : channel.at("o").get<double>() +
                               channel.at("s").get<double>() * static_cast<double>(sum));
  }
  return values;
}

Json data_of(const ReportContent& content) {
  return page_data(content, report_charts(content, ChartExtent::page));
}

Json scene_data(const SceneRecord& scene) {
  ReportContent content;
  content.scenes = {scene};
  return data_of(content).at("scenes").at(0);
}

TEST(PageChannel, IsRightToHalfAStep) {
  std::vector<double> values;
  for (int k = 0; k < 200; ++k) values.push_back(1e3 + 7e-3 * std::sin(0.1 * k));
  const Json channel = page_channel(values);
  const std::vector<double> read = decoded(channel, 200);
  ASSERT_EQ(read.size(), values.size());
  // Half of a 4000th of the range 0.014, and the rounding of `s` to four digits.
  for (std::size_t k = 0; k < values.size(); ++k)
    EXPECT_NEAR(read[k], values[k], 0.5 * 0.014 / 4000 * 1.001);
}

TEST(PageChannel, LeavesOutWhatIsNotFinite) {
  const std::vector<double> values = {1, kNaN, 3, kInfinity, 2};
  const Json channel = page_channel(values, 0, 2);
  EXPECT_EQ(channel.at("q"), Json::parse("[0, null, 2, null, -1]"));
  EXPECT_EQ(channel.at("o"), 1);
  EXPECT_EQ(channel.at("s"), 1);
  const std::vector<double> none = {kNaN, -kInfinity};
  EXPECT_EQ(page_channel(none).at("q"), Json::parse("[null, null]"));
  EXPECT_EQ(page_channel({}).at("q"), Json::array());
}

TEST(PageChannel, IsANumberWhereNothingChanges) {
  const std::vector<double> level = {0.1, 0.1, 0.1}, noise = {1, 1 + 1e-15, 1};
  EXPECT_EQ(page_channel(level), Json(0.1));
  EXPECT_EQ(page_channel(noise), Json(1));
  const std::vector<double> small = {1e-9, -1e-9};
  EXPECT_TRUE(page_channel(small).is_object());
  EXPECT_EQ(page_channel(small, 1e-8), Json(0));
}

TEST(PageChannel, RoundsNumbers) {
  EXPECT_EQ(page_number(1.0 / 3).dump(), "0.333333");
  EXPECT_EQ(page_number(240).dump(), "240");
  EXPECT_EQ(page_number(-2.0 / 3, 2).dump(), "-0.67");
  EXPECT_TRUE(page_number(kNaN).is_null());
  EXPECT_TRUE(page_number(-kInfinity).is_null());
}

TEST(PageData, UnpacksToWhatItWas) {
  ReportContent content;
  content.scenes = {lottery_scene(), box_scene()};
  // RFC 4648, section 10.
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("fooba"), "Zm9vYmE=");
  const std::string text = data_of(content).dump(), packed = deflated(text);
  EXPECT_EQ(packed_page_data(content, report_charts(content, ChartExtent::page)),
            base64_of(packed));
  EXPECT_LT(packed.size(), text.size() / 2);
  std::string unpacked(text.size(), '\0');
  uLongf size = unpacked.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(unpacked.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  EXPECT_EQ(size, text.size());
  EXPECT_EQ(unpacked, text);
}

TEST(PageData, HashesAsBrowsersDo) {
  // FIPS 180-4's example "abc", its digest in base64.
  EXPECT_EQ(source_hash("abc"), "sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=");
}

TEST(PageData, HoldsEveryPhaseOfEveryRun) {
  SceneRecord scene = lottery_scene(64);
  scene.runs[0].observables["i.sliding_time"].values[7] = kNaN;
  scene.runs.push_back(failed_run(EngineRecord::Status::crashed, "signal 11"));
  const Json data = scene_data(scene);
  ASSERT_EQ(data.at("runs").size(), 3u);
  EXPECT_EQ(data["runs"][0]["label"], "bullet double default 240 Hz");
  EXPECT_EQ(data["runs"][1]["rate"], 4000);
  EXPECT_EQ(data["runs"][1]["verdict"], "deviates");
  EXPECT_EQ(data["runs"][2]["verdict"], "failed");
  EXPECT_NE(data["runs"][0]["look"], data["runs"][1]["look"]);
  ASSERT_EQ(data.at("charts").size(), 2u);
  EXPECT_EQ(data["charts"][0]["title"], "i-j.effective_restitution");
  const Json& e = data["charts"][0]["panels"][0];
  EXPECT_EQ(e["y"]["runs"], Json::parse("[0, 1]"));  // the third shows nothing
  EXPECT_EQ(e["y"]["names"][1], "bullet double default 4000 Hz");
  EXPECT_DOUBLE_EQ(e["truth"]["value"], 0.357142857);
  EXPECT_DOUBLE_EQ(e["truth"]["tolerance"], 0.005);
  EXPECT_NEAR(e["bands"][0]["x"][0].get<double>(), 5.0 / 14 - 0.005, 1e-6);
  EXPECT_TRUE(e["bands"][0]["y"][1].is_null());  // up to the frame
  // Every phase of both runs is within, outside or beyond the axis.
  const auto points = [](const Json& panel) {
    std::size_t count = 0;
    for (const Json& curve : panel["curves"])
      if (curve.contains("notes")) {
        EXPECT_EQ(curve["notes"].size(), curve["x"].size());
        count += curve["notes"].size();
      }
    return count;
  };
  EXPECT_EQ(points(e), 2u * 64);
  EXPECT_EQ(e["curves"][0]["label"], "reference");
  EXPECT_EQ(e["curves"][1]["label"], "within the tolerance");
  EXPECT_EQ(e["curves"][1]["x"][0], 0.358);
  EXPECT_EQ(e["curves"][1]["notes"][0], "phase 1 of 64");
  EXPECT_EQ(e["curves"][1]["look"]["ink"], "blue");
  EXPECT_TRUE(e["curves"][1]["look"]["line"].is_null());
  const Json& t = data["charts"][1]["panels"][0];
  EXPECT_EQ(t["x"]["label"], "i.sliding_time [ms]");
  EXPECT_EQ(points(t), 2u * 64 - 1);
}

TEST(PageData, HoldsWhatABoxShowsOverTime) {
  SceneRecord scene = box_scene();
  scene.reference.box->samples = 200;
  const Json charts = scene_data(scene).at("charts");
  const auto strips = std::ranges::find_if(
      charts, [](const Json& chart) { return chart["title"] == "symmetric-steel over time"; });
  ASSERT_NE(strips, charts.end());
  // H, K and the collision rate; R is zero throughout.
  ASSERT_EQ((*strips)["panels"].size(), 3u);
  const Json& height = (*strips)["panels"][0];
  EXPECT_EQ(height["y"]["label"], "H [mm]");
  EXPECT_EQ(height["curves"][2]["label"], "mean");
  EXPECT_EQ(height["curves"][2]["y"], Json::parse("[15, 15]"));
  EXPECT_EQ(height["bands"][0]["y"], Json::parse("[14, 16]"));
  EXPECT_EQ(height["curves"][0]["label"], "not averaged");
  const Json& averaged = height["curves"][1];
  const std::vector<double> time = decoded(averaged["x"], 200);
  const std::vector<double> values = decoded(averaged["y"], 200);
  ASSERT_EQ(time.size(), 200u);
  for (std::size_t k = 0; k < 200; ++k) {
    const double t = 0.51 + 0.01 * static_cast<double>(k + 50);
    EXPECT_NEAR(time[k], t, 2.5 / 4000);
    EXPECT_NEAR(values[k], 15 + 2 * std::sin(7 * t), 4.0 / 4000);
  }
}

TEST(PageData, KeepsTheExtremesOfALongSeries) {
  SceneRecord scene = box_scene(100'000);
  scene.reference.box->series.height[54'321] = 0.02;
  const Json panel = scene_data(scene).at("charts")[0].at("panels")[0];
  const std::vector<double> height = decoded(panel.at("curves").at(0).at("y"), 0);
  EXPECT_LE(height.size(), 2u * 2u * 300u);
  EXPECT_NEAR(*std::max_element(height.begin(), height.end()), 20, 1e-2);
}

/// A ball of 10 mm that slides to the right at 1 m/s without turning, on a plane tilted by 5°.
SceneRecord sliding_ball() {
  SceneRecord scene;
  scene.scenario = parse_scenario(R"(slipcheck: 1
name: ball
title: A ball
materials: {steel: {density: 7850}}
contacts:
  - {between: [steel, substrate], friction: 0.3}
substrate: {tilt: 5 deg, periodic: [1, 2]}
bodies:
  - {name: ball, material: steel, sphere: {radius: 0.01}, mass: 0.5, position: [0, 0], velocity: [1, 0]}
run: {until: 0.1}
)",
                                  "ball.yaml");
  scene.scene = solved_scene(scene.scenario);
  return scene;
}

RecordedMotion slid(std::size_t frames) {
  RecordedMotion motion;
  motion.role = "worst";
  motion.phase = 3;
  motion.error = 2.5;
  for (std::size_t k = 0; k < frames; ++k) {
    MotionFrame frame;
    frame.time = 1e-3 * static_cast<double>(k);
    BodyState body;
    body.position = {frame.time, 0, 0.01};
    body.velocity = {1, 0, 0};
    frame.bodies = {body};
    motion.frames.push_back(frame);
  }
  return motion;
}

TEST(PageData, HoldsMotionWithItsQuantities) {
  SceneRecord scene = sliding_ball();
  EXPECT_TRUE(scene_data(scene).at("motion").is_null());
  scene.runs = {lottery_run(240, 1)};
  scene.reference.motion = slid(10);
  scene.runs[0].motions = {slid(10)};
  scene.runs[0].motions[0].frames[9].bodies[0].position.z() = 0.02;
  const Json motion = scene_data(scene).at("motion");
  EXPECT_EQ(motion["bodies"], Json::parse(R"([{"name": "ball", "radius": 0.01}])"));
  EXPECT_NEAR(motion["tilt"].get<double>(), 5, 1e-5);
  EXPECT_EQ(motion["substrate"], true);
  EXPECT_EQ(motion["periodic"], Json::parse("[1.0, 2.0]"));
  ASSERT_EQ(motion["runs"].size(), 2u);
  EXPECT_EQ(motion["runs"][0]["run"], -1);
  const Json& run = motion["runs"][1];
  EXPECT_EQ(run["run"], 0);
  EXPECT_EQ(run["role"], "worst");
  EXPECT_EQ(run["phase"], 3);
  EXPECT_EQ(run["error"], 2.5);
  const Json& ball = run["bodies"][0];
  EXPECT_EQ(ball["speed"], 1);
  const std::vector<double> x = decoded(ball["p"][0], 10), slip = decoded(ball["slip"][0], 10);
  EXPECT_NEAR(x[9], 9e-3, 1e-6);
  EXPECT_DOUBLE_EQ(slip[0], 1);
  EXPECT_TRUE(std::isnan(slip[9]));  // it is in the air
  EXPECT_EQ(run["energy"], 0.25);    // m v²/2
}

TEST(PageData, ThinsMotionButKeepsCollisions) {
  SceneRecord scene = sliding_ball();
  scene.reference.motion = slid(1000);
  scene.reference.motion->frames[500].touches = {{0, 1}};
  scene.reference.motion->frames[777].touches = {{0, kSubstrate}};
  const Json run = scene_data(scene).at("motion").at("runs").at(0);
  const std::vector<double> time = decoded(run["time"], 0);
  ASSERT_EQ(time.size(), 64u);
  EXPECT_DOUBLE_EQ(time.front(), 0);
  EXPECT_NEAR(time.back(), 0.999, 1e-4);
  ASSERT_EQ(run["touches"].size(), 1u);
  const std::size_t frame = run["touches"][0][0];
  EXPECT_NEAR(time[frame], 0.5, 1e-4);
  EXPECT_NEAR(time[frame - 1], 0.499, 1e-4);
}

TEST(PageData, ShowsLessOfEachRunWhereThereAreMany) {
  // 500 × 2 × 64 states are too many for a page, 500 × 40 are not.
  SceneRecord scene = sliding_ball();
  EngineRecord run = lottery_run(240, 1);
  run.motions = {slid(64), slid(64)};
  run.motions[0].role = "nearest";
  scene.runs = {run};
  EXPECT_EQ(scene_data(scene).at("motion").at("runs").size(), 2u);
  scene.runs.assign(500, run);
  const Json runs = scene_data(scene).at("motion").at("runs");
  ASSERT_EQ(runs.size(), 500u);
  EXPECT_EQ(runs[499]["role"], "worst");
  EXPECT_EQ(decoded(runs[499]["time"], 0).size(), 40u);
}

TEST(PageData, LeavesOutMotionThatDoesNotFitTheScene) {
  SceneRecord scene = sliding_ball();
  scene.reference.motion = slid(5);
  scene.reference.motion->frames[2].bodies.clear();
  EXPECT_TRUE(scene_data(scene).at("motion").is_null());
  scene.reference.motion = RecordedMotion{};
  EXPECT_TRUE(scene_data(scene).at("motion").is_null());
}

TEST(PageData, HoldsErrorAgainstRunTime) {
  ReportContent content;
  content.precision = {precision_scene()};
  const Json data = data_of(content).at("precision").at(0);
  EXPECT_EQ(data["id"], "precision-1");
  EXPECT_EQ(data["name"], "symmetric-steel");
  ASSERT_EQ(data["charts"].size(), 2u);
  EXPECT_EQ(data["charts"][0]["title"], "symmetric-steel, i-j.effective_restitution");
  const Json& work = data["charts"][0]["panels"][0];
  EXPECT_EQ(work["x"]["log"], true);
  const auto tuned = std::ranges::find_if(
      work["curves"], [](const Json& curve) { return curve["label"] == "bullet double tuned"; });
  ASSERT_NE(tuned, work["curves"].end());
  EXPECT_EQ((*tuned)["x"][0], 0.00048);  // 2 µs × 240
  EXPECT_EQ((*tuned)["y"][0], 0.001);
  EXPECT_EQ((*tuned)["look"]["line"], "solid");
}

TEST(PageData, HoldsMapsAndLimits) {
  ReportContent content;
  EXPECT_TRUE(data_of(content).at("stability").is_null());
  content.limits = limit_results();
  content.limits.maps.push_back({});  // interrupted
  const Json data = data_of(content).at("stability");
  ASSERT_EQ(data["maps"].size(), 1u);
  ASSERT_EQ(data["maps"][0]["panels"].size(), 1u);  // errors are in the cells' notes
  const Json& map = data["maps"][0]["panels"][0];
  std::vector<std::string> outcomes;
  for (const Json& cell : map["cells"])
    outcomes.push_back(map["looks"][cell["look"].get<std::size_t>()]["label"]);
  EXPECT_EQ(outcomes, (std::vector<std::string>{"accurate", "degraded", "tunnelled", "NaN",
                                                "accurate", "energy growing"}));
  EXPECT_EQ(map["cells"][1]["note"], "speed [m/s]: 0.1\nrestitution [-]: 0\n|e − e_ref|: 0.03");
  ASSERT_EQ(data["limits"].size(), 2u);
  EXPECT_EQ(data["limits"][0]["title"], "largest stable step, steel-pair");
  EXPECT_EQ(data["limits"][0]["panels"][0]["y"]["names"].size(), 3u);
  EXPECT_EQ(data["limits"][1]["panels"][0]["curves"][0]["x"][0], 1.01e-5);
}

TEST(PageChart, HoldsNoFormulaAndNothingThatJsonHasNot) {
  Panel panel{"t^s_{col}", {plot_literal("a_b")}, {}, {{"", {}, {1, kNaN, kInfinity}, {1, 2, 3}}}};
  panel.colours = ColourMap{{1, 2}, {1}, {0, 1}, "z"};
  Panel plain = panel;
  plain.colours.reset();
  const Json chart = page_chart({"name", "", "", {panel, plain}});
  ASSERT_EQ(chart["panels"].size(), 1u);
  EXPECT_EQ(chart["panels"][0]["title"], "t^s_col");
  EXPECT_EQ(chart["panels"][0]["x"]["label"], "a_b");
  EXPECT_EQ(chart["panels"][0]["curves"][0]["x"], Json::parse("[1, null, null]"));
  EXPECT_EQ(page_palette()["blue"], Json::parse(R"(["#0072b2", "#56b4e9"])"));
}

}  // namespace
}  // namespace slipcheck::testing
