#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/state_archive.h"
#include "physics/numbers.h"
#include "reference/piles/pile_body.h"

namespace slipcheck {

/// Tells when nothing moves any more: no body by more than rounding, for long.
class PileRest {
 public:
  explicit PileRest(double window = 0) : window_(window) {}

  void exchange(StateArchive& archive) { archive(window_, since_, places_); }

  /// Whether all is at rest since `window` before this time [s].
  bool sees_rest(double time, std::span<const PileBody> bodies) {
    if (places_.size() != bodies.size() || !is_where_it_was(bodies)) {
      places_.clear();
      for (const PileBody& b : bodies) places_.push_back({b.position, b.turned});
      since_ = time;
    }
    return time - since_ >= window_;
  }

 private:
  struct Place {
    Vector3 position, turned;
  };

  bool is_where_it_was(std::span<const PileBody> bodies) const {
    constexpr double kStill = 1e-12;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const PileBody& b = bodies[i];
      const double rounding = 16 * kEpsilon * b.position.cwiseAbs().maxCoeff();
      const double turns = 16 * kEpsilon * b.turned.cwiseAbs().maxCoeff();
      if (!((b.position - places_[i].position).cwiseAbs().maxCoeff() <=
            kStill * b.radius + rounding) ||
          !((b.turned - places_[i].turned).cwiseAbs().maxCoeff() <= kStill + turns))
        return false;
    }
    return true;
  }

  double window_;
  double since_ = 0;
  std::vector<Place> places_;
};

}  // namespace slipcheck
