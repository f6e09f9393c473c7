#pragma once

#include <string>

#include "harness/run/reference_run.h"
#include "scenario/scenario.h"

namespace slipcheck {

using ReferenceValues = ByName<UncertainValue>;  ///< by full name

/// What a relative move of an observable is relative to [its unit], >= 0, as errors are: the
/// reference's value, of vectors and their components the vector's length, of a position the way
/// from the start. 0 where the reference does not show it.
double observable_scale(const Scenario& scenario, const ReferenceValues& reference,
                        const std::string& full_name);

}  // namespace slipcheck
