#include "studies/stability/body_passage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace slipcheck {
namespace {

/// Nearest distance from the origin to the straight way from `a` on by `step`.
double nearest_on_way(const Vector3& a, const Vector3& step) {
  const double length2 = step.squaredNorm();
  const double s = length2 > 0 ? std::clamp(-a.dot(step) / length2, 0.0, 1.0) : 0.0;
  const Vector3 nearest = a + s * step;
  return nearest.norm();
}

}  // namespace

BodyPassage::BodyPassage(const ReferencePath& path) : path_(&path) {
  // Wide enough that pairs need not be looked for often, narrow enough that few are near.
  for (const Sphere& sphere : path.scene().hard.bodies) skin_ = std::max(skin_, 2 * sphere.radius);
}

void BodyPassage::begin(std::span<const BodyState> states) {
  positions_.clear();
  for (const BodyState& state : states) positions_.push_back(state.position);
  depth_ = 0;
  find_near();
}

void BodyPassage::find_near() {
  const Scene& scene = path_->scene().hard;
  const auto sphere = [&](std::size_t i) {
    return NearSphere{positions_[i], scene.bodies[i].radius};
  };
  near_ = near_pairs({positions_.size(), sphere}, skin_, scene.periodic);
  budget_ = 0.5 * skin_;
}

std::string BodyPassage::take(std::span<const BodyState> states) {
  const Scene& scene = path_->scene().hard;
  const auto& bodies = scene.bodies;
  std::vector<Vector3> moved(states.size());
  double farthest = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    moved[i] = states[i].position - positions_[i];
    farthest = std::max(farthest, moved[i].norm());
  }
  // What moves farther than the skin in one step may meet anything.
  if (farthest > budget_) {
    const double skin = skin_;
    skin_ = std::max(skin_, 2 * farthest);
    find_near();
    skin_ = skin;
  }
  budget_ -= farthest;

  std::string passed;
  for (const auto& [i, j] : near_) {
    const double reach = bodies[i].radius + bodies[j].radius;
    const double smaller = std::min(bodies[i].radius, bodies[j].radius);
    const Vector3 apart = scene.to_nearest_image(positions_[j] - positions_[i]);
    const Vector3 step = moved[j] - moved[i];
    const double beyond = reach - nearest_on_way(apart, step) -
                          path_->overlap(static_cast<int>(i), static_cast<int>(j));
    depth_ = std::max(depth_, beyond / smaller);
    if (beyond > smaller && passed.empty())
      passed = fmt::format("bodies {} and {} come {:.3g} smaller radii deep into each other", i, j,
                           beyond / smaller);
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    positions_[i] = states[i].position;
    const double z = states[i].position.z();
    depth_ = std::max(depth_, 1 - z / bodies[i].radius);
    if (z < 0 && passed.empty())
      passed =
          fmt::format("body {} is with its centre {:.3g} m below the substrate's surface", i, -z);
  }
  return passed;
}

}  // namespace slipcheck
