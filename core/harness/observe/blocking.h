#pragma once

#include <cstddef>
#include <span>

#include "harness/observe/observables.h"

namespace slipcheck {

/// Fewer samples than this tell nothing about how they are correlated: their mean has no error.
inline constexpr std::size_t kFewestForAnError = 32;

/// The mean of a correlated series and how far it may be from the mean of an endless one.
struct BlockedMean {
  double mean = kNotObserved;            ///< in the unit of the samples; NaN for none
  double standard_error = kNotObserved;  ///< of the mean, >= 0; NaN below kFewestForAnError samples
  /// Samples' integrated correlation time, ½ + Σ ρ_k over the lags k >= 1, in samples: ½ where they
  /// are independent. NaN where there is no error.
  double correlation_time = kNotObserved;
  double effective_samples = kNotObserved;  ///< n/(2 correlation_time), <= n
  std::size_t samples = 0;                  ///< n
  std::size_t blocks = 0;  ///< whose scatter gives the error; 0 where there is none
  /// The error no longer depended on the block size. If not, the series is too short for its
  /// correlation and `standard_error` is only a lower bound.
  bool plateau = false;

  /// Half of the interval that holds the true mean with 95 % probability: Student's factor of
  /// blocks − 1 degrees of freedom times the standard error.
  double half_width95() const;
};

/// The half-width of the central 95 % of Student's t with that many degrees of freedom, >= 3, by
/// the Cornish-Fisher series (Abramowitz and Stegun 26.7.5) to 0.3 %.
double student_factor95(std::size_t degrees_of_freedom);

/// Flyvbjerg and Petersen, J. Chem. Phys. 91, 461 (1989): the scatter of the means of blocks of B
/// samples gives an error SE_B of the whole mean that rises with B until blocks are independent.
/// The block size is the smallest with B³ > 2 n g_B², g_B = (SE_B/SE_1)² (Lee et al., Phys. Rev. E
/// 83, 066706 (2011); also Wolff, Comput. Phys. Commun. 156, 143 (2004)): there what the
/// correlation of neighbouring blocks still hides, g/B relative, falls below the scatter of the
/// estimate itself, √(2B/n). Sizes grow by about √2; at least 6 blocks remain. A series that
/// repeats itself with a whole number of blocks has no scatter; the error is never below what one
/// sample more or less does, σ/n.
BlockedMean blocked_mean(std::span<const double> series);

}  // namespace slipcheck
