#pragma once

#include <chrono>

namespace slipcheck {

/// Wall time that stands still while this program is stopped (SIGSTOP, ^Z, a frozen container), so
/// that no limit of time is used up meanwhile. Counts as stopped: nobody has asked for a second, in
/// which the whole program had less than a twentieth of a processor. Of steady_clock; from any
/// thread, 0.5 µs.
std::chrono::steady_clock::time_point running_time();

}  // namespace slipcheck
