#pragma once

#include <span>

#include "physics/frame.h"

namespace slipcheck {

/// Looks at the runs of an engine's ensemble, one after the other, beside the observer.
class PhaseWatch {
 public:
  virtual ~PhaseWatch() = default;

  /// The next run begins, with these states at `time` [s].
  virtual void begin(double time, std::span<const BodyState> states) = 0;
  /// The end of a step, or an instant inside it (Frame::part), at `time` [s]. Comes before the
  /// frame is judged: a frame that makes the run unstable is seen too.
  virtual void take(double time, const Frame& frame) = 0;
  /// Whether the run is to go on although the scene's own end has been reached.
  virtual bool wants_more() const { return false; }
};

}  // namespace slipcheck
