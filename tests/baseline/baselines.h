#pragma once

#include <string>

#include "studies/baseline/baseline.h"

namespace slipcheck::testing {

/// An ensemble of four that has these statistics.
inline EnsembleValue ensemble(double median, double min, double max) {
  EnsembleValue value;
  value.median = median;
  value.min = min;
  value.max = max;
  value.values = {min, median, median, max};
  return value;
}

/// Two balls that meet, after which i slides for 20 ms and ends at 3 m/s, 4 m/s; in one engine a
/// little else. e_eff may be 0.01 off, sliding times 1 %, final velocities 10 %.
inline SceneRecord meeting() {
  SceneRecord scene;
  scene.scenario.name = "meeting";
  scene.scenario.sha256 = std::string(64, 'a');
  scene.scenario.compare.tolerance = {{"effective_restitution", {0.01, false}},
                                      {"sliding_time", {0.01, false}},
                                      {"final_velocity", {0.1, false}}};
  scene.reference.cpu_seconds = 2e-6;
  scene.reference.observables = {{"i-j.effective_restitution", {0.4, 1e-16}},
                                 {"i.final_velocity", {5, 1e-15}},
                                 {"i.final_velocity.x", {3, 1e-15}},
                                 {"i.final_velocity.y", {4, 1e-15}},
                                 {"i.final_velocity.z", {0, 0}},
                                 {"i.sliding_time", {0.02, 1e-18}},
                                 {"i.stopping_time", {0.5, 1e-16}}};
  EngineRecord& run = scene.runs.emplace_back();
  run.engine = "bullet";
  run.version = "3.24";
  run.precision = "double";
  run.profile = "default";
  run.rate = 240;
  run.status = RunStatus::ok;
  run.phases = 4;
  run.cpu_seconds = 1e-3;
  run.observables = {{"i-j.effective_restitution", ensemble(0.45, 0.42, 0.48)},
                     {"i.final_velocity.x", ensemble(3.1, 3.1, 3.1)},
                     {"i.sliding_time", ensemble(0.021, 0.0205, 0.0215)},
                     {"i.stopping_time", ensemble(0.6, 0.6, 0.6)}};
  for (const char* name : {"i-j.effective_restitution", "i.final_velocity", "i.sliding_time"})
    run.errors[name].verdict = Verdict::within;
  scene.reference.run.reached = true;
  return scene;
}

inline SceneBaseline meeting_baseline() { return baseline_of(meeting(), 4, "0.1.0"); }

}  // namespace slipcheck::testing
