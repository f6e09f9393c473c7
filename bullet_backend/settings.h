#pragma once

#include <map>
#include <string>

#include "bullet_backend/profiles.h"
#include "engine/engine.h"

class btDiscreteDynamicsWorld;

namespace slipcheck::bullet {

/// The settings in force, read back from Bullet; SI. `time_step` as Bullet rounds it [s].
/// Bullet is asked for every contact's coefficients. Where they differ from ball to ball the name
/// carries the body, "rolling_friction[3]", where they differ from pair to pair two bodies that
/// stand for their materials, "restitution[0-2]"; those with a box carry one body of the
/// material, "floor_friction[0]". One that follows a law is the text "by speed".
std::map<std::string, Setting> read_settings(btDiscreteDynamicsWorld& world, const HardScene& scene,
                                             Profile profile, double time_step);

}  // namespace slipcheck::bullet
