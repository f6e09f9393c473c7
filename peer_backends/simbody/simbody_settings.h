#pragma once

#include <vector>

#include "engine/setting_rows.h"
#include "peer_backends/simbody/system.h"

namespace slipcheck::simbody {

/// Everything that a profile can choose. Simbody has no values of its own for the stiffness of a
/// contact and the speed at which its dissipation is set; the rest is as it ships. Meaning, unit
/// and range stand once, in setting_rows().
struct SimbodySettings {
  IntegratorKind integrator = IntegratorKind::runge_kutta_merson;
  double accuracy = 1e-3;
  bool interpolate = true;
  double transition_velocity = 0.01;  // [m/s]
  double modulus = 1e9;               // [Pa]
  double impact_speed = 0;            // [m/s]
  double lowest_restitution = 0.05;
  bool fields = false;
  int frames = 1;
};

const std::vector<SettingRow<SimbodySettings>>& setting_rows();

}  // namespace slipcheck::simbody
