#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/state_archive.h"
#include "physics/frame.h"

namespace slipcheck {

/// Shows an observer the fixed steps as events. StepSolver tells what touches at the end of a step;
/// but a contact that ends inside a step pushes once more, by what it lasted too long, half of it
/// in that step and half in the next. So a contact is shown for two steps more, and its times are
/// known to so much.
class StepsAsEvents final : public FrameSink {
 public:
  explicit StepsAsEvents(FrameSink& next) : next_(next) {}

  void take(double time, const Frame& frame) override {
    shown_ = frame;
    there_.clear();
    std::vector<Touch> now;
    for (const Touch& touch : frame.touches) {
      if (touch.second == kSubstrate) continue;
      now.push_back(touch);
      there_.push_back(bodies_of(touch));
    }
    if (!std::ranges::is_sorted(there_)) std::ranges::sort(there_);
    add(before_);
    add(long_before_);
    long_before_ = std::move(before_);
    before_ = std::move(now);
    next_.take(time, shown_);
  }

  void exchange(StateArchive& archive) { archive(before_, long_before_); }

 private:
  /// In the order in which the frames have them.
  static std::pair<int, int> bodies_of(const Touch& touch) { return {touch.second, touch.first}; }

  /// Those that are not shown yet.
  void add(const std::vector<Touch>& earlier) {
    const auto known = static_cast<std::ptrdiff_t>(there_.size());
    for (const Touch& touch : earlier) {
      if (std::binary_search(there_.begin(), there_.begin() + known, bodies_of(touch))) continue;
      shown_.touches.push_back(touch);
      there_.push_back(bodies_of(touch));
    }
    std::sort(there_.begin() + known, there_.end());
    std::inplace_merge(there_.begin(), there_.begin() + known, there_.end());
  }

  FrameSink& next_;
  Frame shown_;
  std::vector<std::pair<int, int>> there_;   ///< bodies of the contacts that are shown, sorted
  std::vector<Touch> before_, long_before_;  ///< of two bodies, of the last two frames
};

}  // namespace slipcheck
