#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "studies/precision/precision.h"
#include "studies/stability/limits.h"
#include "studies/stability/stability.h"

namespace slipcheck::testing {

/// An engine's curve over 240, 1000 and 4000 Hz whose worst error of effective restitution is
/// `first` at 240 Hz and falls with the given power of the rate; the trajectory's is a tenth of
/// it. A step costs 2 µs.
inline MethodCurve engine_curve(const std::string& precision, const std::string& profile,
                                double first, double power) {
  MethodCurve curve;
  curve.engine = "bullet";
  curve.version = "3.24";
  curve.precision = precision;
  curve.profile = profile;
  curve.settings = {{"erp", 0.25}};
  for (const double rate : {240.0, 1000.0, 4000.0}) {
    WorkPrecision point;
    point.knob = rate;
    point.status = RunStatus::ok;
    point.phases = 16;
    const double error = first * std::pow(240 / rate, power);
    point.errors["i-j.effective_restitution"] = {error, error / 2, error / 1.5, true, 0.005, ""};
    point.errors[kTrajectory] = {error / 10, error / 20, error / 15, false, {}, ""};
    point.cost = WorkCost{2e-6, 2e-6 * rate, 0.03, 5};
    curve.points.push_back(point);
  }
  const bool falls = power > 0.25;
  for (const char* name : {"i-j.effective_restitution", kTrajectory}) {
    const double part = std::string(name) == kTrajectory ? 0.1 : 1;
    Convergence& convergence = curve.convergence[name];
    convergence.kind = falls ? Convergence::Kind::converges : Convergence::Kind::does_not_converge;
    if (falls) {
      convergence.order = power;
      convergence.order_error = 0.02;
    }
    convergence.coarsest = part * first;
    convergence.finest = part * first * std::pow(0.06, power);
    convergence.largest = part * first;
  }
  return curve;
}

/// A curve of the reference over two knobs whose error is ten times what the knob is.
inline MethodCurve reference_curve(MethodCurve::Kind kind, double coarse, double fine) {
  MethodCurve curve;
  curve.kind = kind;
  for (const double knob : {coarse, fine}) {
    WorkPrecision point;
    point.knob = knob;
    point.status = RunStatus::ok;
    point.phases = 4;
    point.errors["i-j.effective_restitution"] = {10 * knob, 5 * knob, 7 * knob, true, 0.005, ""};
    point.errors[kTrajectory] = {knob, knob, knob, false, {}, ""};
    point.cost = WorkCost{1e-6, 1e-3 / std::sqrt(knob), 0.01, 5};
    curve.points.push_back(point);
  }
  curve.convergence["i-j.effective_restitution"] = {
      Convergence::Kind::converges, 1, 0.001, 10 * coarse, 10 * fine, 10 * coarse};
  curve.convergence[kTrajectory] = {Convergence::Kind::converges, 1, 0.001, coarse, fine, coarse};
  return curve;
}

/// Two balls of which `default` does not converge, `tuned` does, and another count of iterations
/// has nothing to say; the reference's events are exact and on the front.
inline PrecisionScene precision_scene(const std::string& name = "symmetric-steel") {
  PrecisionScene scene;
  scene.scenario.name = name;
  scene.scenario.title = "Two rolling steel spheres collide head-on";
  scene.reference.solver = "event";
  scene.simulated = 0.109;
  scene.path_length = 0.0123;
  scene.curves = {
      engine_curve("single", "default", 0.14, 0), engine_curve("double", "default", 0.14, 0),
      engine_curve("single", "tuned", 1e-3, 0.6), engine_curve("double", "tuned", 1e-3, 1)};
  MethodCurve more = engine_curve("double", "default", 0.13, 0);
  more.iterations = 50;
  scene.curves.push_back(more);
  scene.curves[3].points[2].pareto = {"i-j.effective_restitution", kTrajectory};
  scene.curves.push_back(reference_curve(MethodCurve::Kind::contact, 1e-3, 1e-12));
  MethodCurve event = reference_curve(MethodCurve::Kind::event, 0, 0);
  event.points.resize(1);
  event.points[0].cost->per_simulated_second = 1e-5;
  event.points[0].pareto = {"i-j.effective_restitution", kTrajectory};
  for (auto& [quantity, convergence] : event.convergence)
    convergence = {Convergence::Kind::exact, kNotObserved, kNotObserved, 0, 0, 0};
  scene.curves.push_back(event);
  return scene;
}

inline StabilityRun stability_run(const std::string& precision, const std::string& profile,
                                  Outcome outcome, const std::string& why) {
  StabilityRun run;
  run.record.engine = "bullet";
  run.record.version = "3.24";
  run.record.precision = precision;
  run.record.profile = profile;
  run.record.rate = 240;
  run.record.status = RunStatus::ok;
  run.record.cpu_seconds = 0.01;
  run.record.steps = 480;
  run.outcome = outcome;
  run.why = why;
  // Two of the 16 phases come out so, the others are accurate.
  run.phases[static_cast<std::size_t>(outcome)] += 2;
  run.phases[0] += 14;
  if (outcome <= Outcome::tunnelled) {
    run.worst_error = outcome == Outcome::accurate ? 0.5 : 28;
    run.worst_observable = "i-j.restitution";
    run.energy_gain = outcome == Outcome::energy_growing ? 0.21 : 0;
  }
  return run;
}

/// Three cases, the last of which the reference refuses, under three methods.
inline std::vector<StabilityCase> stability_cases() {
  std::vector<StabilityCase> cases(3);
  const char* const names[] = {"speed-1e4", "mass-ratio-1e6", "radius-zero"};
  for (std::size_t k = 0; k < cases.size(); ++k) {
    cases[k].scenario.name = names[k];
    cases[k].scenario.title = "A stiff case";
    cases[k].reference = {true, false, "", 1e-6, 1e-5};
  }
  cases[0].runs = {
      stability_run("single", "default", Outcome::energy_growing,
                    "energy rises by 21 % of the scene's"),
      stability_run("double", "default", Outcome::tunnelled, "i passes through j at 1.2 ms"),
      stability_run("double", "tuned", Outcome::accurate, "")};
  cases[1].runs = {stability_run("single", "default", Outcome::not_finite, "NaN at step 7"),
                   stability_run("double", "default", Outcome::crashed, "signal 11"),
                   stability_run("double", "tuned", Outcome::degraded, "28 tolerances")};
  cases[2].reference = {false, true, "the radius must be > 0 m, got 0", kNotObserved, 0};
  cases[2].runs = {stability_run("single", "default", Outcome::refused, "no such sphere")};
  return cases;
}

/// A limit that was found, one that lies beyond the range, one without answer, and one with theory;
/// a map of 3 × 2 cells.
inline LimitResults limit_results() {
  LimitResults results;
  Limit found;
  found.method = "bullet";
  found.version = "3.24";
  found.precision = "double";
  found.profile = "default";
  found.scene = "steel-pair";
  found.low = 1e-5;
  found.high = 1;
  found.good = 0.01;
  found.bad = 0.0121;
  found.beyond = Outcome::energy_growing;
  found.why = "energy rises by 7 %";
  found.islands = {0.002};
  Limit endless = found;
  endless.profile = "tuned";
  endless.good = 1;
  endless.bad.reset();
  endless.islands.clear();
  Limit unanswered = endless;
  unanswered.precision = "single";
  unanswered.good.reset();
  unanswered.reason = "interrupted";
  Limit theory;
  theory.method = "fixed-step";
  theory.scene = "held-ball";
  theory.low = 1e-7;
  theory.high = 1e-3;
  theory.good = 1e-5;
  theory.bad = 1.0201e-5;
  theory.beyond = Outcome::exploded;
  theory.theory = 1.01e-5;
  theory.theory_name = "2/ω0";
  results.limits = {found, endless, unanswered, theory};

  OutcomeMap map;
  map.name = "speed-restitution-bullet-double-default";
  map.title = "bullet double default at 240 Hz";
  map.method = "bullet";
  map.precision = "double";
  map.profile = "default";
  map.x = {"speed [m/s]", true, {0.01, 0.1, 1}};
  map.y = {"restitution [-]", false, {0, 1}};
  map.outcome = {Outcome::accurate,   Outcome::degraded, Outcome::tunnelled,
                 Outcome::not_finite, Outcome::accurate, Outcome::energy_growing};
  map.worst_error = {1e-9, 0.03, 0.5, kNotObserved, 0, 0.2};
  map.error_label = "|e − e_ref|";
  map.theory = {{0.01, 0.2}, {1, 0.9}};
  map.theory_name = "where h v = R";
  results.maps = {map};
  return results;
}

}  // namespace slipcheck::testing
