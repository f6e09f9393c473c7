#pragma once

#include <string>
#include <vector>

#include "report/rows/summary.h"

namespace slipcheck {

/// What the results come to, first of all on the page: the finding in a sentence, how many scenes
/// came out how, what is to be said of naive runs, and a score for each engine and profile. Nothing
/// without scenes.
std::string html_summary(const Summary& summary);

/// The worst deviations with links to their scenes; nothing where there are none. `ids` are those
/// of `scenes`, which the summary is of.
std::string html_worst(const Summary& summary, const std::vector<SceneRecord>& scenes,
                       const std::vector<std::string>& ids);

}  // namespace slipcheck
