#pragma once

#include <cmath>
#include <numbers>

namespace slipcheck {

/// The vibrating floor of a vertical box, L Sec. III: z_f(t) = A0 sin(2π f t). At rest where A0 or
/// f is 0. Phase zero, at the times n/f, is where it passes z = 0 upwards.
struct ShakenFloor {
  double amplitude = 0;  ///< A0 [m], >= 0
  double frequency = 0;  ///< f [Hz], >= 0

  double angular_frequency() const { return 2 * std::numbers::pi * frequency; }  ///< ω [1/s]
  bool is_still() const { return amplitude == 0 || frequency == 0; }
  double height(double t) const { return amplitude * std::sin(angular_frequency() * t); }  ///< [m]
  double velocity(double t) const {  ///< [m/s]
    return largest_speed() * std::cos(angular_frequency() * t);
  }
  double acceleration(double t) const {  ///< [m/s²]
    return -angular_frequency() * angular_frequency() * height(t);
  }
  double largest_speed() const { return amplitude * angular_frequency(); }  ///< V [m/s]
};

}  // namespace slipcheck
