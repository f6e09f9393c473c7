#include "engine/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace slipcheck {
namespace {

/// "a whole number >= 1 and <= 4", "a number >= 0 m/s"
std::string numbers_of(const SettingInfo& known) {
  std::string text = known.whole ? "a whole number" : "a number";
  if (std::isfinite(known.low)) text += fmt::format(" >= {}", known.low);
  if (std::isfinite(known.low) && std::isfinite(known.high)) text += " and";
  if (std::isfinite(known.high)) text += fmt::format(" <= {}", known.high);
  if (!known.unit.empty()) text += ' ' + known.unit;
  return text;
}

bool takes(const SettingInfo& known, double number) {
  return std::isfinite(number) && number >= known.low && number <= known.high &&
         !(known.whole && number != std::floor(number));
}

bool takes(const SettingInfo& known, const std::string& word) {
  return known.choices.empty() || std::ranges::find(known.choices, word) != known.choices.end();
}

}  // namespace

std::vector<SettingFault> check_settings(const std::vector<SettingInfo>& known,
                                         const Settings& settings) {
  std::vector<SettingFault> faults;
  for (const auto& [name, value] : settings) {
    const SettingInfo* info = find_setting(known, name);
    std::string rule = info == nullptr ? "is no setting of this engine" : broken_rule(*info, value);
    if (rule.empty()) continue;
    faults.push_back({name, std::move(rule), info == nullptr ? "" : exact_text(value)});
  }
  return faults;
}

std::string broken_rule(const SettingInfo& known, const Setting& value) {
  if (std::holds_alternative<bool>(known.shipped))
    return std::holds_alternative<bool>(value) ? "" : "must be true or false";
  if (std::holds_alternative<double>(known.shipped)) {
    const double* number = std::get_if<double>(&value);
    return number != nullptr && takes(known, *number) ? "" : "must be " + numbers_of(known);
  }
  const std::string* word = std::get_if<std::string>(&value);
  if (word != nullptr && takes(known, *word)) return "";
  if (known.choices.empty()) return "must be a word";
  return fmt::format("must be one of {}", fmt::join(known.choices, ", "));
}

const SettingInfo* find_setting(const std::vector<SettingInfo>& known, const std::string& name) {
  const auto found = std::ranges::find(known, name, &SettingInfo::name);
  return found == known.end() ? nullptr : &*found;
}

std::string exact_text(const Setting& setting) {
  if (const bool* flag = std::get_if<bool>(&setting)) return *flag ? "true" : "false";
  if (const double* number = std::get_if<double>(&setting)) return fmt::format("{}", *number);
  return std::get<std::string>(setting);
}

}  // namespace slipcheck
