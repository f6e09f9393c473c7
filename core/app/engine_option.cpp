#include "app/engine_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/engine_registry.h"
#include "scenario/rules/rules.h"

namespace slipcheck {

CLI::Validator installed_engine(bool or_all) {
  const auto check = [or_all](std::string& name) -> std::string {
    if (or_all && name == "all") return {};
    const auto is_it = [&](const EngineExecutable& each) {
      return each.engine == name || engine_family(each.engine) == name;
    };
    if (std::ranges::any_of(find_engines(), is_it)) return {};
    const std::vector<std::string> names = engine_names();
    if (std::ranges::count(names, engine_family(name)) == 0)
      return fmt::format("must be one of the engines {}{}, got {}", fmt::join(names, ", "),
                         did_you_mean(name, names), name);
    return not_installed_text(name);
  };
  return CLI::Validator(check, "");
}

}  // namespace slipcheck
