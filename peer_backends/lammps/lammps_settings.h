#pragma once

#include <vector>

#include "engine/setting_rows.h"

namespace slipcheck::lammps {

/// What two spheres exchange.
enum class PairStyle {
  law,            ///< the scene's law, in whichever of LAMMPS's styles has exactly that
  hooke_history,  ///< gran/hooke/history: a tangential spring beside the damping
  hertz_history,  ///< gran/hertz/history
};

/// How the coefficients of hard contacts become those of springs.
enum class Coefficients {
  pair,    ///< exactly, from restitution and contact time
  fields,  ///< as they are typed: e for LAMMPS's damping `tsuji`, rolling friction as it stands
};

/// What takes a slip away below Coulomb's cap in hard contacts and on the substrate.
enum class StickingBy {
  scene,    ///< springs where contacts of the scene remember, else damping
  damping,  ///< nothing holds: what lies on a slope creeps
  spring,   ///< it remembers the slip, and holds
};

/// Everything that a profile can choose. LAMMPS has no values of its own for the coefficients of a
/// contact; those here are customary. Meaning, unit and range stand once, in setting_rows().
struct LammpsSettings {
  PairStyle pair_style = PairStyle::law;
  Coefficients coefficients = Coefficients::pair;
  StickingBy sticking_by = StickingBy::scene;
  double collision_time = 1e-4;  // [s]
  int steps_per_collision = 50, substeps = 0, frames = 1;
  double sticking = 10, lowest_restitution = 0.01;
  double skin = 0.3;
  int ranks = 1;
};

const std::vector<SettingRow<LammpsSettings>>& setting_rows();

}  // namespace slipcheck::lammps
