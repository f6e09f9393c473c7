#pragma once

#include <vector>

#include "engine/setting_rows.h"
#include "peer_backends/siconos/system.h"

namespace slipcheck::siconos {

/// How rolling friction gets into NewtonImpactRollingFrictionNSL.
enum class Coefficients {
  pair,    ///< by the exact map: (1 + I/(m R²)) μ_r R
  fields,  ///< as it is typed
};

/// Everything that a profile can choose; the values here are Siconos's own. Meaning, unit and range
/// stand once, in setting_rows().
struct SiconosSettings {
  Coefficients coefficients = Coefficients::pair;
  double theta = 0.5;
  Solver solver = Solver::nsgs;
  double tolerance = 1e-4;
  int iterations = 1000;
  double newton_tolerance = 1e-6;
  double activation_threshold = 0;  // [m]
  int substeps = 1;
};

const std::vector<SettingRow<SiconosSettings>>& setting_rows();

}  // namespace slipcheck::siconos
