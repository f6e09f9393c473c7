#pragma once

#include "scenario/scenario.h"

namespace slipcheck {

/// When a run ends.
struct RunEnd {
  Run::Until until = Run::Until::rolling;
  double time = 0;   ///< [s], for Until::time
  double limit = 0;  ///< [s]: the run has failed if it comes to this first

  /// No run goes on beyond this [s]: nothing later needs to be looked for.
  double last() const { return until == Run::Until::time ? time : limit; }
};

}  // namespace slipcheck
