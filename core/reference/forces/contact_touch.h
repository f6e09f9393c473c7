#pragma once

#include <cstddef>
#include <optional>

#include "reference/forces/contact_state.h"
#include "scene/ode.h"

namespace slipcheck {

/// Two bodies that come into contact.
struct NextTouch {
  double time = 0;
  std::size_t first = 0, second = 0;
};

/// The first contact of two bodies that are not in contact, within the integrator's last step:
/// found on its dense output by steps that cannot pass a contact, so that not even a graze shorter
/// than the step is missed. `state` is that at the start of the step.
std::optional<NextTouch> first_touch(const ContactState& state, const Ode& ode);

}  // namespace slipcheck
