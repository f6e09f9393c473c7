#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "base/json_node.h"
#include "studies/stability/limits.h"
#include "studies/stability/stability.h"

namespace slipcheck {

/// Catalogue, limits and maps as "slipcheck-stability/1" (docs/result-file.md). All values are SI.
nlohmann::ordered_json json_of(const std::vector<StabilityCase>& cases, const StabilityGrid& grid,
                               const LimitResults& limits);

/// What such a file holds.
struct StabilityFile {
  std::vector<StabilityCase> cases;
  LimitResults limits;
  OutcomeCriteria criteria;
};
/// Such that json_of() gives the same again. Of each run's record what the file does not name is
/// missing. Throws BadJson.
StabilityFile read_stability(const JsonNode& file);

}  // namespace slipcheck
