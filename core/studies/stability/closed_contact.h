#pragma once

#include "studies/stability/limit_search.h"

namespace slipcheck {

/// One run of the reference's fixed-step solver on a linear contact that never opens:
/// ξ̈ + γ ξ̇ + ω0² ξ = 0, a sphere held between two that outweigh it 1e12 times and that it overlaps
/// so far that it swings inside. omega0 [1/s], > 0, gamma [1/s], >= 0, step [s], > 0.
///
/// Good where the amplitude does not grow: over 4000 steps it stays below 1000 times the first one
/// (without damping the scheme itself lets it become 1/√(1 − (h ω0/2)²) times as large), and in the
/// last quarter it is at most twice that in the second. A mode of growth 1 + g a step so shows from
/// g = 3.5e-4 on.
Trial closed_contact_trial(double omega0, double gamma, double step);

}  // namespace slipcheck
