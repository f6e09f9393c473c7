#include "report/html/page_data.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "records.h"
#include "report/html/packed_text.h"
#include "report/html/page_channel.h"
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

Json scene_data(const SceneRecord& scene) {
  ReportContent content;
  content.scenes = {scene};
  return page_data(content).at("scenes").at(0);
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
  const std::string text = page_data(content).dump(), packed = deflated(text);
  EXPECT_EQ(packed_page_data(content), base64_of(packed));
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
  ASSERT_EQ(data.at("phases").size(), 2u);
  const Json& e = data["phases"][0];
  EXPECT_EQ(e["observable"], "i-j.effective_restitution");
  EXPECT_EQ(e["unit"], "");
  EXPECT_DOUBLE_EQ(e["reference"], 0.357142857);
  EXPECT_NEAR(e["low"].get<double>(), 5.0 / 14 - 0.005, 1e-9);
  EXPECT_NEAR(e["high"].get<double>(), 5.0 / 14 + 0.005, 1e-9);
  ASSERT_EQ(e["values"].size(), 3u);
  ASSERT_EQ(e["values"][0].size(), 64u);
  EXPECT_EQ(e["values"][0][0], 0.358);
  EXPECT_NEAR(e["values"][0][63].get<double>(), 0.498, 1e-9);
  EXPECT_TRUE(e["values"][2].is_null());
  const Json& t = data["phases"][1];
  EXPECT_EQ(t["unit"], "ms");
  EXPECT_EQ(t["factor"], 1e-3);
  EXPECT_TRUE(t["values"][0][7].is_null());
  EXPECT_FALSE(t["values"][1][7].is_null());
}

TEST(PageData, HoldsWhatABoxShowsOverTime) {
  SceneRecord scene = box_scene();
  scene.reference.box->samples = 200;
  const Json series = scene_data(scene).at("series");
  // H, K and the collision rate; R is zero throughout.
  ASSERT_EQ(series.size(), 3u);
  EXPECT_EQ(series[0]["unit"], "mm");
  EXPECT_EQ(series[0]["mean"], 0.015);
  EXPECT_EQ(series[0]["uncertainty"], 0.001);
  EXPECT_EQ(series[0]["averaged_from"], 50);
  const std::vector<double> time = decoded(series[0]["time"], 250);
  const std::vector<double> height = decoded(series[0]["values"], 250);
  ASSERT_EQ(time.size(), 250u);
  ASSERT_EQ(height.size(), 250u);
  for (std::size_t k = 0; k < 250; ++k) {
    const double t = 0.51 + 0.01 * static_cast<double>(k);
    EXPECT_NEAR(time[k], t, 2.5 / 4000);
    EXPECT_NEAR(height[k], 0.015 + 0.002 * std::sin(7 * t), 0.004 / 4000);
  }
  EXPECT_TRUE(scene_data(box_scene(1)).at("series").empty());
  EXPECT_TRUE(scene_data(lottery_scene()).at("series").empty());
}

TEST(PageData, KeepsTheExtremesOfALongSeries) {
  SceneRecord scene = box_scene(100'000);
  scene.reference.box->series.height[54'321] = 0.02;
  const Json series = scene_data(scene).at("series")[0];
  const std::vector<double> height = decoded(series.at("values"), 0);
  EXPECT_LE(height.size(), 2u * 2u * 300u);
  EXPECT_NEAR(*std::max_element(height.begin(), height.end()), 0.02, 1e-5);
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
  const Json data = page_data(content).at("precision").at(0);
  EXPECT_EQ(data["id"], "precision-1");
  EXPECT_EQ(data["name"], "symmetric-steel");
  ASSERT_EQ(data["quantities"].size(), 2u);
  EXPECT_EQ(data["quantities"][0]["name"], "i-j.effective_restitution");
  EXPECT_EQ(data["quantities"][1]["name"], "trajectory");
  // Four of the engine, not that of other iterations, which is best at nothing, and two solvers.
  ASSERT_EQ(data["curves"].size(), 6u);
  const Json& tuned = data["curves"][3];
  EXPECT_EQ(tuned["label"], "bullet double tuned");
  EXPECT_EQ(tuned["kind"], "engine");
  EXPECT_EQ(tuned["knob"], "rate");
  ASSERT_EQ(tuned["points"].size(), 3u);
  EXPECT_EQ(tuned["points"][0]["setting"], "240 Hz");
  EXPECT_EQ(tuned["points"][0]["cost"], 0.00048);  // 2 µs × 240
  EXPECT_EQ(tuned["points"][0]["errors"], Json::parse("[0.001, 0.0001]"));
  EXPECT_EQ(tuned["points"][2]["front"], Json::parse("[true, true]"));
}

TEST(PageData, HoldsMapsAndLimits) {
  ReportContent content;
  EXPECT_TRUE(page_data(content).at("stability").is_null());
  content.limits = limit_results();
  content.limits.maps.push_back({});  // interrupted
  const Json data = page_data(content).at("stability");
  ASSERT_EQ(data["outcomes"].size(), 10u);
  EXPECT_EQ(data["outcomes"][4]["name"], "tunnelled");
  EXPECT_EQ(data["outcomes"][1]["usable"], true);
  ASSERT_EQ(data["maps"].size(), 1u);
  EXPECT_EQ(data["maps"][0]["cells"], Json::parse("[0, 1, 4, 6, 0, 3]"));
  EXPECT_EQ(data["maps"][0]["errors"], Json::parse("[1e-9, 0.03, 0.5, null, 0, 0.2]"));
  EXPECT_EQ(data["maps"][0]["x"]["values"], Json::parse("[0.01, 0.1, 1]"));
  ASSERT_EQ(data["limits"].size(), 2u);
  EXPECT_EQ(data["limits"][0]["title"], "largest stable step, steel-pair");
  EXPECT_EQ(data["limits"][0]["unit"], "s");
  EXPECT_EQ(data["limits"][0]["works"], "below");
  EXPECT_EQ(data["limits"][0]["rows"].size(), 3u);
  EXPECT_EQ(data["limits"][0]["rows"][0]["good"], 0.01);
  EXPECT_EQ(data["limits"][0]["rows"][0]["beyond"], 3);
  EXPECT_TRUE(data["limits"][0]["rows"][1]["bad"].is_null());
  EXPECT_EQ(data["limits"][1]["rows"][0]["theory"], 1.01e-5);
}

}  // namespace
}  // namespace slipcheck::testing
