#pragma once

#include <string>

#include "scenario/scenario.h"

namespace slipcheck {

/// The scene at its start as a figure: balls to scale with their velocities and names and a scale
/// bar, seen from above, or from the side where bodies are off the substrate or in a container. Of
/// more than 500 those in their middle.
std::string scene_drawing(const Scenario& scenario);

}  // namespace slipcheck
