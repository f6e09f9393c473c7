#pragma once

#include <vector>

#include "report/json/json_node.h"
#include "studies/precision/precision.h"
#include "studies/stability/limits.h"
#include "studies/stability/stability.h"

namespace slipcheck {

/// The scenes of a "slipcheck-precision/1", such that json_of() gives the same again. Of their
/// reference only the solver's name is known. Throws BadResults.
std::vector<PrecisionScene> read_precision(const JsonNode& file);

/// What a "slipcheck-stability/1" holds.
struct StabilityFile {
  std::vector<StabilityCase> cases;
  LimitResults limits;
  OutcomeCriteria criteria;
};
/// Likewise. Of each run's record what the file does not name is missing. Throws BadResults.
StabilityFile read_stability(const JsonNode& file);

}  // namespace slipcheck
