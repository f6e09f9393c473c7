#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/html/html_engines.h"

namespace slipcheck {

/// An engine's run of a scene, the k-th: its verdict with the worst error, and behind it all
/// observables of `names`, what is expected, warnings and settings that are not shared. Open where
/// something is wrong.
std::string html_run(const SceneRecord& scene, std::size_t k, const std::vector<std::string>& names,
                     const SharedSettings& shared);

}  // namespace slipcheck
