#pragma once

#include "physics/elastic_pair.h"
#include "physics/linear_contact.h"
#include "physics/normal_force.h"
#include "physics/tangential_force.h"
#include "scenario/scenario.h"

namespace slipcheck {

// From the models of a scenario to the forces of core/physics, as far as no integrator is needed.

inline ContactEnd contact_end(EndsAt ends_at) {
  return ends_at == EndsAt::zero_overlap ? ContactEnd::zero_overlap : ContactEnd::zero_force;
}

/// K (2) from any two of its parameters, by the end rule's own relations. reduced_mass [kg], > 0.
LinearContact linear_contact(const LinearNormal& model, double reduced_mass);

/// Young modulus and Poisson ratio, which the material must have, and its dissipation time, 0 where
/// it has none.
ElasticMaterial elastic_material(const Material& material);

/// The asperities of B (35), (37) between spheres of that effective radius [m].
AsperityForce asperity_force(const AsperityTangential& model, double effective_radius);

}  // namespace slipcheck
