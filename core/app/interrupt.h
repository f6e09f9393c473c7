#pragma once

#include <atomic>

namespace slipcheck {

/// So long what has finished is written in peace: an impatient second signal does not lose it [s].
inline constexpr int kPatienceAfterInterrupt = 5;

/// Set by the first SIGINT or SIGTERM after watch_for_interrupts(); another one ends the program at
/// once, but not within kPatienceAfterInterrupt.
const std::atomic<bool>& interrupted();
void watch_for_interrupts();

}  // namespace slipcheck
