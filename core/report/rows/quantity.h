#pragma once

#include <cstddef>
#include <string>

#include "scenario/units.h"

namespace slipcheck {

/// In what unit and with how many decimals numbers of one row are shown, so that they compare at a
/// glance.
class QuantityFormat {
 public:
  /// For numbers about as large as `magnitude` [SI], with as many significant digits.
  QuantityFormat(double magnitude, const Dimension& dimension, int digits = 4);

  /// The number alone; "–" for NaN. `value` in SI.
  std::string number(double value) const;
  /// With the unit.
  std::string text(double value) const;
  /// "ms", empty for a pure number.
  const std::string& unit() const { return unit_; }
  /// One unit in SI.
  double factor() const { return factor_; }

 private:
  std::string unit_;
  double factor_ = 1;
  int decimals_ = 0;
  bool scientific_ = false;
};

/// One quantity by itself, "83.01 ms"; `value` in SI.
std::string quantity(double value, const Dimension& dimension, int digits = 4);

/// A share of one as "14.1 %", three significant digits; "–" for NaN.
std::string percent(double share);

/// At most four significant digits without trailing zeros, for pure numbers such as tolerances.
std::string plain_number(double value);

/// "1 scene", "3 scenes"
std::string counted(std::size_t count, const std::string& noun);

}  // namespace slipcheck
