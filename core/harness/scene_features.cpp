#include "harness/scene_features.h"

#include <fmt/format.h>

#include <algorithm>

namespace slipcheck {
namespace {

bool any_pair(const HardScene& scene, bool (*has)(const PairContact&)) {
  return scene.bodies.size() > 1 && std::any_of(scene.pairs.begin(), scene.pairs.end(), has);
}

bool any_substrate(const HardScene& scene, bool (*has)(const SubstrateContact&)) {
  return std::any_of(scene.substrate.begin(), scene.substrate.end(), has);
}

bool starts_above(const HardScene& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.initial[i].position.z() > scene.bodies[i].radius * (1 + 1e-12) ||
        scene.initial[i].velocity.z() > 0)
      return true;
  return false;
}

bool unlike_radii(const HardScene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const Sphere& sphere) {
    return sphere.radius != scene.bodies.front().radius;
  });
}

}  // namespace

std::vector<Feature> scene_features(const HardScene& scene) {
  const bool collisions = scene.bodies.size() > 1;
  const bool rubbing = any_pair(scene, [](const PairContact& c) { return c.friction > 0; });
  const bool speed_law = any_pair(
      scene, [](const PairContact& c) { return !std::holds_alternative<double>(c.restitution); });
  const bool sliding =
      any_substrate(scene, [](const SubstrateContact& c) { return c.kinetic_friction > 0; });
  const bool rolling =
      any_substrate(scene, [](const SubstrateContact& c) { return !c.rolling.is_zero(); });
  const bool table =
      any_substrate(scene, [](const SubstrateContact& c) { return !c.rolling.is_constant(); });
  const bool drilling =
      any_substrate(scene, [](const SubstrateContact& c) { return c.drilling_length > 0; });
  const bool bounces =
      any_substrate(scene, [](const SubstrateContact& c) { return c.restitution > 0; });
  const bool jumps = !scene.confined && (starts_above(scene) || bounces ||
                                         (collisions && (rubbing || unlike_radii(scene))));
  return {
      {"collisions of two bodies", collisions,
       collisions ? fmt::format("{} bodies", scene.bodies.size()) : "one body"},
      {"restitution over the impact speed", speed_law,
       speed_law ? "power law" : "one number for all speeds"},
      {"rubbing at collisions", rubbing,
       rubbing ? "Coulomb friction with restitution beta0" : "the impulse is normal"},
      {"sliding friction on the substrate", sliding,
       sliding ? "straight slip, parabolic paths" : "what slides goes on sliding"},
      {"rolling friction", rolling,
       rolling ? (table ? "from a table over the speed: exponential pieces" : "one coefficient")
               : "rolling bodies keep their speed"},
      {"drilling friction", drilling,
       drilling ? "uncoupled from the sliding" : "spins about the vertical last"},
      {"flight and landing", jumps,
       jumps ? "bodies can leave the substrate" : "bodies stay on the substrate"},
  };
}

}  // namespace slipcheck
