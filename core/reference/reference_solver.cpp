#include "reference/reference_solver.h"

#include "reference/initial_contacts.h"

namespace slipcheck {

bool has_exact_phases(const HardScene& scene) {
  return EventSolver::can_solve(scene) && EventSolver::is_exact(scene);
}

bool runs_in_phases(const HardScene& scene) {
  const bool is_large =
      scene.bodies.size() > EventSettings{}.most_without_cells || scene.periodic != Vector2::Zero();
  return EventSolver::can_solve(scene) && (EventSolver::is_exact(scene) || is_large);
}

ReferenceSolver::ReferenceSolver(const ContactScene& scene, Compare::Reference asked,
                                 double most_events)
    : scene_(&scene), most_events_(most_events) {
  const bool soft = !scene.is_hard();
  resolved_ =
      asked == Compare::Reference::contact || (asked == Compare::Reference::automatic && soft);
  if (!resolved_ && soft) {
    if (!initial_contacts(scene, scene.hard.initial).empty())
      throw Unsupported("bodies that overlap at the start can only be solved with soft contacts");
    hardened_ = scene;
    hardened_->soft.assign(scene.soft.size(), std::nullopt);
  }
  phases_ = !resolved_ && runs_in_phases(scene.hard);
}

SolvedRun ReferenceSolver::run(const RunEnd& end, FrameSink* sink,
                               const SolverAccuracy& accuracy) const {
  const std::vector<BodyState>& initial = scene().hard.initial;
  if (phases_) {
    EventSettings settings;
    settings.most_events = most_events_;
    settings.collapse_fraction *= accuracy.cut_offs;
    settings.landing_fraction *= accuracy.cut_offs;
    const EventRun run = EventSolver(scene().hard, initial, settings).run(end, sink);
    return {run.end_time,   run.reached,   false, run.reason,  run.events,
            run.collisions, run.collapses, 0,     std::nullopt};
  }
  ContactSettings settings;
  settings.tolerance = accuracy.tolerance;
  settings.cut_offs = accuracy.cut_offs;
  const ContactRun run = ContactSolver(scene(), initial, settings).run(end, sink);
  return {run.end_time,   run.reached,   run.failed, run.reason, run.events,
          run.collisions, run.collapses, run.steps,  run.balance};
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
  const HardScene& hard = scene().hard;
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

}  // namespace

std::vector<std::vector<BodyState>> ReferenceSolver::states_along(
    std::span<const double> times) const {
  const std::vector<BodyState>& initial = scene().hard.initial;
  if (phases_) {
    EventSettings settings;
    settings.most_events = most_events_;
    return walk(EventSolver(scene().hard, initial, settings), times);
  }
  return walk(ContactSolver(scene(), initial), times);
}

double ReferenceSolver::next_collision(std::span<const BodyState> states, double start,
                                       double limit, double slowest) const {
  if (runs_in_phases(scene().hard)) {
    EventSettings settings;
    settings.start = start;
    return EventSolver(scene().hard, states, settings).next_collision(limit, slowest);
  }
  ContactSettings settings;
  settings.tolerance = 1e-8;  // engines are further off
  settings.start = start;
  return ContactSolver(scene(), states, settings).next_collision(limit, slowest);
}

}  // namespace slipcheck
