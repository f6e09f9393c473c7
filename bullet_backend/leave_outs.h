#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bullet_backend/bullet_settings.h"
#include "scene/scene.h"

namespace slipcheck::bullet {

/// What of Bullet's work in each step a scene does not need, where the setting `leaves_out` allows.
/// All but the line changes no bit of any result.
struct LeaveOuts {
  /// Bounding boxes and their overlaps, of one body: that of a half-space has no end, and so it is
  /// always near all surfaces. With more bodies even a surface's box, which never changes, moves
  /// the tree of boxes on, and with it the order of contacts.
  bool broadphase = false;
  /// Where bodies are at the end of a step if nothing is in their way: Bullet integrates their
  /// orientations for it, and all that it looks at is their bounding boxes, to which a sphere's
  /// orientation is nothing. Rigid bodies with damping have it applied there.
  bool predictions = false;
  /// The sweep for CCD, which needs a body with a threshold; Bullet predicts motions for it anew.
  bool sweeps = false;
  /// Pairs that can touch: Bullet keeps memory for 4096, 5 MB that a fresh world has to clear.
  std::optional<int> most_pairs;
  /// The horizontal direction, of length 1, of the vertical plane in which all moves: one row of
  /// friction along it does for two. The other friction's row would have nothing to do but to brake
  /// rounding, and results differ by rounding.
  std::optional<Vector2> line;
};

/// For bodies in these states. SI.
LeaveOuts find_leave_outs(const Scene& scene, std::span<const BodyState> states,
                          const BulletSettings& settings);

/// What Bullet leaves out in this scene, by itself or by `leaves`, each with the reason.
std::vector<std::string> left_out(const LeaveOuts& leaves, const Scene& scene,
                                  const BulletSettings& settings);

}  // namespace slipcheck::bullet
