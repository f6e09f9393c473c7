#pragma once

#include <nlohmann/json.hpp>

#include "report/rows/version_rows.h"

namespace slipcheck {

/// What changed between two versions of an engine as "slipcheck-versions/1" (docs/result-file.md),
/// with the values of every phase of what has moved. All values are SI.
nlohmann::ordered_json json_of(const VersionComparison& comparison,
                               const std::vector<VersionChange>& changes);

}  // namespace slipcheck
