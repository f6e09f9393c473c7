#pragma once

#include <string>

#include "scenario/scenario.h"
#include "scenario/yaml_tree.h"

namespace slipcheck {

/// SHA-256 of what a scene's file says, in hex: it is the same after an edit of comments, layout,
/// the order of keys, `title` and `source`, or of how a number is written. Of a scene without a
/// text its own `sha256`.
std::string content_digest(const Scenario& scenario);

/// The same of a scene's tree.
std::string content_digest(const YamlNode& root);

/// What a node says, as JSON: numbers that no quotes hold as numbers, objects in the order of keys.
std::string content_text(const YamlNode& node);

}  // namespace slipcheck
