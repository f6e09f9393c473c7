#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "reference/steps/grain_islands.h"
#include "reference/steps/grain_kernels.h"
#include "reference/steps/grain_neighbours.h"

namespace slipcheck {

/// Which listed pairs of grains can meet within a block of steps, and which of them do if all go
/// straight on.
class GrainMeetings {
 public:
  /// Of what must outlive this. margin: how near two must be to meet in the block [m]; time: of the
  /// block [s]; step: h [s]; braking, landing: as of GrainBlocks.
  GrainMeetings(const GrainKernels& kernels, const GrainArrays& grains, const GrainNeighbours& list,
                double margin, double time, double step, double braking, double landing)
      : kernels_(&kernels),
        grains_(&grains),
        list_(&list),
        listed_{list.first(), list.second()},
        margin_(margin),
        time_(time),
        step_(step),
        landing_(landing),
        // What the substrate's friction takes from two grains, and roundings.
        aside_(braking * time * (time + step) + 1e-9 * kernels.plane().radius) {}

  /// Of the listed pairs first … last − 1.
  void find(std::size_t first, std::size_t last, GrainNear& found) const {
    found.near.clear();
    const std::size_t count = last - first;
    kernels_->find_near(*grains_, listed_.first.subspan(first, count),
                        listed_.second.subspan(first, count), margin_, found.near);
    for (std::uint32_t& each : found.near) each += static_cast<std::uint32_t>(first);
    const GrainFeatures& has = kernels_->features();
    if (has.walls)
      std::erase_if(found.near, [&](std::uint32_t k) {
        return list_->wall(k) != GrainPair::kNoWall && gap(k) > 0.5 * margin_;
      });
    if (has.walls)
      has.lifts ? find_hit<true, true>(found) : find_hit<false, true>(found);
    else
      has.lifts ? find_hit<true, false>(found) : find_hit<false, false>(found);
  }

 private:
  /// How far a grain comes off its way where it lands within the block, at most [m].
  double aside(std::uint32_t i) const {
    const GrainArrays& g = *grains_;
    const double fall = kernels_->plane().gravity * time_;
    const double height = g.z[i] + g.vz[i] * time_ - 0.5 * fall * (time_ + step_);
    return g.flies[i] > 0 && height < g.radius[i]
               ? landing_ * (std::abs(g.vz[i]) + 1.5 * fall) * time_
               : 0;
  }

  /// Between the grain and the wall of a pair of the list [m].
  double gap(std::uint32_t k) const {
    const std::uint32_t i = listed_.first[k];
    return kernels_->plane().walls[list_->wall(k)].distance(grains_->x[i], grains_->y[i]) -
           grains_->radius[i];
  }

  /// Whether the grain of such a pair comes to the wall.
  bool hits_wall(std::uint32_t k) const {
    const std::uint32_t i = listed_.first[k];
    const GrainWall& wall = kernels_->plane().walls[list_->wall(k)];
    const double closing = -(wall.x * grains_->vx[i] + wall.y * grains_->vy[i]);
    const double landing = kernels_->features().lifts ? aside(i) : 0;
    return gap(k) - std::max(closing, 0.0) * time_ <= aside_ + landing;
  }

  template <bool kLifts, bool kWalls>
  void find_hit(GrainNear& found) const {
    const GrainPlane& plane = kernels_->plane();
    const GrainArrays& g = *grains_;
    const bool radii = kernels_->features().radii;
    double reach = 2 * plane.radius + aside_;
    std::size_t hits = 0;
    found.hit.resize(found.near.size());
    for (const std::uint32_t k : found.near) {
      const std::uint32_t i = listed_.first[k], j = listed_.second[k];
      if (kWalls && i == j) {
        found.hit[hits] = i;
        hits += hits_wall(k) ? 1 : 0;
        continue;
      }
      double dx = g.x[i] - g.x[j], dy = g.y[i] - g.y[j];
      dx -= shift_to_nearest_image(dx, plane.length_x);
      dy -= shift_to_nearest_image(dy, plane.length_y);
      const double ux = g.vx[i] - g.vx[j], uy = g.vy[i] - g.vy[j];
      // Closest to each other at once, in the end, or between.
      const double speed2 = std::max(ux * ux + uy * uy, std::numeric_limits<double>::min());
      const double when = std::clamp(-(dx * ux + dy * uy) / speed2, 0.0, time_);
      if (radii) reach = level_reach(g, i, j) + aside_;
      double most = reach;
      if constexpr (kLifts) most += aside(i) + aside(j);
      dx += ux * when;
      dy += uy * when;
      found.hit[hits] = i;
      hits += dx * dx + dy * dy <= most * most ? 1 : 0;
    }
    found.hit.resize(hits);
  }

  const GrainKernels* kernels_;
  const GrainArrays* grains_;
  const GrainNeighbours* list_;
  GrainPairs listed_;
  double margin_, time_, step_, landing_, aside_;
};

}  // namespace slipcheck
