#pragma once

#include <optional>
#include <string>
#include <vector>

namespace slipcheck {

/// Multiples of 1, 2 or 5 times a power of ten from low to high, > low: three to eight of them.
std::vector<double> round_ticks(double low, double high);

/// One axis as asked for.
struct AxisSpec {
  std::string label;  ///< with the unit in brackets; ^ and _ as in plot_text.h
  bool logarithmic = false;
  /// In the unit of the label; where not given, the data decide. > 0 on a logarithmic axis.
  std::optional<double> low = std::nullopt, high = std::nullopt;
};

/// An axis with its range, from values to places.
class PlotAxis {
 public:
  struct Tick {
    double value;
    std::string label;  ///< empty for a minor tick
  };

  /// The range that is not given covers `values` with a little room; NaN and, on a logarithmic
  /// axis, what is not positive do not count.
  PlotAxis(AxisSpec spec, const std::vector<double>& values);

  const AxisSpec& spec() const { return spec_; }
  double low() const { return low_; }
  double high() const { return high_; }
  /// 0 at the low end, 1 at the high end; NaN for what a logarithmic axis cannot show.
  double fraction(double value) const;
  /// With labels: round numbers; on a logarithmic axis powers of ten, between them 2 and 5 where
  /// few decades leave room, and minor ticks.
  std::vector<Tick> ticks() const;

 private:
  std::vector<Tick> logarithmic_ticks() const;

  AxisSpec spec_;
  double low_ = 0, high_ = 1;
};

}  // namespace slipcheck
