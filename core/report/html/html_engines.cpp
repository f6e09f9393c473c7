#include "report/html/html_engines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <variant>

#include "base/old_reasons.h"
#include "report/html/html_text.h"

namespace slipcheck {
namespace {

std::string method_name(const EngineRecord& run) {
  return fmt::format("{} {} {}", run.engine, run.precision, run.profile);
}

/// "0.1", "true", "sequential"
std::string setting_text(const Setting& setting) {
  if (const double* number = std::get_if<double>(&setting)) return fmt::format("{:.7g}", *number);
  if (const bool* flag = std::get_if<bool>(&setting)) return *flag ? "true" : "false";
  return std::get<std::string>(setting);
}

Cell setting_cell(const Setting& setting) {
  const double* number = std::get_if<double>(&setting);
  return {setting_text(setting), Tone::plain, number ? *number : kNotObserved};
}

/// Keeps what the others have, too, with the same value.
void keep_common(Settings& settings, const Settings& others) {
  std::erase_if(settings, [&](const auto& entry) {
    const auto found = others.find(entry.first);
    return found == others.end() || found->second != entry.second;
  });
}

void take_away(Settings& settings, const Settings& known) {
  for (const auto& [name, setting] : known) settings.erase(name);
}

}  // namespace

std::string html_settings(std::string_view head, const Settings& settings) {
  std::vector<std::string> items;
  for (const auto& [name, setting] : settings)
    items.push_back(fmt::format("{} {}", name, setting_text(setting)));
  return html_paragraph("faint", head, fmt::format("{}", fmt::join(items, ", ")));
}

SharedSettings::SharedSettings(const std::vector<SceneRecord>& scenes) {
  for (const SceneRecord& scene : scenes)
    for (const EngineRecord& run : scene.runs) {
      if (run.applied.settings.empty()) continue;
      const auto [shared, is_first] = shared_.try_emplace(method_name(run), run.applied.settings);
      if (!is_first) keep_common(shared->second, run.applied.settings);
    }
}

Settings SharedSettings::beside_shared(const EngineRecord& run) const {
  Settings settings = run.applied.settings;
  const auto shared = shared_.find(method_name(run));
  if (shared != shared_.end()) take_away(settings, shared->second);
  return settings;
}

Settings SharedSettings::of_scene(const SceneRecord& scene) const {
  std::optional<Settings> common;
  for (const EngineRecord& run : scene.runs) {
    if (run.applied.settings.empty()) continue;
    const Settings settings = beside_shared(run);
    if (common)
      keep_common(*common, settings);
    else
      common = settings;
  }
  return common.value_or(Settings{});
}

Settings SharedSettings::others(const EngineRecord& run, const SceneRecord& scene) const {
  Settings settings = beside_shared(run);
  if (!settings.empty()) take_away(settings, of_scene(scene));
  return settings;
}

std::string SharedSettings::html() const {
  TextTable table{{{"setting"}}, {}, "Settings as applied in all runs"};
  std::set<std::string> names;
  for (const auto& [method, settings] : shared_) {
    table.columns.push_back({method});
    for (const auto& [name, setting] : settings) names.insert(name);
  }
  if (names.empty()) return {};
  for (const std::string& name : names) {
    std::vector<Cell>& row = table.rows.emplace_back(1, Cell{name});
    for (const auto& [method, settings] : shared_) {
      const auto found = settings.find(name);
      row.push_back(found == settings.end() ? Cell{"–", Tone::faint} : setting_cell(found->second));
    }
  }
  return html_details(
      "Settings as applied in all runs [SI]",
      html_paragraph("faint", "",
                     "What differs from scene to scene or from run to run, –, stands there.") +
          html_table(table));
}

std::string html_lacks(const std::vector<SceneRecord>& scenes) {
  std::map<std::string, std::map<std::string, std::set<std::size_t>>> lacks;  // scenes by method
  std::map<std::string, std::set<std::size_t>> tried;
  for (std::size_t k = 0; k < scenes.size(); ++k)
    for (const EngineRecord& run : scenes[k].runs) {
      const std::string method = fmt::format("{} {}", run.engine, run.profile);
      if (run.status != RunStatus::skipped) tried[method].insert(k);
      for (const Lack& lack : run.applied.not_represented)
        lacks[lack.kind.empty() ? kind_in_words(lack.text) : lack.kind][method].insert(k);
    }
  if (lacks.empty()) return {};
  TextTable table{{{"what the scene needs"}}, {}, "What engines cannot represent"};
  for (const auto& [method, where] : tried)
    table.columns.push_back({fmt::format("{}, of {}", method, where.size()), true});
  for (const auto& [lack, by_method] : lacks) {
    std::vector<Cell>& row = table.rows.emplace_back(1, Cell{lack});
    for (const auto& [method, where] : tried) {
      const auto found = by_method.find(method);
      row.push_back(count_cell(found == by_method.end() ? 0 : found->second.size()));
    }
  }
  return "<h2>What engines cannot represent</h2>\n" +
         html_paragraph("faint", "", "The number of scenes that need it.") + html_table(table);
}

}  // namespace slipcheck
