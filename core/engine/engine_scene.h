#pragma once

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
};

/// What an engine is given: bodies and substrate with every contact hard, and beside that the
/// forces of contacts that last, for engines that have such. The hard contact of a pair that has
/// forces is the one that comes closest to them.
struct EngineScene : Scene {
  EngineScene() = default;
  /// A scene in which every contact is hard.
  EngineScene(Scene scene) : Scene(std::move(scene)) {}  // NOLINT: a scene is one for engines
  explicit EngineScene(const ContactScene& scene) : Scene(scene.hard) {
    if (scene.is_hard()) return;
    soft = SoftContacts{scene.soft, scene.soft_box};
    // No engine takes springs that remember: it gets the hard contact closest to them.
    for (auto* contacts :
         {&soft->pairs, &soft->box.on_floor, &soft->box.on_wall, &soft->box.on_lid})
      for (std::optional<SoftContact>& contact : *contacts)
        if (contact && contact->memory) contact.reset();
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
};

}  // namespace slipcheck
