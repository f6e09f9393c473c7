#pragma once

#include <vector>

#include "physics/vector.h"
#include "reference/events/huge_pages.h"

namespace slipcheck {

/// A sphere between two steps: positions at the instant, velocities half a step before.
struct alignas(64) PileBody {
  double radius = 0;                           ///< [m]
  Vector3 position = Vector3::Zero();          ///< [m]
  Vector3 velocity = Vector3::Zero();          ///< [m/s]
  Vector3 angular_velocity = Vector3::Zero();  ///< [rad/s]
  Vector3 change = Vector3::Zero();            ///< of the velocity by the last step [m/s]
  Vector3 turn_change = Vector3::Zero();       ///< of the angular velocity [rad/s]
  Vector3 force = Vector3::Zero();             ///< now, without the weight [N]
  Vector3 torque = Vector3::Zero();            ///< now [N m]
  double mass = 0, inertia = 0;                ///< [kg], [kg m²]
  double load = 1;                             ///< of its weight that it has, in [0, 1]
  Vector3 rounded = Vector3::Zero();           ///< of its way, not yet in the position [m]
  Vector3 turned = Vector3::Zero();            ///< ∫Ω dt since the start [rad]
};

/// Asks for a body that is used soon.
inline void prefetch(const PileBody& body) {
  const auto* bytes = reinterpret_cast<const char*>(&body);
  for (std::size_t line = 0; line < sizeof body; line += 64) __builtin_prefetch(bytes + line, 1);
}

using PileBodies = std::vector<PileBody, HugePages<PileBody>>;

/// What the contacts have done since the start.
struct PileLedger {
  double dissipated = 0;  ///< [J]
  double work = 0;        ///< by moving surfaces on bodies [J]
};

}  // namespace slipcheck
