#pragma once

#include "../scenes.h"
#include "physics/contact/linear_contact.h"
#include "scene/contact_scene.h"

namespace slipcheck::test {

/// The scene's pairs in K's linear contact, with the restitution of the scene's first pair.
inline ContactScene soft(Scene hard, double collision_time = 2.55e-5,
                         ContactEnd end = ContactEnd::zero_overlap,
                         const TangentialForce& tangential = NoTangentialForce{}) {
  ContactScene scene = with_hard_contacts(std::move(hard));
  const double reduced = scene.hard.bodies[0].mass / 2;
  const double e = std::get<double>(scene.hard.pairs[0].restitution);
  const LinearContact law = LinearContact::with_collision_time(
      reduced, e, collision_time,
      end == ContactEnd::zero_overlap ? LinearContact::End::zero_overlap
                                      : LinearContact::End::zero_force);
  scene.soft[0] =
      SoftContact{LinearForce{law.stiffness(), law.damping_rate() * reduced}, end, tangential};
  return scene;
}

/// One steel ball on the substrate.
inline ContactScene one_ball(const BodyState& state) {
  Scene scene = steel_scene(1);
  scene.initial = {state};
  return with_hard_contacts(std::move(scene));
}

}  // namespace slipcheck::test
