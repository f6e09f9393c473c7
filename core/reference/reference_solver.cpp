#include "reference/reference_solver.h"

#include <algorithm>

namespace slipcheck {

bool has_exact_phases(const HardScene& scene) {
  const bool plain = std::all_of(
      scene.substrate.begin(), scene.substrate.end(), [](const SubstrateContact& contact) {
        const bool rubs_both = contact.rolling_while_sliding && !contact.rolling.is_zero();
        return contact.coupled_radius == 0 && !rubs_both;
      });
  return plain && scene.motion.is_still() && scene.downhill.isZero(0);
}

ReferenceSolver::ReferenceSolver(const ContactScene& scene, Compare::Reference asked)
    : scene_(&scene) {
  const bool soft = !scene.is_hard();
  resolved_ =
      asked == Compare::Reference::contact || (asked == Compare::Reference::automatic && soft);
  if (!resolved_ && soft) {
    hardened_ = scene;
    hardened_->soft.assign(scene.soft.size(), std::nullopt);
  }
  exact_ = !resolved_ && has_exact_phases(scene.hard);
}

SolvedRun ReferenceSolver::run(const RunEnd& end, FrameSink* sink,
                               const SolverAccuracy& accuracy) const {
  const std::vector<BodyState>& initial = scene().hard.initial;
  if (exact_) {
    EventSettings settings;
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
  if (has_exact_phases(scene().hard))
    return EventSolver(scene().hard, scene().hard.initial).first_contact(limit);
  ContactSettings settings;
  settings.tolerance = tolerance;
  return ContactSolver(scene(), scene().hard.initial, settings).first_contact(limit);
}

std::vector<BodyState> ReferenceSolver::states_at(double time) const {
  const HardScene& hard = scene().hard;
  if (time == 0) return hard.initial;
  const RunEnd end{Run::Until::time, time, time};
  if (has_exact_phases(hard)) {
    EventSolver solver(hard, hard.initial);
    solver.run(end, nullptr);
    return solver.states();
  }
  ContactSolver solver(scene(), hard.initial);
  solver.run(end, nullptr);
  return solver.states();
}

double ReferenceSolver::next_collision(std::span<const BodyState> states, double start,
                                       double limit, double slowest) const {
  if (has_exact_phases(scene().hard))
    return start + EventSolver(scene().hard, states).next_collision(limit - start, slowest);
  ContactSettings settings;
  settings.tolerance = 1e-8;  // engines are further off
  settings.start = start;
  return ContactSolver(scene(), states, settings).next_collision(limit, slowest);
}

}  // namespace slipcheck
