#include "reference/forces/soft_box_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <variant>

#include "base/stop_scope.h"
#include "physics/numbers.h"
#include "reference/forces/soft_box_dynamics.h"
#include "reference/forces/soft_box_flight.h"
#include "reference/forces/soft_box_watch.h"

namespace slipcheck {
namespace {

using Near = SoftBoxFlight::Near;
using What = SoftBoxWatch::What;

}  // namespace

class SoftBoxSolver::Impl {
 public:
  Impl(const ContactScene& scene, std::span<const BodyState> initial,
       const SoftBoxSettings& settings)
      : settings_(settings), dynamics_(scene), flight_(dynamics_) {
    assert(settings.steps_per_contact >= 10 && initial.size() == scene.hard.bodies.size());
    state_.bodies.resize(initial.size());
    for (std::size_t i = 0; i < initial.size(); ++i) {
      state_.bodies[i] = planar(initial[i]);
      flight_.release(i, 0, state_.bodies[i]);
    }
    after_ = sample_ = state_;
    list();
    for (std::size_t k = 0; k < flight_.near().size(); ++k) {
      const Near near = flight_.near()[k];
      if (overlap(near, 0, state_) > 0) add_touch(near);
    }
    touches_changed();
    first_energy_ = energy();
  }

  SolvedRun run(const RunEnd& end, FrameSink* sink) {
    if (end.until != Run::Until::time)
      throw Unsupported("resolved contacts in a box run until a time; nothing there comes to rest");
    sink_ = sink;
    interval_ = sink ? end.sample_interval : 0;
    next_sample_ = interval_ > 0 ? std::floor(now_ / interval_) : 0;
    while (sample_time() <= now_) ++next_sample_;
    SolvedRun run;
    if (sink) show(now_, state_);
    while (now_ < end.time && steps_ < settings_.max_steps) {
      heed_stop();
      if (now_ >= flight_.valid_until() || must_list_) list();
      const Near* meeting = flight_.next_meeting(now_);
      double until = std::min(end.time, flight_.valid_until());
      const bool meets = meeting && meeting->meeting <= until;
      if (meets) until = std::max(meeting->meeting, now_);
      if (dynamics_.touches.empty()) {
        show_samples(until);
        now_ = until;
      } else {
        advance(until);
      }
      if (meets && now_ == until) {
        add_touch(*meeting);
        touches_changed();
      }
    }
    if (sink && shown_ < now_) show(now_, state_);
    run.end_time = now_;
    run.reached = now_ >= end.time;
    if (!run.reached) run.reason = "more than " + std::to_string(settings_.max_steps) + " steps";
    run.steps = steps_;
    run.collisions = collisions_;
    run.contacts = bounces_;
    run.balance = {energy(), first_energy_, state_.dissipated, state_.work};
    run.balance->scale = std::max({std::abs(first_energy_), std::abs(run.balance->energy),
                                   std::abs(state_.work), std::abs(state_.dissipated)});
    return run;
  }

  std::vector<BodyState> states() const {
    std::vector<BodyState> states;
    for (const PlanarMotion& m : motions(now_, state_)) states.push_back(spatial(m));
    return states;
  }
  double now() const { return now_; }
  std::size_t body_steps() const { return body_steps_; }
  double energy() const { return dynamics_.energy(now_, motions(now_, state_)); }

 private:
  using State = SoftBoxDynamics::State;
  using Rates = SoftBoxDynamics::Rates;

  PlanarMotion motion(std::size_t i, double t, const State& state) const {
    return flight_.is_flying(i) ? flight_.at(i, t) : state.bodies[i];
  }
  std::vector<PlanarMotion> motions(double t, const State& state) const {
    std::vector<PlanarMotion> all(dynamics_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = motion(i, t, state);
    return all;
  }
  double overlap(const Near& near, double t, const State& state) const {
    const PlanarMotion one = motion(near.first, t, state);
    const bool is_pair = near.partner < dynamics_.size();
    return dynamics_
        .meeting(near.first, near.partner, t, one, is_pair ? motion(near.partner, t, state) : one)
        .overlap;
  }

  // --- samples -----------------------------------------------------------------------------------
  double sample_time() const { return interval_ > 0 ? next_sample_ * interval_ : kNever; }

  void show(double t, const State& state) {
    frame_.bodies.resize(dynamics_.size());
    for (std::size_t i = 0; i < dynamics_.size(); ++i)
      frame_.bodies[i] = spatial(motion(i, t, state));
    frame_.collisions = collisions_;
    sink_->take(t, frame_);
    shown_ = t;
  }

  /// Those until then, of a stretch that begins now and has no event within.
  void show_samples(double until) {
    for (; sample_time() <= until; ++next_sample_) {
      const double t = sample_time();
      if (!dynamics_.touches.empty())
        dynamics_.step(now_, t - now_, state_, rates_, sample_, sample_rates_);
      show(t, sample_);
    }
  }

  // --- who touches whom --------------------------------------------------------------------------
  void list() {
    flight_.list(now_, motions(now_, state_));
    must_list_ = false;
    watch_near();
  }

  void watch_near() {
    watched_.clear();
    const std::size_t n = dynamics_.size();
    for (const Near& near : flight_.near())
      if (!near.touching && (!flight_.is_flying(near.first) ||
                             (near.partner < n && !flight_.is_flying(near.partner))))
        watched_.push_back(near);
  }

  void add_touch(const Near& near) {
    const std::size_t n = dynamics_.size();
    for (const std::size_t i : {near.first, near.partner})
      if (i < n && flight_.is_flying(i)) {
        state_.bodies[i] = flight_.at(i, now_);
        flight_.stop(i);
      }
    const bool is_pair = near.partner < n;
    const PlanarMotion& one = state_.bodies[near.first];
    const PlanarMotion& other = state_.bodies[is_pair ? near.partner : near.first];
    const auto at = dynamics_.meeting(near.first, near.partner, now_, one, other);
    flight_.find(near.first, near.partner).touching = true;
    dynamics_.touches.push_back(dynamics_.touch(near.first, near.partner, at));
    state_.bends.push_back(
        first_bend(dynamics_.touches.back().law->tangential, at.closing, at.slip));
    ++(is_pair ? collisions_ : bounces_);
  }

  void remove_touch(std::size_t c) {
    const SoftTouch& touch = dynamics_.touches[c];
    flight_.find(touch.first, touch.partner).touching = false;
    dynamics_.touches.erase(dynamics_.touches.begin() + static_cast<std::ptrdiff_t>(c));
    state_.bends.erase(state_.bends.begin() + static_cast<std::ptrdiff_t>(c));
  }

  /// Brings all that follows from the touches up to date.
  void touches_changed() {
    const std::size_t n = dynamics_.size();
    touching_.assign(n, false);
    for (const SoftTouch& touch : dynamics_.touches) {
      touching_[touch.first] = true;
      if (touch.partner < n) touching_[touch.partner] = true;
    }
    dynamics_.moved.clear();
    for (std::size_t i = 0; i < n; ++i) {
      if (touching_[i])
        dynamics_.moved.push_back(i);
      else if (!flight_.is_flying(i))
        flight_.release(i, now_, state_.bodies[i]);
    }
    watch_near();
    if (!dynamics_.touches.empty()) dynamics_.evaluate(now_, state_, rates_);
  }

  // --- steps -------------------------------------------------------------------------------------
  double step_length() const {
    double h = kNever;
    for (std::size_t c = 0; c < dynamics_.touches.size(); ++c) {
      const SoftTouch& touch = dynamics_.touches[c];
      const SoftBoxDynamics::Forces& f = rates_.forces[c];
      double own = touch.time_scale / settings_.steps_per_contact;
      if (!std::holds_alternative<LinearForce>(touch.law->normal)) {
        // Begin and end, about ξ/|ξ̇| away, are not smooth in the time.
        const double away = 0.5 * std::abs(f.at.overlap / f.at.closing);
        if (away < own) own = std::max(away, own / 32);
      }
      if (const auto* asperity = std::get_if<AsperityForce>(&touch.law->tangential)) {
        const double rate2 =
            asperity->friction * std::abs(f.normal) / asperity->size * touch.tangential_mobility;
        own = std::min(own, 3 / (std::sqrt(rate2) * settings_.steps_per_contact));
      }
      h = std::min(h, own);
    }
    return h;
  }

  /// One step, at most until then.
  void advance(double until) {
    double h = step_length();
    const bool to_the_end = now_ + h >= until;
    if (to_the_end) h = until - now_;
    watch_.begin(dynamics_, state_, rates_);
    try_step(h);
    watch_begins(h);
    const double taken = locate(h);
    const double then = to_the_end && taken == h ? until : now_ + taken;
    if (sink_ && sample_time() <= then) show_samples(then);
    std::swap(state_.bodies, after_.bodies);
    std::swap(state_.bends, after_.bends);
    state_.work = after_.work;
    state_.dissipated = after_.dissipated;
    std::swap(rates_, then_);
    now_ = then;
    ++steps_;
    body_steps_ += dynamics_.moved.size();
    for (const std::size_t i : dynamics_.moved)
      must_list_ |= !flight_.covers(std::hypot(state_.bodies[i].vx, state_.bodies[i].vz));
    for (std::size_t c = 0; c < dynamics_.touches.size(); ++c)
      dynamics_.scale(dynamics_.touches[c], rates_.forces[c].at);
    handle_events();
  }

  void try_step(double h) {
    dynamics_.step(now_, h, state_, rates_, after_, then_);
    watch_.look(dynamics_, after_, then_);
    for (SoftBoxWatch::Item& item : watch_.items)
      if (item.what == What::begin) item.now = -overlap(watched_[item.index], now_ + h, after_);
  }

  /// Those near that overlap after the first try.
  void watch_begins(double h) {
    for (std::size_t k = 0; k < watched_.size(); ++k) {
      const double after = overlap(watched_[k], now_ + h, after_);
      if (!(after > 0)) continue;
      SoftBoxWatch::Item item{What::begin, k};
      item.low = -overlap(watched_[k], now_, state_);
      item.now = -after;
      item.can_be_found = item.low > 0;
      watch_.items.push_back(item);
    }
  }

  /// Shortens the step that was tried to the first event within, by the Illinois rule on whatever
  /// happened, and leaves that step as the last one tried.
  double locate(double tried) {
    double low = 0, high = tried, last = tried;
    for (SoftBoxWatch::Item& item : watch_.items) item.high = item.now;
    int side = 0;
    for (int count = 1; count <= 60; ++count) {
      double first = kNever, tolerance = 0;
      for (const SoftBoxWatch::Item& item : watch_.items) {
        if (!item.can_be_found || item.high > 0) continue;
        const double at = low + (high - low) * item.low / (item.low - item.high);
        if (at >= first) continue;
        first = at;
        tolerance = (item.is_corner ? 1e-3 : 1e-10) * tried;
      }
      if (!(first < high - tolerance)) break;
      last = count % 8 == 0 ? 0.5 * (low + high) : first + 0.5 * tolerance;
      try_step(last);
      const bool happened = std::ranges::any_of(watch_.items, [](const SoftBoxWatch::Item& item) {
        return item.can_be_found && !(item.now > 0);
      });
      const double low_part = happened && side == 1 ? 0.5 : 1;
      const double high_part = !happened && side == -1 ? 0.5 : 1;
      for (SoftBoxWatch::Item& item : watch_.items) {
        item.low = happened ? low_part * item.low : item.now;
        item.high = happened ? item.now : high_part * item.high;
      }
      side = happened ? 1 : -1;
      (happened ? high : low) = last;
    }
    if (last != high) try_step(high);
    return high;
  }

  void handle_events() {
    bool changed = false;
    std::vector<std::size_t>& ended = ended_;
    ended.clear();
    std::vector<Near>& begun = begun_;
    begun.clear();
    for (const SoftBoxWatch::Item& item : watch_.items) {
      if (item.now > 0 || item.is_corner) continue;
      changed = true;
      if (item.what == What::begin)
        begun.push_back(watched_[item.index]);
      else if (item.what == What::end)
        ended.push_back(item.index);
      else
        change(item);
    }
    if (!changed) return;
    for (auto c = ended.rbegin(); c != ended.rend(); ++c) remove_touch(*c);
    for (const Near& near : begun) add_touch(near);
    touches_changed();
  }

  /// The touch goes on by another branch of its laws.
  void change(const SoftBoxWatch::Item& item) {
    SoftTouch& touch = dynamics_.touches[item.index];
    double& bend = state_.bends[item.index];
    if (item.what == What::force) {
      touch.pushes = !touch.pushes;
      touch.branch = {};
      bend = bend_without_force(touch.law->tangential, bend);
    } else {
      cross(item.edge, item.turn < 0, touch.law->tangential, rates_.forces[item.index].normal,
            touch.branch, bend);
    }
  }

  SoftBoxSettings settings_;
  SoftBoxDynamics dynamics_;
  SoftBoxFlight flight_;
  SoftBoxWatch watch_;
  double now_ = 0, first_energy_ = 0;
  bool must_list_ = false;  ///< a body has become too fast for the list of those near
  State state_, after_;
  Rates rates_, then_;         ///< of state_ and after_
  std::vector<Near> watched_;  ///< near, of which one touches something, but not the other
  std::vector<bool> touching_;
  std::vector<std::size_t> ended_;
  std::vector<Near> begun_;

  FrameSink* sink_ = nullptr;
  Frame frame_;
  State sample_;
  Rates sample_rates_;
  double interval_ = 0, next_sample_ = 0, shown_ = -1;

  std::size_t steps_ = 0, body_steps_ = 0, collisions_ = 0, bounces_ = 0;
};

SoftBoxSolver::SoftBoxSolver(const ContactScene& scene, std::span<const BodyState> initial,
                             const SoftBoxSettings& settings)
    : impl_(std::make_unique<Impl>(scene, initial, settings)) {}
SoftBoxSolver::~SoftBoxSolver() = default;
SoftBoxSolver::SoftBoxSolver(SoftBoxSolver&&) noexcept = default;

SolvedRun SoftBoxSolver::run(const RunEnd& end, FrameSink* sink) { return impl_->run(end, sink); }
std::vector<BodyState> SoftBoxSolver::states() const { return impl_->states(); }
double SoftBoxSolver::now() const { return impl_->now(); }
std::size_t SoftBoxSolver::body_steps() const { return impl_->body_steps(); }
double SoftBoxSolver::energy() const { return impl_->energy(); }

}  // namespace slipcheck
