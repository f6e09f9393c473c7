#include "reference/steps/grain_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace slipcheck {
namespace {

std::vector<GrainKind> kinds_of(const Scene& scene, std::vector<std::uint32_t>& kind) {
  std::vector<GrainKind> kinds;
  std::map<std::tuple<std::uint32_t, double, double, double>, std::uint32_t> found;
  kind.reserve(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Sphere& sphere = scene.bodies[i];
    const auto [at, is_new] =
        found.try_emplace({scene.material[i], sphere.mass, sphere.shape_factor, sphere.radius},
                          static_cast<std::uint32_t>(kinds.size()));
    if (is_new) {
      const SubstrateContact& contact = scene.on_substrate(i);
      kinds.push_back({1 / sphere.mass, 1 / sphere.moment_of_inertia(), sphere.mass * scene.gravity,
                       1 / (1 + sphere.inverse_shape_factor()),
                       sphere.inverse_shape_factor() / sphere.radius, contact.static_friction,
                       contact.kinetic_friction, scene.material[i], sphere.radius});
    }
    kind.push_back(at->second);
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
  features.radii = std::ranges::any_of(
      scene.bodies, [&](const Sphere& s) { return s.radius != scene.bodies[0].radius; });
  features.rubs |= features.radii;
  const bool spins_level = std::any_of(initial.begin(), initial.end(), [](const BodyState& s) {
    return !s.angular_velocity.head<2>().isZero(0);
  });
  features.driven = !scene.motion.is_still() || !scene.downhill.isZero(0);
  features.on_plane =
      slides_or_rolls(scene) || (features.rubs && spins_level) || features.driven || features.radii;
  features.any_normal = std::any_of(laws.begin(), laws.end(), [](const GrainLaw& law) {
    return !std::holds_alternative<LinearForce>(law.normal);
  });
  features.any_normal |= features.radii;  // one loop for all of them
  return features;
}

GrainPlane plane_of(const Scene& scene) {
  GrainPlane plane{0, scene.bodies[0].radius, 0, scene.periodic.x(), scene.periodic.y()};
  double sum = 0;
  for (const Sphere& sphere : scene.bodies) {
    plane.radius = std::max(plane.radius, sphere.radius);
    plane.smallest = std::min(plane.smallest, sphere.radius);
    sum += sphere.radius;
  }
  plane.mean = sum / static_cast<double>(scene.bodies.size());
  return plane;
}

}  // namespace

GrainKernels grain_kernels(const ContactScene& scene, std::span<const BodyState> initial,
                           std::vector<std::uint32_t>& kind) {
  const Scene& hard = scene.hard;
  std::vector<GrainLaw> laws = laws_of(scene);
  const GrainFeatures features = features_of(hard, laws, initial);
  return {features, std::move(laws), kinds_of(hard, kind), plane_of(hard)};
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
    if (std::abs(initial[i].position.z() - hard.bodies[i].radius) > 1e-12 * hard.bodies[i].radius ||
        initial[i].velocity.z() != 0)
      return "bodies are above the substrate";
  }
  const GrainFeatures features = features_of(hard, laws_of(scene), initial);
  if (!hard.confined && features.rubs && features.on_plane)
    return "bodies that rub or differ in radius can lift each other off the substrate, which is "
           "not confined";
  return "";
}

}  // namespace slipcheck
