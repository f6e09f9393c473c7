#include "reference/run_variation.h"

#include <algorithm>
#include <utility>

#include "reference/event_solver.h"

namespace slipcheck {

void reverse_bodies(HardScene& scene) {
  std::ranges::reverse(scene.bodies);
  std::ranges::reverse(scene.initial);
  std::ranges::reverse(scene.material);
}

void ReverseSink::take(double time, const Frame& frame) {
  const auto last = static_cast<int>(frame.bodies.size()) - 1;
  frame_.bodies.assign(frame.bodies.rbegin(), frame.bodies.rend());
  frame_.touches = frame.touches;
  for (Touch& touch : frame_.touches) {
    touch.first = last - touch.first;
    if (touch.second == kSubstrate) continue;
    touch.second = last - touch.second;
    std::swap(touch.first, touch.second);
  }
  sink_.take(time, frame_);
}

/// A pair that friction with the substrate presses together flies about 2w/g at the least rebound
/// w: the contact time that does as little.
CollapseRule other_rule(const HardScene& scene) {
  using Model = CollapseRule::Model;
  if (scene.collapse.model != Model::slowest_rebound) return {};
  const double w = EventSettings{}.collapse_fraction * speed_scale(scene, scene.initial);
  return {Model::contact_time, scene.gravity > 0 ? 2 * w / scene.gravity : 0};
}

}  // namespace slipcheck
