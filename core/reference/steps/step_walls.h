#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/state_archive.h"
#include "reference/steps/step_contact.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// Whether the fixed-step solvers know a surface: a plane at rest, upright on the substrate.
inline bool is_wall(const Surface& surface) {
  const auto* plane = std::get_if<PlaneShape>(&surface.shape);
  return plane && surface.motion.is_still() && std::abs(plane->normal.z()) <= 1e-12;
}

/// The contacts of StepLoop's bodies with walls: of each with each, as few touch one.
class StepWalls {
 public:
  using Contact = StepContact<AnyNormalForce, AnyPair>;
  using Law = Contact::Law;

  /// All surfaces of the scene, which outlives this, are walls. laws: by material × wall.
  StepWalls(const Scene& scene, std::vector<Law> laws)
      : scene_(&scene), laws_(std::move(laws)), contacts_(scene.bodies.size() * count()) {}

  void exchange(StateArchive& archive) { archive(contacts_); }

  /// What they do to bodies now, beside what else does.
  void meet(StepWorld& world) {
    StepBody wall;
    for (std::size_t k = 0; k < world.bodies.size(); ++k) {
      StepBody& body = world.bodies[k];
      const std::size_t i = world.number_of(k);
      for (std::size_t w = 0; w < count(); ++w) {
        Contact& contact = contacts_[i * count() + w];
        const PlaneShape& plane = std::get<PlaneShape>(scene_->surfaces[w].shape);
        const double distance = plane.normal.dot(body.position - plane.point);
        if (distance > body.radius && !contact.touching()) continue;
        StepTally tally;
        contact.step(
            world, body, wall, distance * plane.normal,
            [&]() -> const Law& { return laws_[scene_->material[i] * count() + w]; }, tally,
            [&](const Contact::Push& push) { push.on(body, false); });
        world.touching += tally.touching;
      }
    }
  }

  /// Adds those that press a body.
  void show(const StepWorld& world, std::vector<Touch>& touches) const {
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const double impulse = std::abs(contacts_[k].normal_force()) * world.step;
      if (contacts_[k].touching() && impulse > 0)
        touches.push_back({static_cast<int>(k / count()), surface_touch(k % count()), impulse});
    }
  }

 private:
  std::size_t count() const { return scene_->surfaces.size(); }

  const Scene* scene_;
  std::vector<Law> laws_;
  std::vector<Contact> contacts_;  ///< by body, in the scene's order, × wall
};

}  // namespace slipcheck
