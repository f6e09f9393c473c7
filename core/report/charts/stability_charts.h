#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "report/charts/chart.h"
#include "report/rows/stability_rows.h"

namespace slipcheck {

// `taken` as in file_stem.h.

/// "stability-catalogue": cases by methods, the reference first.
Chart catalogue_chart(const std::vector<StabilityCase>& cases, std::set<std::string>& taken);

/// "limit-<kind>-<scene>": limits of one kind on one scene as bars over the range that was
/// searched: blue where it works, in the colour of what happens beyond; a line where theory puts
/// the limit.
Chart limits_chart(const LimitGroup& group, std::set<std::string>& taken);

/// "map-<name>": the map of outcomes and, where any error is finite, that of its logarithm beside
/// it.
Chart map_chart(const OutcomeMap& map, std::set<std::string>& taken);

}  // namespace slipcheck
