#include "scenario/units.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <system_error>

namespace slipcheck {
namespace {

/// How many of the SI's (kg, m, s, rad) a unit is: scale · kg^mass m^length s^time rad^angle.
struct Measure {
  double scale = 1;
  std::array<double, 4> powers = {};
};

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using UnitPointer = std::unique_ptr<ut_unit, FreeUnit>;

/// UDUNITS-2 with its data base. The library keeps global state while it parses: one at a time.
class UnitLibrary {
 public:
  static UnitLibrary& instance() {
    static UnitLibrary library;
    return library;
  }

  /// Nothing if the library does not know the unit; throws BadQuantity for one that is no plain
  /// multiple of base units.
  std::optional<Measure> measure(const std::string& name) {
    if (name.find('\n') != std::string::npos) return std::nullopt;  // which it would print
    const std::lock_guard lock(mutex_);
    const UnitPointer unit(ut_parse(system_.get(), name.c_str(), UT_UTF8));
    if (!unit) return std::nullopt;
    Visit visit{this, {}, ""};
    ut_accept_visitor(unit.get(), &kVisitor, &visit);
    if (!visit.refusal.empty()) throw BadQuantity(visit.refusal);
    return visit.measure;
  }

 private:
  struct FreeSystem {
    void operator()(ut_system* system) const { ut_free_system(system); }
  };
  struct Visit {
    UnitLibrary* library;
    Measure measure;
    std::string refusal;
  };

  UnitLibrary() {
    ut_set_error_message_handler(ut_ignore);
    system_.reset(ut_read_xml(nullptr));
    if (!system_) {
      throw BadQuantity(
          "needs the UDUNITS-2 data base to read a unit, which cannot be loaded (package "
          "libudunits2-data, or the path in UDUNITS2_XML_PATH)");
    }
    add_symbol("deg", "arc_degree");
    add_symbol("dyn", "dyne");
    add_symbol("P", "poise");
    constexpr std::array kBaseNames = {"kilogram", "meter", "second", "radian"};
    for (std::size_t i = 0; i < base_.size(); ++i) {
      base_[i].reset(ut_get_unit_by_name(system_.get(), kBaseNames[i]));
    }
  }

  /// Symbols of the field that the data base lacks.
  void add_symbol(const char* symbol, const char* name) {
    const UnitPointer unit(ut_get_unit_by_name(system_.get(), name));
    ut_map_symbol_to_unit(symbol, UT_UTF8, unit.get());
  }

  static Visit& visit(void* argument) { return *static_cast<Visit*>(argument); }

  static ut_status multiply(Visit& to, const ut_unit* basic, int power) {
    for (std::size_t i = 0; i < to.library->base_.size(); ++i) {
      if (ut_compare(basic, to.library->base_[i].get()) == 0) {
        to.measure.powers[i] += power;
        return UT_SUCCESS;
      }
    }
    to.refusal = "must be in units of mass, length, time and angle";
    return UT_VISIT_ERROR;
  }
  static ut_status visit_basic(const ut_unit* unit, void* argument) {
    return multiply(visit(argument), unit, 1);
  }
  static ut_status visit_product(const ut_unit*, int count, const ut_unit* const* basic,
                                 const int* powers, void* argument) {
    for (int i = 0; i < count; ++i) {
      const ut_status status = multiply(visit(argument), basic[i], powers[i]);
      if (status != UT_SUCCESS) return status;
    }
    return UT_SUCCESS;
  }
  static ut_status visit_galilean(const ut_unit*, double scale, const ut_unit* underlying,
                                  double offset, void* argument) {
    if (offset != 0) {
      visit(argument).refusal = "must have a unit without an offset";
      return UT_VISIT_ERROR;
    }
    visit(argument).measure.scale *= scale;
    return ut_accept_visitor(underlying, &kVisitor, argument);
  }
  static ut_status visit_timestamp(const ut_unit*, const ut_unit*, double, void* argument) {
    visit(argument).refusal = "must not be a date";
    return UT_VISIT_ERROR;
  }
  static ut_status visit_logarithmic(const ut_unit*, double, const ut_unit*, void* argument) {
    visit(argument).refusal = "must not have a logarithmic unit";
    return UT_VISIT_ERROR;
  }

  static constexpr ut_visitor kVisitor = {visit_basic, visit_product, visit_galilean,
                                          visit_timestamp, visit_logarithmic};

  std::mutex mutex_;
  std::unique_ptr<ut_system, FreeSystem> system_;
  std::array<UnitPointer, 4> base_;
};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

BadQuantity unknown_unit(std::string_view unit, const Dimension& dimension) {
  return BadQuantity(fmt::format("must be {}, as in \"{}\"; the unit \"{}\" is not known",
                                 with_article(dimension), dimension.example, unit));
}

/// A unit with broken powers, such as "N/m^1.5" or "cm^-0.5", which UDUNITS cannot write: factors
/// separated by blanks, '.', '*' or '/', each with its own power.
Measure measure_of_factors(std::string_view unit, const Dimension& dimension) {
  Measure total;
  double sign = 1;
  for (std::string_view rest = unit; !rest.empty();) {
    const std::size_t name_end = std::min(rest.find_first_of(" *./^"), rest.size());
    const std::string name(rest.substr(0, name_end));
    rest.remove_prefix(name_end);
    double power = sign;
    if (rest.starts_with('^')) {
      rest.remove_prefix(1);
      double written = 0;
      const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), written);
      if (error != std::errc() || !(std::abs(written) <= 20)) throw unknown_unit(unit, dimension);
      rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
      power *= written;
    }
    if (name != "1") {
      const auto factor = name.empty() ? std::nullopt : UnitLibrary::instance().measure(name);
      if (!factor) throw unknown_unit(unit, dimension);
      total.scale *= std::pow(factor->scale, power);
      for (std::size_t i = 0; i < total.powers.size(); ++i) {
        total.powers[i] += power * factor->powers[i];
      }
    }
    sign = 1;
    const std::size_t next = std::min(rest.find_first_not_of(" *./"), rest.size());
    if (rest.substr(0, next).find('/') != std::string_view::npos) sign = -1;
    if (next == rest.size() && next > 0) throw unknown_unit(unit, dimension);
    rest.remove_prefix(next);
  }
  return total;
}

bool has_broken_power(std::string_view unit) {
  for (std::size_t i = unit.find('^'); i != std::string_view::npos; i = unit.find('^', i + 1)) {
    std::size_t end = i + 1;
    while (end < unit.size() && (is_digit(unit[end]) || unit[end] == '-')) ++end;
    if (end + 1 < unit.size() && unit[end] == '.' && is_digit(unit[end + 1])) return true;
  }
  return false;
}

Measure measure_of(std::string_view written, const Dimension& dimension) {
  std::string unit(written);
  if (unit.starts_with('/')) unit.insert(unit.begin(), '1');
  // "5 3 m" and "0x10" are mistakes, though UDUNITS would read a scale into the unit.
  const bool reciprocal = unit.starts_with("1/");
  if (!reciprocal && (is_digit(unit[0]) || unit[0] == '-' || unit[0] == '+' || unit[0] == '.')) {
    throw unknown_unit(written, dimension);
  }
  if (has_broken_power(unit)) return measure_of_factors(unit, dimension);
  const auto measure = UnitLibrary::instance().measure(unit);
  if (!measure) throw unknown_unit(written, dimension);
  return *measure;
}

/// Scales by powers of ten are divided by where that is exact, so that 2 mm is the double nearest
/// to 0.002.
double scaled(double value, double scale) {
  const double inverse = std::round(1 / scale);
  const bool is_inverse = inverse > 1 && inverse < 1e15 && std::abs(scale * inverse - 1) < 4e-16;
  return is_inverse ? value / inverse : value * scale;
}

double finite(double value) {
  if (!std::isfinite(value)) throw BadQuantity("must be a finite number");
  return value;
}

/// Reads the number that a text starts with and takes it off the text.
double take_number(std::string_view& text) {
  std::string_view digits = text;
  if (digits.starts_with('+') && digits.size() > 1 && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    throw BadQuantity("must be in the range of double precision");
  }
  if (error != std::errc()) throw BadQuantity("must be a number");
  text = digits.substr(static_cast<std::size_t>(end - digits.data()));
  return finite(value);
}

}  // namespace

std::string with_article(const Dimension& dimension) {
  const bool vowel = std::string_view("aeiou").find(dimension.name[0]) != std::string_view::npos;
  return (vowel ? "an " : "a ") + std::string(dimension.name);
}

const char* unit_name(const Dimension& dimension, UnitSystem system) {
  return system == UnitSystem::si ? dimension.si : dimension.cgs;
}

double to_si(double value, const Dimension& dimension, UnitSystem system) {
  if (dimension.angle == 1 && dimension.time == 0) return value * std::numbers::pi / 180;
  if (system == UnitSystem::si) return value;
  const double exponent = -3 * dimension.mass - 2 * dimension.length;
  return exponent < 0 ? value / std::pow(10, -exponent) : value * std::pow(10, exponent);
}

double parse_number(std::string_view text) {
  const double value = take_number(text);
  if (!text.empty()) throw BadQuantity("must be a number");
  return value;
}

Quantity parse_quantity(std::string_view text, const Dimension& dimension) {
  std::string_view rest = text;
  const double number = take_number(rest);
  if (rest.empty()) return {number, false};
  rest = trimmed(rest);
  if (rest.empty()) throw BadQuantity("must be a number");

  const Measure unit = measure_of(rest, dimension);
  // 1/s is accepted for rad/s, but hertz are cycles: 31 Hz might be meant either way.
  const bool turns = dimension.angle == 1 && dimension.time == -1;
  const bool per_second = turns && unit.powers[3] == 0 && rest.find("Hz") == std::string_view::npos;
  const std::array powers = {dimension.mass, dimension.length, dimension.time,
                             per_second ? 0 : dimension.angle};
  for (std::size_t i = 0; i < powers.size(); ++i) {
    if (std::abs(unit.powers[i] - powers[i]) > 1e-9) {
      throw BadQuantity(
          fmt::format("must be {}, as in \"{}\"", with_article(dimension), dimension.example));
    }
  }
  return {finite(scaled(number, unit.scale)), true};
}

}  // namespace slipcheck
