#pragma once

#include <string>

#include "engine/engine.h"
#include "report/json/json_node.h"
#include "report/rows/context.h"
#include "scenario/scenario.h"

namespace slipcheck {

// What results of all kinds have in common. All throw BadResults.

/// The scene of an object with its `text`, `file` and `sha256`.
Scenario read_scenario(const JsonNode& scene);

/// Settings by name, of a member that json_number.h's settings_json() wrote.
Settings read_settings(const JsonNode& node, const std::string& key);

RunStatus read_status(const JsonNode& run);

/// `slipcheck` and `machine`; without a date.
Context read_context(const JsonNode& file);

}  // namespace slipcheck
