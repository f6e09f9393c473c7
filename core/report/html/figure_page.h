#pragma once

#include <string>
#include <vector>

#include "report/charts/gnuplot.h"

namespace slipcheck {

/// One self-contained page with all figures, their captions and links to the files beside it.
/// `command` is what made it.
std::string figure_page(const std::vector<Chart>& figures, const ChartDrawings& drawn,
                        const std::string& introduction, const std::string& command);

}  // namespace slipcheck
