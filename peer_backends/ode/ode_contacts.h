#pragma once

#include <ode/ode.h>

#include "peer_backends/ode/ode_settings.h"
#include "peer_backends/shared/contact_values.h"
#include "peer_backends/shared/surfaces.h"

namespace slipcheck::ode {

/// A body of a contact.
struct Ball {
  int index;
  BodyState state;
  bool hit;  ///< by another body in this step, so that it will slip whether it does so far or not
};

/// What it touches: another body, or a surface with its velocity.
struct Partner {
  int index;
  BodyState state;
};

/// What a contact joint is told. Its rows (ODE, ode/src/joints/contact.cpp) are
///   normal    v_n' = max(erp ξ/dt, e |v_n|) of overlap ξ, the second where |v_n| > bounce_vel;
///   friction  v_t' = motion, |impulse| <= μ λ_n along each of two directions;
///   rolling   Ω' = 0 about these and the normal, |impulse| <= ρ λ_n about each.
/// With λ_n the impulse of the normal row where the mode has dContactApprox1.
class ContactRules {
 public:
  /// Steps of `time_step` [s] of ODE's own. The scene has to outlive this.
  ContactRules(const Scene& scene, const OdeSettings& settings, double time_step);

  /// The numbers of a contact of bodies that move in this way.
  peer::ContactValues values(int body, int other, const peer::ContactMotion& motion) const;

  /// Fills surface and fdir1 of a contact of `ball`, which geom.normal points to.
  void fill(dContact& contact, const Ball& ball, const Partner& partner) const;

 private:
  void direct(dContact& contact, int other, const Vector3& slip, const Vector3& motion,
              const Vector3& surface) const;

  const Scene& scene_;
  OdeSettings settings_;
  double time_step_;
};

}  // namespace slipcheck::ode
