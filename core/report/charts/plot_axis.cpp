#include "report/charts/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace slipcheck {
namespace {

constexpr double kRoom = 0.04;  // beside the data, of the range
constexpr double kSlack = 1e-9;

/// 10^exponent as it is read best: 0.01 … 1000 in full.
std::string power_of_ten(int exponent) {
  if (exponent >= -2 && exponent <= 3) return fmt::format("{:g}", std::pow(10.0, exponent));
  std::string text = "10^{" + std::to_string(exponent) + "}";
  if (const auto minus = text.find('-'); minus != std::string::npos) text.replace(minus, 1, "−");
  return text;
}

std::string with_true_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

}  // namespace

std::vector<double> round_ticks(double low, double high) {
  const double raw = (high - low) / 5;
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  // The nearest of 1, 2, 5 and 10 on a logarithmic scale.
  const double share = raw / decade;
  const double step = decade * (share < std::sqrt(2)    ? 1
                                : share < std::sqrt(10) ? 2
                                : share < std::sqrt(50) ? 5
                                                        : 10);
  std::vector<double> result;
  for (double k = std::ceil(low / step - kSlack); k * step <= high + kSlack * step; ++k)
    result.push_back(k * step);
  return result;
}

PlotAxis::PlotAxis(AxisSpec spec, const std::vector<double>& values) : spec_(std::move(spec)) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double low = kInfinity, high = -kInfinity;
  for (double value : values) {
    if (!std::isfinite(value) || (spec_.logarithmic && value <= 0)) continue;
    if (spec_.logarithmic) value = std::log10(value);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) low = high = 0;
  const double room = high > low ? kRoom * (high - low) : std::max(0.05 * std::abs(high), 1e-300);
  const auto back = [&](double value) { return spec_.logarithmic ? std::pow(10, value) : value; };
  low_ = spec_.low.value_or(back(low - room));
  high_ = spec_.high.value_or(back(high + room));
  if (!(high_ > low_)) high_ = spec_.logarithmic ? 10 * low_ : low_ + 1;
}

double PlotAxis::fraction(double value) const {
  if (!spec_.logarithmic) return (value - low_) / (high_ - low_);
  return value > 0 ? std::log(value / low_) / std::log(high_ / low_) : NAN;
}

std::vector<PlotAxis::Tick> PlotAxis::ticks() const {
  if (spec_.logarithmic) return logarithmic_ticks();
  const std::vector<double> values = round_ticks(low_, high_);
  // As many decimals as the ticks' distance needs.
  const double step = values.size() > 1 ? values[1] - values[0] : 1;
  const int decimals = static_cast<int>(std::ceil(-std::log10(step) - kSlack));
  std::vector<Tick> result;
  for (double value : values) {
    if (std::abs(value) < kSlack * (high_ - low_)) value = 0;
    const bool in_full = decimals <= 4 && std::abs(value) < 1e5;
    result.push_back(
        {value, with_true_minus(in_full ? fmt::format("{:.{}f}", value, std::max(decimals, 0))
                                        : fmt::format("{:.3g}", value))});
  }
  return result;
}

std::vector<PlotAxis::Tick> PlotAxis::logarithmic_ticks() const {
  const int first = static_cast<int>(std::floor(std::log10(low_) + kSlack));
  const int last = static_cast<int>(std::ceil(std::log10(high_) - kSlack));
  const double decades = std::log10(high_ / low_);
  const int every = decades > 14 ? 4 : decades > 7 ? 2 : 1;
  std::vector<Tick> result;
  for (int n = first; n <= last; ++n)
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10.0, n);
      if (value < low_ * (1 - kSlack) || value > high_ * (1 + kSlack)) continue;
      if (digit == 1)
        result.push_back({value, n % every == 0 ? power_of_ten(n) : ""});
      else if (decades <= 1.7 && (digit == 2 || digit == 5))
        result.push_back({value, fmt::format("{:g}", value)});
      else if (every == 1)
        result.push_back({value, ""});
    }
  return result;
}

}  // namespace slipcheck
