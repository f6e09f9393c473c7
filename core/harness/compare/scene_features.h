#pragma once

#include <string>
#include <vector>

#include "scene/contact_scene.h"

namespace slipcheck {

/// What the reference can do, and whether a scene needs it.
struct Feature {
  std::string name;  ///< "rolling friction"
  bool needed = false;
  std::string detail;  ///< why it is needed, or what leaving it out saves
};

/// Every feature of the reference, needed by the scene or left out.
std::vector<Feature> scene_features(const ContactScene& scene);

}  // namespace slipcheck
