#include "reference/reference_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/numbers.h"
#include "reference/initial_contacts.h"
#include "reference/lasting_contacts.h"
#include "reference/run_variation.h"
#include "reference/steps/step_length.h"
#include "reference/steps/step_solver.h"
#include "reference/steps/steps_as_events.h"

namespace slipcheck {
namespace {

/// A state that is no number stays so: the last ones tell. `solved` fails where there is one.
SolvedRun checked(SolvedRun solved, const std::vector<BodyState>& states) {
  const auto is_finite = [](const BodyState& state) {
    return state.position.allFinite() && state.velocity.allFinite() &&
           state.angular_velocity.allFinite();
  };
  const auto lost = std::ranges::find_if_not(states, is_finite);
  if (lost == states.end()) return solved;
  solved.failed = true;
  solved.reached = false;
  solved.reason = fmt::format("the state of body {} is not finite at {:.9g} s",
                              lost - states.begin(), solved.end_time);
  return solved;
}

}  // namespace

bool has_exact_phases(const Scene& scene) {
  return EventSolver::can_solve(scene) && EventSolver::is_exact(scene);
}

bool runs_in_phases(const Scene& scene) {
  const bool is_large =
      scene.bodies.size() > EventSettings{}.most_without_cells || scene.periodic != Vector2::Zero();
  return EventSolver::can_solve(scene) && (EventSolver::is_exact(scene) || is_large);
}

ReferenceSolver::ReferenceSolver(const ContactScene& scene, const ReferenceSettings& settings)
    : scene_(&scene), settings_(settings) {
  const bool soft = !scene.is_hard();
  const bool automatic = settings.asked == Compare::Reference::automatic;
  const bool periodic = !scene.hard.periodic.isZero(0);
  const bool stepped =
      settings.asked == Compare::Reference::steps ||
      (automatic && soft && (periodic || scene.hard.bodies.size() > kMostIntegrated));
  resolved_ = stepped || settings.asked == Compare::Reference::contact || (automatic && soft);
  if (!resolved_ && soft) {
    if (!initial_contacts(scene, scene.hard.initial).empty())
      throw Unsupported("bodies that overlap at the start can only be solved with soft contacts");
    made_ = scene;
    made_->soft.assign(scene.soft.size(), std::nullopt);
  }
  if (automatic && !soft && has_lasting_contacts(scene.hard)) {
    collision_time_ = short_collision_time(scene.hard);
    made_ = with_lasting_contacts(scene.hard, collision_time_);
    resolved_ = made_.has_value();
  }
  phases_ = !resolved_ && runs_in_phases(scene.hard);
  if (!stepped && !phases_ && periodic)
    throw Unsupported(
        "the integrator knows no images across a periodic plane's edges; compare.reference may be "
        "steps, or event where every contact is hard");
  if (!stepped) return;
  const double collision = shortest_collision(scene);
  if (collision == kNever)
    throw Unsupported(
        "steps of fixed length need a collision to be measured by: no two bodies have a soft "
        "contact and move");
  step_ = collision / settings.steps_per_contact;
  StepSolver(scene, scene.hard.initial, {.step = step_, .general = settings.general});
}

EventSettings ReferenceSolver::event_settings() const {
  EventSettings settings;
  settings.most_events = settings_.most_events;
  settings.general = settings_.general;
  return settings;
}

SolvedRun ReferenceSolver::run_steps(const RunEnd& end, FrameSink* sink, double factor) const {
  double step = factor * step_;
  // The last step ends where the run does.
  if (end.until == Run::Until::time && end.time > 0)
    step = end.time / std::max(1.0, std::round(end.time / step));
  StepSolver solver(scene(), scene().hard.initial, {.step = step, .general = settings_.general});
  std::optional<StepsAsEvents> events;
  if (sink) events.emplace(*sink);
  SolvedRun solved;
  StepRun run;
  try {
    run = solver.run(end, events ? &*events : nullptr);
  } catch (const StepTooLong& too_long) {
    solved.failed = true;
    solved.reason = too_long.what();
    solved.end_time = solver.now();
    return solved;
  }
  solved.end_time = run.end_time;
  solved.reached = run.reached;
  solved.reason = run.reason;
  solved.events = solved.collisions = run.collisions;
  solved.steps = run.steps;
  return checked(std::move(solved), solver.states());
}

SolvedRun ReferenceSolver::run_varied(const RunEnd& end, FrameSink* sink,
                                      SolverAccuracy accuracy) const {
  ContactScene varied = scene();
  Scene& hard = varied.hard;
  std::optional<ReverseSink> reversing;
  if (accuracy.reversed) {
    reverse_bodies(hard);
    if (sink) reversing.emplace(*sink);
  }
  if (accuracy.other_rule) hard.collapse = other_rule(hard.collapse);
  accuracy.reversed = accuracy.other_rule = false;
  return ReferenceSolver(varied, settings_).run(end, reversing ? &*reversing : sink, accuracy);
}

SolvedRun ReferenceSolver::run(const RunEnd& end, FrameSink* sink,
                               const SolverAccuracy& accuracy) const {
  if (accuracy.reversed || accuracy.other_rule) return run_varied(end, sink, accuracy);
  if (is_stepped()) return run_steps(end, sink, accuracy.step);
  const std::vector<BodyState>& initial = scene().hard.initial;
  if (phases_) {
    EventSettings settings = event_settings();
    settings.collapse_fraction *= accuracy.cut_offs;
    settings.landing_fraction *= accuracy.cut_offs;
    EventSolver solver(scene().hard, initial, settings);
    const EventRun run = solver.run(end, sink);
    return checked({run.end_time, run.reached, false, run.reason, run.events, run.collisions,
                    run.collapses, 0, std::nullopt},
                   solver.states());
  }
  ContactSettings settings;
  settings.tolerance = accuracy.tolerance;
  settings.cut_offs = accuracy.cut_offs;
  std::optional<ContactScene> softer;
  if (softened_to() > 0 && accuracy.softness != 1)
    softer = with_lasting_contacts(scene_->hard, accuracy.softness * collision_time_);
  ContactSolver solver(softer ? *softer : scene(), initial, settings);
  const ContactRun run = solver.run(end, sink);
  SolvedRun solved{run.end_time,   run.reached,   run.failed, run.reason, run.events,
                   run.collisions, run.collapses, run.steps,  run.balance};
  if (softened_to() > 0 && has_come_apart(scene_->hard, solver.states())) {
    solved.reached = false;
    solved.reason =
        "bodies that rested on each other come apart: how they then collide is not known";
  }
  return checked(std::move(solved), solver.states());
}

std::vector<std::string> ReferenceSolver::loop() const {
  if (is_stepped())
    return StepSolver(scene(), scene().hard.initial, {.step = step_, .general = settings_.general})
        .features();
  if (!phases_) return {"all bodies in one system, integrated from event to event"};
  return EventSolver::features(scene().hard, event_settings());
}

double ReferenceSolver::first_contact(double limit, double tolerance) const {
  if (!initial_contacts(scene(), scene().hard.initial).empty()) return 0;
  if (runs_in_phases(scene().hard))
    return EventSolver(scene().hard, scene().hard.initial).first_contact(limit);
  ContactSettings settings;
  settings.tolerance = tolerance;
  return ContactSolver(scene(), scene().hard.initial, settings).first_contact(limit);
}

std::vector<BodyState> ReferenceSolver::states_at(double time) const {
  const Scene& hard = scene().hard;
  if (time == 0) return hard.initial;
  const RunEnd end{Run::Until::time, time, time};
  if (runs_in_phases(hard) && initial_contacts(scene(), hard.initial).empty()) {
    EventSolver solver(hard, hard.initial);
    solver.run(end, nullptr);
    return solver.states();
  }
  ContactSolver solver(scene(), hard.initial);
  solver.run(end, nullptr);
  return solver.states();
}

namespace {

template <class Solver>
std::vector<std::vector<BodyState>> walk(Solver solver, std::span<const double> times) {
  std::vector<std::vector<BodyState>> states;
  states.reserve(times.size());
  for (const double time : times) {
    if (!solver.run({Run::Until::time, time, time}, nullptr).reached) break;
    states.push_back(solver.states());
  }
  return states;
}

/// Between two steps on straight lines: the error is that of half a step of acceleration.
std::vector<std::vector<BodyState>> walk_in_steps(StepSolver solver,
                                                  std::span<const double> times) {
  std::vector<std::vector<BodyState>> states;
  states.reserve(times.size());
  for (const double time : times) {
    solver.run({Run::Until::time, time, time}, nullptr);
    states.push_back(solver.states());
    for (BodyState& state : states.back()) state.position -= (solver.now() - time) * state.velocity;
  }
  return states;
}

}  // namespace

std::vector<std::vector<BodyState>> ReferenceSolver::states_along(
    std::span<const double> times) const {
  const std::vector<BodyState>& initial = scene().hard.initial;
  if (phases_) return walk(EventSolver(scene().hard, initial, event_settings()), times);
  if (is_stepped())
    return walk_in_steps(
        StepSolver(scene(), initial, {.step = step_, .general = settings_.general}), times);
  return walk(ContactSolver(scene(), initial), times);
}

double ReferenceSolver::next_collision(std::span<const BodyState> states, double start,
                                       double limit, double slowest) const {
  if (runs_in_phases(scene().hard)) {
    EventSettings settings;
    settings.start = start;
    settings.slowest_rebound = 1e-2 * slowest;  // a cascade of weaker ones would never be it
    return EventSolver(scene().hard, states, settings).next_collision(limit, slowest);
  }
  ContactSettings settings;
  settings.tolerance = 1e-8;  // engines are further off
  settings.start = start;
  return ContactSolver(scene(), states, settings).next_collision(limit, slowest);
}

}  // namespace slipcheck
