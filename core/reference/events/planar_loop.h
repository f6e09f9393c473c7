#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "physics/contact/elastic_pair.h"
#include "physics/contact/planar_collision.h"
#include "reference/events/planar_world.h"

namespace slipcheck {

// What PlanarWorld does at each event, for scenes that have what kHas says. What a scene lacks adds
// zeros or multiplies by one, so that every loop that may serve a scene gives the same bits.

/// PlanarWorld with the loop for kHas, for EventScheduler.
template <PlanarFeatures kHas>
class PlanarLoop {
 public:
  /// The world must outlive this, and its scene have no more than kHas.
  explicit PlanarLoop(PlanarWorld& world) : world_(&world) {}

  std::size_t size() const { return world_->size(); }
  EventPlan& plan(std::uint32_t i) { return world_->plan(i); }
  void prefetch(std::uint32_t i) const { world_->prefetch(i); }
  void prefetch_cells(std::uint32_t i) const { world_->prefetch_cells(i); }
  void prefetch_neighbours(std::uint32_t i) const { world_->prefetch_neighbours(i); }
  double own_event_time(std::uint32_t i, double now) {
    return world_->own_event_time<kHas>(i, now);
  }
  BodyChange do_own_event(std::uint32_t i, double now) {
    return world_->do_own_event<kHas>(i, now);
  }
  std::span<const std::uint32_t> collide(std::uint32_t i, std::uint32_t j, double now) {
    return world_->collide<kHas>(i, j, now);
  }
  EventPlan first_collision(std::uint32_t i, double now, double before, Neighbourhood neighbours) {
    return world_->first_collision<kHas>(i, now, before, neighbours);
  }

 private:
  PlanarWorld* world_;
};

template <PlanarFeatures kHas>
double PlanarWorld::own_event_time(std::uint32_t i, double now) {
  Body& body = moved_to<kHas>(i, now);
  const std::int32_t ix = column(i), iy = row(i);
  Own own = Own::none;
  double earliest = kNever;
  const auto consider = [&](double after, Own what) {
    const double t = now + std::max(after, 0.0);
    if (t < earliest) earliest = t, own = what;
  };
  if (body.vx < 0 && !(kHas.box && upright_ && ix == 0))
    consider((ix * grid_.width_x() - body.x) / body.vx, Own::left);
  else if (body.vx > 0 && !(kHas.box && upright_ && ix == last_column_))
    consider(((ix + 1) * grid_.width_x() - body.x) / body.vx, Own::right);

  const double above = std::max((iy + 1) * grid_.width_y() - body.y, 0.0);
  const double below = std::max(body.y - iy * grid_.width_y(), 0.0);
  if constexpr (kHas.box) {
    const double square = body.vy * body.vy - 2 * gravity_ * above;
    if (body.vy > 0 && square >= 0) {
      consider(2 * above / (body.vy + std::sqrt(square)), Own::up);
    } else if (gravity_ > 0 || body.vy < 0) {
      const double root = std::sqrt(body.vy * body.vy + 2 * gravity_ * below);
      consider(
          body.vy > 0 ? (body.vy + root) / gravity_ : 2 * below / std::max(root - body.vy, 1e-300),
          Own::down);
    }
    if (upright_) find_wall_event(i, now, earliest, own);
  } else {  // √(v²) is |v| to the last bit
    if (body.vy > 0)
      consider(above / body.vy, Own::up);
    else if (body.vy < 0)
      consider(below / -body.vy, Own::down);
  }
  body.plan.own_kind = static_cast<std::uint32_t>(own);
  return earliest;
}

template <PlanarFeatures kHas>
BodyChange PlanarWorld::do_own_event(std::uint32_t i, double now) {
  Body& body = moved_to<kHas>(i, now);
  const auto cross = [&](int step, std::uint32_t cell, std::uint32_t cells, double& coordinate,
                         double period, std::int32_t Matter::*image) {
    if (step < 0 ? cell > 0 : cell + 1 < cells) return;
    matter_[i].*image += step;
    coordinate -= step * period;
  };
  const auto cross_x = [&](int step) {
    cross(step, grid_.x_of(i), grid_.cells_x(), body.x, grid_.period().x, &Matter::image_x);
    grid_.move(i, moved_x_ = step, moved_y_ = 0);
    return BodyChange::cell;
  };
  const auto cross_y = [&](int step) {
    cross(step, grid_.y_of(i), grid_.cells_y(), body.y, grid_.period().y, &Matter::image_y);
    grid_.move(i, moved_x_ = 0, moved_y_ = step);
    return BodyChange::cell;
  };
  switch (own(i)) {
    case Own::left:
      return cross_x(-1);
    case Own::right:
      return cross_x(+1);
    case Own::down:
      return cross_y(-1);
    case Own::up:
      return cross_y(+1);
    case Own::none:
      return BodyChange::nothing;
    default:
      break;
  }
  if constexpr (kHas.box) return meet_wall(i, now);
  return BodyChange::nothing;
}

template <PlanarFeatures kHas>
double PlanarWorld::collision_time(std::uint32_t i, std::uint32_t j, double now,
                                   const CellGrid::Shift& shift) const {
  const Body &a = bodies_[i], &b = bodies_[j];
  const double dt = now - b.time;
  const double dx = a.x - (b.x + shift.x + b.vx * dt);
  double dy, dvy;
  if constexpr (kHas.box) {
    // Both fall alike, so that they approach each other on straight lines.
    dy = a.y - (b.y + shift.y + (b.vy - 0.5 * gravity_ * dt) * dt);
    dvy = a.vy - (b.vy - gravity_ * dt);
  } else {
    dy = a.y - (b.y + shift.y + b.vy * dt);
    dvy = a.vy - b.vy;
  }
  const double dvx = a.vx - b.vx;
  const double approach = dx * dvx + dy * dvy;
  double contact_square = contact_square_;
  if constexpr (kHas.radii) {
    const double contact = radii_[i] + radii_[j];
    contact_square = contact * contact;
  }
  const double gap = dx * dx + dy * dy - contact_square;
  const double square = approach * approach - (dvx * dvx + dvy * dvy) * gap;
  // Who approaches whom is a coin toss: no branches here. Those that overlap touch now.
  static constexpr double kOf[] = {kNever, 0};
  const bool touches = (approach < 0) & ((gap <= 0) | (square >= 0));
  return now + std::max(gap, 0.0) / (std::sqrt(std::max(square, 0.0)) - approach) + kOf[touches];
}

template <PlanarFeatures kHas>
EventPlan PlanarWorld::first_collision(std::uint32_t i, double now, double before,
                                       Neighbourhood neighbours) {
  if (neighbours == Neighbourhood::all)
    grid_.find_near(i, around_);
  else
    grid_.find_newly_near(i, moved_x_, moved_y_, around_);
  EventPlan first{.collision = before};
  if (around_.count == 0) return first;
  moved_to<kHas>(i, now);
  for (const auto& [j, cell] : around_.bodies()) {
    const double t = collision_time<kHas>(i, j, now, around_.shift[cell]);
    if (t < std::min(first.collision, bodies_[j].plan.collision)) {
      first.collision = t;
      first.partner = j;
    }
  }
  return first;
}

template <PlanarFeatures kHas>
double PlanarWorld::exchange_impulse(std::uint32_t i, std::uint32_t j, const PairContact& contact) {
  Body &a = bodies_[i], &b = bodies_[j];
  Matter &of_a = matter_[i], &of_b = matter_[j];
  const CellGrid::Shift shift = nearest_image(a, b);
  const double dx = a.x - (b.x + shift.x), dy = a.y - (b.y + shift.y);
  const double per_distance = 1 / std::sqrt(dx * dx + dy * dy);
  const double n_x = dx * per_distance, n_y = dy * per_distance;
  const double dvx = a.vx - b.vx, dvy = a.vy - b.vy;
  const double u_n = dvx * n_x + dvy * n_y;
  if (u_n >= 0) return 0;  // rounding
  const Sphere first{radius_of<kHas>(i), of_a.mass, of_a.shape_factor};
  const Sphere second{radius_of<kHas>(j), of_b.mass, of_b.shape_factor};
  double u_t = 0, kappa = 0;
  if constexpr (kHas.spin) {
    u_t = dvy * n_x - dvx * n_y - first.radius * of_a.spin - second.radius * of_b.spin;
    kappa = tangential_mass_ratio(first, second);
  }
  const double slowest = least_.rebound_of(of_a.hardest_impact, of_b.hardest_impact);
  of_a.hardest_impact = std::max(of_a.hardest_impact, -u_n);
  of_b.hardest_impact = std::max(of_b.hardest_impact, -u_n);
  double e = restitution_at(contact.restitution, -u_n);
  const double judged = kHas.box && upright_ ? -u_n : e * -u_n;
  const bool is_slow = !has_elastic_rule() && judged < slowest;
  if (is_slow) e = slowest / -u_n;
  PlanarImpulse impulse =
      planar_impulse(contact, e, effective_mass(first, second), kappa, u_n, u_t);
  // That n is a unit vector but for rounding must not add up over many collisions.
  impulse.normal *= 2 - (n_x * n_x + n_y * n_y);
  if (is_slow) ++collapses_;
  PlanarVelocity v{a.vx, a.vy, of_a.spin}, w{b.vx, b.vy, of_b.spin};
  apply(impulse, n_x, n_y, first.radius, of_a.mass, of_a.shape_factor, v);
  apply(impulse, -n_x, -n_y, second.radius, of_b.mass, of_b.shape_factor, w);
  const double change_x = of_a.mass * (v.x - a.vx) + of_b.mass * (w.x - b.vx);
  const double change_y = of_a.mass * (v.y - a.vy) + of_b.mass * (w.y - b.vy);
  const double size = std::max({of_a.mass * std::sqrt(a.vx * a.vx + a.vy * a.vy),
                                of_b.mass * std::sqrt(b.vx * b.vx + b.vy * b.vy), impulse.normal});
  momentum_error_ =
      std::max(momentum_error_, std::max(std::abs(change_x), std::abs(change_y)) / size);
  a.vx = v.x, a.vy = v.y;
  b.vx = w.x, b.vy = w.y;
  if constexpr (kHas.spin) of_a.spin = v.spin, of_b.spin = w.spin;
  dissipated_ += impulse.dissipated;
  ++collisions_;
  if (sink_) note_touch(i, j, impulse);
  return -u_n;
}

template <PlanarFeatures kHas>
std::span<const std::uint32_t> PlanarWorld::collide(std::uint32_t i, std::uint32_t j, double now) {
  moved_to<kHas>(i, now);
  moved_to<kHas>(j, now);
  changed_.assign({i, j});
  const bool is_quick = is_in_quick_succession(i, now) || is_in_quick_succession(j, now);
  const bool is_cluster = is_quick && !has_elastic_rule();
  if (is_quick) ++collapses_;
  if (sink_) show_changed(now, !is_cluster);
  exchange_impulse<kHas>(i, j, is_quick && has_elastic_rule() ? kElastic : between(i, j));
  if (is_cluster) resolve_cluster(now);
  for (std::uint32_t k : changed_) matter_[k].last_collision = now;
  if (sink_) show_changed(now, true);
  return changed_;
}

}  // namespace slipcheck
