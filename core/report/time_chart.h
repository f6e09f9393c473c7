#pragma once

#include <string>

#include "harness/record.h"

namespace slipcheck {

/// What a box showed at each sample: a strip each for H, K, R and the collision rate over the time,
/// with the mean and the band that holds the true one with 95 %. Samples before the averaged ones
/// are drawn fainter. HTML; nothing for a scene that is not in a box or has fewer than two samples.
std::string html_time_charts(const SceneRecord& scene);

}  // namespace slipcheck
