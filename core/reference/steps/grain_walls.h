#pragma once

#include <string>
#include <vector>

#include "reference/steps/grain_kernels.h"
#include "scene/scene.h"

namespace slipcheck {

/// The scene's surfaces as GrainSolver takes them: planes upright on the substrate, and plates up
/// to their tops. As many as surfaces where there is no wall_refusal().
std::vector<GrainWall> grain_walls(const Scene& scene);

/// Why some are no walls to it, or nothing: they are askew, move, do not reach down to the plane,
/// stand between bodies or so that one could come around or over them; or the plane is tilted,
/// moves or repeats itself across them.
std::string wall_refusal(const Scene& scene);

}  // namespace slipcheck
