#pragma once

#include <vector>

#include "bullet_backend/bullet_settings.h"
#include "engine/engine.h"
#include "scene/scene.h"

namespace slipcheck::bullet {

/// What of the scene (SI) Bullet does not do with these settings and steps of `time_step` [s].
std::vector<Lack> not_represented(const Scene& scene, const BulletSettings& settings,
                                  double time_step);

/// The fastest approach of two bodies in a step, over the smaller one's radius [-], by the
/// velocities at the start; 0 for a single body.
double approach_in_a_step(const Scene& scene, double time_step);

}  // namespace slipcheck::bullet
