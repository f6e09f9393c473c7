#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "reference/near_pairs.h"
#include "studies/stability/reference_path.h"

namespace slipcheck {

/// Finds bodies that pass through each other or the substrate, also between two frames: on the
/// straight ways between them. A collision inside a step bends the real way outwards, away from the
/// other body, so that the straight one is never nearer than both its ends and the contact.
///
/// On a plane that repeats itself the nearest images count. Pairs far apart are looked at again
/// only once the bodies may have come near.
class BodyPassage {
 public:
  /// `path` must outlive this.
  explicit BodyPassage(const ReferencePath& path);

  void begin(std::span<const BodyState> states);
  /// Says by what a body has passed since the frame before; empty where none has. A centre below
  /// the plane has passed the substrate; a pair whose overlap exceeds the reference's deepest by
  /// the smaller radius has passed through each other.
  std::string take(std::span<const BodyState> states);

  /// Deepest overlap so far beyond the reference's, over the (smaller) radius [-], >= 0.
  double depth() const { return depth_; }

 private:
  void find_near();

  const ReferencePath* path_;
  std::vector<Vector3> positions_;  ///< in the frame before
  std::vector<NearPair> near_;      ///< that may meet before `budget_` is used up
  double skin_ = 0;                 ///< how much farther than touching is near [m]
  double budget_ = 0;               ///< what the fastest body may still move [m]
  double depth_ = 0;
};

}  // namespace slipcheck
