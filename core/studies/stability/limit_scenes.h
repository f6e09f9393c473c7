#pragma once

#include "scenario/scenario.h"

namespace slipcheck {

// The scenes on which limits are looked for and maps are drawn; docs/stability.md, "Limits and
// maps", explains each. None asks for an engine: the searches put in engines and rates.

/// "pair": two rolling steel balls, R = 2 mm, meet at 30 cm/s after 0.05 s, e_n = 0.9, μ = 0.1.
Scenario limit_pair();

/// "collision": the pair without friction or spin, so that it meets once whatever the restitution.
Scenario limit_collision();

/// "strikes-heavier": such a ball, the first, rolls into one at rest; the second is to get heavier.
Scenario limit_strikes_heavier();

/// "struck-by-heavier": the second, which is to get heavier, rolls into the first, at rest.
Scenario limit_struck_by_heavier();

/// "bounce": a ball falls 5 cm and bounces once with e = 0.8.
Scenario limit_bounce();

/// "roll": a ball rolls to rest in 2.5 s.
Scenario limit_roll();

/// "soft-pair": the pair with a linear contact of 1e6 N/m, which lasts 36 µs, after 0.5 ms.
Scenario limit_soft_pair();

}  // namespace slipcheck
