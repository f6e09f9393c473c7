#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "harness/observe/blocking.h"
#include "harness/observe/observables.h"
#include "physics/frame.h"
#include "scene/scene.h"

namespace slipcheck {

/// h_cm0 of L (14): the height of the centre of mass over the floor [m] of the scene's bodies at
/// rest in a triangular lattice,
///
///   h_cm0 = (d0/2N) {n_b [(1 − √3/2) n_h + √3/2 n_h²] + n_r (1 + √3 n_h)},
///
/// N = n_b n_h + n_r: n_h full rows of n_b bodies, each √3/2 d0 over the one below, and n_r < n_b
/// bodies in the row on top. d0 is the mean diameter. Every row holds n_b = ⌊width/d0 − ½⌋, at
/// least one, as neighbouring rows are shifted by d0/2 against each other: 9 in a box 10 d0 wide.
/// In a box narrower than 1.5 d0 one body a row is shifted by width − d0 only, and rows are √(d0² −
/// (width − d0)²) apart. `scene` has a box and a body.
double resting_height(const Scene& scene);

/// When a box is looked at and which looks count.
struct BoxSampling {
  /// Time between samples [s], > 0, where the floor has no frequency; else it is a share of 1/f.
  double interval = 0;
  std::size_t per_period = 1;  ///< samples, > 0; 1: at phase zero alone
  std::size_t discard = 0;     ///< periods before the first sample
  bool until_steady = false;   ///< and more, until H, K and R are steady (steady_state.h)
};

/// Time between two samples of this scene in a box [s].
double sampling_interval(const Scene& scene, const BoxSampling& sampling);

/// What was seen at each sample after the `discard` periods; all of one length.
struct BoxSeries {
  std::vector<double> time;               ///< [s]
  std::vector<double> height;             ///< H [m]
  std::vector<double> kinetic_energy;     ///< K [J]
  std::vector<double> rotational_energy;  ///< R [J]
  std::vector<double> collision_rate;     ///< over the interval before the sample [1/s]
};

/// What a scene in a box shows as a whole, defined in docs/observables.md.
struct BoxObservables {
  BlockedMean height;             ///< H [m]
  BlockedMean kinetic_energy;     ///< K, of translation, per body [J]
  BlockedMean rotational_energy;  ///< R, per body [J]
  BlockedMean collision_rate;     ///< of two bodies, all bodies together [1/s]
  std::size_t samples = 0;        ///< that the means are taken over
  std::size_t discarded = 0;      ///< periods before the first of them
  bool steady = false;            ///< H, K and R show no trend over these samples
};

/// Samples a scene in a box at phase zero of its floor, for the reference and for engines alike.
///
/// H, K, R and the number of collisions are linear between the two frames that enclose n/f; exact
/// where a frame falls on it, as the reference's do. Between frames a step h apart the error is at
/// most, for H, g h²/8 + Δv h/4 with Δv what collisions within the step change of the centre of
/// mass's velocity; for K, m g² h²/8 for a body in free flight. The energy that a collision within
/// the step changes counts in the proportion of the step that lies before n/f, which is right on
/// the average over where in the step it falls.
class BoxObserver final : public FrameSink {
 public:
  /// `scene` has a box and outlives the observer. Where frames do not count the collisions, each
  /// Touch of two bodies that did not touch in the frame before is one: an engine thus misses
  /// collisions of a pair in consecutive steps.
  /// Throws std::invalid_argument for a sampling interval that is not > 0.
  BoxObserver(const Scene& scene, const BoxSampling& sampling);

  void take(double time, const Frame& frame) override;

  const BoxSeries& series() const { return series_; }

  /// The means over the samples so far.
  BoxObservables finish() const;

 private:
  /// Frames this near to a phase zero, of the interval, fall on it: times are rounded.
  static constexpr double kOnTime = 1e-9;

  /// H, K, R and collisions so far.
  using Look = std::array<double, 4>;
  Look look_at(const Frame& frame) const;
  void count_collisions(const Frame& frame);
  void sample(double time, const Look& look);

  const Scene* scene_;
  BoxSampling sampling_;
  double rest_, mass_;
  BoxSeries series_;
  std::size_t next_;  ///< the number n of the next sample
  bool began_ = false;
  double time_ = 0;                          ///< of the last frame
  Look look_{};                              ///< at it
  double collisions_before_ = kNotObserved;  ///< at the last n/f
  std::uint64_t collisions_ = 0;
  std::vector<std::pair<int, int>> touching_, now_;  ///< pairs in order
};

}  // namespace slipcheck
