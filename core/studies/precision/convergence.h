#pragma once

#include <span>

#include "studies/precision/precision.h"

namespace slipcheck {

/// Below what errors tell nothing.
struct ErrorFloor {
  /// What of an error cannot be told from rounding and from the reference's uncertainty, >= 0.
  double noise = 0;
  /// What nobody asks about, a small part of the scene's tolerance, >= 0. An error may stay
  /// constant below it.
  double negligible = 0;
};

/// How worst errors fall along a curve: at these knobs, which fall (steps, tolerances), from coarse
/// to fine. Errors that are NaN are left out.
///
/// exact: all are at most the noise, or all at most negligible and they do not fall.
/// converges: all that holds of
///   - the power law through the points above the noise has p > 0.25 and p > 2 σ_p,
///   - the finest is at most half of the coarsest,
///   - the last three still fall with p > 0.25, or the finest is at most negligible,
/// or the finest are at most the noise (then the order has those above it alone).
/// unknown: fewer than three errors, which do not lie below a floor.
/// does_not_converge: all others.
Convergence convergence_of(std::span<const double> knobs, std::span<const double> errors,
                           const ErrorFloor& floor);

}  // namespace slipcheck
