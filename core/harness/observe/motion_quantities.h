#pragma once

#include <cstddef>
#include <vector>

#include "harness/observe/motion.h"
#include "scene/scene.h"

namespace slipcheck {

/// What a motion's frames show, for charts over time.
struct MotionQuantities {
  /// Of the lowest point over what carries the body, along it [m/s], `slip[frame][body]`; NaN while
  /// nothing does, and in a box.
  std::vector<std::vector<Vector3>> slip;
  std::vector<std::vector<double>> speed;  ///< of the centre [m/s], `speed[frame][body]`
  std::vector<double> kinetic_energy;      ///< of all bodies, rotation included [J], by frame
};

/// Whether there is a substrate and the body's centre is not higher than R (1 + 1e-3) over it.
bool is_on_substrate(const Scene& scene, std::size_t body, const BodyState& state);

/// `motion` is one of the scene's bodies, in their order.
MotionQuantities motion_quantities(const Scene& scene, const RecordedMotion& motion);

}  // namespace slipcheck
