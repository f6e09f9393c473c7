#include "studies/tuning/tuning_space.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "engine/settings.h"

namespace slipcheck {
namespace {

bool is_tunable(const SettingInfo& info) { return !info.candidates.empty() || info.range; }

std::string tunable_names(const EngineInfo& info) {
  std::vector<std::string> names;
  for (const SettingInfo& setting : info.settings)
    if (is_tunable(setting)) names.push_back(setting.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Rounded to four significant digits.
double legible(double value) { return std::stod(fmt::format("{:.4g}", value)); }

}  // namespace

Settings TuningSpace::canonical(Settings settings) const {
  std::erase_if(settings, [&](const auto& named) {
    const SettingInfo* info = find_setting(known, named.first);
    return info && info->shipped == named.second;
  });
  return settings;
}

TuningSpace tuning_space(const EngineInfo& info, const Settings& start,
                         const std::vector<std::string>& only) {
  TuningSpace space;
  space.known = info.settings;
  for (const std::string& name : only) {
    const SettingInfo* setting = find_setting(info.settings, name);
    if (!setting || !is_tunable(*setting))
      throw std::invalid_argument(
          fmt::format("must be settings that {} has something to try for ({}), got {}", info.engine,
                      tunable_names(info), name));
  }
  for (const SettingInfo& setting : info.settings)
    if (is_tunable(setting) && (only.empty() || std::ranges::count(only, setting.name) > 0))
      space.vary.push_back(setting);
  space.start = space.canonical(start);
  return space;
}

void add_start(TuningSpace& space, const std::string& profile, const Settings& settings,
               const std::vector<std::string>& only) {
  Settings chosen = only.empty() ? settings : space.start;
  for (const std::string& name : only) {
    const auto there = settings.find(name);
    if (there == settings.end())
      chosen.erase(name);
    else
      chosen[name] = there->second;
  }
  chosen = space.canonical(std::move(chosen));
  const bool is_known =
      chosen == space.start || std::ranges::any_of(space.others, [&](const TuningStart& other) {
        return other.settings == chosen;
      });
  if (!is_known) space.others.push_back({profile, std::move(chosen)});
}

const Setting& value_of(const SettingInfo& info, const Settings& settings) {
  const auto chosen = settings.find(info.name);
  return chosen == settings.end() ? info.shipped : chosen->second;
}

double coordinate(const SettingInfo& info, double value) {
  const SettingInfo::Range& range = *info.range;
  const double inside = std::clamp(value, range.low, range.high);
  if (range.logarithmic) return std::log(inside / range.low) / std::log(range.high / range.low);
  return (inside - range.low) / (range.high - range.low);
}

double value_at(const SettingInfo& info, double coordinate) {
  const SettingInfo::Range& range = *info.range;
  const double value = range.logarithmic ? range.low * std::pow(range.high / range.low, coordinate)
                                         : range.low + coordinate * (range.high - range.low);
  return std::clamp(info.whole ? std::round(value) : legible(value), range.low, range.high);
}

std::vector<TuningMove> moves_from(const TuningSpace& space, const Settings& settings) {
  std::vector<TuningMove> moves;
  for (const SettingInfo& info : space.vary)
    for (const Setting& candidate : info.candidates)
      if (candidate != value_of(info, settings)) moves.push_back({&info, candidate});
  return moves;
}

std::string changes_text(const TuningSpace& space, const Settings& base, const Settings& settings) {
  std::vector<std::string> changes;
  for (const SettingInfo& info : space.known) {
    const Setting& value = value_of(info, settings);
    if (value != value_of(info, base))
      changes.push_back(fmt::format("{} {}", info.name, exact_text(value)));
  }
  return changes.empty() ? "nothing" : fmt::format("{}", fmt::join(changes, ", "));
}

}  // namespace slipcheck
