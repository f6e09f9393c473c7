#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/state_archive.h"
#include "harness/observe/assembly.h"
#include "physics/frame.h"

namespace slipcheck {

/// Counts of a quantity over even intervals, as a density of it.
struct Histogram {
  double low = 0, width = 1;     ///< of the first interval, and of each
  std::vector<double> counts;    ///< of each, >= 0
  std::vector<double> expected;  ///< the same where nothing is correlated; empty: not known

  double middle(std::size_t k) const { return low + (static_cast<double>(k) + 0.5) * width; }
};

/// What many bodies show as a whole over a run.
struct Assembly {
  std::vector<double> time;           ///< [s]
  std::vector<AssemblyState> states;  ///< at these
  /// Over the second half of the run, where bodies move: components of δv over their root mean
  /// square, of all bodies and directions.
  Histogram velocity;
  /// Over the second half of the run: pairs by their distance over the mean diameter.
  Histogram pairs;
  double mean_diameter = 0;  ///< [m]
  bool flat = false;         ///< as of AssemblyRegion, at the first sample
  std::size_t bodies = 0;

  /// Probability density of a component [-], what a Maxwellian has, and that with the first term of
  /// Sonine's polynomials,
  ///   φ(c) [1 + a_2 (c⁴/8 − 3c²/4 + 3/8)],  φ(c) = exp(−c²/2)/√(2π)
  /// (T. P. C. van Noije, M. H. Ernst, Granular Matter 1, 57 (1998), in one of its components).
  double velocity_density(std::size_t k) const;
  static double maxwell(double c);
  static double with_sonine(double c, double a2);
  /// a_2 over the second half of the run, mean and standard error of the mean [-]; NaN for none.
  std::pair<double, double> sonine() const;
  /// g at the k-th distance [-]; NaN where no pair is expected.
  double pair_correlation(std::size_t k) const;

  void exchange(StateArchive& archive);
};

/// Looks at a run at even times: at the first frame at or after each.
class AssemblyObserver final : public FrameSink {
 public:
  /// Where a sample of all bodies goes beside the numbers, as the run goes on.
  using States = std::function<void(double time, const std::vector<BodyState>& bodies)>;

  /// The scene, which must outlive it, as of assembly_state(). end: of the run [s], > 0, with so
  /// many samples, >= 2, the first at time 0.
  AssemblyObserver(const ContactScene& scene, double end, std::size_t samples, States states = {});

  void take(double time, const Frame& frame) override;
  std::optional<double> next_look() const override;
  const Assembly& assembly() const { return assembly_; }
  /// What it goes on with.
  void exchange(StateArchive& archive) { archive(next_, assembly_); }

 private:
  void add_velocities(const std::vector<BodyState>& bodies);
  void add_pairs(const std::vector<BodyState>& bodies);

  const ContactScene* scene_;
  double end_;
  std::size_t samples_;
  States states_;
  std::size_t next_ = 0;
  Assembly assembly_;
};

}  // namespace slipcheck
