#pragma once

#include <vector>

#include "harness/compare/scene_features.h"

namespace slipcheck {

/// Every feature of the reference for a scene in a box, needed or left out.
std::vector<Feature> box_features(const ContactScene& scene);

}  // namespace slipcheck
