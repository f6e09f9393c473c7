#pragma once

#include <limits>
#include <string>

#include "harness/record.h"

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
  run.errors["i-j.effective_restitution"] = {0.071, 0.141, 0.005, true, false, ""};
  run.errors["i.sliding_time"] = {0.001, 0.003, 0.01, false, true, ""};
  run.applied.settings = {{"friction", 0.1}, {"split_impulse", true}, {"solver", "sequential"}};
  run.applied.not_represented = {"static friction", "coupled drilling"};
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
