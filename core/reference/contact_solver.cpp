#include "reference/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "reference/contact_state.h"
#include "reference/contact_touch.h"
#include "reference/contact_watch.h"
#include "reference/ode.h"

namespace slipcheck {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
using What = ContactWatch::What;

ContactScales scales_of(const ContactScene& scene, std::span<const BodyState> initial,
                        const ContactSettings& settings) {
  ContactScales scales;
  double radius = 0;
  for (const Sphere& sphere : scene.hard.bodies) radius = std::max(radius, sphere.radius);
  // A scene in which nothing moves has the speed of a fall through a thousandth of its size.
  const double least = 1e-3 * std::sqrt(2 * scene.hard.gravity * radius);
  scales.speed = std::max({speed_scale(scene.hard, initial), least, 1e-30});
  scales.slip_floor = 100 * settings.tolerance * scales.speed;
  scales.slowest_rebound = settings.cut_offs * EventSettings{}.collapse_fraction * scales.speed;
  scales.slowest_landing = settings.cut_offs * EventSettings{}.landing_fraction * scales.speed;
  return scales;
}

/// Which method suits the stretch between two events: Adams, until it crawls and BDF does not. A
/// slip that begins slowly while its direction turns is stiff; a contact that swings is not.
class MethodChoice {
 public:
  Ode::Method method() const { return method_; }
  void begin(Ode::Method method) {
    method_ = method;
    trial_ = method == Ode::Method::adams ? Trial::adams : Trial::over;
    steps_ = 0;
  }
  /// After a step to the time `now`; whether the method changed.
  bool step(double now) {
    if (trial_ == Trial::over || ++steps_ < kSteps) {
      if (steps_ == kSteps / 2) middle_ = now;
      return false;
    }
    const double pace = now - middle_;
    steps_ = 0;
    if (trial_ == Trial::adams) {
      adams_pace_ = pace;
      trial_ = Trial::bdf;
      method_ = Ode::Method::bdf;
      return true;
    }
    trial_ = Trial::over;
    if (pace > 3 * adams_pace_) return false;
    method_ = Ode::Method::adams;
    return true;
  }

 private:
  enum class Trial { adams, bdf, over };
  static constexpr int kSteps = 400;
  Ode::Method method_ = Ode::Method::adams;
  Trial trial_ = Trial::adams;
  int steps_ = 0;
  double middle_ = 0, adams_pace_ = 0;
};

/// Where sliding and spin share the friction, a small slip dies out at the rate (1+A) μ_k N/(m |w|)
/// with w = (u, a_c Ω_z): the faster, the less of both is left. A contact of bodies is fast too.
bool is_stiff(const ContactState& state) {
  const ContactDynamics& dynamics = state.dynamics();
  const HardScene& scene = state.scene().hard;
  double slow_enough = 0;
  for (const ContactMode& contact : dynamics.contacts)
    slow_enough = std::max(slow_enough, 10 / contact.time_scale);
  for (std::size_t i = 0; i < dynamics.modes.size(); ++i) {
    const double spin = state.y[i * ContactDynamics::kBody + 8];
    const BodyMode& mode = dynamics.modes[i];
    if (!dynamics.is_coupled(i) || mode.kind != BodyMode::Kind::sliding || mode.spin_held) continue;
    const SubstrateContact& contact = scene.on_substrate(i);
    const double left = std::hypot(dynamics.slip(i, state.y.data()).norm(),
                                   contact.coupled_radius * spin, dynamics.creep_speed);
    const double push = contact.kinetic_friction * std::abs(state.evaluation().bodies[i].normal);
    const Sphere& sphere = scene.bodies[i];
    if ((1 + sphere.inverse_shape_factor()) * push > slow_enough * sphere.mass * left) return true;
  }
  return false;
}

}  // namespace

class ContactSolver::Impl {
 public:
  Impl(const ContactScene& scene, std::span<const BodyState> initial,
       const ContactSettings& settings)
      : scene_(&scene),
        settings_(settings),
        state_(scene, initial, settings.start, scales_of(scene, initial, settings)) {
    make_integrator(Ode::Method::adams);
    initial_energy_ = energy();
    largest_energy_ = state_.dynamics().kinetic_energy(state_.time, state_.y.data());
  }

  ContactRun run(const RunEnd& end, FrameSink* sink);
  double first_contact(double limit);
  double next_collision(double limit, double slowest);

  const ContactState& state() const { return state_; }
  EnergyBalance balance() const;

 private:
  /// What stopped the integration.
  struct Happening {
    std::optional<NextTouch> touch;
    std::vector<std::pair<ContactWatch::Item, int>> roots;
    bool kink = false;
  };

  void make_integrator(Ode::Method method);
  void restart();
  void predict_landings();
  Happening advance(double limit);
  void handle(const Happening& happening, FrameSink* sink, ContactRun& run);
  void handle_touch(const NextTouch& touch, FrameSink* sink, ContactRun& run);
  void handle_root(const ContactWatch::Item& item, int direction);
  void reveal_slides(FrameSink* sink);
  bool has_ended(const RunEnd& end);
  bool will_collide(double limit);
  double energy() const;
  void show(FrameSink* sink, double time, std::optional<Touch> hit = std::nullopt);

  const ContactScene* scene_;
  ContactSettings settings_;
  ContactState state_;
  std::optional<Ode> ode_;
  Ode::Method method_ = Ode::Method::adams;  ///< of ode_
  MethodChoice choice_;
  bool new_stretch_ = true;  ///< the modes have changed since the last restart
  std::optional<ContactWatch> watch_;
  ContactDynamics::Evaluation scratch_;
  std::vector<double> floor_;
  std::size_t steps_before_ = 0;  ///< of integrators that were replaced
  bool must_restart_ = true;
  std::vector<double> landing_;  ///< when each body comes down from a free flight, or infinity
  double initial_energy_ = 0, largest_energy_ = 0;
  double next_look_ = -1;
  std::vector<bool> seen_sliding_;  ///< a frame has shown this body's present slide
  Frame frame_;
};

// --- integration ---------------------------------------------------------------------------------

void ContactSolver::Impl::make_integrator(Ode::Method method) {
  if (ode_) steps_before_ += ode_->steps();
  method_ = method;
  ode_.emplace(state_.y.size(), method, [this](double t, const double* y, double* rate) {
    state_.dynamics().right_side(t, y, rate);
  });
  floor_.resize(state_.y.size());
  scratch_ = {};
}

void ContactSolver::Impl::restart() {
  if (new_stretch_) choice_.begin(is_stiff(state_) ? Ode::Method::bdf : Ode::Method::adams);
  new_stretch_ = false;
  const Ode::Method method = choice_.method();
  if (ode_->y().size() != state_.y.size() || method != method_) make_integrator(method);
  state_.follow_directions();
  watch_.emplace(state_);
  ode_->watch(
      watch_->items().size(),
      [this](double t, const double* y, double* value) {
        watch_->values(state_, t, y, scratch_, value);
      },
      watch_->directions());

  const HardScene& scene = scene_->hard;
  const double tolerance = settings_.tolerance, speed = state_.scales().speed;
  double mass = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double radius = scene.bodies[i].radius;
    double* floor = floor_.data() + i * ContactDynamics::kBody;
    std::fill_n(floor, 3, tolerance * radius);
    std::fill_n(floor + 3, 3, tolerance * speed);
    std::fill_n(floor + 6, 2, tolerance * speed);
    floor[8] = tolerance * speed / radius;
    mass = std::max(mass, scene.bodies[i].mass);
  }
  const auto& dynamics = state_.dynamics();
  std::fill(floor_.begin() + static_cast<std::ptrdiff_t>(dynamics.slot_at(0)), floor_.end(), 1e30);
  for (const ContactMode& contact : dynamics.contacts) {
    double* floor = floor_.data() + dynamics.slot_at(contact.slot);
    floor[0] = tolerance * contact.overlap_scale;
    double bend = contact.overlap_scale;
    if (const auto* asperity = std::get_if<AsperityForce>(&contact.law->tangential)) {
      bend = asperity->size;
      if (asperity->form == AsperityForce::Form::passive && contact.growing)
        bend *= std::visit([&](const auto& law) { return law.elastic(contact.overlap_scale); },
                           contact.law->normal);
    }
    std::fill_n(floor + 1, 3, tolerance * bend);
  }
  floor_[dynamics.dissipated_at()] = floor_[dynamics.work_at()] =
      tolerance * std::max(mass * speed * speed, 1e-3 * largest_energy_);
  ode_->start(state_.time, state_.y, tolerance, floor_);
  predict_landings();
  must_restart_ = false;
}

/// A free flight is a parabola: it ends where its closed form says, however short it is.
void ContactSolver::Impl::predict_landings() {
  const HardScene& scene = scene_->hard;
  landing_.assign(scene.bodies.size(), kNever);
  for (std::size_t i = 0; i < landing_.size(); ++i) {
    if (state_.dynamics().modes[i].on_plane() || state_.in_contact(i)) continue;
    const double* body = state_.y.data() + i * ContactDynamics::kBody;
    const double h = std::max(0.0, body[2]), v = body[5], g = scene.gravity;
    const double root = std::sqrt(v * v + 2 * g * h);
    if (v > 0 ? g > 0 : root > v)
      landing_[i] = state_.time + (v > 0 ? (v + root) / g : 2 * h / (root - v));
  }
}

ContactSolver::Impl::Happening ContactSolver::Impl::advance(double limit) {
  if (must_restart_) restart();
  if (state_.dynamics().modes.size() > 1) state_.evaluate();
  const double kink = state_.dynamics().next_kink;
  const double landing = *std::min_element(landing_.begin(), landing_.end());
  const double last = std::min({limit, kink, landing});
  Happening happening;
  // What is due within rounding of now needs no step.
  if (last <= state_.time + 4e-16 * std::abs(state_.time)) {
    state_.time = std::max(state_.time, last);
    happening.kink = last == kink;
    for (std::size_t i = 0; i < landing_.size(); ++i)
      if (landing_[i] <= last) happening.roots.push_back({{What::landing, i}, -1});
    return happening;
  }
  const Ode::Stop stop = ode_->step(last);
  happening.touch = first_touch(state_, *ode_);
  if (happening.touch) {
    if (happening.touch->time > state_.time) {
      ode_->dense(happening.touch->time, state_.y);
      state_.time = happening.touch->time;
    }
  } else {
    std::copy(ode_->y().begin(), ode_->y().end(), state_.y.begin());
    state_.time = ode_->time();
    if (stop == Ode::Stop::root)
      for (std::size_t k = 0; k < watch_->items().size(); ++k)
        if (ode_->roots_found()[k] != 0)
          happening.roots.emplace_back(watch_->items()[k], ode_->roots_found()[k]);
    happening.kink = stop == Ode::Stop::limit && last == kink;
    if (stop == Ode::Stop::limit)
      for (std::size_t i = 0; i < landing_.size(); ++i)
        if (landing_[i] <= last) happening.roots.push_back({{What::landing, i}, -1});
  }
  state_.follow_directions();
  if (choice_.step(state_.time)) must_restart_ = true;
  largest_energy_ =
      std::max(largest_energy_, state_.dynamics().kinetic_energy(state_.time, state_.y.data()));
  return happening;
}

// --- events --------------------------------------------------------------------------------------

void ContactSolver::Impl::handle_touch(const NextTouch& touch, FrameSink* sink, ContactRun& run) {
  ++run.collisions;
  state_.project();
  if (scene_->between(touch.first, touch.second)) {
    show(sink, state_.time);
    state_.begin_contact(touch.first, touch.second);
    state_.settle();
    return;
  }
  show(sink, state_.time);
  const CollisionResult result = state_.collide_now(touch.first, touch.second);
  if (result.impact_speed < state_.scales().slowest_rebound) ++run.collapses;
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
    case What::force_sign:
      state_.dynamics().contacts[i].force_sign = direction;
      break;
    case What::force_end:
      state_.clamp_contact(i);
      break;
    case What::force_begin:
      state_.release_contact(i);
      break;
    case What::cap:
      state_.dynamics().contacts[i].capped = direction > 0;
      break;
    case What::break_forward:
      state_.break_asperity(i, 1);
      break;
    case What::break_back:
      state_.break_asperity(i, -1);
      break;
    case What::growth:
      state_.switch_growth(i, direction > 0);
      break;
    case What::roll_kink:
      break;
    case What::contact_end:  // handled last, by handle()
    case What::slip_dies_out:
    case What::greatest_overlap:
      break;
  }
}

void ContactSolver::Impl::handle(const Happening& happening, FrameSink* sink, ContactRun& run) {
  if (happening.touch) {
    ++run.events;
    handle_touch(*happening.touch, sink, run);
    must_restart_ = new_stretch_ = true;
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
  must_restart_ = new_stretch_ = true;
  if (landed) {
    // A body that bounces shows its touch in the frame after the landing.
    for (const auto& [item, direction] : happening.roots)
      if (item.what == What::landing && !state_.dynamics().modes[item.index].on_plane())
        frame_.touches.push_back(
            {static_cast<int>(item.index), kSubstrate, scene_->hard.bodies[item.index].mass});
  }
  show(sink, state_.time);
  // A contact is shown once more at its end.
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
  for (const ContactMode& contact : dynamics.contacts)
    frame_.touches.push_back(
        {static_cast<int>(contact.first), static_cast<int>(contact.second), 1e-300});
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
  balance.substrate_work = state_.y[state_.dynamics().work_at()];
  balance.scale =
      std::max({largest_energy_, std::abs(balance.dissipated), std::abs(balance.substrate_work)});
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
  const double next = Impl(*scene_, now, coarse).next_collision(limit, 0);
  next_look_ = next;
  return std::isfinite(next);
}

bool ContactSolver::Impl::has_ended(const RunEnd& end) {
  if (end.until == Run::Until::time || !state_.dynamics().contacts.empty()) return false;
  const std::size_t count = state_.dynamics().modes.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!state_.dynamics().modes[i].on_plane()) return false;
    if (end.until == Run::Until::rest ? !state_.rests(i) : state_.slides(i)) return false;
  }
  return !will_collide(end.limit);
}

ContactRun ContactSolver::Impl::run(const RunEnd& end, FrameSink* sink) {
  ContactRun run;
  const bool to_a_time = end.until == Run::Until::time;
  const double last = to_a_time ? end.time : end.limit;
  show(sink, state_.time);
  bool event = true;
  while (true) {
    // Only an event changes what a run ends with.
    if (event && has_ended(end)) {
      run.reached = true;
      break;
    }
    if (state_.time >= last) {
      run.reached = to_a_time;
      if (!to_a_time)
        run.reason = end.until == Run::Until::rolling
                         ? "a body still slides or flies, or collides again, at the limit"
                         : "a body still moves at the limit";
      state_.project();
      show(sink, state_.time);
      break;
    }
    if (run.events >= settings_.max_events) {
      run.reason = "more than " + std::to_string(settings_.max_events) + " events";
      break;
    }
    if (steps_before_ + ode_->steps() >= settings_.max_steps) {
      run.reason = "more than " + std::to_string(settings_.max_steps) + " steps";
      break;
    }
    const std::size_t before = run.events;
    try {
      handle(advance(last), sink, run);
    } catch (const IntegrationFailure& failure) {
      run.failed = true;
      run.reason = failure.what();
      break;
    }
    event = run.events != before;
    if (sink && !event) reveal_slides(sink);
  }
  run.end_time = state_.time;
  run.steps = steps_before_ + ode_->steps();
  run.balance = balance();
  return run;
}

double ContactSolver::Impl::first_contact(double limit) {
  ContactRun run;
  while (state_.time < limit && run.events < settings_.max_events) {
    const Happening happening = advance(limit);
    if (happening.touch) return state_.time;
    for (const auto& [item, direction] : happening.roots)
      if (item.what == What::landing) return state_.time;
    handle(happening, nullptr, run);
  }
  return kNever;
}

double ContactSolver::Impl::next_collision(double limit, double slowest) {
  ContactRun run;
  while (state_.time < limit && run.events < settings_.max_events) {
    const Happening happening = advance(limit);
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

ContactRun ContactSolver::run(const RunEnd& end, FrameSink* sink) { return impl_->run(end, sink); }
double ContactSolver::first_contact(double limit) { return impl_->first_contact(limit); }
double ContactSolver::next_collision(double limit, double slowest) {
  return impl_->next_collision(limit, slowest);
}
std::vector<BodyState> ContactSolver::states() const { return impl_->state().bodies(); }
double ContactSolver::now() const { return impl_->state().time; }
EnergyBalance ContactSolver::balance() const { return impl_->balance(); }

}  // namespace slipcheck
