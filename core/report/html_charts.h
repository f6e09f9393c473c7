#pragma once

#include <string>
#include <vector>

#include "harness/record.h"

namespace slipcheck {

/// A scene's strip charts: of those observables that have a tolerance, effective restitution first,
/// then what is worst; what looks the same is drawn once. Below each what it shows in words. Empty
/// where there is nothing to draw.
std::string html_charts(const SceneRecord& scene, const std::vector<std::string>& names);

}  // namespace slipcheck
