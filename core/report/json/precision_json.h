#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "base/json_node.h"
#include "studies/precision/precision.h"

namespace slipcheck {

/// Error against run time as "slipcheck-precision/1" (docs/result-file.md). All values are SI.
nlohmann::ordered_json json_of(const std::vector<PrecisionScene>& scenes,
                               const PrecisionGrid& grid);

/// The scenes of such a file, such that json_of() gives the same again. Of their reference only the
/// solver's name is known. Throws BadJson.
std::vector<PrecisionScene> read_precision(const JsonNode& file);

}  // namespace slipcheck
