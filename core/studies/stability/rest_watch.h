#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "studies/stability/outcome.h"
#include "studies/stability/reference_path.h"

namespace slipcheck {

/// Follows bodies over the substrate that rest in the reference. A body may come to rest later than
/// there, within half of its rest; from when it has, or that half is over, it stays where it is.
/// While it moves at more than a tenth of the scene's speed it is on its way and does not creep.
class RestWatch {
 public:
  /// `path` must outlive this.
  RestWatch(const ReferencePath& path, const OutcomeCriteria& criteria);

  void begin(double time, std::span<const BodyState> states);
  void take(double time, std::span<const BodyState> states);

  /// Largest way of a body that should stay, over its radius [-], >= 0.
  double creep() const { return creep_; }

  /// What is wrong by the criteria; accurate where nothing is.
  PhaseOutcome outcome() const;

 private:
  struct Resting {
    std::size_t body = 0;
    double from = 0, late = 0;  ///< when its rest begins, and when half of it is over [s]
    double slow = 0;  ///< speed [m/s] that takes it no farther than allowed in all its rest
    double fast = 0;  ///< speed [m/s] above which it does not creep but is on its way
    bool stays = false;
    Vector2 place = Vector2::Zero();  ///< over the substrate, where it stays [m]
  };

  const ReferencePath* path_;
  OutcomeCriteria criteria_;
  std::vector<Resting> resting_;
  double creep_ = 0;
  std::size_t worst_ = 0;  ///< body
  double creeps_at_ = 0;   ///< when the criterion was first missed [s]
};

}  // namespace slipcheck
