#include "bullet_backend/next_contact.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>

#include "bullet_backend/convert.h"

namespace slipcheck::bullet {

NextContact::NextContact(const Balls& balls, const Surfaces& surfaces, const Scene& scene,
                         const WorldUnits& units, const PeriodicCell& cell, double tolerance)
    : balls_(balls),
      surfaces_(surfaces),
      scene_(scene),
      gravity_(units.turn * Vector3(scene.downhill.x(), scene.downhill.y(), -scene.gravity)),
      tolerance_(tolerance),
      states_(balls.count()),
      cell_(cell),
      near_(cell) {}

/// |Δx + Δv t| = reach: with b = Δx·Δv < 0 the first root c/(−b + √(b² − Δv² c)), c = Δx² − reach².
/// Bullet sees two spheres touch only where they overlap, and so they are to overlap by half the
/// tolerance.
double NextContact::of_balls(const BodyState& a, const BodyState& b, double reach,
                             double within) const {
  const Vector3 apart = a.position - b.position;
  const Vector3 line = apart - cell_.shift(apart), velocity = a.velocity - b.velocity;
  const double rate = line.dot(velocity);
  if (rate >= 0) return within;
  const double distance = line.norm();
  const double gap = distance - reach;
  if (gap > within * velocity.norm()) return within;
  if (gap <= 0) return touches_now(-rate / distance, within) ? 0 : within;
  reach -= tolerance_ / 2;
  const double c = (distance - reach) * (distance + reach);
  const double root = rate * rate - velocity.squaredNorm() * c;
  if (root < 0) return within;
  return std::min(within, c / (-rate + std::sqrt(root)));
}

bool NextContact::touches_now(double approach, double within) const {
  return approach * within > 1e-3 * tolerance_;
}

double NextContact::after(double now, double within) {
  for (std::size_t i = 0; i < states_.size(); ++i) states_[i] = balls_.state(i);
  within = of_surfaces(now, within);
  for (const auto& surface : surfaces_.beside())
    for (std::size_t i = 0; i < states_.size(); ++i) within = of_surface(*surface, i, now, within);
  return of_pairs(within);
}

/// Steps as long as nothing can touch, until the gap is as good as closed. Of a sphere it is to be
/// an overlap, as between balls.
double NextContact::of_surface(const SurfaceBody& surface, std::size_t body, double now,
                               double within) const {
  constexpr int kMostLooks = 100;
  const BodyState& ball = states_[body];
  const auto nearest_after = [&](double t) {
    return surface.nearest(now + t, ball.position + t * (ball.velocity + t * gravity_));
  };
  const double radius = scene_.bodies[body].radius;
  const NearestPoint near = nearest_after(0);
  if (near.distance - radius <= tolerance_) {
    const double approach = near.normal.dot(surface.velocity(now, near.point) - ball.velocity);
    return touches_now(approach, within) ? 0 : within;
  }
  const double reach = surface.is_ball() ? radius - tolerance_ / 2 : radius;
  const double fastest = ball.velocity.norm() + 2 * within * gravity_.norm() +
                         surface.largest_speed(ball.position) +
                         within * surface.turning_rate() * ball.velocity.norm();
  double t = 0;
  for (int look = 0; look < kMostLooks && t < within; ++look) {
    const double gap = nearest_after(t).distance - reach;
    if (gap <= tolerance_ / 4) return t;
    t += gap / fastest;
  }
  return std::min(t, within);
}

double NextContact::of_surfaces(double now, double within) const {
  for (const btRigidBody* surface : surfaces_.planes()) {
    const auto* plane = static_cast<const btStaticPlaneShape*>(surface->getCollisionShape());
    const Vector3 n = from_bullet(plane->getPlaneNormal());
    const Vector3 moved = surfaces_.displacement(*surface, now);
    const double offset = double(plane->getPlaneConstant()) + n.dot(moved);
    const double rate = n.dot(surfaces_.velocity(*surface, now));
    // Of tangent and chord the one that is ahead of the surface.
    const double chord = n.dot(surfaces_.displacement(*surface, now + within) - moved) / within;
    const double ahead = std::max(rate, chord);
    const double pull = -gravity_.dot(n);
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const double gap = n.dot(states_[i].position) - offset - scene_.bodies[i].radius;
      const double ball = n.dot(states_[i].velocity);
      if (gap <= tolerance_) {
        if (touches_now(rate - ball, within)) return 0;
        continue;
      }
      const double v = ball - ahead;
      // gap + (v − g t) t = 0
      const double root = v * v + 4 * pull * gap;
      if (root < 0) continue;
      const double towards = -v + std::sqrt(root);
      if (towards > 0) within = std::min(within, 2 * gap / towards);
    }
  }
  return within;
}

/// Only those pairs whose ways along an axis overlap.
double NextContact::of_pairs(double within) {
  near_.clear();
  for (std::size_t i = 0; i < states_.size(); ++i)
    near_.add(states_[i].position, within * states_[i].velocity, scene_.bodies[i].radius);
  near_.for_each([&](std::size_t i, std::size_t j) {
    within = std::min(within, of_balls(states_[i], states_[j],
                                       scene_.bodies[i].radius + scene_.bodies[j].radius, within));
  });
  return within;
}

}  // namespace slipcheck::bullet
