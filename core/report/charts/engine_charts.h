#pragma once

#include <optional>
#include <set>
#include <string>

#include "report/charts/chart.h"
#include "report/rows/engine_matrix.h"

namespace slipcheck {

/// "engines": error against run time of all engines in one picture: over the scenes of the matrix
/// the median of the worst phase's error, beside the CPU time of a simulated second; an engine in
/// one version under one profile is a line through its rates. None without two methods.
/// `taken` as in file_stem.h.
std::optional<Chart> engine_chart(const EngineMatrix& matrix, std::set<std::string>& taken);

}  // namespace slipcheck
