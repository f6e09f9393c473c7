#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace slipcheck {

/// What bare numbers of a file are in.
enum class UnitSystem { si, cgs };

/// A physical dimension as powers of kilogram, metre, second and radian. The radian counts, so that
/// 31 rad/s is no frequency and 5 deg no coefficient of friction.
struct Dimension {
  const char* name;  ///< "length"
  double mass = 0;
  double length = 0;
  double time = 0;
  double angle = 0;
  const char* si = "";       ///< unit of a bare number in an SI file
  const char* cgs = "";      ///< and in a CGS one
  const char* example = "";  ///< a text with a unit
};

inline constexpr Dimension kPureNumber{"number", 0, 0, 0, 0, "", "", "1 %"};
inline constexpr Dimension kLength{"length", 0, 1, 0, 0, "m", "cm", "2 mm"};
inline constexpr Dimension kTime{"time", 0, 0, 1, 0, "s", "s", "3 ms"};
inline constexpr Dimension kMass{"mass", 1, 0, 0, 0, "kg", "g", "5 g"};
inline constexpr Dimension kDensity{"density", 1, -3, 0, 0, "kg/m3", "g/cm3", "7.85 g/cm3"};
inline constexpr Dimension kPressure{"pressure", 1, -1, -2, 0, "Pa", "dyn/cm2", "206 GPa"};
inline constexpr Dimension kViscosity{"viscosity", 1, -1, -1, 0, "Pa s", "poise", "10 Pa s"};
inline constexpr Dimension kFrequency{"frequency", 0, 0, -1, 0, "Hz", "Hz", "5 Hz"};
inline constexpr Dimension kRate{"rate", 0, 0, -1, 0, "1/s", "1/s", "8 1/s"};
inline constexpr Dimension kAngle{"angle", 0, 0, 0, 1, "deg", "deg", "0.1 rad"};
inline constexpr Dimension kVelocity{"velocity", 0, 1, -1, 0, "m/s", "cm/s", "10 cm/s"};
inline constexpr Dimension kAngularVelocity{"angular velocity", 0, 0, -1, 1, "rad/s", "rad/s",
                                            "50 rad/s"};
inline constexpr Dimension kAcceleration{"acceleration", 0, 1, -2, 0, "m/s2", "cm/s2", "9.81 m/s2"};
inline constexpr Dimension kStiffness{"stiffness", 1, 0, -2, 0, "N/m", "dyn/cm", "1e5 N/m"};
inline constexpr Dimension kPerRootLength{"a roughness factor", 0, -0.5, 0, 0, "m^-0.5", "cm^-0.5",
                                          "1 cm^-0.5"};
inline constexpr Dimension kSpecificEnergy{"energy per mass", 0,        2,         -2, 0,
                                           "m2/s2",           "cm2/s2", "1 cm2/s2"};
inline constexpr Dimension kImpulse{"impulse", 1, 1, -1, 0, "N s", "dyn s", "0.3 N s"};
inline constexpr Dimension kEnergy{"energy", 1, 2, -2, 0, "J", "erg", "1 erg"};

/// "a length", "an angle"
std::string with_article(const Dimension& dimension);

/// Unit of a bare number in a file of these units, "" for a pure number.
const char* unit_name(const Dimension& dimension, UnitSystem system);

/// A bare number of a file in SI (angles in radians).
double to_si(double value, const Dimension& dimension, UnitSystem system);

/// The rule that a number or unit breaks, "must be a finite number".
class BadQuantity : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The whole text as a finite decimal number. Throws BadQuantity.
double parse_number(std::string_view text);

/// A text as it may stand in a file: a bare number or one with its unit.
struct Quantity {
  double value = 0;  ///< in SI where there is a unit, else as it stands
  bool has_unit = false;
};

/// Reads "2", "2 mm" or "1.2e-3 dyn s/cm"; a unit must have the dimension. Throws BadQuantity.
/// The unit data base is loaded when the first unit occurs.
Quantity parse_quantity(std::string_view text, const Dimension& dimension);

}  // namespace slipcheck
