#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scenario/reading.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// Why two bodies must not overlap at all; none where they may by less than the smaller radius.
using OverlapRule = std::function<std::optional<std::string>(const Body&, const Body&)>;

/// Notes a fault, at the path of the later one, for each body that overlaps another and must not;
/// touching within round-off is allowed. `periodic` are the lengths of the cell, if there is one
/// [m], > 0. Without a rule nothing may overlap.
void check_overlaps(const std::vector<Body>& bodies, const std::vector<std::string>& paths,
                    const std::optional<Vector2>& periodic, Reading& reading,
                    const OverlapRule& rule = {});

/// How much a sphere overlaps another, relative to round-off none: <= 0 [m] where they do not.
double overlap_of(const Vector3& a, double radius_a, const Vector3& b, double radius_b);

}  // namespace slipcheck
