#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "figures/box_runs.h"
#include "figures/statement.h"
#include "harness/compare/power_law.h"

namespace slipcheck {

// What L reads off several runs in a box.

/// A number with its standard error.
struct Measured {
  double value = 0, error = 0;

  std::string text() const;  ///< "1.94 ± 0.01"
};

/// The mean of independent numbers.
Measured mean_of(std::span<const Measured> values);

/// a/b of independent numbers, b > 0.
Measured ratio_of(const Measured& a, const Measured& b);

Measured height_of(const BoxMeans& run);  ///< H [m]

/// The geometric mean of H_a/H_b over runs of the same number, at least one.
Measured height_ratio(std::span<const BoxMeans> a, std::span<const BoxMeans> b);

/// Heights that L calls equal: their ratio is 1 within the 15 % that L gives as H's scatter.
Statement equal_heights(std::string what, std::string stated, const Measured& ratio);

/// H ∝ x^p, twice.
struct HeightLaw {
  PowerLaw plain;     ///< least squares in logarithms, all runs alike, as L has it
  PowerLaw weighted;  ///< with the errors of H

  Measured exponent() const;           ///< p of `plain`
  Measured weighted_exponent() const;  ///< p of `weighted`
};

/// The fit to the runs with least <= x <= most; there are two at least.
HeightLaw fit_heights(std::span<const double> x, std::span<const BoxMeans> runs, double least = 0,
                      double most = INFINITY);

}  // namespace slipcheck
