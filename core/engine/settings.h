#pragma once

#include <string>
#include <vector>

#include "engine/engine.h"

namespace slipcheck {

/// A setting that an engine does not take, or a value that it does not take for it.
struct SettingFault {
  std::string name;
  std::string rule;   ///< "must be >= 0 m/s"
  std::string value;  ///< as exact_text() gives it; empty where the name is unknown
};

/// Everything that is wrong with settings for an engine that takes `known`: names that it has not,
/// values of another type, out of range, not whole, none of the choices.
std::vector<SettingFault> check_settings(const std::vector<SettingInfo>& known,
                                         const Settings& settings);

/// What is wrong with one value, "" if nothing: "must be true or false".
std::string broken_rule(const SettingInfo& known, const Setting& value);

/// The setting with this name, or null.
const SettingInfo* find_setting(const std::vector<SettingInfo>& known, const std::string& name);

/// A value in words: true, 0.2, multibody. A number reads back as the same.
std::string exact_text(const Setting& setting);

}  // namespace slipcheck
