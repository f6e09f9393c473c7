#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/compare/record.h"

namespace slipcheck {

/// The result file of one scene, "slipcheck-result/1" (docs/result-file.md). All values are SI and
/// read back as the same double; the same record gives the same text.
nlohmann::ordered_json json_of(const SceneRecord& scene);

/// Of one scene its result, of several a "slipcheck-results/1" with a list of them.
nlohmann::ordered_json json_of(const std::vector<SceneRecord>& scenes);

}  // namespace slipcheck
