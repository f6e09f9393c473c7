#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "scene/contact_scene.h"
#include "scene/scene.h"

namespace slipcheck {

/// The forces of those contacts of a scene that last; none: that contact is hard.
struct SoftContacts {
  std::vector<std::optional<SoftContact>> pairs;  ///< by material × material, symmetric
  SoftBox box;                                    ///< by material where there is a box, else empty
  /// By material × surface; empty where all of those are hard.
  std::vector<std::optional<SoftContact>> surfaces = {};

  bool has_memory() const {
    return any_remembers(pairs) || any_remembers(box.on_floor) || any_remembers(box.on_wall) ||
           any_remembers(box.on_lid) || any_remembers(surfaces);
  }
};

/// What an engine is given: bodies and substrate with every contact hard, and beside that the
/// forces of contacts that last, for engines that have such. The hard contact of a pair that has
/// forces is the one that comes closest to them.
struct EngineScene : Scene {
  EngineScene() = default;
  /// A scene in which every contact is hard.
  EngineScene(Scene scene) : Scene(std::move(scene)) {}  // NOLINT: a scene is one for engines
  /// Throws Unsupported where each two bodies have a contact of their own.
  explicit EngineScene(const ContactScene& scene) : Scene(scene.hard) {
    if (scene.own)
      throw Unsupported("no engine is given bodies that have each two a contact of their own");
    if (!scene.is_hard()) soft = SoftContacts{scene.soft, scene.soft_box, scene.soft_surfaces};
  }

  /// Bodies go over in one piece however few they are, to a worker that takes many
  /// (scene_part::kMany).
  bool packed = false;

  /// Nothing where every contact is hard.
  std::optional<SoftContacts> soft;

  /// The forces between two bodies; null where their contact is hard.
  const SoftContact* soft_between(std::size_t i, std::size_t j) const {
    if (!soft) return nullptr;
    const auto& contact = soft->pairs[material[i] * substrate.size() + material[j]];
    return contact ? &*contact : nullptr;
  }
  /// The same of a body and surface k beside the substrate.
  const SoftContact* soft_on_surface(std::size_t body, std::size_t k) const {
    if (!soft || soft->surfaces.empty()) return nullptr;
    const auto& contact = soft->surfaces[material[body] * surfaces.size() + k];
    return contact ? &*contact : nullptr;
  }
  bool has_memory() const { return soft && soft->has_memory(); }
  /// Contacts that remember become hard ones, those that come closest to them.
  void forget_memory() {
    if (!soft) return;
    for (auto* contacts : {&soft->pairs, &soft->box.on_floor, &soft->box.on_wall, &soft->box.on_lid,
                           &soft->surfaces})
      for (std::optional<SoftContact>& contact : *contacts)
        if (contact && contact->memory) contact.reset();
  }
};

}  // namespace slipcheck
