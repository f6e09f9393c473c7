#pragma once

#include <vector>

#include "engine/engine.h"

namespace slipcheck::dart_engine {

/// How a scene's coefficients get into DART's shapes.
enum class CoefficientMap {
  fields,  ///< one shape for each body, with the scene's numbers, combined by DART's own rules
  pair,    ///< a shape for each kind of partner, which together have the pair's numbers
};

enum class Detector {
  fcl,   ///< what a World comes with: spheres as meshes
  dart,  ///< DARTCollisionDetector: spheres and boxes in closed form
};

enum class LcpSolver { dantzig, pgs };

/// Everything that a profile can choose; the values here are DART's own. Meaning, unit and range
/// stand once, in setting_table(). Lengths are DART's, which differ from SI where the profile says
/// so.
struct DartSettings {
  CoefficientMap coefficients = CoefficientMap::pair;
  Detector collision_detector = Detector::fcl;
  LcpSolver lcp_solver = LcpSolver::dantzig;
  double error_reduction_parameter = 0.01, max_error_reduction_velocity = 1e-3, error_allowance = 0,
         constraint_force_mixing = 1e-5;
  double length_unit = 1;
  int substeps = 1;
};

/// What this engine takes.
const std::vector<SettingInfo>& setting_table();

/// `chosen` names only settings of the table, with values of their types and in their ranges.
DartSettings read_settings(const Settings& chosen);

/// All of them, by name.
Settings write_settings(const DartSettings& settings);

}  // namespace slipcheck::dart_engine
