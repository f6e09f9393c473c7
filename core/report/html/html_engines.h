#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "harness/compare/record.h"

namespace slipcheck {

/// The settings that an engine applies in all runs of a page alike, so that they are told once.
class SharedSettings {
 public:
  explicit SharedSettings(const std::vector<SceneRecord>& scenes);

  /// A column for each engine with its precision and profile; nothing where there are no settings.
  std::string html() const;
  /// What all runs of a scene apply alike beside these.
  Settings of_scene(const SceneRecord& scene) const;
  /// What a run of a scene applies beside both.
  Settings others(const EngineRecord& run, const SceneRecord& scene) const;

 private:
  Settings beside_shared(const EngineRecord& run) const;

  std::map<std::string, Settings> shared_;  // by "bullet double tuned"
};

/// "friction 0.1, solver sequential" behind a bold head; nothing without settings.
std::string html_settings(std::string_view head, const Settings& settings);

/// What the engines cannot represent, by engine and profile, and in how many scenes each lack
/// shows; nothing where they lack nothing.
std::string html_lacks(const std::vector<SceneRecord>& scenes);

}  // namespace slipcheck
