#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "physics/frame.h"

namespace slipcheck {

/// All bodies at one instant of a run that is kept for people to look at.
struct MotionFrame {
  double time = 0;                      ///< [s], on the scene's clock
  Vector3 substrate = Vector3::Zero();  ///< displacement of the substrate since time 0 [m]
  std::vector<BodyState> bodies;        ///< in the laboratory
  std::vector<std::pair<int, int>>
      touches;  ///< since the frame before: bodies, or kSubstrate second
};

/// A run of the reference, or one of an engine's ensemble, thinned out.
struct RecordedMotion {
  std::string role;       ///< "reference"; of an ensemble "nearest", "median" or "worst"
  std::size_t phase = 0;  ///< of the ensemble, from 0
  /// Largest deviation of an observable in its tolerance [-]; NaN where nothing has one.
  double error = std::numeric_limits<double>::quiet_NaN();
  std::vector<MotionFrame> frames;  ///< times rise; the first is where the run began
  std::size_t heading = 0;          ///< of the phase's headings, from 0
};

}  // namespace slipcheck
