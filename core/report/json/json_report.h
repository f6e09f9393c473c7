#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/json_node.h"
#include "harness/compare/record.h"

namespace slipcheck {

/// The result file of one scene, "slipcheck-result/1" (docs/result-file.md). All values are SI and
/// read back as the same double; the same record gives the same text.
nlohmann::ordered_json json_of(const SceneRecord& scene);

/// Of one scene its result, of several a "slipcheck-results/1" with a list of them.
nlohmann::ordered_json json_of(const std::vector<SceneRecord>& scenes);

/// The record of one scene from its "slipcheck-result/1", such that json_of() gives the same again.
/// What the file leaves out is missing: motion, and by phase what has neither tolerance nor
/// expectation; of a series that was thinned out each sample stands for those that followed it.
/// Profiles are not needed: their settings are in the file. Throws BadJson.
SceneRecord read_result(const JsonNode& result);

}  // namespace slipcheck
