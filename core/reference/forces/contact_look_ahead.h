#pragma once

#include <cstddef>

#include "reference/forces/contact_events.h"

namespace slipcheck {

// Takes bodies on to what it looks for, showing nobody, through at most so many events: its time
// [s], or infinity where it does not come before `limit` [s]. Throws IntegrationFailure.

/// Two bodies touch or one lands.
double look_for_contact(ContactEvents& events, double limit, std::size_t most_events);
/// Two bodies meet at `slowest` [m/s] or faster.
double look_for_collision(ContactEvents& events, double limit, double slowest,
                          std::size_t most_events);

}  // namespace slipcheck
