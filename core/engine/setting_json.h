#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "base/json_node.h"
#include "engine/engine.h"

namespace slipcheck::protocol {

/// The settings that an engine takes: [{name, about, unit, shipped, …}, …].
nlohmann::json setting_infos_to_json(const std::vector<SettingInfo>& infos);
/// Throws BadJson for infos that contradict themselves: names twice, values that are not of the
/// setting's type or that it would not take.
std::vector<SettingInfo> setting_infos_from_json(const JsonNode& list);

}  // namespace slipcheck::protocol
