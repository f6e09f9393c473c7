#pragma once

#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/rows/phase_spread.h"

namespace slipcheck {

/// One observable over the phases of all runs as a chart, with what it shows in words.
struct PhaseChart {
  PhaseSpread spread;
  std::string caption;
};

/// Those of a scene's observables that are charted: of what has a tolerance, effective restitution
/// first, then what is worst, at most six; what looks the same is charted once.
std::vector<PhaseChart> phase_charts(const SceneRecord& scene);

}  // namespace slipcheck
