#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/thread_team.h"

namespace slipcheck {

/// Puts quantities of grains into a new order. Each thread moves those of its share of the grains,
/// which it works on later too: what another has written comes slowly from that one's cache.
class GrainOrder {
 public:
  using Quantity =
      std::variant<std::vector<double>*, std::vector<std::int32_t>*, std::vector<std::uint32_t>*>;

  /// order: the old index by the new one.
  void apply(std::span<const std::uint32_t> order, std::span<const Quantity> all,
             ThreadTeam& team) {
    moved_.resize(team.size());
    for (std::size_t first = 0; first < all.size(); first += moved_.size()) {
      const auto some = all.subspan(first, std::min(moved_.size(), all.size() - first));
      const auto each = [&](const auto& work) {
        for (std::size_t k = 0; k < some.size(); ++k)
          std::visit([&](auto* values) { work(*values, moved(values, k)); }, some[k]);
      };
      each([&](auto&, auto& moved) { moved.resize(order.size()); });
      team.run_shares(order.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        each([&](const auto& values, auto& moved) {
          std::transform(order.begin() + begin, order.begin() + end, moved.begin() + begin,
                         [from = values.data()](std::uint32_t i) { return from[i]; });
        });
      });
      each([](auto& values, auto& moved) { values.swap(moved); });
    }
  }

  /// Gives back memory.
  void forget() { moved_.clear(); }

 private:
  using Moved =
      std::tuple<std::vector<double>, std::vector<std::int32_t>, std::vector<std::uint32_t>>;

  template <class Values>
  Values& moved(const Values*, std::size_t k) {
    return std::get<Values>(moved_[k]);
  }

  std::vector<Moved> moved_;  ///< some quantities, as many as there are threads
};

}  // namespace slipcheck
