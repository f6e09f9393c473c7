#include "reference/forces/soft_box_flight.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "physics/numbers.h"

namespace slipcheck {

SoftBoxFlight::SoftBoxFlight(const SoftBoxDynamics& dynamics)
    : dynamics_(&dynamics), flights_(dynamics.size()), order_(dynamics.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  double smallest = kNever;
  for (const Sphere& s : dynamics.scene().hard.bodies) {
    smallest = std::min(smallest, s.radius);
    largest_radius_ = std::max(largest_radius_, s.radius);
  }
  skin_ = smallest;
}

PlanarMotion SoftBoxFlight::at(std::size_t i, double t) const {
  const Flight& f = flights_[i];
  const double dt = t - f.time, g = dynamics_->scene().hard.gravity;
  PlanarMotion m = f.start;
  m.x += m.vx * dt;
  m.z += (m.vz - 0.5 * g * dt) * dt;
  m.vz -= g * dt;
  return m;
}

void SoftBoxFlight::release(std::size_t i, double t, const PlanarMotion& motion) {
  flights_[i] = {motion, t, true, true};
  is_stale_ = true;
}

void SoftBoxFlight::stop(std::size_t i) {
  flights_[i].flies = false;
  is_stale_ = true;
}

/// Bodies fall at most g (skin/2)/fastest m/s faster meanwhile, less than a quarter of `fastest`;
/// the floor's own speed, at most half of it, adds to theirs where surfaces are concerned.
void SoftBoxFlight::list(double t, std::span<const PlanarMotion> bodies) {
  const Scene& scene = dynamics_->scene().hard;
  double fastest2 = 0, low_x = kNever, high_x = -kNever, low_z = kNever, high_z = -kNever;
  for (const PlanarMotion& m : bodies) {
    fastest2 = std::max(fastest2, m.vx * m.vx + m.vz * m.vz);
    low_x = std::min(low_x, m.x);
    high_x = std::max(high_x, m.x);
    low_z = std::min(low_z, m.z);
    high_z = std::max(high_z, m.z);
  }
  fastest_ = 2 * std::sqrt(fastest2) + 2 * scene.box->floor.largest_speed() +
             std::sqrt(2 * scene.gravity * skin_) + 1e-9;
  const double largest_step = 0.5 * skin_ / fastest_;
  valid_until_ = t + largest_step;

  near_.clear();
  const bool along_x = high_x - low_x > high_z - low_z;
  const auto place = [&](std::size_t i) { return along_x ? bodies[i].x : bodies[i].z; };
  std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(place(a), a) < std::pair(place(b), b);
  });
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const std::size_t a = order_[k];
    const double reach_a = scene.bodies[a].radius + skin_;
    for (std::size_t l = k + 1; l < order_.size(); ++l) {
      const std::size_t b = order_[l];
      if (place(b) - place(a) > reach_a + largest_radius_) break;
      const double reach = reach_a + scene.bodies[b].radius;
      const double dx = bodies[a].x - bodies[b].x, dz = bodies[a].z - bodies[b].z;
      if (dx * dx + dz * dz < reach * reach)
        near_.push_back({std::min(a, b), std::max(a, b), false, kNever});
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t s = 0; s < SoftBoxDynamics::kSurfaces; ++s) {
      const std::size_t surface = bodies.size() + s;
      if (surface == dynamics_->surface(SoftBoxDynamics::Face::lid) && !dynamics_->has_lid())
        continue;
      if (dynamics_->meeting(i, surface, t, bodies[i], bodies[i]).overlap > -skin_)
        near_.push_back({i, surface, false, kNever});
    }
  }
  std::sort(near_.begin(), near_.end(), [](const Near& a, const Near& b) {
    return std::tie(a.first, a.partner) < std::tie(b.first, b.partner);
  });
  for (const SoftTouch& touch : dynamics_->touches)
    find(touch.first, touch.partner).touching = true;
  for (Flight& f : flights_) f.is_new = true;
  is_stale_ = true;
}

SoftBoxFlight::Near& SoftBoxFlight::find(std::size_t first, std::size_t partner) {
  return *std::lower_bound(near_.begin(), near_.end(), std::pair(first, partner),
                           [](const Near& near, const std::pair<std::size_t, std::size_t>& key) {
                             return std::pair(near.first, near.partner) < key;
                           });
}

const SoftBoxFlight::Near* SoftBoxFlight::next_meeting(double t) {
  if (!is_stale_) return next_;
  const std::size_t n = flights_.size();
  next_ = nullptr;
  for (Near& near : near_) {
    const bool is_pair = near.partner < n;
    const Flight& a = flights_[near.first];
    const Flight& b = flights_[is_pair ? near.partner : near.first];
    if (!a.flies || !b.flies) continue;
    if (a.is_new || b.is_new)
      near.meeting = is_pair ? pair_meeting(t, near.first, near.partner)
                             : surface_meeting(t, near.first, near.partner);
    if (near.meeting < kNever && (!next_ || near.meeting < next_->meeting)) next_ = &near;
  }
  for (Flight& f : flights_) f.is_new = false;
  is_stale_ = false;
  return next_;
}

/// Two parabolas of one acceleration: |Δx + Δv τ| = R_i + R_j.
double SoftBoxFlight::pair_meeting(double t, std::size_t i, std::size_t j) const {
  const PlanarMotion a = at(i, t), b = at(j, t);
  const double dx = a.x - b.x, dz = a.z - b.z, dvx = a.vx - b.vx, dvz = a.vz - b.vz;
  const double towards = -(dx * dvx + dz * dvz);
  if (!(towards > 0)) return kNever;
  const auto& bodies = dynamics_->scene().hard.bodies;
  const double reach = bodies[i].radius + bodies[j].radius, distance = std::hypot(dx, dz);
  const double open = (distance - reach) * (distance + reach);
  if (open <= 0) return t;
  const double root2 = towards * towards - (dvx * dvx + dvz * dvz) * open;
  if (root2 < 0) return kNever;
  const double meeting = t + open / (towards + std::sqrt(root2));
  return meeting <= valid_until_ ? meeting : kNever;
}

/// Since gap(t + τ) >= gap − c τ − ½ B τ² with the closing speed c and a bound B of the relative
/// acceleration, steps to the root of that bound never pass a contact.
double SoftBoxFlight::surface_meeting(double t, std::size_t i, std::size_t surface) const {
  const Scene& scene = dynamics_->scene().hard;
  const ShakenFloor& floor = scene.box->floor;
  const double touching = 8 * kEpsilon * scene.bodies[i].radius;
  const double rate = floor.angular_frequency();
  const bool upright = surface == dynamics_->surface(SoftBoxDynamics::Face::left) ||
                       surface == dynamics_->surface(SoftBoxDynamics::Face::right);
  const double bound = upright ? 0 : scene.gravity + floor.amplitude * rate * rate;
  while (t <= valid_until_) {
    const PlanarMotion m = at(i, t);
    const SoftBoxDynamics::Meeting here = dynamics_->meeting(i, surface, t, m, m);
    const double gap = -here.overlap, closing = here.closing;
    if (gap <= touching && closing > 0) return t;
    if (bound == 0 && closing <= 0) return kNever;
    const double open = std::max(gap, touching);
    const double root = std::sqrt(closing * closing + 2 * bound * open);
    const double next = t + (closing > 0 ? 2 * open / (closing + root) : (root - closing) / bound);
    if (next == t) return closing > 0 ? t : kNever;
    t = next;
  }
  return kNever;
}

}  // namespace slipcheck
