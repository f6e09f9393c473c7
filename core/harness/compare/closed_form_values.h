#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/observe/observables.h"
#include "scene/scene.h"

namespace slipcheck {

/// What Kondic's corrected closed forms (closed_forms.h) say of a scene; nothing is observed where
/// they do not apply. They apply to one body that slides, rolls or spins on the plane, and to two
/// of one radius that roll without friction until they collide once, centrally or obliquely,
/// without rubbing.
Observables closed_form_observables(const Scene& scene);

/// The same by observable name.
std::map<std::string, double> closed_form_values(const Scene& scene,
                                                 const std::vector<std::string>& body_names);

}  // namespace slipcheck
