#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "harness/compare/record.h"

namespace slipcheck::testing {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// An engine's run of `phases` phases whose effective restitution rises evenly from 0.358 to 0.498.
inline EngineRecord lottery_run(double rate, std::size_t phases) {
  EngineRecord run;
  run.engine = "bullet";
  run.version = "3.24";
  run.precision = "double";
  run.profile = "default";
  run.settings = {{"body", std::string("multibody")}, {"erp", 0.25}};
  run.rate = rate;
  run.status = EngineRecord::Status::ok;
  run.cpu_seconds = 3.1e-6 * 100;
  run.steps = 100;
  run.phases = phases;
  EnsembleValue& e = run.observables["i-j.effective_restitution"];
  EnsembleValue& t = run.observables["i.sliding_time"];
  for (std::size_t p = 0; p < phases; ++p) {
    const double part = phases == 1 ? 0 : static_cast<double>(p) / static_cast<double>(phases - 1);
    e.values.push_back(0.358 + 0.14 * part);
    t.values.push_back(0.0276 + 0.0001 * part);
  }
  e.min = 0.358;
  e.median = 0.428;
  e.max = e.values.back();
  t.min = 0.0276;
  t.median = 0.02765;
  t.max = t.values.back();
  run.errors["i-j.effective_restitution"] = {0.071, 0.141, 0.005, true, Verdict::deviates, ""};
  run.errors["i.sliding_time"] = {0.001, 0.003, 0.01, false, Verdict::within, ""};
  run.applied.settings = {{"friction", 0.1}, {"split_impulse", true}, {"solver", "sequential"}};
  run.applied.not_represented = {Lack{"static friction", "friction"}, Lack{"coupled drilling"}};
  return run;
}

/// Two balls and one engine at two rates, as the notes tell of it.
inline SceneRecord lottery_scene(std::size_t phases = 64) {
  SceneRecord scene;
  Scenario& scenario = scene.scenario;
  scenario.name = "symmetric-steel";
  scenario.title = "Two rolling steel spheres collide head-on";
  scenario.source = "Kondic 1999, Sec. IV A";
  scenario.file = "scenarios/symmetric-steel.yaml";
  scenario.sha256 = std::string(64, 'a');
  for (const double side : {-1.0, 1.0}) {
    Body body;
    body.name = side < 0 ? "i" : "j";
    body.sphere = {0.002, 2.6e-4};
    body.initial.position = Vector3(3e-3 * side, 0, 0.002);
    body.initial.velocity = Vector3(-0.15 * side, 0, 0);
    scenario.bodies.push_back(body);
  }
  scenario.compare.tolerance = {{"effective_restitution", {0.005, false}},
                                {"sliding_time", {0.01, false}}};
  scene.reference.cpu_seconds = 1.2e-6;
  scene.reference.run.end_time = 0.0830;
  scene.reference.run.reached = true;
  scene.reference.run.collisions = 1;
  scene.reference.observables = {{"i-j.effective_restitution", {5.0 / 14, 1e-16}},
                                 {"i-j.restitution", {0.9, 1e-16}},
                                 {"i.sliding_time", {0.1 / 3.6, 1e-17}},
                                 {"j.sliding_time", {0.1 / 3.6, 1e-17}}};
  scene.reference.closed_form = {{"i-j.effective_restitution", 5.0 / 14}};
  scene.runs = {lottery_run(240, phases), lottery_run(4000, phases)};
  return scene;
}

/// A vibrated box without engines whose H swings about 15 mm, of `samples` samples 10 ms apart.
inline SceneRecord box_scene(std::size_t samples = 250) {
  SceneRecord scene = lottery_scene();
  scene.runs.clear();
  scene.scenario.compare.tolerance.clear();
  scene.scenario.surroundings = Container{
      .width = 0.01, .floor_amplitude = 5e-4, .floor_frequency = 100, .height = std::nullopt};
  for (Body& body : scene.scenario.bodies) body.initial.position.x() += 0.005;
  ReferenceResult& reference = scene.reference;
  reference.closed_form.clear();
  reference.observables = {{"all.height", {0.015, 0.001}},
                           {"all.kinetic_energy", {1.461e-7, 7e-9}},
                           {"all.rotational_energy", {0, 0}},
                           {"all.collision_rate", {5414, 391}}};
  BoxReference& box = reference.box.emplace();
  box.samples = samples;
  box.discarded = 50;
  box.steady = true;
  for (std::size_t k = 0; k < samples; ++k) {
    const double t = 0.5 + 0.01 * static_cast<double>(k + 1);
    box.series.time.push_back(t);
    box.series.height.push_back(0.015 + 0.002 * std::sin(7 * t));
    box.series.kinetic_energy.push_back(1.461e-7 + 1e-8 * std::cos(5 * t));
    box.series.rotational_energy.push_back(0);
    box.series.collision_rate.push_back(5414 + 500 * std::sin(3 * t));
  }
  return scene;
}

/// The limits of what an engine is expected to show.
inline ExpectedObservable expected_max(double low, double high) {
  ExpectedObservable expected;
  expected.max = {low, high};
  return expected;
}

/// The first run of the lottery alone, of which it is known that it is one.
inline SceneRecord expected_lottery() {
  SceneRecord scene = lottery_scene();
  scene.runs.resize(1);
  ExpectedObservable none;
  none.none = true;
  Expectation& expect = scene.runs[0].expect.emplace();
  expect.observables = {{"i-j.effective_restitution", expected_max(0.49, 0.5)},
                        {"j.jump_height", none}};
  return scene;
}

/// A run that is not ok.
inline EngineRecord failed_run(EngineRecord::Status status, const std::string& reason) {
  EngineRecord run;
  run.engine = "bullet";
  run.precision = "single";
  run.profile = "tuned";
  run.rate = 240;
  run.status = status;
  run.reason = reason;
  return run;
}

}  // namespace slipcheck::testing
