#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/compare/record.h"

namespace slipcheck {

/// The middle one of these, at least one; of an even number the mean of the two in the middle.
double median(std::vector<double> values);
/// √(Σ x²/n) of these, at least one.
double root_mean_square(std::span<const double> values);

/// The ensemble's observables, by name, from each phase's named values: the names that the
/// reference has or any phase has.
std::map<std::string, EnsembleValue> ensemble_values(
    const std::vector<std::map<std::string, double>>& phases);

/// Notes how far the headings are apart in each observable of an ensemble whose values are those of
/// `headings` >= 1 headings, one after the other, each with as many phases. Nothing of one heading.
void note_heading_spreads(std::map<std::string, EnsembleValue>& ensemble, std::size_t headings);

/// "1 of 3 phases do not show it", or "runs" where a phase has several headings.
std::string missing_phases(const EnsembleValue& value);

/// Why a tolerance judges nothing, where the reference shows nothing of what it names.
inline constexpr const char* kNothingOccurs = "nothing of it occurs in the reference";

/// Holds an ensemble against the reference. Every observable of the reference gets a deviation, and
/// a verdict where the scene gives a tolerance. What has a tolerance and only the engine shows
/// deviates; a tolerance that names nothing that either of them shows is undecided, under its own
/// key. Undecided is also what the reference does not know to the tolerance, and everything where
/// the reference came to no end. A value that is zero but for rounding has no relative error: it
/// is within its tolerance where the engine's is as near to zero as the reference knows.
std::map<std::string, Deviation> deviations(const Scenario& scenario,
                                            const ReferenceResult& reference,
                                            const std::map<std::string, EnsembleValue>& ensemble);

/// By phase, the largest of these deviations in its tolerance [-]: infinite where the phase lacks
/// what the reference shows or shows what the reference lacks; NaN where nothing has a tolerance by
/// which it can be judged.
std::vector<double> phase_errors(const Scenario& scenario, const ReferenceResult& reference,
                                 const std::map<std::string, EnsembleValue>& ensemble);

/// Holds an ensemble against what is expected of it, in the order of names, then min, median, max.
/// A range is met if its statistic lies in it, limits included, and every phase shows the
/// observable; `none` if no phase does.
std::vector<ExpectationResult> expectation_results(
    const Expectation& expectation, const std::map<std::string, EnsembleValue>& ensemble);

}  // namespace slipcheck
