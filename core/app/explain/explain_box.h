#pragma once

#include "scenario/scenario.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// Prints what follows from the numbers of a scene in a box: its floor's speed and acceleration,
/// the bed of bodies at rest, L's estimate of K/R, when it is looked at. Runs nothing.
void explain_box(const Scenario& scenario, const ContactScene& scene);

}  // namespace slipcheck
