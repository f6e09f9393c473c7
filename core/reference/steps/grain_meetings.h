#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/thread_team.h"
#include "reference/steps/grain_kernels.h"
#include "reference/steps/grain_neighbours.h"

namespace slipcheck {

/// Which listed pairs of grains can meet within a block of steps, and which of them do if all go
/// straight on. Each thread looks at a stretch of the list of its own.
class GrainMeetings {
 public:
  /// margin: how near two must be to meet in the block [m]; time: of the block [s]; braking: the
  /// largest μ_k g of a grain [m/s²]; step: h [s].
  void find(const GrainKernels& kernels, const GrainArrays& grains, const GrainNeighbours& listed,
            double margin, double time, double braking, double step, ThreadTeam& team) {
    // What the substrate's friction takes from two grains, and roundings.
    const double aside = braking * time * (time + step) + 1e-9 * kernels.plane().radius;
    const std::span<const std::uint32_t> first = listed.first(), second = listed.second();
    found_.resize(team.size());
    team.run_shares(first.size(), [&](std::size_t own, std::size_t from, std::size_t to) {
      Found& found = found_[own];
      found.near.clear();
      kernels.find_near(grains, first.subspan(from, to - from), second.subspan(from, to - from),
                        margin, found.near);
      for (std::uint32_t& each : found.near) each += static_cast<std::uint32_t>(from);
      find_hit(kernels.plane(), grains, first, second, aside, time, found);
    });
    near_.clear();
    hit_.clear();
    for (const Found& found : found_) {
      near_.insert(near_.end(), found.near.begin(), found.near.end());
      hit_.insert(hit_.end(), found.hit.begin(), found.hit.end());
    }
  }
  /// A grain that touches another one is hit whatever their ways.
  void hit_too(std::uint32_t grain) { hit_.push_back(grain); }

  const std::vector<std::uint32_t>& near() const { return near_; }  ///< by index in the list
  /// Of each pair that meets the first grain.
  const std::vector<std::uint32_t>& hit() const { return hit_; }

 private:
  struct Found {
    std::vector<std::uint32_t> near, hit;
  };

  static void find_hit(const GrainPlane& plane, const GrainArrays& g,
                       std::span<const std::uint32_t> first, std::span<const std::uint32_t> second,
                       double aside, double time, Found& found) {
    const double reach = 2 * plane.radius + aside;
    std::size_t hits = 0;
    found.hit.resize(found.near.size());
    for (const std::uint32_t k : found.near) {
      const std::uint32_t i = first[k], j = second[k];
      double dx = g.x[i] - g.x[j], dy = g.y[i] - g.y[j];
      dx -= shift_to_nearest_image(dx, plane.length_x);
      dy -= shift_to_nearest_image(dy, plane.length_y);
      const double ux = g.vx[i] - g.vx[j], uy = g.vy[i] - g.vy[j];
      // Closest to each other at once, in the end, or between.
      const double speed2 = std::max(ux * ux + uy * uy, std::numeric_limits<double>::min());
      const double when = std::clamp(-(dx * ux + dy * uy) / speed2, 0.0, time);
      dx += ux * when;
      dy += uy * when;
      found.hit[hits] = i;
      hits += dx * dx + dy * dy <= reach * reach ? 1 : 0;
    }
    found.hit.resize(hits);
  }

  std::vector<Found> found_;  ///< by thread
  std::vector<std::uint32_t> near_, hit_;
};

}  // namespace slipcheck
