#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/charts/chart.h"

namespace slipcheck {

// Charts of a scene. `taken` as in file_stem.h.

/// The observables of a page or all of them, those of a page first.
enum class ChartExtent { page, all };

/// "phases-<scene>-<observable>": a row for each run with a point for each phase, beside the
/// reference's value and the tolerance; what it shows in words is the caption. On a page what has a
/// tolerance, effective restitution first, then what is worst, at most six, and what looks the same
/// once.
std::vector<Chart> phase_charts(const SceneRecord& scene, ChartExtent extent,
                                std::set<std::string>& taken);

/// "motion-<scene>": slip, speed and energy over time, of the reference and of each engine's run
/// the phase in the middle, of at most four bodies; none where no motion was recorded.
std::optional<Chart> motion_chart(const SceneRecord& scene, std::set<std::string>& taken);

/// Whether a motion has frames, and all bodies in each: what was read may not.
bool fits_scene(const Scene& scene, const RecordedMotion& motion);

/// "series-<scene>": what a box showed at each sample, with the mean and its 95 % interval.
std::optional<Chart> series_chart(const SceneRecord& scene, std::set<std::string>& taken);

/// "assembly-<scene>" and "distributions-<scene>": what many bodies showed as a whole, over time
/// and over the second half of the run; none where that was not asked for.
std::vector<Chart> assembly_charts(const SceneRecord& scene, std::set<std::string>& taken);

}  // namespace slipcheck
