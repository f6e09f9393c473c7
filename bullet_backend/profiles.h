#pragma once

#include <string>
#include <vector>

#include "scenario/hard_scene.h"

namespace slipcheck::bullet {

enum class Profile {
  default_,  ///< Bullet's own settings, the scene's coefficients through the exact maps
  naive,     ///< the scene's coefficients straight in the bodies' fields, combined by Bullet
};

/// Names of the profiles, sorted.
std::vector<std::string> profile_names();

/// Throws Refused with the names that there are.
Profile parse_profile(const std::string& name);

/// What of the scene Bullet does not do under this profile with steps of `time_step` [s], in words
/// for the report.
std::vector<std::string> not_represented(const HardScene& scene, Profile profile, double time_step);

}  // namespace slipcheck::bullet
