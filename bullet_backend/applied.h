#pragma once

#include "bullet_backend/bullet_settings.h"
#include "bullet_backend/world_units.h"
#include "engine/engine.h"

class btDiscreteDynamicsWorld;

namespace slipcheck::bullet {

/// The settings in force, of which Bullet's own are read back from it, in its units. Where these
/// are not SI, length_unit [m], time_unit [s] and mass_unit [kg] are among them.
/// Bullet is asked for every contact's coefficients. Where they differ from ball to ball the name
/// carries the body, "rolling_friction[3]", where they differ from pair to pair two bodies that
/// stand for their materials, "restitution[0-2]"; those with a box carry one body of the
/// material, "floor_friction[0]". One that follows a law is the text "by speed",
/// one that depends on whether the contact slips "by slip".
/// `scene` and `time_step` are in the world's units.
Settings applied_settings(btDiscreteDynamicsWorld& world, const Scene& scene,
                          const BulletSettings& settings, const WorldUnits& units,
                          double time_step);

}  // namespace slipcheck::bullet
