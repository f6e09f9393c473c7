#include "app/list_engines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/say.h"
#include "engine/engine_registry.h"
#include "engine/profile.h"
#include "engine/remote_engine.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Setting& setting) {
  return std::visit([](const auto& value) { return Json(value); }, setting);
}

/// What a setting takes: words, limits of a number as null where there is none.
Json json_of(const SettingInfo& info) {
  Json entry{{"name", info.name}, {"unit", info.unit}, {"shipped", json_of(info.shipped)}};
  if (std::holds_alternative<double>(info.shipped)) {
    const auto limit = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
    entry["takes"] = info.whole ? "whole number" : "number";
    entry["low"] = limit(info.low);
    entry["high"] = limit(info.high);
  } else if (std::holds_alternative<bool>(info.shipped)) {
    entry["takes"] = {true, false};
  } else {
    entry["takes"] = info.choices.empty() ? Json("word") : Json(info.choices);
  }
  entry["about"] = info.about;
  return entry;
}

/// true, 0.2, multibody
std::string word_of(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number()) return fmt::format("{}", value.get<double>());
  return value.get<std::string>();
}

/// "true, false", "number, 0 … 1", "whole number, >= 1"
std::string taken(const Json& setting) {
  const Json& takes = setting["takes"];
  std::string text;
  if (takes.is_array()) {
    for (const Json& value : takes) text += (text.empty() ? "" : ", ") + word_of(value);
    return text;
  }
  text = word_of(takes);
  const bool has_low = setting.contains("low") && !setting["low"].is_null();
  const bool has_high = setting.contains("high") && !setting["high"].is_null();
  if (has_low && has_high)
    return fmt::format("{}, {} … {}", text, word_of(setting["low"]), word_of(setting["high"]));
  if (has_low) text += fmt::format(", >= {}", word_of(setting["low"]));
  if (has_high) text += fmt::format(", <= {}", word_of(setting["high"]));
  return text;
}

}  // namespace

Json list_engines() {
  Json list = Json::array();
  const std::vector<EngineExecutable> found = find_engines();
  for (const EngineExecutable& executable : found) {
    Json entry{{"engine", executable.engine}, {"precision", executable.precision}};
    try {
      entry["version"] = RemoteEngine(executable.command).info().version;
      entry["profiles"] = profile_names(executable);
      entry["status"] = "ok";
    } catch (const WorkerFailure& failure) {
      entry["status"] = "crashed";
      entry["reason"] = failure.what();
    }
    list.push_back(std::move(entry));
  }
  for (const auto& [name, from] : known_engines())
    if (std::ranges::none_of(
            found, [&](const EngineExecutable& e) { return engine_family(e.engine) == name; }))
      list.push_back(Json{{"engine", name},
                          {"status", "skipped"},
                          {"reason", fmt::format("not installed: {}", from)}});
  return list;
}

Json list_profiles() {
  Json list = Json::array();
  std::set<std::filesystem::path> seen;  // precisions beside each other share their profiles
  for (const EngineExecutable& executable : find_engines())
    for (const std::string& name : profile_names(executable)) {
      const auto file = find_profile(executable, name, "");
      if (!file || !seen.insert(*file).second) continue;
      try {
        const Profile profile = load_profile(*file);
        list.push_back(Json{{"engine", executable.engine},
                            {"profile", name},
                            {"settings", profile.settings.size()},
                            {"about", profile.about}});
      } catch (const BadScenario& bad) {
        say("{}\n", bad.what());
      }
    }
  return list;
}

Json list_settings() {
  Json list = Json::array();
  for (const EngineExecutable& executable : find_engines()) {
    try {
      const EngineInfo engine = RemoteEngine(executable.command).info();
      for (const SettingInfo& info : engine.settings) {
        const Json setting = json_of(info);
        const auto same = std::find_if(list.begin(), list.end(), [&](Json other) {
          const bool same_engine = other["engine"] == executable.engine;
          other.erase("engine");
          other.erase("precision");
          return same_engine && other == setting;
        });
        if (same != list.end()) {
          (*same)["precision"].push_back(executable.precision);
          continue;
        }
        Json entry{{"engine", executable.engine},
                   {"precision", Json::array({executable.precision})}};
        entry.update(setting);
        list.push_back(std::move(entry));
      }
    } catch (const WorkerFailure& failure) {
      say("{}: {}\n", executable.command.program.string(), failure.what());
    }
  }
  return list;
}

Json settings_in_words(const Json& list) {
  Json rows = Json::array();
  for (const Json& setting : list)
    rows.push_back(Json{{"engine", setting["engine"]},
                        {"precision", setting["precision"]},
                        {"name", setting["name"]},
                        {"shipped", word_of(setting["shipped"])},
                        {"takes", taken(setting)},
                        {"unit", setting["unit"]},
                        {"about", setting["about"]}});
  return rows;
}

}  // namespace slipcheck
