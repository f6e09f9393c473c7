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
/// the engine accelerates all bodies the other way.
class MovingFrame {
 public:
  MovingFrame() = default;
  /// Throws Refused, in the name of `engine`, for a substrate that jumps.
  MovingFrame(const Scene& scene, const std::string& engine) : motion_(scene.motion) {
    if (motion_.kind() == SubstrateMotion::Kind::table)
      throw Refused(engine + ": a substrate that moves by a table, whose velocity jumps");
  }

  bool is_accelerated() const { return motion_.kind() == SubstrateMotion::Kind::oscillation; }
  /// Of the substrate, `since` [s] after the start [m/s²].
  Vector3 acceleration(double since) const { return motion_.acceleration(start_ + since); }

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
