#pragma once

#include "physics/frame.h"
#include "scenario/hard_scene.h"

namespace slipcheck {

// The same scene in ways that change nothing but what rules decide.

/// The bodies the other way round: so come the collisions of one instant.
void reverse_bodies(HardScene& scene);

/// Shows `sink`, which must outlive this, the frames of a scene with reversed bodies as those of
/// the scene itself.
class ReverseSink final : public FrameSink {
 public:
  explicit ReverseSink(FrameSink& sink) : sink_(sink) {}
  void take(double time, const Frame& frame) override;

 private:
  FrameSink& sink_;
  Frame frame_;
};

/// What the scene's rule for collapse is held against: the TC model in place of the least rebound,
/// and the other way round.
CollapseRule other_rule(const HardScene& scene);

}  // namespace slipcheck
