#include "reference/forces/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/numbers.h"
#include "reference/forces/contact_events.h"
#include "reference/forces/contact_look_ahead.h"

namespace slipcheck {

class ContactSolver::Impl {
 public:
  Impl(const ContactScene& scene, std::span<const BodyState> initial,
       const ContactSettings& settings)
      : scene_(&scene),
        settings_(settings),
        initial_(initial.begin(), initial.end()),
        overlapping_(initial_contacts(scene, initial)),
        events_(scene, initial, settings, overlapping_),
        initial_energy_(energy()),
        initial_elastic_energy_(state().dynamics().elastic_energy(state().y.data())) {}

  SolvedRun run(const RunEnd& end, FrameSink* sink);
  double first_contact(double limit) {
    if (is_at_start() && !overlapping_.empty()) return state().time;
    return look_for_contact(events_, limit, settings_.max_events);
  }
  double next_collision(double limit, double slowest) {
    // Looks at what meets: an engine's overlaps are not to burst apart.
    if (!overlapping_.empty()) return collision_from(initial_, settings_, limit, slowest);
    return look_for_collision(events_, limit, slowest, settings_.max_events);
  }

  const ContactState& state() const { return events_.state(); }
  EnergyBalance balance() const;

 private:
  bool has_ended(const RunEnd& end);
  bool will_collide(double limit);
  double collision_from(std::span<const BodyState> states, const ContactSettings& settings,
                        double limit, double slowest) const;
  bool is_at_start() const { return state().time == settings_.start; }
  double energy() const;

  const ContactScene* scene_;
  ContactSettings settings_;
  std::vector<BodyState> initial_;
  std::vector<InitialContact> overlapping_;  ///< at the start
  ContactEvents events_;
  double initial_energy_, initial_elastic_energy_;
  double next_look_ = -1;
};

double ContactSolver::Impl::energy() const {
  return state().dynamics().kinetic_energy(state().time, state().y.data()) +
         state().dynamics().potential_energy(state().y.data());
}

EnergyBalance ContactSolver::Impl::balance() const {
  EnergyBalance balance;
  balance.energy = energy();
  balance.initial = initial_energy_;
  balance.dissipated = state().y[state().dynamics().dissipated_at()];
  balance.work = state().y[state().dynamics().work_at()];
  balance.scale = std::max({events_.integrator().largest_kinetic_energy(), initial_elastic_energy_,
                            std::abs(balance.dissipated), std::abs(balance.work)});
  return balance;
}

/// When two bodies meet at `slowest` or faster if they go on from these states, where all that
/// overlap is to approach first.
double ContactSolver::Impl::collision_from(std::span<const BodyState> states,
                                           const ContactSettings& settings, double limit,
                                           double slowest) const {
  ContactEvents ahead(*scene_, states, settings, {});
  return look_for_collision(ahead, limit, slowest, settings.max_events);
}

/// Whether two bodies meet before `limit` if the run goes on from here.
bool ContactSolver::Impl::will_collide(double limit) {
  const std::vector<BodyState> now = state().bodies();
  if (now.size() < 2) return false;
  if (state().time <= next_look_) return true;
  ContactSettings coarse;
  coarse.tolerance = std::max(1e-9, settings_.tolerance);
  coarse.start = state().time;
  next_look_ = collision_from(now, coarse, limit, 0);
  return std::isfinite(next_look_);
}

bool ContactSolver::Impl::has_ended(const RunEnd& end) {
  if (end.until == Run::Until::time || !state().only_leans()) return false;
  const std::size_t count = state().dynamics().modes.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!state().dynamics().modes[i].on_plane()) return false;
    if (end.until == Run::Until::rest ? !state().rests(i) : state().slides(i)) return false;
  }
  return !will_collide(end.limit);
}

SolvedRun ContactSolver::Impl::run(const RunEnd& end, FrameSink* sink) {
  SolvedRun run;
  const double last = end.last();
  if (is_at_start()) run.collisions = overlapping_.size();
  events_.show(sink, state().time);
  // What overlaps from the start may lift a body at once.
  if (is_at_start() && !overlapping_.empty()) events_.show(sink, state().time);
  bool event = true;
  while (true) {
    // Only an event changes what a run ends with, but where bodies lean on each other.
    const bool leans = !state().dynamics().contacts.empty() && state().only_leans();
    try {
      if ((event || leans) && has_ended(end)) {
        run.reached = true;
        break;
      }
    } catch (const IntegrationFailure& failure) {
      run.failed = true;
      run.reason = failure.what();
      break;
    }
    if (state().time >= last) {
      run.stop_at_limit(end.until);
      events_.project();
      events_.show(sink, state().time);
      break;
    }
    if (run.events >= settings_.max_events) {
      run.reason = "more than " + std::to_string(settings_.max_events) + " events";
      break;
    }
    if (events_.integrator().steps() >= settings_.max_steps) {
      run.reason = "more than " + std::to_string(settings_.max_steps) + " steps";
      break;
    }
    const std::size_t before = run.events;
    try {
      events_.perform(events_.advance(last), sink, run);
    } catch (const IntegrationFailure& failure) {
      run.failed = true;
      run.reason = failure.what();
      break;
    }
    event = run.events != before;
    if (sink && !event) events_.reveal_slides(sink);
  }
  run.end_time = state().time;
  run.steps = events_.integrator().steps();
  run.balance = balance();
  return run;
}

// --- the public face -----------------------------------------------------------------------------

ContactSolver::ContactSolver(const ContactScene& scene, std::span<const BodyState> initial,
                             const ContactSettings& settings)
    : impl_(std::make_unique<Impl>(scene, initial, settings)) {}
ContactSolver::~ContactSolver() = default;
ContactSolver::ContactSolver(ContactSolver&&) noexcept = default;

SolvedRun ContactSolver::run(const RunEnd& end, FrameSink* sink) { return impl_->run(end, sink); }
double ContactSolver::first_contact(double limit) { return impl_->first_contact(limit); }
double ContactSolver::next_collision(double limit, double slowest) {
  return impl_->next_collision(limit, slowest);
}
std::vector<BodyState> ContactSolver::states() const { return impl_->state().bodies(); }
double ContactSolver::now() const { return impl_->state().time; }
EnergyBalance ContactSolver::balance() const { return impl_->balance(); }

}  // namespace slipcheck
