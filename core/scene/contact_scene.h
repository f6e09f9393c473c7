#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "physics/contact/contact_memory.h"
#include "physics/contact/normal_force.h"
#include "physics/contact/tangential_force.h"
#include "scene/scene.h"

namespace slipcheck {

class OwnContacts;
struct Scenario;

/// Up to so many classes of bodies a contact that depends on the two is kept for each two of them.
inline constexpr std::size_t kMostInTable = 300;

/// A contact of two bodies that lasts: forces over overlap and slip.
struct SoftContact {
  NormalForce normal;
  ContactEnd end = ContactEnd::zero_overlap;
  TangentialForce tangential;
  /// Bodies that meet exchange the impulse of their hard contact first; these forces only hold what
  /// that leaves together.
  bool after_impact = false;
  /// Friction and rolling resistance with memory, in place of `tangential`.
  std::optional<ContactMemory> memory = {};
};

/// One of them keeps springs.
inline bool any_remembers(const std::vector<std::optional<SoftContact>>& contacts) {
  return std::ranges::any_of(contacts, [](const auto& each) { return each && each->memory; });
}

/// What a box's surfaces do to bodies where those contacts last; by material.
struct SoftBox {
  std::vector<std::optional<SoftContact>> on_floor, on_wall, on_lid;
};

/// A scene in numbers alone with each pair's forces, as the contact solver needs it.
struct ContactScene {
  /// The bodies and the substrate; for a soft pair also the hard contact that comes closest to it,
  /// which is what engines are given.
  Scene hard;
  /// By row × row of `hard`, symmetric; none: that pair's contact is hard.
  std::vector<std::optional<SoftContact>> soft;
  /// Where each two bodies have a contact of their own; `hard.pairs` and `soft` are then those of
  /// two bodies that stand for all of theirs.
  std::shared_ptr<const OwnContacts> own;
  /// Overlaps at the start up to this part of the sum of two radii are none: such a pair is only
  /// in contact where it is pushed together.
  double touching = 0;
  /// By material × surface of `hard`; none: that contact is hard. Empty without surfaces.
  std::vector<std::optional<SoftContact>> soft_surfaces;
  SoftBox soft_box;                   ///< sized by material where `hard` has a box, else empty
  std::vector<std::string> warnings;  ///< where a law leaves the range in which it holds

  /// That of the table.
  const std::optional<SoftContact>& between(std::size_t i, std::size_t j) const {
    return soft[hard.row_of(i) * hard.row_count() + hard.row_of(j)];
  }
  /// A copy, of those that are their own too.
  std::optional<SoftContact> contact_of(std::size_t i, std::size_t j) const;
  const std::optional<SoftContact>& on_surface(std::size_t body, std::size_t surface) const {
    return soft_surfaces[hard.material[body] * hard.surfaces.size() + surface];
  }
  bool is_hard() const {
    const auto all_hard = [](const std::vector<std::optional<SoftContact>>& contacts) {
      return std::ranges::none_of(contacts, [](const auto& each) { return each.has_value(); });
    };
    return all_hard(soft) && all_hard(soft_surfaces) && all_hard(soft_box.on_floor) &&
           all_hard(soft_box.on_wall) && all_hard(soft_box.on_lid);
  }
  /// A contact remembers more than one tangential law: only PileSolver keeps that.
  bool has_memory() const {
    return any_remembers(soft) || any_remembers(soft_surfaces) ||
           any_remembers(soft_box.on_floor) || any_remembers(soft_box.on_wall) ||
           any_remembers(soft_box.on_lid);
  }
};

/// The scene with no contact that lasts.
inline ContactScene with_hard_contacts(Scene scene) {
  ContactScene made;
  made.soft.resize(scene.pairs.size());
  made.hard = std::move(scene);
  return made;
}

/// Throws Unsupported, naming place and model, for what no solver knows, and BadScenario for a
/// restitution that a law cannot reach. most_in_table: classes of bodies, beyond which each two
/// have a soft contact of their own where it depends on them.
ContactScene make_contact_scene(const Scenario& scenario, std::size_t most_in_table = kMostInTable);

}  // namespace slipcheck
