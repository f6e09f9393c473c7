#pragma once

#include "engine/engine_scene.h"
#include "peer_backends/simbody/simbody_settings.h"
#include "peer_backends/simbody/system.h"

namespace slipcheck::simbody {

/// c [s/m] for which f = k x^(3/2) (1 + (3/2) c ẋ) rebounds with e, in (0, 1], at the impact speed
/// v [m/s]. With λ = (3/2) c the motion m v dv = −f dx separates, ∫ v dv/(1 + λ v) is the same
/// inwards and outwards, and a = λ v solves a − ln(1 + a) = −e a − ln(1 − e a).
double dissipation_for(double restitution, double speed);

/// E* of two equal surfaces for F_N = ρ ξ^(3/2), ρ [N/m^1.5], with the relative radius [m]. Two
/// equal ones are as soft as 2^(−3/2) of one in f = (4/3) √R (s E^(2/3))^(3/2) ξ^(3/2), s = 1/2.
double modulus_for(double rho, double relative_radius);

/// Two bodies, or a body and the substrate. Throws Refused for a soft contact of another law.
HuntCrossley pair_contact(const EngineScene& scene, std::size_t i, std::size_t j,
                          const SimbodySettings& settings);
HuntCrossley substrate_contact(const Scene& scene, std::size_t body,
                               const SimbodySettings& settings);
/// With surface k beside the substrate.
HuntCrossley surface_contact(const Scene& scene, std::size_t body, std::size_t k,
                             const SimbodySettings& settings);

}  // namespace slipcheck::simbody
