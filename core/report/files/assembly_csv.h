#pragma once

#include <string>

#include "harness/observe/assembly_observer.h"

namespace slipcheck {

// What many bodies show as a whole, as long tables: a row for each number, texts and doubles alone
// in each column, as Parquet wants them. All values SI.

/// scene, quantity, unit, time, value: of each sample.
std::string assembly_series_csv(const std::string& scene, const Assembly& assembly);

/// scene, distribution, curve, x, density: velocities and pairs over the second half of the run, as
/// measured and as Maxwell, Sonine and an ideal gas have them.
std::string assembly_distributions_csv(const std::string& scene, const Assembly& assembly);

}  // namespace slipcheck
