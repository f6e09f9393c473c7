#pragma once

#include <atomic>

namespace slipcheck {

/// Set by the first SIGINT or SIGTERM after watch_for_interrupts(); a second one ends the program
/// at once.
const std::atomic<bool>& interrupted();
void watch_for_interrupts();

}  // namespace slipcheck
