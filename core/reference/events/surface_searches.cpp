#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/numbers.h"
#include "physics/safe_root.h"
#include "reference/events/path_collision.h"
#include "reference/events/surface_world.h"

// What comes next for a body of SurfaceWorld, alone and with another.

namespace slipcheck {

double SurfaceWorld::path_end(std::uint32_t i, double now) {
  std::optional<double>& end = bodies_[i].path_end;
  if (!end) end = find_path_end(i, now);
  return *end;
}

double SurfaceWorld::find_path_end(std::uint32_t i, double now) {
  Body& body = bodies_[i];
  body.next = Own::phase;
  body.hit = kNone;
  double first = body.end;
  const auto horizon = [&] { return first - now; };
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (k == body.support) continue;
    const double t = now + first_hit(i, k, now, horizon());
    if (!(t < first)) continue;
    first = t;
    body.next = Own::hit;
    body.hit = k;
  }
  if (body.support != kNone && places_[body.support].half.x() > 0) {
    const double t = now + first_edge(i, now, horizon());
    if (t < first) {
      first = t;
      body.next = Own::edge;
    }
  }
  return first;
}

/// In what time [s] the body comes to a surface, or infinity where not within `horizon`. Steps that
/// pass no contact: the distance to what is convex bends towards zero by no more than the relative
/// acceleration, and that to a plane along a parabola by its part across.
double SurfaceWorld::first_hit(std::uint32_t i, std::size_t k, double now, double horizon) const {
  constexpr int kMostSteps = 10'000;
  const Body& body = bodies_[i];
  const SurfacePlace& place = places_[k];
  const double least = 8 * kEpsilon * scene_->bodies[i].radius;
  double bound = body.bound + place.bend;
  const auto* plane = std::get_if<PlaneShape>(&place.surface.shape);
  if (plane && body.is_parabola && place.bend == 0)
    bound = std::max(0.0, -plane->normal.dot(body.acceleration));
  double t = 0;
  for (int n = 0; n < kMostSteps && t <= horizon; ++n) {
    const SurfacePlace::Beside at =
        place.beside(scene_->bodies[i].radius, on_path(i, now + t), now + t);
    if (at.gap <= touching(i) && std::abs(at.opening) <= slowest_) {
      // It goes along the surface.
      if (!body.is_parabola || place.bend > 0 || k == body.left) {
        t += bound > 0 ? std::sqrt(2e-6 * scene_->bodies[i].radius / bound) : kNever;
        continue;
      }
      const double push = at.near.normal.dot(body.acceleration);
      return push < -1e-9 * std::max(body.bound, scene_->gravity_vector().norm()) ? t : kNever;
    }
    if (at.gap <= least && at.opening < 0) return t;
    const double step = step_to_bound(std::max(at.gap, least), at.opening, bound);
    if (step == kNever) return kNever;
    if (t + step == t) return at.opening < 0 ? t : kNever;
    t += step;
  }
  return t <= horizon ? t : kNever;
}

/// In what time [s] the body's centre passes an edge of the plate that carries it.
double SurfaceWorld::first_edge(std::uint32_t i, double now, double horizon) const {
  const SurfacePlace& place = places_[bodies_[i].support];
  double first = kNever;
  for (int axis = 0; axis < 2; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vector3 outward = side * place.axes.col(axis);
      const double beyond = place.half[axis] + 1e-3 * touching(i);
      const auto left = [&](double t, double& slope) {
        const PathPoint at = on_path(i, now + t);
        slope = -outward.dot(at.velocity);
        return beyond - outward.dot(at.position - place.origin);
      };
      double slope = 0;
      if (left(0, slope) <= 0 && slope >= 0) continue;  // it comes back
      const double t = first_zero(left, bodies_[i].bound, std::min(horizon, first));
      first = std::min(first, t);
    }
  return first;
}

double SurfaceWorld::collision_time(std::uint32_t i, std::uint32_t j, double now,
                                    const CellGrid::Shift&) const {
  const Body &a = bodies_[i], &b = bodies_[j];
  const auto is_at_rest = [&](std::uint32_t k) {
    return bodies_[k].support != kNone && phases_[k].is_at_rest() && bodies_[k].velocity.isZero(0);
  };
  if (is_at_rest(i) && is_at_rest(j)) return kNever;
  const double end = std::min(a.end, b.end);
  const double horizon = end - now + 4 * kEpsilon * (std::isfinite(end) ? end : 0);
  const double contact = scene_->bodies[i].radius + scene_->bodies[j].radius;
  if (a.is_parabola && b.is_parabola) {
    const PathPoint at_a = on_path(i, now), at_b = on_path(j, now);
    return now + time_to_touch(at_a.position - at_b.position, at_a.velocity - at_b.velocity,
                               a.acceleration - b.acceleration, contact, horizon);
  }
  const auto apart = [&](double t) {
    const PathPoint at_a = on_path(i, now + t), at_b = on_path(j, now + t);
    return std::pair<Vector3, Vector3>(at_a.position - at_b.position,
                                       at_a.velocity - at_b.velocity);
  };
  return now + stepping_time_to_touch(apart, a.bound + b.bound, contact, horizon);
}

}  // namespace slipcheck
