#include "reference/overlaps.h"

#include <variant>

namespace slipcheck {

NearSpheres near_spheres(const Scene& scene, std::span<const BodyState> states) {
  return {states.size(), [&scene, states](std::size_t i) {
            return NearSphere{states[i].position, scene.bodies[i].radius};
          }};
}

double elastic_energy(const ContactScene& scene, std::span<const BodyState> states) {
  if (scene.is_hard()) return 0;
  double energy = 0;
  for_each_overlap(scene, states, [&](const Overlap& each) {
    energy +=
        std::visit([&](const auto& law) { return law.energy(each.depth); }, each.contact.normal);
  });
  return energy;
}

}  // namespace slipcheck
