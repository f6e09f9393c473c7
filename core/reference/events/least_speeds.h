#pragma once

#include <algorithm>

namespace slipcheck {

/// Below which things count as over.
struct LeastSpeeds {
  /// A pair parts at least with this part of the largest speed at which one of the two has met
  /// another body so far, whatever the rule for collapse: friction with the substrate can press two
  /// bodies together for long.
  double rebound_fraction = 0;
  double rebound = 0;  ///< nor slower than this [m/s]
  double landing = 0;  ///< a landing that would rebound slower does not [m/s]

  /// Of a pair, from the normal speeds of their hardest impacts so far [m/s].
  double rebound_of(double hardest, double others) const {
    return std::max(rebound, rebound_fraction * std::max(hardest, others));
  }
};

}  // namespace slipcheck
