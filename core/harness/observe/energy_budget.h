#pragma once

#include "harness/observe/assembly_observer.h"

namespace slipcheck {

/// What becomes of the energies of bodies, of gravity and between them over a run.
struct EnergyBudget {
  double first = 0, last = 0;  ///< their sum at the first and last sample [J]
  /// From the lowest sum so far to a later one, the largest [J], >= 0: of bodies that nothing does
  /// work on, an error, or what is in springs on a substrate and on surfaces, which is not seen.
  double rise = 0;
  double scale = 0;  ///< the largest kinetic and elastic energy, and how far gravity's varies [J]
};

EnergyBudget energy_budget(const Assembly& assembly);

/// Nothing does work on the bodies but gravity: what they touch is at rest.
bool is_left_alone(const Scene& scene);

}  // namespace slipcheck
