#include "studies/sweep/sweep_choice.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

#include "scenario/rules/rules.h"

namespace slipcheck {
namespace {

using Kind = SweepParameter::Kind;

constexpr std::string_view kSettings = "settings.";

/// In the order of Kind.
constexpr std::array<std::string_view, 8> kNames = {"",        "engine", "version", "precision",
                                                    "profile", "rate",   "scale",   "phases"};

Setting setting_of(const YamlNode& node) {
  if (!node.plain) return node.text;
  if (node.text == "true" || node.text == "false") return node.text == "true";
  try {
    return parse_number(node.text);
  } catch (const BadQuantity&) {
    return node.text;
  }
}

bool read_phases(const YamlNode& node, Reading& reading, std::size_t& phases) {
  std::int64_t count = 0;
  if (!integer(1, 100'000).read(node, reading, count)) return false;
  phases = static_cast<std::size_t>(count);
  return true;
}

bool read_precision(const YamlNode& node, Reading& reading, std::string& precision) {
  return choice<std::string>({{"single", "single"}, {"double", "double"}})
      .read(node, reading, precision);
}

bool read_setting(const YamlNode& node, Reading& reading, Setting& setting) {
  if (!is_scalar(node)) {
    reading.fault(node, "must be true, false, a number or a word");
    return false;
  }
  setting = setting_of(node);
  return true;
}

}  // namespace

std::string SweepChoice::engine_name() const {
  return version.empty() ? engine : fmt::format("{}@{}", engine, version);
}

SweepParameter named_parameter(const SweepName& name) {
  SweepParameter parameter{name.name, Kind::scene, name.location, {}, {}};
  if (name.name.starts_with(kSettings)) {
    parameter.kind = Kind::setting;
    parameter.setting = name.name.substr(kSettings.size());
    return parameter;
  }
  for (std::size_t k = 1; k < kNames.size(); ++k)
    if (name.name == kNames[k]) parameter.kind = static_cast<Kind>(k);
  return parameter;
}

bool choose(const SweepParameter& parameter, const YamlNode& value, Reading& reading,
            SweepChoice& into) {
  switch (parameter.kind) {
    case Kind::scene:
      break;
    case Kind::engine:
      return name_text(NameStyle::engine).read(value, reading, into.engine);
    case Kind::version:
      return free_text().read(value, reading, into.version);
    case Kind::precision:
      return read_precision(value, reading, into.precision);
    case Kind::profile:
      return free_text().read(value, reading, into.profile);
    case Kind::rate:
      return number(kFrequency, {1e-6, {}, 1e12, {}}).read(value, reading, into.rate);
    case Kind::scale:
      return number(kPureNumber, {1e-9, {}, 1e9, {}}).read(value, reading, into.scale);
    case Kind::phases:
      return read_phases(value, reading, into.phases);
    case Kind::setting:
      return read_setting(value, reading, into.settings[parameter.setting]);
  }
  return false;
}

}  // namespace slipcheck
