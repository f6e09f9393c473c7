#include "scenario/contact_models.h"

#include <algorithm>
#include <cmath>

namespace slipcheck {

LinearContact linear_contact(const LinearNormal& model, double reduced_mass) {
  const ContactEnd end = contact_end(model.ends_at);
  if (model.restitution && model.collision_time) {
    return LinearContact::with_collision_time(reduced_mass, *model.restitution,
                                              *model.collision_time, end);
  }
  if (model.restitution)
    return LinearContact::with_stiffness(reduced_mass, *model.restitution, *model.stiffness, end);
  if (model.stiffness) return {reduced_mass, *model.stiffness, *model.damping_rate, end};
  return LinearContact::with_damping_rate(reduced_mass, *model.damping_rate, *model.collision_time,
                                          end);
}

ElasticMaterial elastic_material(const Material& material) {
  return {material.young_modulus.value(), material.poisson_ratio.value(),
          material.dissipation_time.value_or(0)};
}

AsperityForce asperity_force(const AsperityTangential& model, double effective_radius) {
  AsperityForce force;
  force.size =
      model.asperity_size ? *model.asperity_size : *model.relative_asperity_size * effective_radius;
  force.friction =
      model.friction ? *model.friction : *model.roughness_factor * std::sqrt(force.size);
  force.form = model.form == AsperityTangential::Form::printed ? AsperityForce::Form::printed
                                                               : AsperityForce::Form::passive;
  return force;
}

SpringFriction mindlin_friction(const MindlinTangential& model, const ElasticMaterial& first,
                                const ElasticMaterial& second, double effective_radius) {
  SpringFriction made;
  made.form = model.form == MindlinTangential::Form::passive
                  ? SpringFriction::Form::mindlin
                  : SpringFriction::Form::mindlin_displacement;
  made.stiffness = mindlin_modulus(first, second, effective_radius);
  made.damping_ratio = model.damping_ratio;
  made.static_friction = model.friction.static_;
  made.kinetic_friction = model.friction.kinetic;
  return made;
}

bool depends_on_bodies(const BodyContact& contact) {
  const auto* hard = std::get_if<HardNormal>(&contact.normal);
  return !hard || std::holds_alternative<ViscoelasticRestitution>(hard->restitution);
}

const BodyContact* find_contact(const Scenario& scenario, const std::string& first,
                                const std::string& second) {
  const auto found = std::ranges::find_if(scenario.contacts, [&](const BodyContact& contact) {
    return (contact.first == first && contact.second == second) ||
           (contact.first == second && contact.second == first);
  });
  return found == scenario.contacts.end() ? nullptr : &*found;
}

}  // namespace slipcheck
