#pragma once

#include <cstddef>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "scenario/scenario.h"
#include "scene/contact_maker.h"
#include "scene/contact_scene.h"
#include "scene/scene_outline.h"

namespace slipcheck {

/// Makes the soft contact of two bodies when it is asked for: where a law depends on both and
/// nearly each is of a size of its own, a table of all of them would not fit. May be asked by
/// several threads.
class OwnContacts {
 public:
  /// An outline whose classes share rows. Both are needed no longer. Throws BadScenario for what a
  /// law cannot reach between two bodies that stand for a row.
  OwnContacts(const Scenario& scenario, const SceneOutline& outline);
  OwnContacts(const OwnContacts&) = delete;
  OwnContacts& operator=(const OwnContacts&) = delete;

  /// Of bodies of these rows, the first that of the lower class: what is alike in exact arithmetic
  /// need not be to the last bit. None where it is hard.
  std::optional<SoftContact> of(std::size_t row, const Sphere& sphere, std::size_t other_row,
                                const Sphere& other) const;

 private:
  Scenario rules_;  // without bodies
  std::list<ContactMaker> contacts_;
  std::vector<std::string> materials_;       // by row
  std::vector<const ContactMaker*> makers_;  // by row × row; null: hard
};

}  // namespace slipcheck
