#pragma once

#include <string>
#include <vector>

#include "studies/stability/limits.h"
#include "studies/stability/stability.h"

namespace slipcheck {

/// A row for each case and run, the reference's first (docs/result-file.md).
std::string stability_csv(const std::vector<StabilityCase>& cases);
/// A row for each limit.
std::string limits_csv(const std::vector<Limit>& limits);
/// A row for each cell of each map.
std::string maps_csv(const std::vector<OutcomeMap>& maps);

}  // namespace slipcheck
