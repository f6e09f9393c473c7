#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/frame.h"
#include "scene/scene.h"

namespace slipcheck {

// The same scene in ways that change nothing but what rules decide.

/// The bodies the other way round: so come the collisions of one instant.
void reverse_bodies(Scene& scene);

/// Shows `sink`, which must outlive this, the frames of a scene with reversed bodies as those of
/// the scene itself.
class ReverseSink final : public FrameSink {
 public:
  explicit ReverseSink(FrameSink& sink) : sink_(sink) {}
  void take(double time, const Frame& frame) override;
  bool take_partial(double time, const PartialFrame& frame) override;

 private:
  void reverse_touches(std::span<const Touch> touches);

  FrameSink& sink_;
  Frame frame_;
  std::vector<std::size_t> bodies_;  ///< of a partial frame
  std::size_t count_ = 0;            ///< of all bodies, as of the last whole frame
};

/// What a rule for collapse with a contact time is held against: the other one of the two, with the
/// same time. The least rebound has no other, only another size.
CollapseRule other_rule(CollapseRule rule);

}  // namespace slipcheck
