#pragma once

#include <cstdint>
#include <vector>

#include "reference/steps/grain_bodies.h"
#include "reference/steps/grain_kernels.h"

namespace slipcheck {

/// Verlet's list: all pairs of grains nearer than a skin to each other's surface, found through
/// cells, and the order of the grains in memory: by cells, so that neighbours lie close.
class GrainNeighbours {
 public:
  /// The order, old index by new one, in which grains lie cell by cell. Cells are at least
  /// `width` [m] wide.
  const std::vector<std::uint32_t>& sort(const GrainArrays& grains, const GrainPlane& plane,
                                         double width);
  /// The pairs of grains that sort() has ordered, no further from each other's surface than `skin`
  /// [m] and in ascending order. The width given to sort() must be that of skin and two radii.
  void find(const GrainArrays& grains, const GrainPlane& plane, double skin);

  /// The list; the rest is made anew with it.
  void exchange(StateArchive& archive) { archive(first_, second_); }
  const std::vector<std::uint32_t>& first() const { return first_; }
  const std::vector<std::uint32_t>& second() const { return second_; }  ///< > first()

 private:
  void take(const GrainArrays& grains, const GrainPlane& plane, double skin, std::uint32_t i,
            std::uint32_t begin, std::uint32_t end);

  std::uint32_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> cell_;   ///< of each grain, in the order before sort()
  std::vector<std::uint32_t> start_;  ///< of each cell in the new order
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> first_, second_;
  std::vector<std::uint32_t> found_;
};

}  // namespace slipcheck
