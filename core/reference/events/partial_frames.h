#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "physics/frame.h"

namespace slipcheck {

/// Shows of many bodies those alone that an event changes, with those that they met last: what both
/// become is looked at when the later one has become it.
class PartialFrames {
 public:
  explicit PartialFrames(std::size_t bodies) : partner_(bodies) {
    std::iota(partner_.begin(), partner_.end(), 0);
  }

  void note_collision(std::uint32_t i, std::uint32_t j) {
    partner_[i] = j;
    partner_[j] = i;
  }

  /// state_of(i): its state now; add_touch(i): adds that something carries it, if it does, to
  /// `touches`, in which are those of the event. False: the sink wants all bodies, and `touches`
  /// are as before.
  template <class StateOf, class AddTouch>
  bool show(FrameSink& sink, std::span<const std::uint32_t> changed, double now,
            std::vector<Touch>& touches, const StateOf& state_of, const AddTouch& add_touch) {
    shown_.assign(changed.begin(), changed.end());
    for (const std::uint32_t i : changed)
      if (std::ranges::find(shown_, partner_[i]) == shown_.end()) shown_.push_back(partner_[i]);
    states_.clear();
    const std::size_t of_event = touches.size();
    for (const std::size_t i : shown_) {
      const auto body = static_cast<std::uint32_t>(i);
      states_.push_back(state_of(body));
      add_touch(body);
    }
    is_last_partial_ = sink.take_partial(
        now, {shown_, states_, touches,
              [&state_of](std::size_t i) { return state_of(static_cast<std::uint32_t>(i)); }});
    touches.resize(is_last_partial_ ? 0 : of_event);
    return is_last_partial_;
  }
  void note_whole() { is_last_partial_ = false; }
  bool is_last_partial() const { return is_last_partial_; }

 private:
  std::vector<std::uint32_t> partner_;  ///< of each body's last collision, or itself
  std::vector<std::size_t> shown_;
  std::vector<BodyState> states_;
  bool is_last_partial_ = false;
};

}  // namespace slipcheck
