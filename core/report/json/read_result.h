#pragma once

#include "harness/compare/record.h"
#include "report/json/json_node.h"

namespace slipcheck {

/// The record of one scene from its "slipcheck-result/1", such that json_of() gives the same again.
/// What the file leaves out is missing: motion, and by phase what has neither tolerance nor
/// expectation; of a series that was thinned out each sample stands for those that followed it.
/// Profiles are not needed: their settings are in the file. Throws BadResults.
SceneRecord read_result(const JsonNode& result);

}  // namespace slipcheck
