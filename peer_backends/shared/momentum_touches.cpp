#include "peer_backends/shared/momentum_touches.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace slipcheck {
namespace {

struct Candidate {
  int first, second;
  Vector3 normal;         // from the second to the first
  bool overlaps = false;  // two bodies do before or after
};

/// Gap [m] that counts as touching: resting bodies hover by rounding.
constexpr double kNear = 1e-6;  // of the radius

/// The surfaces that a body overlaps before or after, or would in free flight.
void add_surfaces(std::vector<Candidate>& found, const Scene& scene, std::size_t body,
                  const BodyState& before, const BodyState& after, double time_step, double time) {
  const double radius = scene.bodies[body].radius, reach = (1 + kNear) * radius;
  const Vector3 flown = before.position + time_step * before.velocity +
                        0.5 * time_step * time_step * scene.gravity_vector();
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    const Surface& surface = scene.surfaces[k];
    const NearestPoint first = surface.nearest(time, before.position),
                       last = surface.nearest(time + time_step, after.position),
                       free = surface.nearest(time + time_step, flown);
    if (std::min({first.distance, last.distance, free.distance}) < reach)
      found.push_back({static_cast<int>(body), surface_touch(k),
                       (first.normal + last.normal).stableNormalized()});
  }
}

std::vector<Candidate> candidates(const Scene& scene, std::span<const BodyState> before,
                                  std::span<const BodyState> after, double time_step, double time) {
  std::vector<Candidate> found;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double radius = scene.bodies[i].radius, margin = kNear * radius;
    const BodyState& old = before[i];
    const double fall = 0.5 * scene.gravity * time_step * time_step;
    const double lowest = std::min({old.position.z(), after[i].position.z(),
                                    old.position.z() + time_step * old.velocity.z() - fall});
    if (!scene.box && scene.has_substrate && lowest < radius + margin)
      found.push_back({static_cast<int>(i), kSubstrate, Vector3::UnitZ()});
    add_surfaces(found, scene, i, old, after[i], time_step, time);
    for (std::size_t j = i + 1; j < scene.bodies.size(); ++j) {
      const double reach = radius + scene.bodies[j].radius;
      const Vector3 apart = scene.to_nearest_image(old.position - before[j].position);
      const Vector3 rate = old.velocity - before[j].velocity;
      const Vector3 now = scene.to_nearest_image(after[i].position - after[j].position);
      // The closest approach of the free flight within the step.
      const double square = rate.squaredNorm();
      const double when = square > 0 ? std::clamp(-apart.dot(rate) / square, 0.0, time_step) : 0.0;
      const double nearest = std::min((apart + when * rate).norm(), now.norm());
      if (nearest < reach + margin)
        found.push_back({static_cast<int>(i), static_cast<int>(j), (apart + now).stableNormalized(),
                         std::min(apart.norm(), now.norm()) < reach});
    }
  }
  return found;
}

}  // namespace

std::vector<Touch> momentum_touches(const Scene& scene, std::span<const BodyState> before,
                                    std::span<const BodyState> after, double time_step, double time,
                                    OverlapPushes overlaps) {
  const std::vector<Candidate> found = candidates(scene, before, after, time_step, time);
  if (found.empty()) return {};
  const auto bodies = static_cast<Eigen::Index>(scene.bodies.size());
  const auto count = static_cast<Eigen::Index>(found.size());
  Eigen::MatrixXd lines = Eigen::MatrixXd::Zero(3 * bodies, count);
  Eigen::VectorXd momenta(3 * bodies);
  const Vector3 gravity(scene.downhill.x(), scene.downhill.y(), -scene.gravity);
  double largest = 0;
  for (Eigen::Index i = 0; i < bodies; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vector3 gained =
        scene.bodies[k].mass * (after[k].velocity - before[k].velocity - time_step * gravity);
    momenta.segment<3>(3 * i) = gained;
    largest = std::max(largest, gained.norm());
  }
  for (Eigen::Index c = 0; c < count; ++c) {
    const Candidate& each = found[static_cast<std::size_t>(c)];
    lines.block<3, 1>(3 * each.first, c) = each.normal;
    if (each.second >= 0) lines.block<3, 1>(3 * each.second, c) = -each.normal;
  }
  const Eigen::VectorXd impulses = lines.completeOrthogonalDecomposition().solve(momenta);
  std::vector<Touch> touches;
  for (Eigen::Index c = 0; c < count; ++c) {
    const Candidate& each = found[static_cast<std::size_t>(c)];
    const bool pushes = overlaps == OverlapPushes::yes && each.overlaps;
    if (impulses[c] > 1e-9 * largest || pushes)
      touches.push_back(
          {each.first, each.second, std::max(impulses[c], std::numeric_limits<double>::min())});
  }
  return touches;
}

bool in_impact(const Scene& scene, std::span<const BodyState> states, double length, double time) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double radius = scene.bodies[i].radius;
    if (scene.has_substrate && states[i].position.z() < radius &&
        std::abs(states[i].velocity.z()) > 10 * scene.gravity * length)
      return true;
    for (const Surface& surface : scene.surfaces) {
      const NearestPoint nearest = surface.nearest(time, states[i].position);
      const Vector3 slip = states[i].velocity - surface.motion.velocity(time, nearest.point);
      if (nearest.distance < radius &&
          std::abs(nearest.normal.dot(slip)) > 10 * scene.gravity_vector().norm() * length)
        return true;
    }
  }
  return false;
}

}  // namespace slipcheck
