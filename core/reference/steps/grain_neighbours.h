#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/thread_team.h"
#include "reference/steps/grain_bodies.h"
#include "reference/steps/grain_kernels.h"

namespace slipcheck {

/// Verlet's list: all pairs of grains nearer than a skin to each other's surface, found through
/// cells, and the order of the grains in memory: by cells, so that neighbours lie close.
class GrainNeighbours {
 public:
  /// The order, old index by new one, in which grains lie cell by cell. Cells are at least
  /// `width` [m] wide. The team shares the work.
  const std::vector<std::uint32_t>& sort(const GrainArrays& grains, const GrainPlane& plane,
                                         double width, ThreadTeam& team);
  /// Where it has put grain `i` of the order before.
  std::uint32_t sorted(std::uint32_t i) const;
  /// The pairs of grains that sort() has ordered, no further from each other's surface than `skin`
  /// [m] and in ascending order, and as pairs of each with itself those so near to walls. The width
  /// given to sort() must be that of skin and two radii. The team shares the work.
  void find(const GrainArrays& grains, const GrainPlane& plane, double skin, ThreadTeam& team);

  /// The list; the rest is made anew with it.
  void exchange(StateArchive& archive) { archive(first_, second_, wall_); }
  const std::vector<std::uint32_t>& first() const { return first_; }
  const std::vector<std::uint32_t>& second() const { return second_; }  ///< > first()
  /// Of a grain and a wall, for which both are the grain; else GrainPair::kNoWall.
  std::uint16_t wall(std::size_t listed) const {
    return wall_.empty() ? GrainPair::kNoWall : wall_[listed];
  }
  /// The place of a pair i < j of the list in it, or of a grain i = j and a wall.
  std::uint32_t place_of(std::uint32_t i, std::uint32_t j,
                         std::uint16_t wall = GrainPair::kNoWall) const;

 private:
  /// What one thread sorts: grains, as they lay before, and cells; `gone`: of the grains those in
  /// cells of other threads.
  struct Sorted {
    GrainStretch grains, cells;
    std::vector<std::uint32_t> gone;
  };
  /// Those of cells beside one, in the order of the cells.
  class Beside;
  /// Pairs by the rows of cells that one thread looks at: the first `count` of them.
  struct Found {
    std::vector<std::uint32_t> first, second;
    std::vector<std::uint16_t> wall;       ///< where there are walls
    std::ptrdiff_t count = 0, before = 0;  ///< before: of other threads
  };
  void count(Sorted& own);
  void place(std::size_t k);
  /// reach: from centre to centre of two grains, by their numbers [m].
  template <class Reach>
  void find_in(const GrainArrays& grains, const GrainPlane& plane, double skin, const Reach& reach,
               std::uint32_t first_row, std::uint32_t last_row, Found& found) const;

  std::uint32_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> cell_;   ///< of each grain, in the order before sort()
  std::vector<std::uint32_t> start_;  ///< of each cell in the new order
  std::vector<std::uint32_t> order_;
  std::vector<Sorted> sorted_;  ///< by thread
  std::vector<std::uint32_t> first_, second_;
  std::vector<std::uint16_t> wall_;
  std::vector<Found> found_;
};

}  // namespace slipcheck
