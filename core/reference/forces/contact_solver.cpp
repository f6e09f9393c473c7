#include "reference/forces/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/numbers.h"
#include "reference/events/event_solver.h"
#include "reference/forces/contact_integrator.h"
#include "reference/initial_contacts.h"

namespace slipcheck {
namespace {

using What = ContactWatch::What;

ContactScales scales_of(const ContactScene& scene, std::span<const BodyState> initial,
                        const ContactSettings& settings,
                        std::span<const InitialContact> overlapping) {
  ContactScales scales;
  double radius = 0;
  for (const Sphere& sphere : scene.hard.bodies) radius = std::max(radius, sphere.radius);
  // A scene in which nothing moves has the speed of a fall through a thousandth of its size.
  const double least = 1e-3 * std::sqrt(2 * scene.hard.gravity * radius);
  scales.speed =
      std::max({speed_scale(scene.hard, initial), release_speed(scene, overlapping), least, 1e-30});
  scales.slip_floor = 100 * settings.tolerance * scales.speed;
  scales.rebound_fraction = settings.cut_offs * EventSettings{}.collapse_fraction;
  scales.slowest_landing = settings.cut_offs * EventSettings{}.landing_fraction * scales.speed;
  return scales;
}

}  // namespace

class ContactSolver::Impl {
 public:
  Impl(const ContactScene& scene, std::span<const BodyState> initial,
       const ContactSettings& settings)
      : Impl(scene, initial, settings, initial_contacts(scene, initial)) {}
  /// Only the pairs in `overlapping` are in contact at the start; others that overlap meet where
  /// they approach.
  Impl(const ContactScene& scene, std::span<const BodyState> initial,
       const ContactSettings& settings, std::vector<InitialContact> overlapping)
      : scene_(&scene),
        settings_(settings),
        initial_(initial.begin(), initial.end()),
        overlapping_(std::move(overlapping)),
        state_(scene, initial, settings.start, scales_of(scene, initial, settings, overlapping_),
               overlapping_),
        integrator_(state_, settings.tolerance),
        initial_energy_(energy()),
        initial_elastic_energy_(state_.dynamics().elastic_energy(state_.y.data())) {}

  SolvedRun run(const RunEnd& end, FrameSink* sink);
  double first_contact(double limit);
  double next_collision(double limit, double slowest);

  const ContactState& state() const { return state_; }
  EnergyBalance balance() const;

 private:
  using Happening = ContactIntegrator::Happening;

  void handle(const Happening& happening, FrameSink* sink, SolvedRun& run);
  void handle_touch(const NextTouch& touch, FrameSink* sink, SolvedRun& run);
  void handle_root(const ContactWatch::Item& item, int direction);
  void reveal_slides(FrameSink* sink);
  bool has_ended(const RunEnd& end);
  bool will_collide(double limit);
  bool is_at_start() const { return state_.time == settings_.start; }
  double energy() const;
  void show(FrameSink* sink, double time, std::optional<Touch> hit = std::nullopt);

  const ContactScene* scene_;
  ContactSettings settings_;
  std::vector<BodyState> initial_;
  std::vector<InitialContact> overlapping_;  ///< at the start
  ContactState state_;
  ContactIntegrator integrator_;
  double initial_energy_, initial_elastic_energy_;
  double next_look_ = -1;
  std::vector<std::size_t> ends_now_;  ///< contacts whose force has just fallen to zero
  std::vector<bool> seen_sliding_;     ///< a frame has shown this body's present slide
  Frame frame_;
};

// --- events --------------------------------------------------------------------------------------

void ContactSolver::Impl::handle_touch(const NextTouch& touch, FrameSink* sink, SolvedRun& run) {
  state_.project();
  const auto& soft = scene_->between(touch.first, touch.second);
  const bool is_impact = !soft || (soft->after_impact && state_.meet(touch.first, touch.second));
  if (is_impact || !soft->after_impact) ++run.collisions;
  if (!is_impact) {
    show(sink, state_.time);
    state_.begin_contact(touch.first, touch.second);
    state_.settle();
    show(sink, state_.time);  // the first touch may lift a body already
    return;
  }
  show(sink, state_.time);
  const CollisionResult result = state_.collide_now(touch.first, touch.second);
  if (result.altered) ++run.collapses;
  state_.hand_impulses_on();
  state_.settle();
  show(sink, state_.time,
       Touch{static_cast<int>(touch.first), static_cast<int>(touch.second),
             std::max(result.impulse.norm(), 1e-300)});
}

void ContactSolver::Impl::handle_root(const ContactWatch::Item& item, int direction) {
  const std::size_t i = item.index;
  switch (item.what) {
    case What::landing:
      state_.land_now(i);
      break;
    case What::lift_off:
      if (scene_->hard.confined)
        state_.dynamics().modes[i].normal_sign = direction;
      else
        state_.lift_off(i);
      break;
    case What::slip_end:
      state_.end_slip(i);
      break;
    case What::slip_develops:
      state_.dynamics().modes[i].slip_begins = false;
      break;
    case What::slip_begin:
      state_.begin_slip(i);
      break;
    case What::roll_end:
      state_.end_roll(i);
      break;
    case What::roll_begin:
      state_.begin_roll(i);
      break;
    case What::spin_end:
      state_.end_spin(i);
      break;
    case What::spin_begin:
      state_.begin_spin(i);
      break;
    case What::force_end:
      state_.clamp_contact(i);
      ends_now_.push_back(i);
      break;
    case What::force_begin:
      state_.release_contact(i);
      break;
    case What::edge:
      state_.cross_edge(i, item.edge, direction > 0);
      break;
    case What::contact_end:  // handled last, by handle()
    case What::roll_kink:
    case What::slip_dies_out:
    case What::greatest_overlap:
      break;
  }
}

void ContactSolver::Impl::handle(const Happening& happening, FrameSink* sink, SolvedRun& run) {
  if (happening.touch) {
    ++run.events;
    handle_touch(*happening.touch, sink, run);
    integrator_.begin_stretch();
    return;
  }
  if (happening.roots.empty() && !happening.kink) return;
  ++run.events;
  const bool shows_before =
      std::any_of(happening.roots.begin(), happening.roots.end(),
                  [](const auto& root) { return root.first.what == What::landing; });
  if (happening.kink) {
    // The last instant at which the substrate has the velocity before.
    show(sink, std::nextafter(state_.time, -kNever));
    state_.feel_substrate_jump();
  } else if (shows_before) {
    show(sink, state_.time);
  }
  bool landed = false;
  for (const auto& [item, direction] : happening.roots) {
    handle_root(item, direction);
    landed |= item.what == What::landing;
  }
  state_.settle();
  integrator_.begin_stretch();
  if (landed) {
    // A body that bounces shows its touch in the frame after the landing.
    for (const auto& [item, direction] : happening.roots)
      if (item.what == What::landing && !state_.dynamics().modes[item.index].on_plane())
        frame_.touches.push_back(
            {static_cast<int>(item.index), kSubstrate, scene_->hard.bodies[item.index].mass});
  }
  // A contact is shown once more at its end.
  show(sink, state_.time);
  ends_now_.clear();
  std::vector<std::size_t> ended;
  for (const auto& [item, direction] : happening.roots)
    if (item.what == What::contact_end) ended.push_back(item.index);
  if (ended.empty()) return;
  std::sort(ended.rbegin(), ended.rend());
  for (std::size_t index : ended) state_.end_contact(index);
  state_.settle();
}

void ContactSolver::Impl::show(FrameSink* sink, double time, std::optional<Touch> hit) {
  if (!sink) {
    frame_.touches.clear();
    return;
  }
  frame_.bodies = state_.bodies();
  const auto& dynamics = state_.dynamics();
  for (std::size_t i = 0; i < dynamics.modes.size(); ++i)
    if (dynamics.modes[i].on_plane())
      frame_.touches.push_back({static_cast<int>(i), kSubstrate, scene_->hard.bodies[i].mass});
  for (std::size_t c = 0; c < dynamics.contacts.size(); ++c) {
    const ContactMode& contact = dynamics.contacts[c];
    const bool acts = !contact.clamped || std::ranges::count(ends_now_, c) > 0;
    frame_.touches.push_back(
        {static_cast<int>(contact.first), static_cast<int>(contact.second), acts ? 1e-300 : 0});
  }
  if (hit) frame_.touches.push_back(*hit);
  sink->take(time, frame_);
  frame_.touches.clear();
}

/// A slide that begins and ends without slip shows in no event's frame: one is shown on its way.
void ContactSolver::Impl::reveal_slides(FrameSink* sink) {
  const auto& modes = state_.dynamics().modes;
  seen_sliding_.resize(modes.size(), false);
  bool reveal = false;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (modes[i].kind != BodyMode::Kind::sliding) {
      seen_sliding_[i] = false;
    } else if (!seen_sliding_[i]) {
      const double slip = state_.dynamics().slip(i, state_.y.data()).norm();
      reveal |= seen_sliding_[i] = slip > 1e-6 * state_.scales().speed;
    }
  }
  if (reveal) show(sink, state_.time);
}

// --- the run -------------------------------------------------------------------------------------

double ContactSolver::Impl::energy() const {
  return state_.dynamics().kinetic_energy(state_.time, state_.y.data()) +
         state_.dynamics().potential_energy(state_.y.data());
}

EnergyBalance ContactSolver::Impl::balance() const {
  EnergyBalance balance;
  balance.energy = energy();
  balance.initial = initial_energy_;
  balance.dissipated = state_.y[state_.dynamics().dissipated_at()];
  balance.work = state_.y[state_.dynamics().work_at()];
  balance.scale = std::max({integrator_.largest_kinetic_energy(), initial_elastic_energy_,
                            std::abs(balance.dissipated), std::abs(balance.work)});
  return balance;
}

/// Whether two bodies meet before `limit` if the run goes on from here.
bool ContactSolver::Impl::will_collide(double limit) {
  const std::vector<BodyState> now = state_.bodies();
  if (now.size() < 2) return false;
  if (state_.time <= next_look_) return true;
  ContactSettings coarse;
  coarse.tolerance = std::max(1e-9, settings_.tolerance);
  coarse.start = state_.time;
  const double next = Impl(*scene_, now, coarse, {}).next_collision(limit, 0);
  next_look_ = next;
  return std::isfinite(next);
}

bool ContactSolver::Impl::has_ended(const RunEnd& end) {
  if (end.until == Run::Until::time || !state_.only_leans()) return false;
  const std::size_t count = state_.dynamics().modes.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!state_.dynamics().modes[i].on_plane()) return false;
    if (end.until == Run::Until::rest ? !state_.rests(i) : state_.slides(i)) return false;
  }
  return !will_collide(end.limit);
}

SolvedRun ContactSolver::Impl::run(const RunEnd& end, FrameSink* sink) {
  SolvedRun run;
  const double last = end.last();
  if (is_at_start()) run.collisions = overlapping_.size();
  show(sink, state_.time);
  // What overlaps from the start may lift a body at once.
  if (is_at_start() && !overlapping_.empty()) show(sink, state_.time);
  bool event = true;
  while (true) {
    // Only an event changes what a run ends with, but where bodies lean on each other.
    const bool leans = !state_.dynamics().contacts.empty() && state_.only_leans();
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
    if (state_.time >= last) {
      run.stop_at_limit(end.until);
      state_.project();
      show(sink, state_.time);
      break;
    }
    if (run.events >= settings_.max_events) {
      run.reason = "more than " + std::to_string(settings_.max_events) + " events";
      break;
    }
    if (integrator_.steps() >= settings_.max_steps) {
      run.reason = "more than " + std::to_string(settings_.max_steps) + " steps";
      break;
    }
    const std::size_t before = run.events;
    try {
      handle(integrator_.advance(last), sink, run);
    } catch (const IntegrationFailure& failure) {
      run.failed = true;
      run.reason = failure.what();
      break;
    }
    event = run.events != before;
    if (sink && !event) reveal_slides(sink);
  }
  run.end_time = state_.time;
  run.steps = integrator_.steps();
  run.balance = balance();
  return run;
}

double ContactSolver::Impl::first_contact(double limit) {
  if (is_at_start() && !overlapping_.empty()) return state_.time;
  SolvedRun run;
  while (state_.time < limit && run.events < settings_.max_events) {
    const Happening happening = integrator_.advance(limit);
    if (happening.touch) return state_.time;
    for (const auto& [item, direction] : happening.roots)
      if (item.what == What::landing) return state_.time;
    handle(happening, nullptr, run);
  }
  return kNever;
}

double ContactSolver::Impl::next_collision(double limit, double slowest) {
  // Looks at what meets: an engine's overlaps are not to burst apart.
  if (!overlapping_.empty())
    return Impl(*scene_, initial_, settings_, {}).next_collision(limit, slowest);
  SolvedRun run;
  while (state_.time < limit && run.events < settings_.max_events) {
    const Happening happening = integrator_.advance(limit);
    if (happening.touch) {
      const BodyState a = state_.body(happening.touch->first);
      const BodyState b = state_.body(happening.touch->second);
      const Vector3 n = (a.position - b.position).normalized();
      if (-n.dot(a.velocity - b.velocity) >= slowest) return state_.time;
    }
    handle(happening, nullptr, run);
  }
  return kNever;
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
