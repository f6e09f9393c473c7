#pragma once

#include <string>
#include <vector>

#include "engine/engine.h"

namespace slipcheck {

/// A profile to begin from.
struct TuningStart {
  std::string profile;
  Settings settings;  ///< without what the engine ships with
};

/// What tuning may change of an engine, and where it begins.
struct TuningSpace {
  std::vector<SettingInfo> known;   ///< all that the engine takes
  std::vector<SettingInfo> vary;    ///< those that tuning may change: with candidates or a range
  Settings start;                   ///< without what the engine ships with
  std::vector<TuningStart> others;  ///< to begin from where they are better than the start

  /// The same settings without those that have the engine's own value: what means the same is the
  /// same.
  Settings canonical(Settings settings) const;
};

/// The space of all settings with candidates or a range, or of those named in `only`. Throws
/// std::invalid_argument with rule and value for a name that the engine has not, and for one with
/// nothing to try. `start` has been checked against what the engine takes.
TuningSpace tuning_space(const EngineInfo& info, const Settings& start,
                         const std::vector<std::string>& only = {});

/// Adds a profile to begin from, if it differs from the start and the others; of its settings those
/// in `only`, over the start's, where that names any.
void add_start(TuningSpace& space, const std::string& profile, const Settings& settings,
               const std::vector<std::string>& only = {});

/// The value of a setting: the chosen one, or the engine's own.
const Setting& value_of(const SettingInfo& info, const Settings& settings);

/// Where a number lies in the setting's range: 0 at the low end, 1 at the high one, of logarithms
/// where the range is so; numbers outside of the range are at its ends. `info` has a range.
double coordinate(const SettingInfo& info, double value);

/// The number at a coordinate in [0, 1], with four significant digits, that a file with it stays
/// legible; whole where the setting is.
double value_at(const SettingInfo& info, double coordinate);

/// One setting with another value than it has: what a search by hand would try next.
struct TuningMove {
  const SettingInfo* setting = nullptr;  ///< of the space's `vary`
  Setting value;
};

/// Every candidate of every setting that `settings` do not have, setting by setting. The space
/// outlives the moves.
std::vector<TuningMove> moves_from(const TuningSpace& space, const Settings& settings);

/// "contact_erp 0, body multibody": what `settings` choose otherwise than `base` do, in the
/// engine's order; "nothing" where they are the same.
std::string changes_text(const TuningSpace& space, const Settings& base, const Settings& settings);

}  // namespace slipcheck
