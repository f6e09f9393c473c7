#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reference/steps/grain_kernels.h"
#include "scene/contact_scene.h"

namespace slipcheck {

// What GrainSolver makes of a scene.

/// Why it does not take the scene, or nothing.
std::string grain_refusal(const ContactScene& scene, std::span<const BodyState> initial);

/// What the scene needs of the loop.
GrainFeatures grain_features(const ContactScene& scene, std::span<const BodyState> initial);

/// The loop for the scene, which outlives it; appends the kind of each body. slowest_rebound: of a
/// landing [m/s].
GrainKernels grain_kernels(const ContactScene& scene, std::span<const BodyState> initial,
                           double slowest_rebound, std::vector<std::uint32_t>& kind);

}  // namespace slipcheck
