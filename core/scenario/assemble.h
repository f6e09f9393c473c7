#pragma once

#include "scenario/reading.h"
#include "scenario/written_scene.h"

namespace slipcheck {

/// Checks the rules that span several keys and resolves what is written into the numbers of a
/// scene. Notes every fault; the result means something only where there is none.
Scenario assemble(const WrittenScene& written, Reading& reading);

/// Velocity of the substrate at time 0 [m/s].
Vector2 initial_velocity(const Motion& motion);

}  // namespace slipcheck
