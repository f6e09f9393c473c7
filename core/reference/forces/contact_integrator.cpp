#include "reference/forces/contact_integrator.h"

#include <algorithm>
#include <cmath>

#include "base/stop_scope.h"
#include "physics/fall_time.h"
#include "physics/numbers.h"

namespace slipcheck {
namespace {

/// Where sliding and spin share the friction, a small slip dies out at the rate (1+A) μ_k N/(m |w|)
/// with w = (u, a_c Ω_z): the faster, the less of both is left. A contact of bodies is fast too.
bool is_stiff(const ContactState& state) {
  const ContactDynamics& dynamics = state.dynamics();
  const Scene& scene = state.scene().hard;
  double slow_enough = 0;
  for (const ContactMode& contact : dynamics.contacts)
    slow_enough = std::max(slow_enough, 10 / contact.time_scale);
  for (std::size_t i = 0; i < dynamics.modes.size(); ++i) {
    const double spin = state.y[i * kBody + 8];
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

ContactIntegrator::ContactIntegrator(ContactState& state, double tolerance)
    : state_(state),
      tolerance_(tolerance),
      largest_energy_(state.dynamics().kinetic_energy(state.time, state.y.data())) {
  make_ode(Ode::Method::adams);
}

void ContactIntegrator::make_ode(Ode::Method method) {
  if (ode_) steps_before_ += ode_->steps();
  method_ = method;
  ode_.emplace(state_.y.size(), method, [this](double t, const double* y, double* rate) {
    state_.dynamics().right_side(t, y, rate);
  });
  floor_.resize(state_.y.size());
  scratch_ = {};
}

void ContactIntegrator::restart() {
  if (new_stretch_) choice_.begin(is_stiff(state_) ? Ode::Method::bdf : Ode::Method::adams);
  new_stretch_ = false;
  const Ode::Method method = choice_.method();
  if (ode_->y().size() != state_.y.size() || method != method_) make_ode(method);
  state_.follow_directions();
  watch_.emplace(state_);
  ode_->watch(
      watch_->items().size(),
      [this](double t, const double* y, double* value) {
        watch_->values(state_, t, y, scratch_, value);
      },
      watch_->directions());

  set_floors();
  ode_->start(state_.time, state_.y, tolerance_, floor_);
  predict_landings();
  must_restart_ = false;
}

/// Absolute tolerances: those of the scene's scales, and of each contact's.
void ContactIntegrator::set_floors() {
  const Scene& scene = state_.scene().hard;
  const double tolerance = tolerance_, speed = state_.scales().speed;
  double mass = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double radius = scene.bodies[i].radius;
    double* floor = floor_.data() + i * kBody;
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
    // What an impact leaves together is pressed to the digits that its velocities have.
    floor[0] = (contact.law->after_impact ? 1e4 : 1) * tolerance * contact.overlap_scale;
    double bend = contact.overlap_scale;
    if (const auto* asperity = std::get_if<AsperityForce>(&contact.law->tangential)) {
      bend = asperity->size;
      if (asperity->form == AsperityForce::Form::passive && contact.branch.growing)
        bend *= std::visit([&](const auto& law) { return law.elastic(contact.overlap_scale); },
                           contact.law->normal);
    }
    if (const auto* angle = std::get_if<ImpactAngleForce>(&contact.law->tangential))
      bend = std::max(angle->friction, 1e-3);
    std::fill_n(floor + 1, 3, tolerance * bend);
  }
  floor_[dynamics.dissipated_at()] = floor_[dynamics.work_at()] =
      tolerance * std::max(mass * speed * speed, 1e-3 * largest_energy_);
}

/// A free flight is a parabola: it ends where its closed form says, however short it is.
void ContactIntegrator::predict_landings() {
  const Scene& scene = state_.scene().hard;
  landing_.assign(scene.bodies.size(), kNever);
  for (std::size_t i = 0; i < landing_.size(); ++i) {
    if (state_.dynamics().modes[i].on_plane() || state_.in_contact(i)) continue;
    const double* body = state_.y.data() + i * kBody;
    landing_[i] = state_.time + fall_time(std::max(0.0, body[2]), body[5], scene.gravity);
  }
}

void ContactIntegrator::add_landings(double time, Happening& happening) const {
  for (std::size_t i = 0; i < landing_.size(); ++i)
    if (landing_[i] <= time) happening.roots.push_back({{ContactWatch::What::landing, i}, -1});
}

ContactIntegrator::Happening ContactIntegrator::advance(double limit) {
  if (must_restart_) restart();
  if (state_.dynamics().modes.size() > 1) state_.evaluate();
  if (state_.reach_caps()) restart();
  const double kink = state_.dynamics().next_kink;
  const double landing = *std::min_element(landing_.begin(), landing_.end());
  const double last = std::min({limit, kink, landing});
  Happening happening;
  // What is due within rounding of now needs no step.
  if (last <= state_.time + 4e-16 * std::abs(state_.time)) {
    heed_stop();
    state_.time = std::max(state_.time, last);
    happening.kink = last == kink;
    add_landings(last, happening);
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
    if (stop == Ode::Stop::limit) add_landings(last, happening);
  }
  state_.follow_directions();
  if (choice_.step(state_.time)) must_restart_ = true;
  largest_energy_ =
      std::max(largest_energy_, state_.dynamics().kinetic_energy(state_.time, state_.y.data()));
  return happening;
}

}  // namespace slipcheck
