#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "harness/record.h"

namespace slipcheck {

/// The middle one of these, at least one; of an even number the mean of the two in the middle.
double median(std::vector<double> values);
/// √(Σ x²/n) of these, at least one.
double root_mean_square(std::span<const double> values);

/// The ensemble's observables, by name, from each phase's named values: the names that the
/// reference has or any phase has.
std::map<std::string, EnsembleValue> ensemble_values(
    const std::vector<std::map<std::string, double>>& phases);

/// Holds an ensemble against the reference. Every observable of the reference gets a deviation, and
/// a verdict where the scene gives a tolerance; what has a tolerance and only the engine shows is
/// not within it.
std::map<std::string, Deviation> deviations(const Scenario& scenario,
                                            const ReferenceResult& reference,
                                            const std::map<std::string, EnsembleValue>& ensemble);

/// By phase, the largest of these deviations in its tolerance [-]: infinite where the phase lacks
/// what the reference shows or shows what the reference lacks; NaN where nothing has a tolerance.
std::vector<double> phase_errors(const Scenario& scenario, const ReferenceResult& reference,
                                 const std::map<std::string, EnsembleValue>& ensemble);

/// Holds an ensemble against what is expected of it, in the order of names, then min, median, max.
/// A range is met if its statistic lies in it, limits included, and every phase shows the
/// observable; `none` if no phase does.
std::vector<ExpectationResult> expectation_results(
    const Expectation& expectation, const std::map<std::string, EnsembleValue>& ensemble);

}  // namespace slipcheck
