#pragma once

#include "physics/sphere.h"
#include "reference/pair/pair_collision.h"
#include "scene/contact_scene.h"

namespace slipcheck::test {

/// One collision of two free spheres as collide_batch() describes it. CVODE integrates between the
/// contact's changes (Coulomb's cap, breaking asperities, F_N at its largest), which are found as
/// roots.
///
/// normal_speed g_N, tangential_speed g_T [m/s], > 0. tolerance: relative, in [1e-13, 1e-3]. Where
/// F_N attracts, a passive asperity does not act. A contact so damped that the spheres stay has the
/// restitution 0 and an infinite duration. Throws IntegrationFailure.
PairCollision collide_freely(const SoftContact& contact, const Sphere& first, const Sphere& second,
                             double normal_speed, double tangential_speed,
                             double tolerance = 1e-12);

}  // namespace slipcheck::test
