#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "physics/frame.h"
#include "scene/scene.h"

namespace slipcheck {

/// The world as seen from the substrate, which so is at rest: what engines get that have no surface
/// that moves along itself. With constant velocity nothing else changes; where it is accelerated,
/// all bodies are so the other way.
class MovingFrame {
 public:
  /// What an engine can do to all bodies: nothing, or give them an acceleration that changes
  /// smoothly.
  enum class Takes { uniform, accelerated };

  MovingFrame() = default;
  /// Throws Refused, in the name of `engine`, for a substrate that moves otherwise.
  MovingFrame(const Scene& scene, const std::string& engine, Takes takes = Takes::uniform)
      : motion_(scene.motion) {
    using Kind = SubstrateMotion::Kind;
    if (motion_.kind() == Kind::oscillation && takes == Takes::uniform)
      throw Refused(engine + ": a substrate that moves at other than constant velocity");
    if (motion_.kind() == Kind::table)
      throw Refused(engine + ": a substrate that moves by a table, whose velocity jumps");
  }

  /// States at the start, at `time` [s], as seen from the substrate.
  std::vector<BodyState> enter(std::span<const BodyState> states, double time) {
    start_ = time;
    const Vector3 velocity = motion_.velocity(time);
    std::vector<BodyState> seen(states.begin(), states.end());
    for (BodyState& state : seen) state.velocity -= velocity;
    return seen;
  }
  /// Back to the scene's frame, `since` [s] after the start.
  void leave(std::vector<BodyState>& states, double since) const {
    if (motion_.is_still()) return;
    const Vector3 velocity = motion_.velocity(start_ + since), way = way_in(since);
    for (BodyState& state : states) {
      state.velocity += velocity;
      state.position += way;
    }
  }

 private:
  /// Of the substrate since the start [m].
  Vector3 way_in(double since) const {
    if (motion_.kind() == SubstrateMotion::Kind::constant) return since * motion_.velocity(0);
    return motion_.position(start_ + since) - motion_.position(start_);
  }

  SubstrateMotion motion_;
  double start_ = 0;  ///< [s]
};

}  // namespace slipcheck
