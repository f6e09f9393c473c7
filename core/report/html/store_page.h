#pragma once

#include <string>
#include <vector>

#include "report/charts/gnuplot.h"
#include "report/rows/store_view.h"

namespace slipcheck {

/// One self-contained page of a sweep: what was found in a sentence, what goes with each parameter,
/// charts, and the runs themselves, at most kMostStoreRows. `program` made the store, `command` the
/// page.
std::string store_page(const StoreView& view, const QueryResult& runs,
                       const std::vector<Chart>& charts, const ChartDrawings& drawn,
                       const std::string& program, const std::string& command);

inline constexpr std::size_t kMostStoreRows = 500;

}  // namespace slipcheck
