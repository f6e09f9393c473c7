#include "harness/observe/motion_recorder.h"

#include <algorithm>
#include <cmath>

#include "harness/observe/motion_quantities.h"
#include "harness/observe/observables.h"

namespace slipcheck {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

void add_pairs(Pairs& to, const Pairs& more) {
  to.insert(to.end(), more.begin(), more.end());
  std::ranges::sort(to);
  to.erase(std::unique(to.begin(), to.end()), to.end());
}

bool is_finite(const BodyState& state) {
  return state.position.allFinite() && state.velocity.allFinite() &&
         state.angular_velocity.allFinite();
}

}  // namespace

std::size_t most_frames(std::size_t bodies) {
  constexpr std::size_t kMostStates = 3000;
  return std::clamp<std::size_t>(kMostStates / std::max<std::size_t>(bodies, 1), 16, 64);
}

// --- one run -------------------------------------------------------------------------------------

bool MotionThinning::begins_collision(const Pairs& touches) const {
  return std::ranges::any_of(touches, [&](const auto& pair) {
    if (std::ranges::binary_search(last_.touches, pair)) return false;
    if (pair.second != kSubstrate) return true;
    const auto i = static_cast<std::size_t>(pair.first);
    return !is_on_substrate(*scene_, i, last_.bodies[i]);
  });
}

bool MotionThinning::shows(std::size_t collision) const {
  return collision > 0 && (collision - 1) % collision_stride_ == 0;
}

void MotionThinning::take(double time, std::span<const BodyState> bodies,
                          std::span<const Touch> touches) {
  if (!std::ranges::all_of(bodies, is_finite)) return;
  Pairs pairs;
  for (const Touch& touch : touches) pairs.emplace_back(touch.first, touch.second);
  std::ranges::sort(pairs);

  const std::size_t number = count_++;
  std::size_t collision = 0;
  if (number > 0) {
    if (begins_collision(pairs)) collision = ++collisions_;
    if (shows(collision)) keep_last(collision);
    if (!last_is_kept_) add_pairs(passed_, last_.touches);
  }
  last_.time = time;
  last_.substrate = scene_->motion.position(time) - scene_->motion.position(0);
  last_.bodies.assign(bodies.begin(), bodies.end());
  last_.touches = std::move(pairs);
  last_number_ = number;
  last_is_kept_ = false;
  if (number % stride_ == 0 || shows(collision)) keep_last(collision);
}

void MotionThinning::keep_last(std::size_t collision) {
  if (last_is_kept_) {
    if (kept_.back().collision == 0) kept_.back().collision = collision;
    return;
  }
  MotionFrame& frame = kept_.emplace_back(Kept{last_, last_number_, collision}).frame;
  add_pairs(frame.touches, passed_);
  passed_.clear();
  last_is_kept_ = true;
  while (kept_.size() >= most_) thin();
}

void MotionThinning::thin() {
  const auto for_collisions =
      std::ranges::count_if(kept_, [&](const Kept& kept) { return kept.number % stride_ != 0; });
  (2 * static_cast<std::size_t>(for_collisions) > most_ ? collision_stride_ : stride_) *= 2;
  std::vector<Kept> wanted;
  Pairs passed;
  for (Kept& kept : kept_) {
    add_pairs(kept.frame.touches, passed);
    passed.clear();
    if (kept.number % stride_ == 0 || shows(kept.collision))
      wanted.push_back(std::move(kept));
    else
      passed = std::move(kept.frame.touches);
  }
  last_is_kept_ = last_is_kept_ && wanted.back().number == last_number_;
  add_pairs(passed_, passed);
  kept_ = std::move(wanted);
}

std::vector<MotionFrame> MotionThinning::finish() {
  std::vector<MotionFrame> frames;
  for (Kept& kept : kept_) frames.push_back(std::move(kept.frame));
  if (count_ > 0 && !last_is_kept_) {
    frames.push_back(std::move(last_));
    add_pairs(frames.back().touches, passed_);
  }
  *this = MotionThinning(*scene_, most_);
  return frames;
}

// --- an ensemble ---------------------------------------------------------------------------------

void MotionRecorder::begin(double time, std::span<const BodyState> states) {
  phases_.emplace_back(*scene_, most_frames(states.size()));
  std::vector<Touch> touches;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (is_on_substrate(*scene_, i, states[i]))
      touches.push_back({static_cast<int>(i), kSubstrate, 1});
  phases_.back().take(time, states, touches);
}

void MotionRecorder::take(double time, const Frame& frame) {
  phases_.back().take(time, frame.bodies, frame.touches);
}

std::vector<RecordedMotion> MotionRecorder::picked(const std::vector<double>& errors) {
  std::vector<RecordedMotion> motions;
  const auto pick = [&](const char* role, std::size_t phase) {
    for (const RecordedMotion& motion : motions)
      if (motion.phase == phase) return;
    motions.push_back(
        {.role = role, .phase = phase, .error = kNotObserved, .frames = phases_[phase].finish()});
    if (phase < errors.size()) motions.back().error = errors[phase];
  };
  std::vector<std::size_t> order;  // of the phases that have an error
  for (std::size_t p = 0; p < std::min(errors.size(), phases_.size()); ++p)
    if (!std::isnan(errors[p])) order.push_back(p);
  if (phases_.empty()) return motions;
  if (order.empty()) {
    pick("median", 0);
  } else {
    std::ranges::stable_sort(order, {}, [&](std::size_t p) { return errors[p]; });
    pick("median", order[(order.size() - 1) / 2]);
    pick("worst", order.back());
    pick("nearest", order.front());
  }
  phases_.clear();
  return motions;
}

std::vector<RecordedMotion> MotionRecorder::last_seen() {
  std::vector<RecordedMotion> motions;
  if (!phases_.empty())
    motions.push_back({.role = "worst",
                       .phase = phases_.size() - 1,
                       .error = kNotObserved,
                       .frames = phases_.back().finish()});
  phases_.clear();
  return motions;
}

}  // namespace slipcheck
