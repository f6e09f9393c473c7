#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/json_node.h"
#include "engine/engine.h"

namespace slipcheck::protocol {

/// How many settings an engine may have: far more than any, and few enough to look through.
inline constexpr std::size_t kMostSettings = 1000;
/// The same of what it has applied, which may be one of each pair of some hundred materials.
inline constexpr std::size_t kMostApplied = 100'000;

/// The settings that an engine takes: [{name, about, unit, shipped, …}, …].
nlohmann::json setting_infos_to_json(const std::vector<SettingInfo>& infos);
/// Throws BadJson for infos that contradict themselves: names twice, values that are not of the
/// setting's type or that it would not take.
std::vector<SettingInfo> setting_infos_from_json(const JsonNode& list);

}  // namespace slipcheck::protocol
