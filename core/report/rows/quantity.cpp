#include "report/rows/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

namespace slipcheck {
namespace {

struct Unit {
  double factor;  ///< in SI
  const char* name;
};

constexpr std::array kLengths = {Unit{1, "m"}, Unit{1e-3, "mm"}, Unit{1e-6, "µm"},
                                 Unit{1e-9, "nm"}};
constexpr std::array kTimes = {Unit{1, "s"}, Unit{1e-3, "ms"}, Unit{1e-6, "µs"}, Unit{1e-9, "ns"}};
constexpr std::array kMasses = {Unit{1, "kg"}, Unit{1e-3, "g"}, Unit{1e-6, "mg"}, Unit{1e-9, "µg"}};
constexpr std::array kVelocities = {Unit{1, "m/s"}, Unit{1e-3, "mm/s"}, Unit{1e-6, "µm/s"},
                                    Unit{1e-9, "nm/s"}};
constexpr std::array kAngularVelocities = {Unit{1, "rad/s"}, Unit{1e-3, "mrad/s"}};
constexpr std::array kSpecificEnergies = {Unit{1, "m²/s²"}, Unit{1e-6, "mm²/s²"}};
constexpr std::array kEnergies = {Unit{1, "J"}, Unit{1e-3, "mJ"}, Unit{1e-6, "µJ"},
                                  Unit{1e-9, "nJ"}, Unit{1e-12, "pJ"}};
constexpr std::array kFrequencies = {Unit{1e6, "MHz"}, Unit{1e3, "kHz"}, Unit{1, "Hz"}};

struct Units {
  std::string_view dimension;
  std::span<const Unit> units;
};
const std::array kUnits = {
    Units{kLength.name, kLengths},
    Units{kTime.name, kTimes},
    Units{kMass.name, kMasses},
    Units{kVelocity.name, kVelocities},
    Units{kAngularVelocity.name, kAngularVelocities},
    Units{kSpecificEnergy.name, kSpecificEnergies},
    Units{kEnergy.name, kEnergies},
    Units{kFrequency.name, kFrequencies},
};

/// The largest unit of which there is at least one, else the smallest; SI where there is no choice.
Unit unit_for(double magnitude, const Dimension& dimension) {
  const auto found = std::find_if(kUnits.begin(), kUnits.end(), [&](const Units& units) {
    return units.dimension == dimension.name;
  });
  if (found == kUnits.end()) return {1, dimension.si};
  // Zero, and what is not finite, have no magnitude.
  if (!std::isfinite(magnitude) || magnitude == 0) {
    return *std::find_if(found->units.begin(), found->units.end(),
                         [](const Unit& unit) { return unit.factor == 1; });
  }
  for (const Unit& unit : found->units)
    if (magnitude >= 0.99995 * unit.factor) return unit;
  return found->units.back();
}

std::string without_negative_zero(std::string text) {
  if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string not_finite(double value) { return std::isnan(value) ? "–" : value > 0 ? "∞" : "−∞"; }

}  // namespace

QuantityFormat::QuantityFormat(double magnitude, const Dimension& dimension, int digits) {
  magnitude = std::abs(magnitude);
  const Unit unit = unit_for(magnitude, dimension);
  unit_ = unit.name;
  factor_ = unit.factor;
  const double scaled = magnitude / factor_;
  if (!std::isfinite(scaled) || scaled == 0) return;
  scientific_ = scaled < 1e-3 || scaled >= 1e6;
  const int leading = static_cast<int>(std::floor(std::log10(scaled * 1.00005)));
  decimals_ = std::clamp(digits - 1 - leading, 0, 6);
}

std::string QuantityFormat::number(double value) const {
  if (!std::isfinite(value)) return not_finite(value);
  const double scaled = value / factor_;
  if (scaled == 0) return "0";
  // What the row's decimals cannot show: far larger, or so small that only zeros would remain.
  const double smallest = 0.5 * std::pow(10.0, -decimals_);
  if (scientific_ || std::abs(scaled) >= 1e6 || std::abs(scaled) < smallest)
    return fmt::format("{:.3g}", scaled);
  return without_negative_zero(fmt::format("{:.{}f}", scaled, decimals_));
}

std::string QuantityFormat::text(double value) const {
  return unit_.empty() || std::isnan(value) ? number(value) : number(value) + " " + unit_;
}

std::string quantity(double value, const Dimension& dimension, int digits) {
  return QuantityFormat(value, dimension, digits).text(value);
}

std::string percent(double share) {
  if (!std::isfinite(share)) return not_finite(share);
  const double value = 100 * share;
  if (value == 0) return "0 %";
  if (std::abs(value) < 1e-3 || std::abs(value) >= 1e5) return fmt::format("{:.1e} %", value);
  const int leading = static_cast<int>(std::floor(std::log10(std::abs(value) * 1.0005)));
  return fmt::format("{:.{}f} %", value, std::clamp(2 - leading, 0, 4));
}

std::string plain_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : not_finite(value);
}

std::string counted(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace slipcheck
