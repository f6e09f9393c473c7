#pragma once

#include <span>
#include <vector>

#include "physics/frame.h"
#include "scene/scene.h"

namespace slipcheck {

/// Whether two bodies that overlap push each other, however little.
enum class OverlapPushes : bool { no, yes };

/// Who exchanged a normal impulse in a step, of an engine that does not tell: what the change of
/// the bodies' momenta beyond gravity's comes to along the lines of centres and the substrate's
/// normal. Only those count who overlap before or after, or who would by their velocities
/// before. Friction's impulses are taken out as far as they are across those lines; where a body
/// touches so many others that the split is not unique, it is the smallest. Where friction along a
/// line of centres is more than what pushes there, an overlap alone tells. The states before are
/// those at `time` [s], by which surfaces move.
std::vector<Touch> momentum_touches(const Scene& scene, std::span<const BodyState> before,
                                    std::span<const BodyState> after, double time_step,
                                    double time = 0, OverlapPushes overlaps = OverlapPushes::no);

/// Whether a body is in the middle of an impact on the substrate or a surface: it overlaps it and
/// moves to or from it faster than gravity makes it in ten times `length` [s]. A state in there, at
/// `time` [s], is neither before nor after the impact. (Of two bodies an observer sees that.)
bool in_impact(const Scene& scene, std::span<const BodyState> states, double length,
               double time = 0);

}  // namespace slipcheck
