#pragma once

#include <cmath>

#include "physics/vector.h"

namespace slipcheck::bullet {

/// The cell by which a plane and all on it repeat themselves, in the axes of the world. Balls run
/// on beyond its edges; what meets across them are images.
class PeriodicCell {
 public:
  PeriodicCell() = default;
  /// Lengths [world's], 0: no repetition along that axis; `turn` from the scene's axes to the
  /// world's.
  PeriodicCell(const Vector2& lengths, const Matrix3& turn) : lengths_(lengths), turn_(turn) {}

  bool repeats() const { return !lengths_.isZero(0); }

  /// What is to be added to the place of a second body so that it is the image nearest to a first
  /// one, where `apart` leads from the second to the first. Exactly zero for the second itself.
  Vector3 shift(const Vector3& apart) const {
    Vector3 shift = Vector3::Zero();
    for (int axis = 0; axis < 2; ++axis)
      if (lengths_[axis] > 0)
        shift += std::round(turn_.col(axis).dot(apart) / lengths_[axis]) * lengths_[axis] *
                 turn_.col(axis);
    return shift;
  }

  /// The place along one of the axes, within [0, length); as it is where nothing repeats.
  double folded(const Vector3& place, int axis) const {
    const double along = turn_.col(axis).dot(place), length = lengths_[axis];
    return length > 0 ? along - std::floor(along / length) * length : along;
  }
  double length(int axis) const { return lengths_[axis]; }

 private:
  Vector2 lengths_ = Vector2::Zero();
  Matrix3 turn_ = Matrix3::Identity();
};

}  // namespace slipcheck::bullet
