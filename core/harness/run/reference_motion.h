#pragma once

#include "harness/observe/motion.h"
#include "reference/reference_solver.h"

namespace slipcheck {

/// The reference's run up to `end` [s], >= 0, its own end, for people to look at: at even times and
/// at its events, twice as many frames as of an engine's run at most. Where velocities jump there
/// is a frame 1e-6 of the run before and one after it. Where there are too many events, those with
/// the longest time since the one before.
RecordedMotion reference_motion(const ReferenceSolver& solver, double end);

}  // namespace slipcheck
