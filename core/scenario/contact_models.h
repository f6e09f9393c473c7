#pragma once

#include "physics/contact/contact_memory.h"
#include "physics/contact/elastic_pair.h"
#include "physics/contact/linear_contact.h"
#include "physics/contact/normal_force.h"
#include "physics/contact/tangential_force.h"
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

/// Mindlin's contact between spheres of that effective radius [m], of materials with elastic
/// constants; its damping is a ratio to the normal one.
SpringFriction mindlin_friction(const MindlinTangential& model, const ElasticMaterial& first,
                                const ElasticMaterial& second, double effective_radius);

/// The contact between two materials, in whichever order the file names them, or null.
const BodyContact* find_contact(const Scenario& scenario, const std::string& first,
                                const std::string& second);

/// Whether the contact's forces or restitution depend on the bodies' radius, mass or shape.
bool depends_on_bodies(const BodyContact& contact);

}  // namespace slipcheck
