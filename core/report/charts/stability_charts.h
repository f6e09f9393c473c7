#pragma once

#include <string>
#include <vector>

#include "report/html/figure_page.h"
#include "studies/stability/limits.h"
#include "studies/stability/stability.h"

namespace slipcheck {

/// The catalogue as one map of cases by methods, the reference first; a cell says why when pointed
/// at. SVG; `name` makes its ids unique.
std::string catalogue_svg(const std::vector<StabilityCase>& cases, const std::string& name);

/// The map of outcomes and, where any error is finite, that of its logarithm beside it.
FigureOnPage map_figure(const OutcomeMap& map, const std::string& name);

/// All figures: the catalogue, limits by kind and scene, maps; names fit for files.
std::vector<FigureOnPage> stability_charts(const std::vector<StabilityCase>& cases,
                                           const LimitResults& limits);

}  // namespace slipcheck
