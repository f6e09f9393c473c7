#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/written_scene.h"

namespace slipcheck {

/// The number, from 1, of a fill's body of this name; 0: none has it.
std::int64_t number_in(const Fill& fill, std::string_view name);

/// The names of a scene's bodies and surfaces, with what has them. Those of fills, up to millions,
/// are known by their rule.
class SceneNames {
 public:
  struct Shared {
    std::string name, path;  ///< path: of what had it before
  };

  /// One name of what stands at `path`; false: another has it, and keeps it.
  bool add(const std::string& name, const std::string& path) {
    return single_.emplace(name, path).second;
  }
  /// Those of a fill, which must outlive this. Returns the first one that something else has.
  std::optional<Shared> add(const Fill& fill);

  /// Of what has this name; null: nothing has.
  const std::string* path_of(const std::string& name) const;
  /// All names in which '-' stands.
  std::vector<std::string> joined() const;

 private:
  std::map<std::string, std::string> single_;  ///< paths by names
  std::vector<const Fill*> fills_;
};

}  // namespace slipcheck
