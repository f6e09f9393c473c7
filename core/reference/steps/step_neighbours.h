#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "reference/near_pairs.h"
#include "reference/steps/step_kernel.h"

namespace slipcheck {

/// Two bodies of StepLoop that are near each other, by where they are stored; the first is the
/// scene's first.
struct StepNeighbour {
  std::uint32_t first = 0, second = 0;
  Vector2 shift = Vector2::Zero();  ///< to take from x_first − x_second for the nearest image [m]

  std::size_t nearer() const { return std::min(first, second); }
  std::size_t further() const { return std::max(first, second); }  ///< from the first stored
};

/// Verlet's list of those that can meet within the next steps. Many bodies are put into an order in
/// which those that are near are stored near each other, and again after some searches.
class StepNeighbours {
 public:
  /// periodic: after which the plane repeats itself [m], 0: not.
  /// threads: that look for them.
  StepNeighbours(const Vector2& periodic, std::size_t threads)
      : periodic_(periodic), team_(threads) {}

  void exchange(StateArchive& archive) { archive(all_, left_, largest_, searches_); }
  /// By further(), and then by nearer().
  const std::vector<StepNeighbour>& all() const { return all_; }
  ThreadTeam& team() { return team_; }
  /// Whether none but these can touch now.
  bool cover() const { return left_ >= 0; }

  /// A step took no body further than `way` [m]. Throws StepTooLong where that is more than the
  /// largest radius, or no number.
  void move(double way, const StepWorld& world);

  /// Finds them anew, and may store the bodies in another order. `pairs`, one for each, are kept
  /// where `is_kept`.
  template <class Pair, class IsKept>
  void find(StepWorld& world, std::vector<Pair>& pairs, const IsKept& is_kept) {
    struct Kept {
      std::size_t first, second;  // in the scene
      Pair pair;
    };
    std::vector<Kept> kept;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      if (is_kept(pairs[k]))
        kept.push_back(
            {world.number_of(all_[k].first), world.number_of(all_[k].second), std::move(pairs[k])});
    search(world);
    pairs.clear();
    pairs.resize(all_.size());
    for (Kept& each : kept) {
      const auto [nearer, further] =
          std::minmax({world.place_of(each.first), world.place_of(each.second)});
      const auto found = std::ranges::lower_bound(
          all_, std::pair(further, nearer), {},
          [](const auto& near) { return std::pair(near.further(), near.nearer()); });
      if (found != all_.end() && found->further() == further && found->nearer() == nearer)
        pairs[static_cast<std::size_t>(found - all_.begin())] = std::move(each.pair);
    }
  }

 private:
  void search(StepWorld& world);

  Vector2 periodic_;
  ThreadTeam team_;
  std::vector<StepNeighbour> all_;
  double left_ = -1;    ///< of the skin, before others can touch [m]
  double largest_ = 0;  ///< radius [m]
  std::size_t searches_ = 0;
};

}  // namespace slipcheck
