#include "reference/steps/grain_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "reference/steps/grain_walls.h"

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
                       contact.kinetic_friction, scene.material[i], sphere.radius,
                       contact.rolling(0), contact.drilling_length, &sphere, &contact});
    }
    kind.push_back(at->second);
  }
  return kinds;
}

GrainLaw law_of(const std::optional<SoftContact>& contact) {
  GrainLaw law;
  if (!contact) return law;
  law.normal = contact->normal;
  law.clamped = contact->end == ContactEnd::zero_force;
  if (const auto* viscous = std::get_if<ViscousForce>(&contact->tangential)) {
    law.damping = viscous->damping;
    law.friction = viscous->friction;
  }
  return law;
}

/// By material × material, then by material × wall.
std::vector<GrainLaw> laws_of(const ContactScene& scene) {
  std::vector<GrainLaw> laws;
  for (const auto* table : {&scene.soft, &scene.soft_surfaces})
    for (const std::optional<SoftContact>& contact : *table) laws.push_back(law_of(contact));
  return laws;
}

/// Why a contact that lasts is none of GrainSolver's, or nothing.
std::string refusal_of(const std::optional<SoftContact>& contact) {
  if (!contact) return "not all contacts of bodies are soft";
  if (contact->memory) return "contacts have a memory";
  if (std::holds_alternative<AsperityForce>(contact->tangential)) return "bodies have asperities";
  return "";
}

/// The same of all at surfaces.
std::string refusal_at_surfaces(const ContactScene& scene) {
  if (scene.hard.surfaces.empty()) return "";
  if (scene.soft_surfaces.empty()) return refusal_of({});
  for (const std::optional<SoftContact>& contact : scene.soft_surfaces)
    if (const std::string refusal = refusal_of(contact); !refusal.empty()) return refusal;
  return "";
}

bool slides_or_rolls(const Scene& scene) {
  return std::any_of(scene.substrate.begin(), scene.substrate.end(),
                     [](const SubstrateContact& c) { return c.static_friction > 0; });
}

/// Higher than a few grains upon each other: there would be many neighbours.
bool is_high(const Sphere& sphere, const BodyState& state) {
  return state.position.z() > 6 * sphere.radius;
}

bool is_on_plane(const Sphere& sphere, const BodyState& state) {
  return std::abs(state.position.z() - sphere.radius) <= 1e-12 * sphere.radius &&
         state.velocity.z() == 0;
}

bool are_on_plane(const std::vector<Sphere>& bodies, std::span<const BodyState> states) {
  for (std::size_t i = 0; i < states.size(); ++i)
    if (!is_on_plane(bodies[i], states[i])) return false;
  return true;
}

bool rolls(const Scene& scene) {
  return std::ranges::any_of(scene.substrate, [](const SubstrateContact& c) {
    return !c.rolling.is_zero() || c.drilling_length > 0;
  });
}

bool rubs(const GrainLaw& law) { return law.damping > 0 && law.friction > 0; }

GrainFeatures features_of(const Scene& scene, const std::vector<GrainLaw>& laws,
                          std::span<const BodyState> initial) {
  GrainFeatures features;
  features.rubs = std::any_of(laws.begin(), laws.end(), rubs);
  features.radii = std::ranges::any_of(
      scene.bodies, [&](const Sphere& s) { return s.radius != scene.bodies[0].radius; });
  features.rolls = rolls(scene);
  features.walls = !scene.surfaces.empty();
  features.rubs |= features.radii || features.rolls || features.walls;
  const bool spins_level = std::any_of(initial.begin(), initial.end(), [](const BodyState& s) {
    return !s.angular_velocity.head<2>().isZero(0);
  });
  features.driven = !scene.motion.is_still() || !scene.downhill.isZero(0);
  features.on_plane = slides_or_rolls(scene) || (features.rubs && spins_level) || features.driven ||
                      features.radii || features.rolls || features.walls;
  features.lifts = !scene.confined &&
                   ((features.rubs && features.on_plane) || !are_on_plane(scene.bodies, initial));
  features.rubs |= features.lifts;
  features.on_plane |= features.lifts;
  features.any_normal = std::any_of(laws.begin(), laws.end(), [](const GrainLaw& law) {
    return !std::holds_alternative<LinearForce>(law.normal);
  });
  features.any_normal |= features.is_uneven();  // one loop for all of them
  return features;
}

GrainPlane plane_of(const Scene& scene, double slowest_rebound) {
  GrainPlane plane;
  plane.gravity = scene.gravity;
  plane.slowest_rebound = slowest_rebound;
  plane.smallest = scene.bodies[0].radius;
  plane.length_x = scene.periodic.x();
  plane.length_y = scene.periodic.y();
  plane.walls = grain_walls(scene);
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
                           double slowest_rebound, std::vector<std::uint32_t>& kind) {
  const Scene& hard = scene.hard;
  std::vector<GrainLaw> laws = laws_of(scene);
  const GrainFeatures features = features_of(hard, laws, initial);
  return {features, std::move(laws), kinds_of(hard, kind), plane_of(hard, slowest_rebound)};
}

GrainFeatures grain_features(const ContactScene& scene, std::span<const BodyState> initial) {
  return features_of(scene.hard, laws_of(scene), initial);
}

std::string grain_refusal(const ContactScene& scene, std::span<const BodyState> initial) {
  const Scene& hard = scene.hard;
  if (hard.box) return "the scene is a box";
  if (!hard.has_substrate) return "there is no substrate";
  if (scene.own) return "each two bodies have a contact of their own";
  for (const SubstrateContact& c : hard.substrate) {
    if (!c.rolling.is_constant()) return "rolling friction depends on the speed";
    if (c.rolling_while_sliding && !c.rolling.is_zero())
      return "rolling friction acts on bodies that slide";
    if (c.coupled_radius > 0) return "sliding and drilling share their friction";
  }
  for (const std::optional<SoftContact>& contact : scene.soft)
    if (const std::string refusal = refusal_of(contact); !refusal.empty()) return refusal;
  for (const std::string& refusal : {refusal_at_surfaces(scene), wall_refusal(hard)})
    if (!refusal.empty()) return refusal;
  if (hard.confined && !are_on_plane(hard.bodies, initial))
    return "bodies are above the substrate, which confines them";
  for (std::size_t i = 0; i < hard.bodies.size(); ++i)
    if (is_high(hard.bodies[i], initial[i])) return "bodies are high above the substrate";
  return "";
}

}  // namespace slipcheck
