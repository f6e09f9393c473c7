#include "studies/sweep/sweep_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "scenario/record_keys.h"
#include "scenario/schema.h"
#include "studies/sweep/scene_path.h"
#include "studies/sweep/sweep_samples.h"

namespace slipcheck {
namespace {

using nlohmann::json;

/// The rules that many rows or numbers break.
constexpr const char* kSpanRule =
    "must be [from, to], or {from: , to: } with scale: linear or logarithmic and whole: true or "
    "false";

/// What varies beside paths into the scene and settings.NAME, with what editors say of it.
constexpr std::array<std::pair<const char*, const char*>, 7> kVaried = {{
    {"engine", "slipcheck list engines"},
    {"version", "of the engine"},
    {"precision", "single or double"},
    {"profile", "the engine's settings: a name or a file"},
    {"rate", "steps per second [Hz], > 0"},
    {"scale", "lengths over those of the scene, > 0"},
    {"phases", "runs of an ensemble, 1 to 100000"},
}};

struct WrittenNumber {
  double value = 0;
  std::string unit;
};

/// A number with whatever stands behind it.
std::optional<WrittenNumber> number_in(const YamlNode& node) {
  if (!is_scalar(node)) return std::nullopt;
  WrittenNumber written;
  const char* const last = node.text.data() + node.text.size();
  const char* const first = node.text.data() + (node.text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(first, last, written.value);
  if (error != std::errc() || !std::isfinite(written.value)) return std::nullopt;
  const std::string_view rest(end, static_cast<std::size_t>(last - end));
  const std::size_t begin = std::min(rest.find_first_not_of(' '), rest.size());
  written.unit = rest.substr(begin);
  return written;
}

struct SpanKeys {
  YamlPointer from, to;
  bool logarithmic = false, whole = false;
  std::int64_t count = 0;
};

/// Any node, as it stands.
Rule<YamlPointer> any_node() {
  return {[](const YamlNode& node, Reading&, YamlPointer& target) {
            target = std::make_shared<YamlNode>(node);
            return true;
          },
          [] {
            return json{{"type", {"number", "string"}}};
          }};
}

/// `counted`: of a grid, which says how many.
Rule<SpanKeys> span_keys(bool counted) {
  Record<SpanKeys> keys;
  keys.key("from", &SpanKeys::from, any_node(), required, "the least")
      .key("to", &SpanKeys::to, any_node(), required, "the largest")
      .key("scale", &SpanKeys::logarithmic,
           choice<bool>({{"linear", false}, {"logarithmic", true}}), optional, "how they lie")
      .key("whole", &SpanKeys::whole, boolean(), optional, "true: rounded to whole numbers");
  if (counted)
    keys.key("count", &SpanKeys::count, integer(2, 1'000'000), required, "how many, both included");
  return keys.rule();
}

bool read_span(const YamlNode& node, Reading& reading, const SpanKeys& keys, SweepSpan& span) {
  const auto from = number_in(*keys.from), to = number_in(*keys.to);
  const auto refuse = [&](const char* rule) {
    reading.fault(node, rule);
    return false;
  };
  if (!from || !to) return refuse("must be from a number to a number, with one unit or none");
  if (from->unit != to->unit) return refuse("must have one unit on both numbers, written alike");
  if (!(from->value < to->value)) return refuse("must be from the smaller number to the larger");
  if (keys.logarithmic && !(from->value > 0)) return refuse("must be > 0 on a logarithmic scale");
  span = {from->value, to->value, from->unit, keys.logarithmic, keys.whole, node.location};
  return true;
}

bool read_written_span(const YamlNode& node, Reading& reading, SweepSpan& span) {
  SpanKeys keys;
  if (is_list(node) && node.items.size() == 2) {
    keys.from = node.items[0];
    keys.to = node.items[1];
  } else if (!is_mapping(node)) {
    reading.fault(node, kSpanRule);
    return false;
  } else if (!span_keys(false).read(node, reading, keys)) {
    return false;
  }
  return read_span(node, reading, keys, span);
}

/// Goes through a mapping whose keys are names of what varies.
template <class Visit>
bool for_each_name(const YamlNode& node, Reading& reading, Visit visit) {
  if (!is_mapping(node) || node.entries.empty()) {
    reading.fault(node, "must be a mapping with at least one name of what varies");
    return false;
  }
  bool good = true;
  for (const YamlNode::Entry& entry : node.entries) {
    const auto step = reading.key(entry.key, entry.location, *entry.value);
    good = visit(SweepName{dotted(entry.key), entry.location}, entry.value) && good;
  }
  return good;
}

/// A grid's values: one, a list of them, or so many between two.
bool read_axis(const YamlPointer& node, Reading& reading, SweepPart& part) {
  if (is_scalar(*node)) {
    part.rows = {{node}};
  } else if (is_list(*node)) {
    if (!is_list(*node, reading, 1, kNoLimit)) return false;
    for (const YamlPointer& item : node->items) part.rows.push_back({item});
  } else if (is_mapping(*node)) {
    SpanKeys keys;
    SweepSpan span;
    if (!span_keys(true).read(*node, reading, keys) || !read_span(*node, reading, keys, span))
      return false;
    part.count = static_cast<std::size_t>(keys.count);
    part.spans = {span};
    for (std::size_t k = 0; k < part.count; ++k)
      part.cube.push_back(static_cast<double>(k) / static_cast<double>(part.count - 1));
    return true;
  } else {
    reading.fault(*node, "must be a value, a list of values, or {from: , to: , count: }");
    return false;
  }
  part.count = part.rows.size();
  return true;
}

bool read_grid(const YamlNode& node, Reading& reading, SweepBlock& block) {
  return for_each_name(node, reading, [&](SweepName name, const YamlPointer& value) {
    SweepPart part{"grid", {std::move(name)}, 0, {}, {}, {}};
    if (!read_axis(value, reading, part)) return false;
    block.parts.push_back(std::move(part));
    return true;
  });
}

/// Rows of which each has a value for each name; all have those of the first.
bool read_list(const YamlNode& node, Reading& reading, SweepBlock& block) {
  if (!is_list(node, reading, 1, kNoLimit)) return false;
  SweepPart part{"list", {}, node.items.size(), {}, {}, {}};
  bool good = true;
  for (std::size_t k = 0; k < node.items.size(); ++k) {
    const YamlNode& item = *node.items[k];
    const auto step = reading.item(k, item);
    std::vector<YamlPointer> row(part.names.size());
    good = for_each_name(item, reading,
                         [&](SweepName name, const YamlPointer& value) {
                           const auto known =
                               std::ranges::find(part.names, name.name, &SweepName::name);
                           const auto at = static_cast<std::size_t>(known - part.names.begin());
                           if (k == 0 && known == part.names.end()) {
                             part.names.push_back(std::move(name));
                             row.push_back(value);
                             return true;
                           }
                           if (known == part.names.end() || row[at]) {
                             reading.fault(*value, "must name once what the first row names");
                             return false;
                           }
                           row[at] = value;
                           return true;
                         }) &&
           good;
    if (good && std::ranges::count(row, nullptr) > 0) {
      reading.fault(item, "must name all that the first row names");
      good = false;
    }
    part.rows.push_back(std::move(row));
  }
  if (good) block.parts.push_back(std::move(part));
  return good;
}

struct Sampled {
  std::int64_t points = 0, seed = 1;
  SweepPart part;
};

/// Names that vary, each with such a value, and those that editors are to know.
json names_schema(const json& value) {
  json names = {{"type", "object"}, {"minProperties", 1}, {"additionalProperties", value}};
  for (const auto& [name, about] : kVaried) {
    names["properties"][name] = value;
    names["properties"][name]["description"] = about;
  }
  return names;
}

/// What could stand in the file; which is right the name says.
json value_schema() {
  return {{"type", {"number", "string", "boolean", "array", "object", "null"}}};
}

json number_schema() { return {{"type", {"number", "string"}}}; }

json grid_schema() {
  const json one = {{"type", {"number", "string", "boolean"}}};
  const json several = {{"type", "array"}, {"minItems", 1}, {"items", value_schema()}};
  return names_schema({{"anyOf", {one, several, span_keys(true).schema()}}});
}

json rows_schema() {
  return {{"type", "array"}, {"minItems", 1}, {"items", names_schema(value_schema())}};
}

json ranges_schema() {
  const json pair = {
      {"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", number_schema()}};
  return names_schema({{"anyOf", {pair, span_keys(false).schema()}}});
}

Rule<SweepPart> ranges_rule() {
  return {[](const YamlNode& node, Reading& reading, SweepPart& part) {
            return for_each_name(node, reading, [&](SweepName name, const YamlPointer& value) {
              part.names.push_back(std::move(name));
              return read_written_span(*value, reading, part.spans.emplace_back());
            });
          },
          ranges_schema};
}

Rule<Sampled> sampled_rule(bool seeded) {
  Record<Sampled> sampled;
  sampled.key("points", &Sampled::points, integer(1, 1'000'000), required, "how many")
      .key("ranges", &Sampled::part, ranges_rule(), required, "by name: [from, to]");
  if (seeded)
    sampled.key("seed", &Sampled::seed, integer(0, 1'000'000'000), optional,
                "of the random numbers");
  return sampled.rule();
}

Rule<SweepBlock> part_rule(const std::string& kind) {
  const Rule<Sampled> rule = sampled_rule(kind == "latin_hypercube");
  return {[rule, kind](const YamlNode& node, Reading& reading, SweepBlock& block) {
            Sampled sampled;
            if (!rule.read(node, reading, sampled)) return false;
            SweepPart& part = sampled.part;
            part.kind = kind;
            part.count = static_cast<std::size_t>(sampled.points);
            const std::size_t dimensions = part.names.size();
            if (dimensions > kMostSampled / part.count) {
              reading.fault(node,
                            fmt::format("must have at most {} points times ranges", kMostSampled));
              return false;
            }
            part.cube = kind == "sobol" ? sobol_points(part.count, dimensions)
                                        : latin_hypercube(part.count, dimensions,
                                                          static_cast<std::uint64_t>(sampled.seed));
            block.parts.push_back(std::move(part));
            return true;
          },
          rule.schema};
}

}  // namespace

YamlPointer SweepSpan::at(double place) const {
  double value = logarithmic ? from * std::pow(to / from, place) : from + (to - from) * place;
  if (place >= 1) value = to;
  if (whole) value = std::round(value);
  auto node = std::make_shared<YamlNode>();
  node->kind = YamlNode::Kind::scalar;
  node->location = location;
  node->text = unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
  return node;
}

YamlPointer SweepPart::value(std::size_t row, std::size_t name) const {
  if (!rows.empty()) return rows[row][name];
  return spans[name].at(cube[row * names.size() + name]);
}

nlohmann::json sweep_file_schema() {
  json schema = scenario_schema();
  json& sweep = schema["properties"]["sweep"];
  sweep = sweep_rule().schema();
  sweep["description"] = "what varies, for slipcheck sweep (slipcheck run refuses it)";
  return schema;
}

Rule<SweepBlock> sweep_rule() {
  const auto by = [](auto read, auto schema) { return Rule<SweepBlock>{read, schema}; };
  Record<SweepBlock> block;
  block
      .whole("grid", by(read_grid, grid_schema), optional,
             "by name: all combinations of their values")
      .whole("list", by(read_list, rows_schema), optional, "rows of names with a value each")
      .whole("latin_hypercube", part_rule("latin_hypercube"), optional,
             "points in a box, one in each slice")
      .whole("sobol", part_rule("sobol"), optional, "points that fill a box evenly")
      .at_least_one_of({"grid", "list", "latin_hypercube", "sobol"});
  return block.rule();
}

}  // namespace slipcheck
