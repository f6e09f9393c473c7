#pragma once

#include <set>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/charts/gnuplot_script.h"

namespace slipcheck {

/// Adds the charts of a scene: "phases-<scene>-<observable>" for each observable with a tolerance,
/// "motion-<scene>" where motion was recorded, "series-<scene>" of a box. `taken` as in
/// file_stem.h.
void add_scene_charts(const SceneRecord& scene, std::set<std::string>& taken,
                      std::vector<GnuplotChart>& charts);

}  // namespace slipcheck
