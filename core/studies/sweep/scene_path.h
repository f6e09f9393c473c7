#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenario/yaml_tree.h"

namespace slipcheck {

/// The place of a key or item in a scene's tree.
struct ScenePath {
  struct Step {
    std::string key;                   ///< of a mapping
    std::optional<std::size_t> index;  ///< of a list, in place of the key
  };
  std::vector<Step> steps;

  /// As rules name it: "bodies[0].velocity[1]".
  std::string text() const;
};

/// What a path says of a tree that has no such place; the message is a rule.
class BadPath : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "bodies[i].velocity[0]" as "bodies.i.velocity.0", under which a path is known.
std::string dotted(std::string written);

/// The place that a path means, in dots or in brackets: items of a list by number from 0, or by
/// their `name`. All but the last step must be there; a mapping may lack the last. Throws BadPath.
ScenePath scene_path(const YamlNode& root, const std::string& written);

/// The tree with `value` at the path, new from the root down to there; the entry has the place
/// `location`.
YamlPointer with_value(const YamlPointer& root, const ScenePath& path, const YamlPointer& value,
                       Location location);

/// The tree without this key of its root.
YamlPointer without_key(const YamlPointer& root, const std::string& key);

}  // namespace slipcheck
