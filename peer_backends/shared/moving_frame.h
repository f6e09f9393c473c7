#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "physics/frame.h"
#include "scene/scene.h"

namespace slipcheck {

/// A substrate at rest or of constant velocity is the same to bodies that are seen from it: so
/// engines get the scene that have no surface that moves along itself.
class MovingFrame {
 public:
  MovingFrame() = default;
  /// Throws Refused, in the name of `engine`, for a substrate that moves otherwise.
  MovingFrame(const Scene& scene, const std::string& engine) : velocity_(scene.motion.velocity(0)) {
    const auto kind = scene.motion.kind();
    if (kind != SubstrateMotion::Kind::still && kind != SubstrateMotion::Kind::constant)
      throw Refused(engine + ": a substrate that moves at other than constant velocity");
  }

  /// States at the start, as seen from the substrate.
  std::vector<BodyState> enter(std::span<const BodyState> states) const {
    std::vector<BodyState> seen(states.begin(), states.end());
    for (BodyState& state : seen) state.velocity -= velocity_;
    return seen;
  }
  /// Back to the scene's frame, `time` [s] after the start.
  void leave(std::vector<BodyState>& states, double time) const {
    if (velocity_.isZero(0)) return;
    for (BodyState& state : states) {
      state.velocity += velocity_;
      state.position += time * velocity_;
    }
  }

 private:
  Vector3 velocity_ = Vector3::Zero();
};

}  // namespace slipcheck
