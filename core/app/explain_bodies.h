#pragma once

#include "scenario/hard_scene.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// Prints a row for each body, or for several in a row that look alike: size, inertia, speed, and
/// on a substrate the slip on it.
void explain_bodies(const Scenario& scenario, const HardScene& scene);

}  // namespace slipcheck
