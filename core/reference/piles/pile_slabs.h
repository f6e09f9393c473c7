#pragma once

#include <cstdint>
#include <vector>

#include "reference/near_pairs.h"
#include "reference/piles/pile_law_table.h"
#include "reference/piles/pile_loop.h"

namespace slipcheck {

/// A body and what it may touch soon.
struct PileNear {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::uint32_t first = 0;                  ///< its place among PileWorld::bodies
  int second = kSubstrate;                  ///< the other's, or as of Touch
  std::uint32_t contact = kNone;            ///< of the slab's contacts
  std::uint32_t law = 0;                    ///< of the table
  std::int32_t across_x = 0, across_y = 0;  ///< periods between the second and its nearest image
};

/// What can touch within the next steps: Verlet's lists, shared out into slabs of space.
///
/// A slab is as wide as the largest two bodies and the skin, or wider. Its list has the pairs
/// within it and those with the next slab, so that all even slabs can be worked on at once, and
/// then all odd ones: no body is in two of them, and what acts on it is added in the same order
/// whichever thread takes which slab. What the slabs are follows from the bodies alone.
///
/// Few bodies are one slab, in the scene's order. Many are sorted by their slabs and within these
/// along a curve through space every few searches, so that neighbours share cache lines.
class PileSlabs {
 public:
  /// ordered_from: so many bodies are many.
  explicit PileSlabs(std::size_t ordered_from) : ordered_from_(ordered_from) {}

  /// Finds them anew, with the numbers of their laws; may change the order of the bodies.
  void find(PileWorld& world, PileLawTable& laws);

  bool is_ordered(const PileWorld& world) const { return world.bodies.size() >= ordered_from_; }
  std::vector<std::vector<PileNear>>& lists() { return lists_; }
  const std::vector<std::vector<PileNear>>& lists() const { return lists_; }
  /// The scene's numbers of the bodies, by place.
  const std::vector<std::uint32_t>& bodies() const { return bodies_; }
  /// The bodies as a search sees them, by place; who moves bodies moves these.
  std::vector<NearSphere>& spheres() { return spheres_; }
  void exchange(StateArchive& archive) {
    archive(lists_, bodies_, spheres_, searches_, skin_, surfaces_speed_, largest_radius_);
  }
  /// Whether it may come nearer to a body than surfaces_speed() tells.
  static bool turns(const Surface& surface) {
    return !surface.motion.rate().isZero(0) && !surface.motion.is_belt();
  }
  double skin() const { return skin_; }                      ///< [m]
  double surfaces_speed() const { return surfaces_speed_; }  ///< of the fastest [m/s]
  double largest_radius() const { return largest_radius_; }  ///< [m]

  /// Calls work(s) for each slab: for even ones, and when all of these have returned for odd ones.
  template <class Work>
  void for_each(ThreadTeam* team, const Work& work) {
    for (std::size_t odd = 0; odd < 2; ++odd) {
      const std::size_t count = (lists_.size() + 1 - odd) / 2;
      const auto half = [&](std::size_t k) { work(2 * k + odd); };
      if (team)
        team->run(count, half);
      else
        for (std::size_t k = 0; k < count; ++k) half(k);
    }
  }

 private:
  void sort_bodies(PileWorld& world);
  void share_out(const PileWorld& world, std::vector<std::uint32_t>& slab_of);

  std::size_t ordered_from_;
  std::vector<std::vector<PileNear>> lists_;  ///< by slab
  std::vector<std::uint32_t> bodies_;
  std::vector<NearSphere> spheres_;
  std::uint64_t searches_ = 0;
  double skin_ = 0, surfaces_speed_ = 0, largest_radius_ = 0;
};

}  // namespace slipcheck
