#include "reference/run_variation.h"

#include <algorithm>
#include <utility>

namespace slipcheck {

void reverse_bodies(Scene& scene) {
  std::ranges::reverse(scene.bodies);
  std::ranges::reverse(scene.initial);
  std::ranges::reverse(scene.material);
}

void ReverseSink::reverse_touches(std::span<const Touch> touches) {
  const auto last = static_cast<int>(count_) - 1;
  frame_.touches.assign(touches.begin(), touches.end());
  for (Touch& touch : frame_.touches) {
    touch.first = last - touch.first;
    if (!is_body(touch.second)) continue;
    touch.second = last - touch.second;
    std::swap(touch.first, touch.second);
  }
}

void ReverseSink::take(double time, const Frame& frame) {
  count_ = frame.bodies.size();
  frame_.bodies.assign(frame.bodies.rbegin(), frame.bodies.rend());
  reverse_touches(frame.touches);
  sink_.take(time, frame_);
}

bool ReverseSink::take_partial(double time, const PartialFrame& frame) {
  bodies_.clear();
  for (const std::size_t i : frame.bodies) bodies_.push_back(count_ - 1 - i);
  reverse_touches(frame.touches);
  const auto state_of = [this, &frame](std::size_t i) { return frame.state_of(count_ - 1 - i); };
  return sink_.take_partial(time, {bodies_, frame.states, frame_.touches, state_of});
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
