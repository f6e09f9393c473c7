#pragma once

#include <string>
#include <vector>

#include "harness/observe/motion.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// A motion as extended XYZ, which OVITO and ASE read: for each frame the number of bodies, a line
/// of keys, and a line for each body in the scene's order. All values SI; a periodic plane makes a
/// lattice, whose third vector spans the heights. The species is X, unknown: bodies are no atoms.
std::string xyz_of(const Scenario& scenario, const RecordedMotion& motion);

/// One frame of it; the lattice spans the heights up to `top` [m].
std::string xyz_frame_of(const Scenario& scenario, double time,
                         const std::vector<BodyState>& bodies, const std::string& role, double top);
/// How high these bodies reach [m], >= 0.
double top_of(const Scenario& scenario, const std::vector<BodyState>& bodies);

}  // namespace slipcheck
