#include "reference/overlaps.h"

#include <variant>

namespace slipcheck {

std::vector<NearSphere> near_spheres(const Scene& scene, std::span<const BodyState> states) {
  std::vector<NearSphere> spheres;
  spheres.reserve(states.size());
  for (std::size_t i = 0; i < states.size(); ++i)
    spheres.push_back({states[i].position, scene.bodies[i].radius});
  return spheres;
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
