#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenario/reading.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// Notes a fault, at the path of the later one, for each body that overlaps another; touching
/// within round-off is allowed. `periodic` are the lengths of the cell, if there is one [m], > 0.
void check_overlaps(const std::vector<Body>& bodies, const std::vector<std::string>& paths,
                    const std::optional<Vector2>& periodic, Reading& reading);

/// How much a sphere overlaps another, relative to round-off none: <= 0 [m] where they do not.
double overlap_of(const Vector3& a, double radius_a, const Vector3& b, double radius_b);

}  // namespace slipcheck
