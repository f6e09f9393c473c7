#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reference/steps/grain_bodies.h"

namespace slipcheck {

/// Grains that may meet within a few steps, and none but each other: their steps are done at once,
/// while they lie in the nearest cache. What the features lack is in none of these arrays.
struct GrainBatch {
  std::size_t count = 0, pair_count = 0;  ///< the arrays may have places for more
  GrainView grains;
  std::vector<GrainPair> pairs;       ///< by index into `grains`
  std::vector<std::uint32_t> acting;  ///< for those of the pairs that do in a step
  /// Forces [N] and torques [N m] by other grains, none between two runs; load |N| dt of the
  /// substrate [N s], squares of the largest speeds [m²/s²], and the constants of GrainKind, for
  /// each grain.
  std::vector<double> fx, fy, fz, tx, ty, tz, load, fastest;
  std::vector<double> inverse_mass, inverse_inertia, weight, share, turn, mu_s, mu_k, mu_r,
      drilling, radius;
  std::vector<const GrainKind*> kind;  ///< where grains land

  static constexpr std::size_t kAtOnce = 256;  ///< grains without others, in the nearest cache

  /// Has so many from now on; what steps change of its grains lies in `in` from `first` on, and
  /// behind it a place for what stands for walls.
  void hold(GrainArrays& in, std::size_t first, std::size_t grain_count, std::size_t count_of_pairs,
            const GrainFeatures& has);
  /// What stands for walls is a point at rest.
  void take_wall(const GrainFeatures& has);
  /// Takes those of `from`; `kinds` are of the scene.
  void take(const GrainArrays& from, std::span<const std::uint32_t> which,
            const std::vector<GrainKind>& kinds, const GrainFeatures& has);

 private:
  void take_kind(std::size_t k, const GrainKind& of, const GrainFeatures& has);
  GrainArrays* in_ = nullptr;
  std::size_t first_ = 0;
  std::size_t of_one_kind_ = 0;  ///< so many places have the constants of the only kind
};

/// So many steps after a block those that slide through it still would, by friction alone.
inline constexpr std::size_t kLastSlides = 20;

/// What a tilted or moving plane does to grains in one step.
struct GrainPush {
  double before_x = 0, before_y = 0;  ///< v_S where the velocities come from [m/s]
  double plane_x = 0, plane_y = 0;    ///< v_S where they go to [m/s]
  double slope_x = 0, slope_y = 0;    ///< acceleration downhill [m/s²]
  /// Where they go to, the velocity from which speeds count [m/s].
  double drift_x = 0, drift_y = 0;
};

/// Steps of a grain of one kind that rolls on it all the while, summed, and what friction does in
/// one to a grain that slides.
struct GrainRoll {
  double radius = 0, per_radius = 0;  ///< R [m], and 1/R [1/m]
  double holds = 0;                   ///< 1: static friction does in each of them; else 0
  double dvx = 0, dvy = 0;            ///< of the velocity [m/s]
  double x = 0, y = 0;                ///< beside v t [m]
  double last_dvx = 0, last_dvy = 0;  ///< in the last step [m/s]
  double share = 0, turn = 0;         ///< see GrainKind
  /// What friction takes of the slip in a step at most, sliding and at rest [m/s].
  double slides_by = 0, holds_by = 0;
  /// The slip beyond which it would slide in each of them, and go on as it did [m/s].
  double slides_from = 0;
};

/// What such a plane does in a row of steps.
struct GrainDriving {
  std::vector<GrainPush> steps;
  std::vector<GrainRoll> rolls;  ///< by kind
};

struct GrainSteps {
  double step = 0;        ///< h [s]
  double first_kick = 0;  ///< from the velocities' time to that of the first step's end [s]
  std::size_t count = 0;
  bool drift = true;                      ///< else the grains get their kicks and stay
  bool begun = false;                     ///< there was a step before the first one
  const GrainDriving* driving = nullptr;  ///< of so many steps, where the plane is driven
};

/// A wall upright on the plane, touched from where n·x > c.
struct GrainWall {
  double x = 0, y = 0;  ///< n
  double c = 0;         ///< [m]
  double top = 0;       ///< where it ends, over the plane [m]

  double distance(double at_x, double at_y) const { return x * at_x + y * at_y - c; }
};

/// What all grains share.
struct GrainPlane {
  double radius = 0;                  ///< R, the largest [m]
  double smallest = 0, mean = 0;      ///< of R [m]
  double length_x = 0, length_y = 0;  ///< of the periodic cell [m]; 0: none
  double gravity = 0;                 ///< g, normal to the plane [m/s²]
  double slowest_rebound = 0;         ///< of a landing [m/s]
  std::vector<GrainWall> walls;
};

/// How far apart centres of two uneven grains that touch are at most, seen from above: 2 √(R_a R_b)
/// where both lie on a plane, else both radii [m].
inline double level_reach(const GrainArrays& grains, std::size_t i, std::size_t j) {
  const double a = grains.radius[i], b = grains.radius[j];
  return grains.z.empty() ? std::sqrt(4 * (a * b)) : a + b;
}

/// A grain that has come down on the substrate within a step with that push lands; see
/// land_after_drift() of StepBody. Others stay as they are.
void land_grain(const GrainKind& kind, const GrainPlane& plane, const GrainPush& push,
                const GrainView& grains, std::size_t i);

/// What a distance is shortened by to the nearest image of `length` [m]; 0: there are none.
inline double shift_to_nearest_image(double distance, double length) {
  if (!(std::abs(distance) > 0.5 * length)) return 0;  // most
  return length > 0 ? length * std::nearbyint(distance / length) : 0;
}

/// Squares of the largest speeds along the plane, and away from it or towards it [m²/s²], and the
/// greatest height of a centre where there are walls [m].
struct GrainSpeeds {
  double along2 = 0, across2 = 0;
  double height = 0;

  void add(const GrainSpeeds& other) {
    along2 = std::max(along2, other.along2);
    across2 = std::max(across2, other.across2);
    height = std::max(height, other.height);
  }
};

/// Of the grains of a batch after its steps.
inline GrainSpeeds fastest_of(const GrainBatch& batch, const GrainFeatures& has) {
  GrainSpeeds fastest;
  for (std::size_t k = 0; k < batch.count; ++k) {
    fastest.along2 = std::max(fastest.along2, batch.fastest[k]);
    if (!has.lifts) continue;
    const double vz = batch.grains.vz[k];
    fastest.add({0, vz * vz, batch.grains.z[k]});
  }
  return fastest;
}

/// Calls for the loop of these features on the best instruction set that the machine has. All give
/// the same bits.
class GrainKernels {
 public:
  GrainKernels(const GrainFeatures& features, std::vector<GrainLaw> laws,
               std::vector<GrainKind> kinds, const GrainPlane& plane)
      : features_(features), laws_(std::move(laws)), kinds_(std::move(kinds)), plane_(plane) {}

  static std::string instruction_set();  ///< that is called for: "AVX3"
  const GrainFeatures& features() const { return features_; }
  const std::vector<GrainKind>& kinds() const { return kinds_; }
  const GrainPlane& plane() const { return plane_; }

  /// Appends those k for which grains first[k] and second[k] are nearer than `margin` [m] to each
  /// other's surface.
  void find_near(const GrainArrays& grains, std::span<const std::uint32_t> first,
                 std::span<const std::uint32_t> second, double margin,
                 std::vector<std::uint32_t>& near) const;
  /// Steps of the grains first … last − 1, which meet none: to rounding what single steps do, in
  /// one go but for those that slide on a driven plane. Not where that has rolling friction.
  GrainSpeeds glide(GrainArrays& grains, std::size_t first, std::size_t last,
                    const GrainSteps& steps) const;
  /// Steps of a batch. Returns how many contacts began.
  std::size_t run(GrainBatch& batch, const GrainSteps& steps) const;

 private:
  GrainFeatures features_;
  std::vector<GrainLaw> laws_;  ///< by material × material, then by material × wall
  std::vector<GrainKind> kinds_;
  GrainPlane plane_;
};

}  // namespace slipcheck
