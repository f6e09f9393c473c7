#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/near_pairs.h"
#include "reference/piles/pile_law_table.h"
#include "reference/piles/pile_loop.h"
#include "reference/piles/pile_waves.h"

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
/// A slab is as wide as the largest two bodies and two skins, or wider: bodies of two slabs beside
/// it do not meet before one of the lists between is used up. Its list has the pairs within it and
/// those with the next slab. A body is in two lists, an even one and an odd one: what acts on it is
/// added in that order, whichever thread takes which list and when (PileWaves). What the slabs are
/// follows from the bodies alone.
///
/// Few bodies are one slab, in the scene's order. Many are sorted by their slabs and within these
/// along a curve through space every few searches, so that neighbours share cache lines.
class PileSlabs {
 public:
  /// ordered_from: so many bodies are many.
  explicit PileSlabs(std::size_t ordered_from) : ordered_from_(ordered_from) {}

  /// Finds them anew, with the numbers of their laws; may change the order of the bodies.
  /// approach: how fast two come nearer at most [m/s]; 0: not known.
  void find(PileWorld& world, PileLawTable& laws, double approach);

  bool is_ordered(const PileWorld& world) const { return world.bodies.size() >= ordered_from_; }
  std::vector<std::vector<PileNear>>& lists() { return lists_; }
  const std::vector<std::vector<PileNear>>& lists() const { return lists_; }
  /// The scene's numbers of the bodies, by place.
  const std::vector<std::uint32_t>& bodies() const { return bodies_; }
  /// The bodies as a search sees them, by place; who moves bodies moves these.
  std::vector<NearSphere>& spheres() { return spheres_; }
  void exchange(StateArchive& archive) {
    archive(lists_, bodies_, spheres_, members_, begins_, drifts_, is_around_, searches_, skin_,
            surfaces_speed_, turning_speed_, largest_radius_);
  }
  /// Whether it may come nearer to a body than surfaces_speed() tells.
  static bool turns(const Surface& surface) {
    return !surface.motion.rate().isZero(0) && !surface.motion.is_belt();
  }
  double skin() const { return skin_; }                      ///< [m]
  double surfaces_speed() const { return surfaces_speed_; }  ///< of the fastest [m/s]
  /// Of what turns, where a body is, when they were found [m/s].
  double turning_speed() const { return turning_speed_; }
  double largest_radius() const { return largest_radius_; }  ///< [m]

  /// The places of a slab's bodies, and their mean velocity when they were found [m/s].
  std::span<const std::uint32_t> members(std::size_t slab) const {
    return std::span(members_).subspan(begins_[slab], begins_[slab + 1] - begins_[slab]);
  }
  const Vector3& drift(std::size_t slab) const { return drifts_[slab]; }
  /// The slab whose bodies are near those of this one beside its own: itself where there is none.
  std::size_t next(std::size_t slab) const {
    if (slab + 1 < lists_.size()) return slab + 1;
    return is_around_ ? 0 : slab;
  }

  PileWaves waves(const ThreadTeam* team) const {
    return {lists_.size(), is_around_, team ? team->size() : 1};
  }

 private:
  void sort_bodies(PileWorld& world);
  void share_out(const PileWorld& world, std::vector<std::uint32_t>& slab_of);
  void find_members(const PileWorld& world, std::span<const std::uint32_t> slab_of);

  std::size_t ordered_from_;
  std::vector<std::vector<PileNear>> lists_;  ///< by slab
  std::vector<std::uint32_t> bodies_;
  std::vector<NearSphere> spheres_;
  std::vector<std::uint32_t> members_, begins_;  ///< places by slab, and where each slab's begin
  std::vector<Vector3> drifts_;                  ///< by slab
  bool is_around_ = false;                       ///< the last slab is beside the first
  std::uint64_t searches_ = 0;
  double skin_ = 0, surfaces_speed_ = 0, turning_speed_ = 0, largest_radius_ = 0;
};

}  // namespace slipcheck
