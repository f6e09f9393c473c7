#include "engine/setting_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/fields.h"
#include "engine/settings.h"

namespace slipcheck::protocol {

using nlohmann::json;

namespace {

json to_json(const Setting& setting) {
  return std::visit([](const auto& value) { return json(value); }, setting);
}

json to_json(const std::vector<Setting>& settings) {
  json list = json::array();
  for (const Setting& setting : settings) list.push_back(to_json(setting));
  return list;
}

Setting setting_from_json(const json& value, const std::string& place) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number()) return value.get<double>();
  if (!value.is_string()) throw Rubbish(fmt::format("{} is no number, text, true or false", place));
  require_utf8(value.get_ref<const std::string&>(), place);
  return value.get<std::string>();
}

json to_json(const SettingInfo& info) {
  json object = {{"name", info.name},
                 {"about", info.about},
                 {"unit", info.unit},
                 {"shipped", to_json(info.shipped)},
                 {"whole", info.whole},
                 {"choices", info.choices},
                 {"candidates", to_json(info.candidates)}};
  if (std::isfinite(info.low)) object["low"] = info.low;
  if (std::isfinite(info.high)) object["high"] = info.high;
  if (info.range)
    object["range"] = {{"low", info.range->low},
                       {"high", info.range->high},
                       {"logarithmic", info.range->logarithmic}};
  return object;
}

bool is_setting_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

SettingInfo::Range range_from_json(const Fields& fields, const SettingInfo& info,
                                   const std::string& place) {
  SettingInfo::Range range{fields.number("low"), fields.number("high"), fields.flag("logarithmic")};
  if (range.low >= range.high || range.low < info.low || range.high > info.high)
    throw Rubbish(fmt::format("{} is no range of what the setting takes", place));
  if (range.logarithmic && range.low <= 0)
    throw Rubbish(fmt::format("{} is logarithmic, but not > 0", place));
  return range;
}

/// A value that the engine says its own setting may have.
Setting own_value(const json& value, const SettingInfo& info, const std::string& place) {
  Setting setting = setting_from_json(value, place);
  const std::string rule = broken_rule(info, setting);
  if (!rule.empty()) throw Rubbish(fmt::format("{} {}", place, rule));
  return setting;
}

SettingInfo setting_info_from_json(const Fields& fields) {
  SettingInfo info;
  info.name = fields.text("name");
  if (!is_setting_name(info.name))
    throw Rubbish(fmt::format("{} is no name of a-z, 0-9 and _", fields.place_of("name")));
  info.about = fields.text("about");
  info.unit = fields.text("unit");
  const json& shipped = fields.member("shipped");
  info.shipped = setting_from_json(shipped, fields.place_of("shipped"));
  info.whole = fields.flag("whole");
  info.choices = fields.texts("choices");
  if (fields.has("low")) info.low = fields.number("low");
  if (fields.has("high")) info.high = fields.number("high");
  const bool is_number = std::holds_alternative<double>(info.shipped);
  if (!is_number && (info.whole || fields.has("low") || fields.has("high") || fields.has("range")))
    throw Rubbish(fmt::format("{} is no number, but has limits", fields.place_of("shipped")));
  if (!std::holds_alternative<std::string>(info.shipped) && !info.choices.empty())
    throw Rubbish(fmt::format("{} is no text, but has choices", fields.place_of("shipped")));
  own_value(shipped, info, fields.place_of("shipped"));
  for (const json& candidate : fields.list("candidates"))
    info.candidates.push_back(own_value(candidate, info, fields.place_of("candidates")));
  if (fields.has("range")) {
    const std::string place = fields.place_of("range");
    info.range = range_from_json(Fields(fields.object("range"), place), info, place);
  }
  return info;
}

}  // namespace

json settings_to_json(const Settings& settings) {
  json object = json::object();
  for (const auto& [name, setting] : settings) object[name] = to_json(setting);
  return object;
}

Settings settings_from_json(const json& object) {
  Settings settings;
  for (const auto& [name, value] : object.items()) {
    require_utf8(name, "the name of a setting");
    settings[name] = setting_from_json(value, "the setting " + name);
  }
  return settings;
}

json setting_infos_to_json(const std::vector<SettingInfo>& infos) {
  json list = json::array();
  for (const SettingInfo& info : infos) list.push_back(to_json(info));
  return list;
}

std::vector<SettingInfo> setting_infos_from_json(const json& list) {
  std::vector<SettingInfo> infos;
  for (const json& object : list) {
    const std::string place = fmt::format("reply.settings[{}]", infos.size());
    SettingInfo info = setting_info_from_json(Fields(object, place));
    if (find_setting(infos, info.name) != nullptr)
      throw Rubbish(fmt::format("{} is a second {}", place, info.name));
    infos.push_back(std::move(info));
  }
  return infos;
}

}  // namespace slipcheck::protocol
