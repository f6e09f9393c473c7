#include "reference/steps/grain_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slipcheck {
namespace {

std::vector<GrainKind> kinds_of(const Scene& scene, std::vector<std::uint32_t>& kind) {
  std::vector<GrainKind> kinds;
  std::vector<const Sphere*> spheres;
  kind.reserve(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Sphere& sphere = scene.bodies[i];
    std::size_t k = 0;
    while (k < kinds.size() &&
           !(kinds[k].material == scene.material[i] && spheres[k]->mass == sphere.mass &&
             spheres[k]->shape_factor == sphere.shape_factor))
      ++k;
    if (k == kinds.size()) {
      const SubstrateContact& contact = scene.on_substrate(i);
      spheres.push_back(&sphere);
      kinds.push_back({1 / sphere.mass, 1 / sphere.moment_of_inertia(), sphere.mass * scene.gravity,
                       1 / (1 + sphere.inverse_shape_factor()),
                       sphere.inverse_shape_factor() / sphere.radius, contact.static_friction,
                       contact.kinetic_friction, static_cast<std::uint32_t>(scene.material[i])});
    }
    kind.push_back(static_cast<std::uint32_t>(k));
  }
  return kinds;
}

std::vector<GrainLaw> laws_of(const ContactScene& scene) {
  std::vector<GrainLaw> laws(scene.soft.size());
  for (std::size_t k = 0; k < laws.size(); ++k) {
    if (!scene.soft[k]) continue;
    const SoftContact& contact = *scene.soft[k];
    laws[k].normal = contact.normal;
    laws[k].clamped = contact.end == ContactEnd::zero_force;
    if (const auto* viscous = std::get_if<ViscousForce>(&contact.tangential)) {
      laws[k].damping = viscous->damping;
      laws[k].friction = viscous->friction;
    }
  }
  return laws;
}

bool slides_or_rolls(const Scene& scene) {
  return std::any_of(scene.substrate.begin(), scene.substrate.end(),
                     [](const SubstrateContact& c) { return c.kinetic_friction > 0; });
}

bool rubs(const GrainLaw& law) { return law.damping > 0 && law.friction > 0; }

GrainFeatures features_of(const Scene& scene, const std::vector<GrainLaw>& laws,
                          std::span<const BodyState> initial) {
  GrainFeatures features;
  features.rubs = std::any_of(laws.begin(), laws.end(), rubs);
  const bool spins_level = std::any_of(initial.begin(), initial.end(), [](const BodyState& s) {
    return !s.angular_velocity.head<2>().isZero(0);
  });
  features.driven = !scene.motion.is_still() || !scene.downhill.isZero(0);
  features.on_plane = slides_or_rolls(scene) || (features.rubs && spins_level) || features.driven;
  features.any_normal = std::any_of(laws.begin(), laws.end(), [](const GrainLaw& law) {
    return !std::holds_alternative<LinearForce>(law.normal);
  });
  return features;
}

}  // namespace

GrainKernels grain_kernels(const ContactScene& scene, std::span<const BodyState> initial,
                           std::vector<std::uint32_t>& kind) {
  const Scene& hard = scene.hard;
  std::vector<GrainLaw> laws = laws_of(scene);
  const GrainFeatures features = features_of(hard, laws, initial);
  return {features,
          std::move(laws),
          kinds_of(hard, kind),
          {hard.bodies[0].radius, hard.periodic.x(), hard.periodic.y()}};
}

GrainFeatures grain_features(const ContactScene& scene, std::span<const BodyState> initial) {
  return features_of(scene.hard, laws_of(scene), initial);
}

std::string grain_refusal(const ContactScene& scene, std::span<const BodyState> initial) {
  const Scene& hard = scene.hard;
  if (hard.box) return "the scene is a box";
  if (scene.own) return "each two bodies have a contact of their own";
  for (const SubstrateContact& c : hard.substrate)
    if (!c.rolling.is_zero() || c.drilling_length > 0 || c.coupled_radius > 0)
      return "the substrate has rolling or drilling friction";
  for (std::size_t k = 0; k < scene.soft.size(); ++k) {
    if (!scene.soft[k]) return "not all contacts of bodies are soft";
    if (std::holds_alternative<AsperityForce>(scene.soft[k]->tangential))
      return "bodies have asperities";
  }
  for (std::size_t i = 0; i < hard.bodies.size(); ++i) {
    if (hard.bodies[i].radius != hard.bodies[0].radius) return "bodies differ in radius";
    if (std::abs(initial[i].position.z() - hard.bodies[i].radius) > 1e-12 * hard.bodies[i].radius ||
        initial[i].velocity.z() != 0)
      return "bodies are above the substrate";
  }
  const GrainFeatures features = features_of(hard, laws_of(scene), initial);
  if (!hard.confined && features.rubs && features.on_plane)
    return "bodies that rub can lift each other off the substrate, which is not confined";
  return "";
}

}  // namespace slipcheck
