#pragma once

#include <algorithm>
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
    for (const Touch& touch : before_) add(touch);
    for (const Touch& touch : long_before_) add(touch);
    long_before_ = std::move(before_);
    before_ = frame.touches;
    next_.take(time, shown_);
  }

  void exchange(StateArchive& archive) { archive(before_, long_before_); }

 private:
  void add(const Touch& touch) {
    if (touch.second != kSubstrate && std::ranges::none_of(shown_.touches, [&](const Touch& there) {
          return there.first == touch.first && there.second == touch.second;
        }))
      shown_.touches.push_back(touch);
  }

  FrameSink& next_;
  Frame shown_;
  std::vector<Touch> before_, long_before_;
};

}  // namespace slipcheck
