#pragma once

#include <string>

#include "harness/compare/record.h"

namespace slipcheck {

// What many bodies show as a whole, as long tables: a row for each number, texts and doubles alone
// in each column, as Parquet wants them. All values SI.

/// scene, quantity, unit, time, value: of each sample.
std::string assembly_series_csv(const std::string& scene, const Assembly& assembly);

/// A row for each quantity and run of an engine beside the reference: means over the second half of
/// both with standard errors, and the mean of the differences at the same times.
std::string assembly_comparison_csv(const SceneRecord& scene);

/// scene, distribution, curve, x, density: velocities and pairs over the second half of the run, as
/// measured and as Maxwell, Sonine and an ideal gas have them.
std::string assembly_distributions_csv(const std::string& scene, const Assembly& assembly);

}  // namespace slipcheck
