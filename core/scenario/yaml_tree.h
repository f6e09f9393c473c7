#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/scenario.h"

namespace slipcheck {

struct YamlNode;
using YamlPointer = std::shared_ptr<const YamlNode>;

/// One node of a YAML document, never changed once built; aliases share their anchor's node.
struct YamlNode {
  enum class Kind { null, scalar, list, mapping };
  struct Entry {
    std::string key;
    Location location;  ///< of the key
    YamlPointer value;
  };

  Kind kind = Kind::null;
  Location location;
  std::string text;                ///< a scalar's
  bool plain = true;               ///< a scalar without quotes
  std::vector<YamlPointer> items;  ///< a list's
  std::vector<Entry> entries;      ///< a mapping's in the order of the file, duplicates kept
  std::size_t size = 1;            ///< number of nodes with every alias written out
  int depth = 1;                   ///< levels, likewise

  /// The value of the first entry with this key, or null.
  const YamlNode* find(std::string_view key) const;
};

/// Parses a text that holds one YAML document. Throws BadScenario for what no later rule could look
/// at: wrong syntax, several documents, tags, aliases that contain themselves or that would write
/// out to more than kMostNodes, more than kMostLevels. `content` says in messages what the file
/// holds.
YamlPointer parse_yaml(std::string_view text, const std::string& file,
                       const char* content = "scene");

inline constexpr std::size_t kMostNodes = 300'000;
inline constexpr int kMostLevels = 64;

}  // namespace slipcheck
