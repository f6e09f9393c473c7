#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "harness/observe/observables.h"

namespace slipcheck {

/// y = c Π x_k^p_k.
struct PowerLaw {
  double factor = kNotObserved;        ///< c, in y's unit over those of the x_k^p_k, > 0
  double factor_error = kNotObserved;  ///< standard error of c
  std::vector<double> exponent;        ///< p_k [-]
  std::vector<double> exponent_error;  ///< standard errors of p_k; NaN where nothing tells them
  /// χ² per degree of freedom: about 1 where the law holds within the errors. NaN where no errors
  /// were given or no degree of freedom is left.
  double chi2_per_degree = kNotObserved;

  double operator()(std::initializer_list<double> x) const;  ///< y at one x_k each
};

/// The power law nearest to points (x_1, …; y): least squares of ln y − ln c − Σ p_k ln x_k,
/// weighted with the error of ln y, σ/y to first order in σ.
///
/// `x`: the variables, each with one value > 0 a point. `y` > 0. `error`: the standard errors σ of
/// y, > 0; empty where they are unknown, and then all points weigh the same and the exponents'
/// errors come from the scatter. Known errors that are too small for the scatter (χ² per degree
/// above 1) make the exponents' errors larger by its square root, as the law then misses something.
/// Throws std::invalid_argument with value and rule for other data, for fewer points than unknowns,
/// and for variables that do not vary independently.
PowerLaw fit_power_law(std::span<const std::vector<double>> x, std::span<const double> y,
                       std::span<const double> error = {});

/// y = c x^p of one variable.
PowerLaw fit_power_law(const std::vector<double>& x, std::span<const double> y,
                       std::span<const double> error = {});

}  // namespace slipcheck
