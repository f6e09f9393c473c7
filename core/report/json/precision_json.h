#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "studies/precision/precision.h"

namespace slipcheck {

/// Error against run time as "slipcheck-precision/1" (docs/result-file.md). All values are SI.
nlohmann::ordered_json json_of(const std::vector<PrecisionScene>& scenes,
                               const PrecisionGrid& grid);

}  // namespace slipcheck
