#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
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
/// within it and those with the next slab. A body is in two lists, an even one and an odd one: what
/// acts on it is added in that order, whichever thread takes which list and when. What the slabs
/// are follows from the bodies alone.
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
            surfaces_speed_, largest_radius_);
  }
  /// Whether it may come nearer to a body than surfaces_speed() tells.
  static bool turns(const Surface& surface) {
    return !surface.motion.rate().isZero(0) && !surface.motion.is_belt();
  }
  double skin() const { return skin_; }                      ///< [m]
  double surfaces_speed() const { return surfaces_speed_; }  ///< of the fastest [m/s]
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

  /// Calls act(s) for each list, for even ones before the odd ones beside them, and done(s) for
  /// each slab as soon as what acts on its bodies has: they are in the caches still. Neither
  /// throws.
  template <class Act, class Done>
  void sweep(ThreadTeam* team, const Act& act, const Done& done) const {
    const std::size_t slabs = lists_.size();
    const std::size_t blocks = team ? blocks_for(team->size()) : 1;
    // Slabs that follow each other, from an even one on.
    const auto begin = [&](std::size_t k) {
      return k < blocks ? k * slabs / blocks / 2 * 2 : slabs;
    };
    const auto inner = [&](std::size_t k) {
      const std::size_t first = begin(k), end = begin(k + 1);
      act(first);
      if (first == 0 && !is_around_) done(first);
      for (std::size_t s = first + 2; s < end; s += 2) {
        act(s);
        act(s - 1);
        done(s - 1);
        done(s);
      }
    };
    // The odd list at its end, which may reach into the next one.
    const auto outer = [&](std::size_t k) {
      const std::size_t last = begin(k + 1) - 1;
      if (last % 2 == 0) return;
      act(last);
      done(last);
      if (const std::size_t beside = next(last); beside != last) done(beside);
    };
    for_each(team, blocks, inner);
    for_each(team, blocks, outer);
  }

 private:
  /// Four for each thread are shared out well; of four slabs one list waits for the block beside.
  std::size_t blocks_for(std::size_t threads) const {
    const std::size_t slabs = lists_.size();
    return std::clamp(slabs / 4, std::min(threads, std::max<std::size_t>(1, slabs / 2)),
                      4 * threads);
  }

  template <class Work>
  static void for_each(ThreadTeam* team, std::size_t count, const Work& work) {
    if (team && count > 1)
      team->run(count, work);
    else
      for (std::size_t k = 0; k < count; ++k) work(k);
  }

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
  double skin_ = 0, surfaces_speed_ = 0, largest_radius_ = 0;
};

}  // namespace slipcheck
