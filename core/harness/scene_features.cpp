#include "harness/scene_features.h"

#include <fmt/format.h>

#include <algorithm>

namespace slipcheck {
namespace {

/// Between bodies of the scene, by what the contact is.
struct PairKinds {
  bool any_soft = false;
  bool viscous = false, asperity = false, impulse = false;  // of rubbing
  bool speed_law = false;                                   // of a hard restitution
};

PairKinds pair_kinds(const ContactScene& scene) {
  PairKinds kinds;
  if (scene.hard.bodies.size() < 2) return kinds;
  for (std::size_t k = 0; k < scene.soft.size(); ++k) {
    if (const auto& soft = scene.soft[k]) {
      kinds.any_soft = true;
      kinds.viscous |= std::holds_alternative<ViscousForce>(soft->tangential);
      kinds.asperity |= std::holds_alternative<AsperityForce>(soft->tangential);
    } else {
      const PairContact& hard = scene.hard.pairs[k];
      kinds.impulse |= hard.friction > 0;
      kinds.speed_law |= !std::holds_alternative<double>(hard.restitution);
    }
  }
  return kinds;
}

std::string rubbing_detail(const PairKinds& kinds) {
  std::string text;
  const auto add = [&](bool has, const char* what) {
    if (has) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  add(kinds.impulse, "Coulomb friction with restitution beta0");
  add(kinds.viscous, "viscous up to Coulomb's cap");
  add(kinds.asperity, "asperities that bend and break");
  return text.empty() ? "the impulse is normal" : text;
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

std::vector<Feature> scene_features(const ContactScene& contacts) {
  const HardScene& scene = contacts.hard;
  const PairKinds kinds = pair_kinds(contacts);
  const bool collisions = scene.bodies.size() > 1;
  const bool rubbing = kinds.impulse || kinds.viscous || kinds.asperity;
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
      {"rubbing at collisions", rubbing, rubbing_detail(kinds)},
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
      {"tilted substrate", tilted, tilted ? "gravity along the plane: integrated" : "level"},
      {"moving substrate", moving, moving ? "integrated" : "still"},
      {"flight and landing", jumps,
       jumps ? "bodies can leave the substrate" : "bodies stay on the substrate"},
  };
}

}  // namespace slipcheck
