#pragma once

#include <vector>

#include "report/charts/chart.h"
#include "report/rows/store_view.h"

namespace slipcheck {

/// A sweep's runs: "parallel", all parameters at once; "scatter", the outcome over each parameter;
/// "surface", its median over two of those that tell most. Of very many runs even selections are
/// drawn, as captions say; medians are of all.
std::vector<Chart> store_charts(const StoreView& view);

}  // namespace slipcheck
