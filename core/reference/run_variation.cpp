#include "reference/run_variation.h"

#include <algorithm>
#include <utility>

namespace slipcheck {

void reverse_bodies(Scene& scene) {
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

CollapseRule other_rule(CollapseRule rule) {
  using Model = CollapseRule::Model;
  if (rule.model == Model::contact_time)
    rule.model = Model::largest_velocity;
  else if (rule.model == Model::largest_velocity)
    rule.model = Model::contact_time;
  return rule;
}

}  // namespace slipcheck
