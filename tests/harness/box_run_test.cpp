#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "engine/engine_registry.h"
#include "engine/remote_engine.h"
#include "harness/run/box_reference.h"
#include "harness/run/scene_run.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

constexpr double kGravity = 9.81;

/// One smooth elastic ball of 1 mm that falls from 10 mm over a floor at rest and drifts sideways.
const char* const kOneBall = R"(slipcheck: 1
name: one
title: One ball
gravity: 9.81
materials: {glass: {density: 2500}}
contacts:
  - {between: [glass, floor], normal: {model: hard, restitution: 1}}
  - {between: [glass, wall], normal: {model: hard, restitution: 1}}
container: {width: "5 mm", floor: {amplitude: 0, frequency: 0}, walls: fixed}
bodies:
  - {name: ball, material: glass, sphere: {radius: "0.5 mm"}, position: ["2 mm", "10 mm"], velocity: [0.03, 0]}
run: {until: 10}
compare: {engines: []}
)";

/// L's rough balls over a floor that moves at up to 1 m/s.
std::string shaken_box(int count, int periods, const std::string& engines = "") {
  return fmt::format(R"(slipcheck: 1
name: box
title: A vibrated box
gravity: 9.81
materials: {{glass: {{density: 2500}}}}
contacts:
  - {{between: [glass, glass], normal: {{model: hard, restitution: 0.9}}, tangential: {{model: hard, friction: 0.5, tangential_restitution: 0}}}}
  - {{between: [glass, floor], normal: {{model: hard, restitution: 0.9}}, tangential: {{model: hard, friction: 0.5, tangential_restitution: 0}}}}
  - {{between: [glass, wall], normal: {{model: hard, restitution: 0.9}}, tangential: {{model: hard, friction: 0.5, tangential_restitution: 0}}}}
container: {{width: "10 mm", floor: {{amplitude: "1.5915 mm", frequency: 100}}, walls: moving}}
fill: {{prefix: g, count: {}, material: glass, radius: "0.5 mm", area: [0, 0, "10 mm", "12 mm"], speed: 0.5, seed: 1995}}
run: {{periods: {}, discard: 20, sample: phase_zero}}
compare:
  engines: [{}]
  tolerance: {{height: 10 %}}
)",
                     count, periods, engines);
}

ReferenceResult run_reference_of(const std::string& text) {
  const Scenario scenario = parse_scenario(text, "box.yaml");
  const ContactScene scene = make_contact_scene(scenario);
  return run_box_reference(ReferenceSolver(scene, reference_settings(scenario)), scenario);
}

std::vector<EngineRecord> run_engines(const std::string& text, std::size_t phases) {
  setenv("SLIPCHECK_ENGINE_PATH",
         (std::string(SLIPCHECK_BINARY_DIR) + ":" + SLIPCHECK_BINARY_DIR + "/faulty").c_str(), 1);
  RunOptions options;
  options.phases = phases;
  options.time_limit = 60;
  return run_scenes({parse_scenario(text, "box.yaml")}, options)[0].runs;
}

TEST(BoxRun, OneElasticBallKeepsItsEnergy) {
  const ReferenceResult result = run_reference_of(kOneBall);
  ASSERT_TRUE(result.run.reached);
  ASSERT_TRUE(result.box);
  const BoxSeries& series = result.box->series;
  EXPECT_EQ(series.time.size(), 1000u);
  const double radius = 0.5e-3, drop = 10e-3 - radius;
  const double mass = 2500 * 4 * std::acos(-1) / 3 * std::pow(radius, 3);
  // The height at rest of one ball is its radius. Rounding: some hundred bounces.
  const double energy = mass * (kGravity * drop + 0.5 * 0.03 * 0.03);
  for (std::size_t k = 0; k < series.time.size(); ++k) {
    ASSERT_NEAR(series.kinetic_energy[k] + mass * kGravity * series.height[k], energy,
                1e-12 * energy);
    ASSERT_EQ(series.rotational_energy[k], 0);
    ASSERT_EQ(series.collision_rate[k], 0);
    // Exact: the ball falls from `drop` and comes back after 2 √(2 drop/g).
    const double rise = std::sqrt(2 * drop / kGravity);
    const double since_top = std::remainder(series.time[k], 2 * rise);
    ASSERT_NEAR(series.height[k], drop - 0.5 * kGravity * since_top * since_top, 1e-12);
  }
  EXPECT_LT(result.observables.at("all.energy_drift").value, 1e-12);
  EXPECT_TRUE(std::isfinite(result.observables.at("all.height").uncertainty));
  // Over a bounce H is 2/3 of the height of the fall on the average; 1000 samples of 114 bounces.
  EXPECT_NEAR(result.observables.at("all.height").value, 2 * drop / 3, 0.01 * drop);
}

/// H, K and R of frames, summed up here as L defines them.
class Sums final : public FrameSink {
 public:
  Sums(const Scene& scene, double from) : scene_(scene), from_(from) {}

  void take(double time, const Frame& frame) override {
    // The end of the run is shown once more where it is a phase zero.
    if (time < from_ || time < last_ + 1e-9) return;
    last_ = time;
    double height = 0, translation = 0, rotation = 0, mass = 0;
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const double m = scene_.bodies[i].mass, r = scene_.bodies[i].radius;
      const double w = frame.bodies[i].angular_velocity.y();
      height += m * frame.bodies[i].position.z();
      translation += m * frame.bodies[i].velocity.squaredNorm() / 2;
      rotation += 0.4 * m * r * r * w * w / 2;
      mass += m;
    }
    ++looks;
    H += height / mass;
    K += translation / static_cast<double>(scene_.bodies.size());
    R += rotation / static_cast<double>(scene_.bodies.size());
  }

  double looks = 0, H = 0, K = 0, R = 0;

 private:
  const Scene& scene_;
  double from_, last_ = 0;
};

TEST(BoxRun, ItsMeansAreThoseOfTheFramesAtPhaseZero) {
  const Scenario scenario = parse_scenario(shaken_box(50, 100), "box.yaml");
  const ContactScene scene = make_contact_scene(scenario);
  const ReferenceSolver solver(scene, reference_settings(scenario));
  const ReferenceResult result = run_box_reference(solver, scenario);

  Sums sums(scene.hard, 0.205);  // the look after 20 periods of 10 ms only begins the count
  const std::size_t collisions = solver.run(until_time(1, 0.01), &sums).collisions;
  EXPECT_EQ(sums.looks, 80);
  EXPECT_EQ(result.box->samples, 80u);
  EXPECT_EQ(result.box->discarded, 20u);
  EXPECT_EQ(result.run.collisions, collisions);

  // L (14) for 50 balls in a box ten diameters wide: 2.492 d0, here with all digits.
  const double s3 = std::sqrt(3);
  const double rest = 1e-3 / 100 * (9 * ((1 - s3 / 2) * 5 + s3 / 2 * 25) + 5 * (1 + s3 * 5));
  // Sums in another order: rounding.
  EXPECT_NEAR(result.observables.at("all.height").value, sums.H / 80 - rest, 1e-14);
  EXPECT_NEAR(result.observables.at("all.kinetic_energy").value / (sums.K / 80), 1, 1e-12);
  EXPECT_NEAR(result.observables.at("all.rotational_energy").value / (sums.R / 80), 1, 1e-12);

  // The rates of all intervals make up the collisions after the first 20 periods.
  const std::vector<double>& rate = result.box->series.collision_rate;
  const double counted = 0.01 * std::accumulate(rate.begin(), rate.end(), 0.0);
  EXPECT_LE(counted, static_cast<double>(collisions));
  EXPECT_GT(counted, 0.5 * static_cast<double>(collisions));
}

TEST(BoxRun, ErrorsFallWithTheRootOfTheTime) {
  // 16 times the samples: a quarter of the error. A blocking error is itself known to about
  // √(B/2n), 25 % of the shorter run with its 2000 samples, and Student's factor of its few blocks
  // is larger by up to 15 %.
  const ReferenceResult shorter = run_reference_of(shaken_box(10, 2020));
  const ReferenceResult longer = run_reference_of(shaken_box(10, 32020));
  EXPECT_TRUE(longer.box->steady);
  for (const char* name : {"all.height", "all.kinetic_energy", "all.collision_rate"}) {
    const UncertainValue &a = shorter.observables.at(name), &b = longer.observables.at(name);
    EXPECT_NEAR(std::log(a.uncertainty / b.uncertainty), std::log(4), std::log(1.5)) << name;
    // Both see the same mean.
    EXPECT_NEAR(a.value, b.value, 2 * std::hypot(a.uncertainty, b.uncertainty)) << name;
  }
}

TEST(BoxRun, TooFewSamplesHaveNoError) {
  const ReferenceResult result = run_reference_of(shaken_box(10, 40));
  EXPECT_EQ(result.box->samples, 20u);
  EXPECT_TRUE(std::isinf(result.observables.at("all.height").uncertainty));
  EXPECT_FALSE(result.box->steady);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_NE(result.warnings[0].find("no steady state"), std::string::npos);
}

/// A ball that flies straight across a box without gravity and meets nothing in the time.
std::string straight_flight(const std::string& engines) {
  std::string text = kOneBall;
  const auto replace = [&](const std::string& old, const std::string& now) {
    text.replace(text.find(old), old.size(), now);
  };
  replace("gravity: 9.81", "gravity: 0");
  replace("until: 10", "until: 0.05");
  replace("engines: []", "engines: [" + engines + "]");
  return text;
}

TEST(BoxRun, AnEnginesEnsembleIsMeasuredLikeTheReference) {
  // The engine of the tests moves bodies on straight lines, which is right here.
  const auto runs = run_engines(
      straight_flight("{engine: faulty, precision: double, profile: ok, rate: 1000}"), 4);
  const EngineRecord& run = runs.at(0);
  ASSERT_EQ(run.status, EngineRecord::Status::ok) << run.reason;
  EXPECT_EQ(run.phases, 4u);
  // Each phase runs for 50 steps, and to the end of the last batch of them.
  EXPECT_GE(run.steps, 4u * 50u);
  const EnsembleValue& height = run.observables.at("all.height");
  EXPECT_NEAR(height.min, 9.5e-3, 1e-15);
  EXPECT_NEAR(height.max, 9.5e-3, 1e-15);
  const double mass = 2500 * 4 * std::acos(-1) / 3 * std::pow(0.5e-3, 3);
  EXPECT_NEAR(run.observables.at("all.kinetic_energy").median / (0.5 * mass * 0.03 * 0.03), 1,
              1e-12);
  EXPECT_EQ(run.observables.at("all.rotational_energy").max, 0);
  EXPECT_LT(run.errors.at("all.height").max, 1e-12);
}

TEST(BoxRun, AnEngineThatBlowsUpIsUnstable) {
  const auto runs = run_engines(
      straight_flight("{engine: faulty, precision: double, profile: nan, rate: 1000}"), 4);
  EXPECT_EQ(runs.at(0).status, EngineRecord::Status::unstable);
  EXPECT_NE(runs[0].reason.find("not finite"), std::string::npos) << runs[0].reason;
  EXPECT_TRUE(runs[0].observables.empty());
}

TEST(BoxRun, BulletRunsTheVibratedBox) {
  const auto runs =
      run_engines(shaken_box(10, 60, "{engine: bullet, precision: double, rate: 8000}"), 2);
  const EngineRecord& run = runs.at(0);
  ASSERT_EQ(run.status, EngineRecord::Status::ok) << run.reason;
  EXPECT_EQ(run.phases, 2u);
  for (const char* name :
       {"all.height", "all.kinetic_energy", "all.rotational_energy", "all.collision_rate"}) {
    ASSERT_TRUE(run.observables.contains(name)) << name;
    EXPECT_GT(run.observables.at(name).min, 0) << name;
    EXPECT_TRUE(run.errors.contains(name)) << name;
  }
  EXPECT_TRUE(run.errors.at("all.height").tolerance.has_value());
}

}  // namespace
}  // namespace slipcheck
