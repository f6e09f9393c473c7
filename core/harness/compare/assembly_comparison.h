#pragma once

#include <vector>

#include "harness/observe/assembly_observer.h"
#include "harness/observe/assembly_quantities.h"

namespace slipcheck {

/// A mean over samples with its standard error, both in the quantity's unit; the error is NaN of
/// fewer than kFewestForAnError samples.
struct AssemblyMean {
  double value = 0, error = 0;
};

/// A quantity over the second half of two runs, at the same times.
struct AssemblyDifference {
  const AssemblyQuantity* quantity = nullptr;
  AssemblyMean reference, engine;
  /// Of the differences at each time, whose errors need not be those of the two: where both runs
  /// change alike, as a gas that cools, they scatter less than either.
  AssemblyMean difference;
};

/// Samples of the two count together that are not further apart than half the time from one to the
/// next. None where there are no such.
std::vector<AssemblyDifference> assembly_differences(const Assembly& reference,
                                                     const Assembly& engine);

}  // namespace slipcheck
