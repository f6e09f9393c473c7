#include "figures/box_fits.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace slipcheck {
namespace {

constexpr double kHeightScatter = 0.15;  ///< of H; L has 10 to 15 %
constexpr double kBoundRounding = 1e-9;  ///< relative, of the ends of a range

Measured exponent_of(const PowerLaw& law) { return {law.exponent[0], law.exponent_error[0]}; }

}  // namespace

std::string Measured::text() const {
  const int digits = error < 0.005 ? 3 : 2;
  return fmt::format("{:.{}f} ± {:.{}f}", value, digits, error, digits);
}

Measured mean_of(std::span<const Measured> values) {
  Measured mean;
  for (const Measured& each : values) {
    mean.value += each.value;
    mean.error += each.error * each.error;
  }
  const auto count = static_cast<double>(values.size());
  return {mean.value / count, std::sqrt(mean.error) / count};
}

Measured ratio_of(const Measured& a, const Measured& b) {
  const double ratio = a.value / b.value;
  return {ratio, std::abs(ratio) * std::hypot(a.error / a.value, b.error / b.value)};
}

Measured height_of(const BoxMeans& run) { return {run.height, run.height_error}; }

Measured height_ratio(std::span<const BoxMeans> a, std::span<const BoxMeans> b) {
  std::vector<Measured> logarithms;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Measured ratio = ratio_of(height_of(a[k]), height_of(b[k]));
    logarithms.push_back({std::log(ratio.value), ratio.error / ratio.value});
  }
  const Measured mean = mean_of(logarithms);
  return {std::exp(mean.value), std::exp(mean.value) * mean.error};
}

Statement equal_heights(std::string what, std::string stated, const Measured& ratio) {
  std::string remark = "Equal: within the 15 % that L gives as H's scatter.";
  if (std::abs(ratio.value - 1) > 4 * ratio.error) remark += " The runs tell them apart.";
  return {std::move(what), std::move(stated), 1 - kHeightScatter, 1 + kHeightScatter,
          ratio.value,     ratio.error,       std::move(remark)};
}

Measured HeightLaw::exponent() const { return exponent_of(plain); }
Measured HeightLaw::weighted_exponent() const { return exponent_of(weighted); }

HeightLaw fit_heights(std::span<const double> x, std::span<const BoxMeans> runs, double least,
                      double most) {
  std::vector<double> at, height, error;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k] < least * (1 - kBoundRounding) || x[k] > most * (1 + kBoundRounding)) continue;
    at.push_back(x[k]);
    height.push_back(runs[k].height);
    error.push_back(runs[k].height_error);
  }
  return {fit_power_law(at, height), fit_power_law(at, height, error)};
}

}  // namespace slipcheck
