#pragma once

#include <string>

#include "explain/explain_rows.h"
#include "scenario/scenario.h"
#include "scene/contact_scene.h"

namespace slipcheck {

struct Explanation {
  std::string solver;  ///< its name and why it: "event (every contact is hard; ...)"
  ExplainSections sections;
};

/// What the scene needs, what its solver leaves out and what is expected; runs nothing. `general`:
/// of the loop that leaves out nothing. Throws Unsupported.
Explanation explain_scene(const Scenario& scenario, const ContactScene& scene, bool general);

}  // namespace slipcheck
