#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/contact_scene.h"

namespace slipcheck {

/// What occurs among a set of contacts.
struct ContactKinds {
  bool any_soft = false;                                    ///< some last
  bool viscous = false, asperity = false, impulse = false;  ///< of rubbing
  bool speed_law = false;   ///< a hard one whose restitution depends on the speed
  bool dissipates = false;  ///< a hard one whose restitution is not 1

  bool rubs() const { return impulse || viscous || asperity; }
  /// How they rub, in words.
  std::string rubbing() const;
};

/// A contact that is soft does not count as hard; where `soft` is empty all are hard.
ContactKinds contact_kinds(const std::vector<PairContact>& hard,
                           const std::vector<std::optional<SoftContact>>& soft);

/// What occurs in either.
ContactKinds operator|(const ContactKinds& a, const ContactKinds& b);

}  // namespace slipcheck
