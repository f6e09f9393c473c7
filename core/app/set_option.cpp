#include "app/set_option.h"

#include <fmt/format.h>

#include "app/commands.h"
#include "scenario/units.h"

namespace slipcheck {
namespace {

Setting setting_of(const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  try {
    return parse_number(text);
  } catch (const BadQuantity&) {
    return text;
  }
}

}  // namespace

void add_set_option(CLI::App& command, std::vector<std::string>& written) {
  command
      .add_option("--set", written,
                  "An engine's setting as name=value, over that of every profile; repeatable "
                  "(slipcheck list settings)")
      ->allow_extra_args(false);
}

void add_ranks_option(CLI::App& command, std::vector<std::string>& written) {
  command
      .add_option_function<unsigned>(
          "--ranks",
          [&written](unsigned ranks) { written.push_back(fmt::format("ranks={}", ranks)); },
          "Processes that share a scene, of engines that can (lammps): as --set ranks=N")
      ->check(CLI::Range(1, 1000000));
}

Settings parse_settings(const std::vector<std::string>& written) {
  Settings settings;
  for (const std::string& each : written) {
    const std::size_t sign = each.find('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == each.size())
      throw BadOption(fmt::format("--set: must be name=value, got '{}'", each));
    if (!settings.emplace(each.substr(0, sign), setting_of(each.substr(sign + 1))).second)
      throw BadOption(
          fmt::format("--set: must name a setting once, got '{}' again", each.substr(0, sign)));
  }
  return settings;
}

void add_general_option(CLI::App& command, bool& general) {
  command.add_flag("--general", general,
                   "Run loops that leave out nothing of what a scene may have, to check those "
                   "that do");
}

}  // namespace slipcheck
