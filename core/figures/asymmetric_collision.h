#pragma once

#include <array>
#include <string>
#include <vector>

#include "figures/steel_pair.h"

namespace slipcheck {

/// Sphere i comes from behind with v_i, j rolls in front of it with a share of v_i, both ways:
/// what the spin exchange by the vertical rubbing F_R does, over v_j/v_i.
struct AsymmetricCollisions {
  static constexpr double kFirstSpeed = 0.1;  ///< v_i [m/s]

  /// After the collision by one way to reckon the spin exchange, by sphere; each over v_j/v_i.
  using Course = std::array<std::vector<AfterCollision>, 2>;

  std::vector<double> ratio;          ///< v_j/v_i [-], from −1 (symmetric) to below 1
  Course without_rubbing;             ///< C = 0
  Course first_order;                 ///< ΔΩ = −C (Ω_i + Ω_j), as in K's figures
  Course exponential;                 ///< −½ (1 − e^(−2C)) of it
  Course capped;                      ///< with Coulomb's cap at both ends of the contact
  Course capped_free;                 ///< the same with the faster sphere free to lift off
  std::vector<ReferenceResult> held;  ///< integrated, on the plane as in K Sec. II-IV
  std::vector<ReferenceResult> free;  ///< integrated, free to leave it (App. F)
  double constant = 0;                ///< C, K (55) [-]
  double share = 0;                   ///< ½ (1 − e^(−2C)) [-]
};

/// Computed when first asked for.
const AsymmetricCollisions& asymmetric_collisions();

}  // namespace slipcheck
