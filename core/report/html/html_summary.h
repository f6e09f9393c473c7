#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/compare/record.h"

namespace slipcheck {

/// The id of a scene's section on the page.
std::string scene_id(std::size_t k);

/// How many scenes came out how, and the worst deviations.
std::string html_summary(const std::vector<SceneRecord>& scenes);

/// The list of all scenes with what is worst of each, and a filter that works without a script.
std::string html_contents(const std::vector<SceneRecord>& scenes);

}  // namespace slipcheck
