#pragma once

#include <nlohmann/json.hpp>

#include "base/json_node.h"
#include "harness/compare/record.h"

namespace slipcheck {

/// Whether the reference or any run of a scene has a motion.
bool has_motions(const SceneRecord& scene);

/// The motions of a scene, "slipcheck-motion/1", as they stand in a file beside its result; all
/// numbers but times have nine significant digits.
nlohmann::ordered_json motion_json_of(const SceneRecord& scene);

/// Gives motions back to the scene that they are of, and to its runs: each goes to the first run of
/// the same engine, precision, profile and rate that has none of its role yet. Throws
/// BadJson for what is not such a file or of another scene, and leaves `scene` as it is.
void read_motions(const JsonNode& file, SceneRecord& scene);

}  // namespace slipcheck
