#pragma once

#include <string>

#include "records.h"
#include "scenario/load.h"

namespace slipcheck::testing {

/// The lottery's scene as a file, with a profile and a schema that are nowhere to be found.
inline const std::string kLotteryText = R"(# yaml-language-server: $schema=../no/such/schema.json
slipcheck: 1
name: symmetric-steel
title: Two rolling steel spheres — "head-on"
units: cgs
gravity: 981
materials:
  steel: {density: 7.85}
contacts:
  - between: [steel, steel]
    normal: {model: hard, restitution: 0.9}
  - between: [steel, substrate]
    friction: {static: 0.5, kinetic: 0.1}
substrate: {}
bodies:
  - {name: i, material: steel, sphere: {radius: 0.2}, position: [-0.3, 0],
     velocity: [15, 0], spin: rolling}
  - {name: j, material: steel, sphere: {radius: 0.2}, position: [0.3, 0],
     velocity: [-15, 0], spin: rolling}
run: {until: rolling, limit: 5}
compare:
  engines:
    - {engine: bullet, precision: double, profile: default, rate: [4000, 240]}
    - engine: bullet
      precision: double
      profile: default
      rate: 240
      expect:
        i-j.effective_restitution: {max: [0.49, 0.5]}
        i-j.restitution: {median: [0.8, 1]}
        j.jump_height: none
    - engine: bullet
      precision: single
      profile: ./no-such-profile.yaml
      rate: 240
      expect: {status: timed_out}
  tolerance: {sliding_time: 1 %, jump_height: 1 %, final_velocity: 1 %,
              effective_restitution: 0.005}
)";

/// The lottery as a run of that file, in whose runs everything occurs that a record can have.
inline SceneRecord rich_record() {
  SceneRecord scene = lottery_scene(5);
  scene.scenario = parse_scenario(kLotteryText, "scenes/symmetric.yaml");
  ReferenceResult& reference = scene.reference;
  reference.solver = "contact";
  reference.first_contact = 0.0125;
  reference.run.reached = false;
  reference.run.reason = "the run's limit of 5 s; it still slides";
  reference.run.failed = true;
  reference.run.events = 7;
  reference.run.collapses = 2;
  reference.run.steps = 1234;
  reference.run.balance = EnergyBalance{1.25, 1, 0.25, 0.5, 3};  // off by 0/3
  reference.run.balance->energy += 3e-13;
  reference.observables["i-j.restitution"].uncertainty = kInfinity;
  reference.observables["i.final_velocity.x"] = {-0.05, 1e-17};
  reference.observables["i.spin"] = {kNaN, kNaN};
  reference.observables["j.spin"] = {kNaN, kInfinity};
  reference.closed_form["i.sliding_time"] = kNaN;
  reference.closed_form["j.sliding_time"] = -kInfinity;
  reference.warnings = {"it still slides", "j \"rocks\""};

  EngineRecord& fast = scene.runs[0] = lottery_run(4000, 5);
  fast.observables["i.sliding_time"].values[1] = kNaN;
  fast.observables["i.sliding_time"].missing = 1;
  fast.observables["i.final_velocity.x"] = {
      -0.05, -0.06, -0.04, {-0.04, -0.05, -0.05, -0.05, -0.06}, 0};
  fast.observables["i-j.restitution"] = {0.9, 0.9, 0.9, {0.9, 0.9, 0.9, 0.9, 0.9}, 0};
  fast.errors["i.sliding_time"] = {
      0.001, 0.003, 0.01, false, Verdict::deviates, "1 of 5 phases do not show it", 0.002};
  fast.errors["j.sliding_time"] = {kNaN, kInfinity, 0.01, false, Verdict::deviates, "", kNaN};
  fast.errors["i-j.restitution"] = {kNaN, kNaN, {}, true, Verdict::unjudged, "", kNaN};
  fast.settings["threshold"] = kInfinity;
  fast.applied.settings["limit"] = -kInfinity;
  fast.cpu_seconds = kInfinity;
  fast.warnings = {"late"};
  scene.runs[1] = lottery_run(240, 5);
  EngineRecord expected = lottery_run(240, 5);
  expected.expect = scene.scenario.compare.engines[1].expect;
  expected.observables["i-j.restitution"] = {0.9, 0.9, 0.9, {0.9, 0.9, kNaN, 0.9, 0.9}, 1};
  scene.runs.push_back(expected);
  EngineRecord late = failed_run(RunStatus::timed_out, "10 s; cpu_seconds are 10");
  late.profile = "./no-such-profile.yaml";
  late.expect = scene.scenario.compare.engines[2].expect;
  late.cpu_seconds = kNaN;
  scene.runs.push_back(late);
  scene.runs.push_back(failed_run(RunStatus::skipped, "not asked for"));
  return scene;
}

}  // namespace slipcheck::testing
