#include "harness/compare/scene_features.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/compare/box_features.h"
#include "harness/compare/contact_kinds.h"

namespace slipcheck {
namespace {

ContactKinds pair_kinds(const ContactScene& scene) {
  if (scene.hard.bodies.size() < 2) return {};
  return contact_kinds(scene.hard.pairs, scene.soft);
}

bool any_substrate(const Scene& scene, bool (*has)(const SubstrateContact&)) {
  return std::any_of(scene.substrate.begin(), scene.substrate.end(), has);
}

bool starts_above(const Scene& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.initial[i].position.z() > scene.bodies[i].radius * (1 + 1e-12) ||
        scene.initial[i].velocity.z() > 0)
      return true;
  return false;
}

bool unlike_radii(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const Sphere& sphere) {
    return sphere.radius != scene.bodies.front().radius;
  });
}

}  // namespace

std::vector<Feature> scene_features(const ContactScene& contacts) {
  const Scene& scene = contacts.hard;
  if (scene.box) return box_features(contacts);
  const ContactKinds kinds = pair_kinds(contacts);
  const bool collisions = scene.bodies.size() > 1;
  const bool rubbing = kinds.rubs();
  const bool sliding =
      any_substrate(scene, [](const SubstrateContact& c) { return c.kinetic_friction > 0; });
  const bool rolling =
      any_substrate(scene, [](const SubstrateContact& c) { return !c.rolling.is_zero(); });
  const bool table =
      any_substrate(scene, [](const SubstrateContact& c) { return !c.rolling.is_constant(); });
  const bool drilling =
      any_substrate(scene, [](const SubstrateContact& c) { return c.drilling_length > 0; });
  const bool coupled =
      any_substrate(scene, [](const SubstrateContact& c) { return c.coupled_radius > 0; });
  const bool rolls_sliding = any_substrate(scene, [](const SubstrateContact& c) {
    return c.rolling_while_sliding && !c.rolling.is_zero();
  });
  const bool tilted = !scene.downhill.isZero(0), moving = !scene.motion.is_still();
  const bool exact = !tilted && !moving && !coupled && !rolls_sliding;
  const bool periodic = scene.periodic != Vector2::Zero();
  const bool bounces =
      any_substrate(scene, [](const SubstrateContact& c) { return c.restitution > 0; });
  const bool jumps = !scene.confined && (starts_above(scene) || bounces ||
                                         (collisions && (rubbing || unlike_radii(scene))));
  return {
      {"collisions of two bodies", collisions,
       collisions ? fmt::format("{} bodies", scene.bodies.size()) : "one body"},
      {"contacts that last", kinds.any_soft,
       kinds.any_soft ? "forces over overlap and slip" : "collisions take no time"},
      {"restitution over the impact speed", kinds.speed_law,
       kinds.speed_law  ? "a law of hard contacts"
       : kinds.any_soft ? "it follows from the forces"
                        : "one number for all speeds"},
      {"rubbing at collisions", rubbing, kinds.rubbing()},
      {"sliding friction on the substrate", sliding,
       !sliding ? "what slides goes on sliding"
       : exact  ? "straight slip, parabolic paths"
                : "Coulomb's, with the stick limit"},
      {"rolling friction", rolling,
       rolling ? (table ? "from a table over the speed" : "one coefficient")
               : "rolling bodies keep their speed"},
      {"rolling friction while sliding", rolls_sliding,
       rolls_sliding ? "integrated" : "it acts on rolling bodies alone"},
      {"drilling friction", drilling,
       coupled    ? "coupled to the sliding: integrated"
       : drilling ? "uncoupled from the sliding"
                  : "spins about the vertical last"},
      {"tilted substrate", tilted, tilted ? "gravity along the plane" : "level"},
      {"moving substrate", moving, moving ? "the slip's direction turns" : "still"},
      {"periodic cell", periodic,
       periodic ? "bodies meet the images of others across its edges" : "the plane has no edges"},
      {"flight and landing", jumps,
       jumps ? "bodies can leave the substrate" : "bodies stay on the substrate"},
  };
}

}  // namespace slipcheck
