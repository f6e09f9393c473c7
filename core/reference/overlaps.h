#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reference/near_pairs.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// Two bodies that overlap and have a soft contact.
struct Overlap {
  std::uint32_t first, second;  ///< bodies, first < second
  const SoftContact& contact;
  double depth;     ///< ξ [m], > 0
  double distance;  ///< of the centres [m]
  Vector3 apart;    ///< from the second's centre, its image that is nearest, to the first's [m]
};

/// Of all bodies in these states; neither is copied.
NearSpheres near_spheres(const Scene& scene, std::span<const BodyState> states);

/// All of them, in order.
template <class Visit>
void for_each_overlap(const ContactScene& scene, std::span<const BodyState> states, Visit visit) {
  const Scene& hard = scene.hard;
  for (const auto& [i, j] : near_pairs(near_spheres(hard, states), 0, hard.periodic)) {
    const Vector3 apart = hard.to_nearest_image(states[i].position - states[j].position);
    const double distance = apart.norm();
    const double depth = hard.bodies[i].radius + hard.bodies[j].radius - distance;
    if (!(depth > 0)) continue;
    std::optional<SoftContact> own;
    if (scene.own) own = scene.contact_of(i, j);
    const std::optional<SoftContact>& contact = scene.own ? own : scene.between(i, j);
    if (contact) visit(Overlap{i, j, *contact, depth, distance, apart});
  }
}

/// What the normal springs between bodies hold [J]; that of bent asperities is no part of it.
double elastic_energy(const ContactScene& scene, std::span<const BodyState> states);

}  // namespace slipcheck
