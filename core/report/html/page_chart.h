#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "report/charts/chart.h"

namespace slipcheck {

/// A chart for the page's script, without formulas; numbers are rounded to six digits, and long
/// lines are channels (page_channel.h). Colours of quantities are left out: cells tell them.
nlohmann::json page_chart(const Chart& chart);
nlohmann::json page_charts(const std::vector<Chart>& charts);

/// Ink, line and marker by their names, null where there is none.
nlohmann::json page_look(const Look& look);

/// Each ink by name, on a light and on a dark ground.
nlohmann::json page_palette();

}  // namespace slipcheck
