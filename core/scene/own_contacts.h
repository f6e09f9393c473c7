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
  /// By row of the scene's table, bodies that stand for it, of which none is out of a law's reach.
  OwnContacts(const Scenario& scenario, const std::vector<std::vector<BodyClass>>& rows);
  OwnContacts(const OwnContacts&) = delete;
  OwnContacts& operator=(const OwnContacts&) = delete;

  /// Of bodies of these rows, the same bits in whichever order; none where it is hard.
  std::optional<SoftContact> of(std::size_t row, const Sphere& sphere, std::size_t other_row,
                                const Sphere& other) const;

 private:
  Scenario rules_;  // without bodies
  std::list<ContactMaker> contacts_;
  std::vector<std::string> materials_;       // by row
  std::vector<const ContactMaker*> makers_;  // by row × row; null: hard
};

}  // namespace slipcheck
