#include "engine/setting_json.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/message_fields.h"
#include "engine/settings.h"

namespace slipcheck {
namespace {

bool is_setting_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

/// A value that the engine says its own setting may have.
void check_own(const JsonNode& node, const SettingInfo& info, const Setting& value) {
  if (const std::string rule = broken_rule(info, value); !rule.empty()) node.fault(rule);
}

void check_info(const JsonNode& node, const SettingInfo& info) {
  if (!is_setting_name(info.name)) node["name"].fault("must be a name of a-z, 0-9 and _");
  const bool is_number = std::holds_alternative<double>(info.shipped);
  if (!is_number && (info.whole || node.has("low") || node.has("high") || info.range))
    node["shipped"].fault("must be a number, as it has limits");
  if (!std::holds_alternative<std::string>(info.shipped) && !info.choices.empty())
    node["shipped"].fault("must be a text, as it has choices");
  check_own(node["shipped"], info, info.shipped);
  const std::vector<JsonNode> candidates = node["candidates"].items();
  for (std::size_t k = 0; k < candidates.size(); ++k)
    check_own(candidates[k], info, info.candidates[k]);
  if (!info.range) return;
  const auto& [low, high, logarithmic] = *info.range;
  if (low >= high || low < info.low || high > info.high)
    node["range"].fault_alone("must be a range of what the setting takes");
  if (logarithmic && low <= 0) node["range"].fault_alone("must be > 0, as it is logarithmic");
}

}  // namespace

template <class Fields>
void describe(Fields& f, SettingInfo::Range& range) {
  f("low", range.low);
  f("high", range.high);
  f("logarithmic", range.logarithmic);
}

template <class Fields>
void describe(Fields& f, SettingInfo& info) {
  f("name", info.name);
  f("about", info.about);
  f("unit", info.unit);
  f("shipped", info.shipped);
  f("whole", info.whole);
  f("choices", info.choices);
  f("candidates", info.candidates);
  f.if_finite("low", info.low);
  f.if_finite("high", info.high);
  f("range", info.range);
}

namespace protocol {

nlohmann::json setting_infos_to_json(const std::vector<SettingInfo>& infos) {
  return message_json(infos);
}

std::vector<SettingInfo> setting_infos_from_json(const JsonNode& list) {
  if (list.json().size() > kMostSettings)
    list.fault_alone(fmt::format("must be at most {} settings", kMostSettings));
  std::vector<SettingInfo> infos;
  for (const JsonNode& node : list.items()) {
    auto info = read_finite<SettingInfo>(node);
    check_info(node, info);
    if (find_setting(infos, info.name) != nullptr)
      node["name"].fault("must be the name of no other");
    infos.push_back(std::move(info));
  }
  return infos;
}

}  // namespace protocol
}  // namespace slipcheck
