#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "reference/near_pairs.h"
#include "reference/steps/step_kernel.h"

namespace slipcheck {

/// Two bodies of StepLoop that are near each other; first < second.
struct StepNeighbour {
  std::uint32_t first = 0, second = 0;
  Vector2 shift = Vector2::Zero();  ///< to take from x_first − x_second for the nearest image [m]

  bool is_before(const StepNeighbour& other) const {
    return std::tie(second, first) < std::tie(other.second, other.first);
  }
};

/// Verlet's list of those that can meet within the next steps, in the order in which a loop over
/// all pairs comes to them: by the second, then by the first.
class StepNeighbours {
 public:
  /// periodic: after which the plane repeats itself [m], 0: not.
  /// threads: that look for them.
  StepNeighbours(const Vector2& periodic, std::size_t threads)
      : periodic_(periodic), team_(threads) {}

  void exchange(StateArchive& archive) { archive(all_, left_, largest_); }
  const std::vector<StepNeighbour>& all() const { return all_; }
  /// Whether none but these can touch now.
  bool cover() const { return left_ >= 0; }

  /// A step took no body further than `way` [m]. Throws StepTooLong where that is more than the
  /// largest radius, or no number.
  void move(double way, const StepWorld& world);

  /// Finds them anew. `pairs`, one for each, are kept where `is_kept`.
  template <class Pair, class IsKept>
  void find(const StepWorld& world, std::vector<Pair>& pairs, const IsKept& is_kept) {
    std::vector<StepNeighbour> found = search(world);
    std::vector<Pair> kept(found.size());
    std::size_t old = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      while (old < all_.size() && all_[old].is_before(found[k])) ++old;
      if (old < all_.size() && !found[k].is_before(all_[old]) && is_kept(pairs[old]))
        kept[k] = std::move(pairs[old]);
    }
    all_ = std::move(found);
    pairs = std::move(kept);
  }

 private:
  std::vector<StepNeighbour> search(const StepWorld& world);

  Vector2 periodic_;
  ThreadTeam team_;
  std::vector<StepNeighbour> all_;
  double left_ = -1;    ///< of the skin, before others can touch [m]
  double largest_ = 0;  ///< radius [m]
};

}  // namespace slipcheck
