#pragma once

#include <map>
#include <string>
#include <vector>

#include "scenario/hard_scene.h"

namespace slipcheck {

/// What Kondic's corrected closed forms (closed_forms.h) say of a scene, by observable name, or
/// nothing where they do not apply. They apply to one body that slides, rolls or spins on the
/// plane, and to two of one radius that roll without friction until they collide once, centrally or
/// obliquely, without rubbing.
std::map<std::string, double> closed_form_values(const HardScene& scene,
                                                 const std::vector<std::string>& body_names);

}  // namespace slipcheck
