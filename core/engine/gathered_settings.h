#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/engine.h"

namespace slipcheck {

/// Values of one name for several bodies or pairs, merged into one entry where all are the same:
/// "friction", or "friction[0]", "friction[1]".
class GatheredSettings {
 public:
  void add(const std::string& name, const std::string& whose, const Setting& value) {
    values_[name].emplace_back(whose, value);
  }

  void move_to(Settings& settings) {
    for (const auto& [name, values] : values_) {
      const Setting& first = values.front().second;
      const bool all_alike = std::all_of(values.begin(), values.end(),
                                         [&](const auto& each) { return each.second == first; });
      if (all_alike) {
        settings[name] = first;
        continue;
      }
      for (const auto& [whose, value] : values)
        settings[fmt::format("{}[{}]", name, whose)] = value;
    }
  }

 private:
  std::map<std::string, std::vector<std::pair<std::string, Setting>>> values_;
};

}  // namespace slipcheck
