#pragma once

#include "scenario/scenario.h"
#include "scene/scene.h"

namespace slipcheck {

/// Prints a row for each body, or for several in a row that look alike: size, inertia, speed, and
/// on a substrate the slip on it.
void explain_bodies(const Scenario& scenario, const Scene& scene);

}  // namespace slipcheck
