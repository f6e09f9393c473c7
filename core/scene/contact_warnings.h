#pragma once

#include <string>
#include <vector>

#include "scene/contact_maker.h"
#include "scene/scene_outline.h"

namespace slipcheck {

/// Where the law of this contact leaves the range in which it holds, one text for each reason: B
/// (11), (12) by the speeds at which bodies and floor start, and the printed asperities that can
/// create energy.
std::vector<std::string> contact_warnings(const Scenario& scenario, const SceneOutline& outline,
                                          const ContactMaker& maker);

}  // namespace slipcheck
