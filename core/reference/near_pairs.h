#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "base/thread_team.h"
#include "physics/vector.h"

namespace slipcheck {

/// What a search for neighbours sees of a body.
struct NearSphere {
  Vector3 position = Vector3::Zero();  ///< [m]
  double radius = 0;                   ///< [m], > 0
};

/// Those of a search, where they are: of many bodies no second copy is made. What they are read
/// from must outlive it.
class NearSpheres {
 public:
  NearSpheres(std::span<const NearSphere> all)
      : size_(all.size()), at_([all](std::size_t i) { return all[i]; }) {}
  NearSpheres(const std::vector<NearSphere>& all) : NearSpheres(std::span(all)) {}
  /// at: that of each body, without a change from call to call.
  NearSpheres(std::size_t size, std::function<NearSphere(std::size_t)> at)
      : size_(size), at_(std::move(at)) {}

  std::size_t size() const { return size_; }
  NearSphere operator[](std::size_t i) const { return at_(i); }

 private:
  std::size_t size_;
  std::function<NearSphere(std::size_t)> at_;
};

/// Two bodies that may touch soon; first < second.
struct NearPair {
  std::uint32_t first = 0, second = 0;
  auto operator<=>(const NearPair&) const = default;
};

/// All pairs of spheres whose surfaces are nearer than `skin` [m], >= 0, in order; on a plane that
/// repeats itself after `periodic` [m] (0: it does not) those of the nearest images.
///
/// Spheres of like size, within a factor of two, share cells as wide as the largest of them;
/// smaller ones look into the cells of the larger ones (V. Ogarko, S. Luding, Comput. Phys. Commun.
/// 183, 931 (2012)), so that the cost goes with the spheres that are near each other, however
/// unlike their radii are. Cells are folded onto some two for each sphere: far apart they may lie.
/// The pairs are the same on any number of threads.
std::vector<NearPair> near_pairs(const NearSpheres& spheres, double skin,
                                 const Vector2& periodic = Vector2::Zero(),
                                 ThreadTeam* team = nullptr);

/// The same pairs in any order, without a list of all: take() has some thousands of bodies' at a
/// time, and makes no search itself.
void near_pairs_in_shares(const NearSpheres& spheres, double skin, const Vector2& periodic,
                          const std::function<void(std::span<const NearPair>)>& take);

/// How thick a skin [m] pays: that which bodies as fast as `speed` [m/s] come through in some 30
/// steps of `step` [s], from 0.1 to 0.6 of `radius` [m]. Thinner ones are looked for too often,
/// thicker ones let too many be looked at.
double near_skin(double speed, double step, double radius);

}  // namespace slipcheck
