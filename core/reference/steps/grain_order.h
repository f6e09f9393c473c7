#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/thread_team.h"

namespace slipcheck {

/// Puts quantities of grains into a new order. The team shares them.
class GrainOrder {
 public:
  using Quantity =
      std::variant<std::vector<double>*, std::vector<std::int32_t>*, std::vector<std::uint32_t>*>;

  /// order: the old index by the new one. Those that are no reals should be the last, so that few
  /// threads need memory for them.
  void apply(std::span<const std::uint32_t> order, std::span<const Quantity> all,
             ThreadTeam& team) {
    moved_.resize(team.size());
    team.run_shares(all.size(), [&](std::size_t own, std::size_t first, std::size_t last) {
      const auto move = [&](auto* values) {
        auto& moved = std::get<std::remove_pointer_t<decltype(values)>>(moved_[own]);
        moved.resize(values->size());
        for (std::size_t k = 0; k < order.size(); ++k) moved[k] = (*values)[order[k]];
        values->swap(moved);
      };
      for (std::size_t k = first; k < last; ++k) std::visit(move, all[k]);
    });
    moved_.clear();
  }

 private:
  using Moved =
      std::tuple<std::vector<double>, std::vector<std::int32_t>, std::vector<std::uint32_t>>;
  std::vector<Moved> moved_;  ///< one quantity's, of each thread
};

}  // namespace slipcheck
