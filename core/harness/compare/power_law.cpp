#include "harness/compare/power_law.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>

namespace slipcheck {
namespace {

/// Columns of the logarithms that agree to this are one variable.
constexpr double kIndependent = 1e-10;

void require_positive(std::span<const double> values, std::size_t points, std::string_view what) {
  if (values.size() != points)
    throw std::invalid_argument(
        fmt::format("power law: {} has {} values for {} points", what, values.size(), points));
  for (double value : values)
    if (!(value > 0) || !std::isfinite(value))
      throw std::invalid_argument(
          fmt::format("power law: {} must be > 0 and finite, got {:g}", what, value));
}

}  // namespace

double PowerLaw::operator()(std::initializer_list<double> x) const {
  assert(x.size() == exponent.size());
  double y = factor;
  auto p = exponent.begin();
  for (double value : x) y *= std::pow(value, *p++);
  return y;
}

PowerLaw fit_power_law(std::span<const std::vector<double>> x, std::span<const double> y,
                       std::span<const double> error) {
  const std::size_t points = y.size(), unknowns = x.size() + 1;
  if (points < unknowns)
    throw std::invalid_argument(
        fmt::format("power law: {} points for {} unknowns", points, unknowns));
  require_positive(y, points, "y");
  for (const auto& variable : x) require_positive(variable, points, "x");
  const bool has_errors = !error.empty();
  if (has_errors) require_positive(error, points, "error");

  // Logarithms less their mean: the factor then does not spoil the condition of the exponents.
  const auto rows = static_cast<Eigen::Index>(points);
  const auto columns = static_cast<Eigen::Index>(unknowns);
  Eigen::MatrixXd a(rows, columns);
  Eigen::VectorXd b(rows), weight(rows), middle = Eigen::VectorXd::Zero(columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto at = static_cast<std::size_t>(i);
    weight[i] = has_errors ? y[at] / error[at] : 1;
    b[i] = weight[i] * std::log(y[at]);
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k) + 1;
    for (Eigen::Index i = 0; i < rows; ++i)
      a(i, column) = std::log(x[k][static_cast<std::size_t>(i)]);
    middle[column] = a.col(column).mean();
    a.col(column).array() -= middle[column];
  }
  a.col(0).setOnes();
  a = weight.asDiagonal() * a;

  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(kIndependent);
  qr.compute(a);
  if (qr.rank() < columns)
    throw std::invalid_argument("power law: the variables must vary, each on its own");
  const Eigen::VectorXd solution = qr.solve(b);
  const Eigen::MatrixXd r_inverse =
      qr.matrixR().topRows(columns).triangularView<Eigen::Upper>().solve(
          Eigen::MatrixXd::Identity(columns, columns));
  const Eigen::MatrixXd half = qr.colsPermutation() * r_inverse;
  Eigen::MatrixXd covariance = half * half.transpose();

  const double chi2 = (a * solution - b).squaredNorm();
  const auto freedom = static_cast<double>(points - unknowns);
  PowerLaw law;
  if (has_errors) {
    if (freedom > 0) law.chi2_per_degree = chi2 / freedom;
    if (law.chi2_per_degree > 1) covariance *= law.chi2_per_degree;
  } else {
    covariance *= freedom > 0 ? chi2 / freedom : kNotObserved;
  }
  // ln c = solution_0 − Σ p_k middle_k.
  Eigen::VectorXd to_factor = -middle;
  to_factor[0] = 1;
  law.factor = std::exp(to_factor.dot(solution));
  law.factor_error = law.factor * std::sqrt(to_factor.dot(covariance * to_factor));
  for (Eigen::Index k = 1; k < columns; ++k) {
    law.exponent.push_back(solution[k]);
    law.exponent_error.push_back(std::sqrt(covariance(k, k)));
  }
  return law;
}

PowerLaw fit_power_law(const std::vector<double>& x, std::span<const double> y,
                       std::span<const double> error) {
  return fit_power_law(std::span(&x, 1), y, error);
}

}  // namespace slipcheck
