#pragma once

#include <optional>
#include <string>

#include "physics/sphere.h"
#include "reference/gas/gas_law.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// What a gas takes from a scene: its first body, and how two of its kind collide.
struct GasOfScene {
  Sphere sphere;
  double speed = 0;     ///< root mean square of the scene's bodies [m/s]
  std::string contact;  ///< path of the contact in the file, "contacts[0]"
  bool soft = false;    ///< forces that last, taken as collisions in an instant
  /// p of 1 − e ~ g^p for e near 1, where the law has one and nothing else takes energy: 0, and 1/5
  /// of the smooth viscoelastic sphere.
  std::optional<double> speed_exponent;
  GasLaw law;
};

/// Hard contacts as they are. Of soft ones without a tangential force e(g), of others B's map
/// (PairMap), for a gas that begins with this speed [m/s], or that of the scene without one. Throws
/// BadScenario where the first body's material has no contact with itself, and Unsupported for
/// forces of which there is no map.
GasOfScene gas_of_scene(const Scenario& scenario, std::optional<double> speed = {});

}  // namespace slipcheck
