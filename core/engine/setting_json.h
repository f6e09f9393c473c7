#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "engine/engine.h"

namespace slipcheck::protocol {

/// {name: number, text or bool, …}
nlohmann::json settings_to_json(const Settings& settings);
/// Throws Rubbish for what is no such map.
Settings settings_from_json(const nlohmann::json& object);

/// The settings that an engine takes: [{name, about, unit, shipped, …}, …].
nlohmann::json setting_infos_to_json(const std::vector<SettingInfo>& infos);
/// Throws Rubbish for infos that contradict themselves: names twice, values that are not of the
/// setting's type or that it would not take.
std::vector<SettingInfo> setting_infos_from_json(const nlohmann::json& list);

}  // namespace slipcheck::protocol
