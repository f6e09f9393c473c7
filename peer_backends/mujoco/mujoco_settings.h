#pragma once

#include <vector>

#include "engine/engine.h"

namespace slipcheck::mujoco {

/// How a scene's coefficients get into MuJoCo's contact pairs.
enum class CoefficientMap {
  fields,  ///< as they stand, μ_r in the place of the length
  pair,    ///< exact maps
};

/// What a coefficient of restitution becomes.
enum class RestitutionMap {
  none,    ///< nothing: MuJoCo has no such number, and all contacts have the profile's solref
  spring,  ///< a solref of its own for each pair: stiffness and damping that give this rebound
};

enum class Cone { pyramidal, elliptic };
enum class Solver { pgs, cg, newton };
enum class Integrator { euler, rk4, implicit };

/// Everything that a profile can choose; the values here are MuJoCo's own. Meaning, unit and range
/// stand once, in setting_table().
struct MujocoSettings {
  CoefficientMap coefficients = CoefficientMap::pair;
  RestitutionMap restitution = RestitutionMap::none;
  double contact_steps = 16;
  int condim = 0;
  Cone cone = Cone::pyramidal;
  double impratio = 1;
  Solver solver = Solver::newton;
  int iterations = 100, noslip_iterations = 0;
  double tolerance = 1e-8;
  Integrator integrator = Integrator::euler;
  double solref_timeconst = 0.02, solref_dampratio = 1;
  double solimp_dmin = 0.9, solimp_dmax = 0.95, solimp_width = 0.001;
  double margin = 0;
  int substeps = 1;
};

/// What this engine takes.
const std::vector<SettingInfo>& setting_table();

/// `chosen` names only settings of the table, with values of their types and in their ranges.
MujocoSettings read_settings(const Settings& chosen);

/// All of them, by name.
Settings write_settings(const MujocoSettings& settings);

}  // namespace slipcheck::mujoco
