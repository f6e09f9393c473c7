#pragma once

#include <algorithm>
#include <cmath>

#include "physics/contact/hard_contact.h"

namespace slipcheck {

/// A body that moves in a plane and spins about the plane's normal.
struct PlanarVelocity {
  double x = 0, y = 0;  ///< of the centre [m/s]
  double spin = 0;      ///< counterclockwise [rad/s]
};

/// What a collision in the plane exchanges.
struct PlanarImpulse {
  double normal = 0;      ///< P_n [N s], >= 0
  double tangential = 0;  ///< P_t [N s]
  double dissipated = 0;  ///< energy [J], >= 0
};

/// L (5)-(12) in the plane: the relative velocity u at the contact point has the normal component
/// u_n < 0 [m/s] (approach) and the tangential one u_t [m/s];
///   P_n = −m_eff (1+e) u_n,  P_t = −κ m_eff (1+β0) u_t, capped at μ P_n.
/// m_eff [kg] and κ (tangential_mass_ratio()) as of elastic_pair.h; a wall is infinitely heavy, so
/// that m_eff = m and 1/κ = 1 + 1/q. The cap is L's β = min[β0, β1]. The restitution e is the
/// contact's at this speed, or what a rule for collapse makes of it.
inline PlanarImpulse planar_impulse(const PairContact& contact, double e, double mass, double kappa,
                                    double u_n, double u_t) {
  PlanarImpulse impulse;
  impulse.normal = -mass * (1 + e) * u_n;
  impulse.dissipated = 0.5 * mass * (1 - e) * (1 + e) * u_n * u_n;
  if (u_t == 0) return impulse;
  const double friction = friction_at(contact.friction, std::abs(u_t));
  if (friction == 0) return impulse;
  const double cap = friction * impulse.normal;
  impulse.tangential =
      std::clamp(-kappa * mass * (1 + contact.tangential_restitution) * u_t, -cap, cap);
  impulse.dissipated -= impulse.tangential * (u_t + 0.5 * impulse.tangential / (kappa * mass));
  return impulse;
}

/// The impulse on a body at the contact point −R n, n = (n_x, n_y) towards the body and
/// t = (−n_y, n_x). The contact point moves along t at v·t − R Ω.
inline void apply(const PlanarImpulse& impulse, double n_x, double n_y, double radius, double mass,
                  double shape_factor, PlanarVelocity& v) {
  v.x += (impulse.normal * n_x - impulse.tangential * n_y) / mass;
  v.y += (impulse.normal * n_y + impulse.tangential * n_x) / mass;
  v.spin -= impulse.tangential / (shape_factor * mass * radius);
}

}  // namespace slipcheck
