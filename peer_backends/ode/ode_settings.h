#pragma once

#include <vector>

#include "engine/engine.h"

namespace slipcheck::ode {

/// How a scene's coefficients get into ODE's contact joints.
enum class CoefficientMap {
  fields,         ///< as they stand, μ_r in the place of the length rho
  pair,           ///< exact maps
  pair_and_slip,  ///< likewise, and told apart by whether the contact slips
};

enum class Stepper {
  step,        ///< dWorldStep: Dantzig's method on the whole of the matrix
  quick_step,  ///< dWorldQuickStep: successive over-relaxation, a number of sweeps
};

enum class FrictionDirection {
  axes,    ///< dPlaneSpace of the normal: a pyramid that stands still
  motion,  ///< fdir1 along the slip, or along the motion where nothing slips
};

/// Everything that a profile can choose; the values here are ODE's own. Meaning, unit and range
/// stand once, in setting_table().
struct OdeSettings {
  CoefficientMap coefficients = CoefficientMap::pair;
  bool approx1 = true;
  FrictionDirection friction_direction = FrictionDirection::axes;
  double bounce_vel = 0;

  Stepper stepper = Stepper::step;
  int quick_step_iterations = 20;
  double quick_step_w = 1.3;
  double erp = 0.2, cfm = 1e-10;
  double contact_max_correcting_vel = 1e18, contact_surface_layer = 0;

  bool auto_disable = false;
  double auto_disable_linear_threshold = 0.01, auto_disable_angular_threshold = 0.01,
         auto_disable_time = 0;
  int auto_disable_steps = 10;
  double linear_damping = 0, angular_damping = 0;
  int substeps = 1;
};

/// What this engine takes.
const std::vector<SettingInfo>& setting_table();

/// `chosen` names only settings of the table, with values of their types and in their ranges.
OdeSettings read_settings(const Settings& chosen);

/// All of them, by name.
Settings write_settings(const OdeSettings& settings);

}  // namespace slipcheck::ode
