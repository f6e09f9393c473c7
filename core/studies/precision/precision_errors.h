#pragma once

#include <map>
#include <string>

#include "harness/run/reference_run.h"
#include "scenario/scenario.h"
#include "studies/precision/convergence.h"

namespace slipcheck {

/// Below what the errors of each of the scene's quantities tell nothing, for a method that rounds
/// to `rounding` of a quantity's own scale.
///
/// The noise is the larger of that and of ten times the reference's uncertainty; a thousandth of
/// the tolerance is negligible.
std::map<std::string, ErrorFloor> error_floors(const Scenario& scenario,
                                               const ReferenceResult& reference, double rounding);

/// What a curve's method leaves of any quantity by rounding alone, of the quantity's own scale [-].
double rounding_of(const MethodCurve& curve);

/// Fits how each quantity's worst error falls along the curve. What some phases do not show has no
/// worst error there.
void find_convergence(const Scenario& scenario, const ReferenceResult& reference,
                      MethodCurve& curve);

/// Marks in each quantity the points of all these curves that are on the front of cost (CPU time
/// per simulated second) and worst error.
void mark_fronts(std::vector<MethodCurve>& curves);

}  // namespace slipcheck
