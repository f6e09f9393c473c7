#include "scenario/rules/rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipcheck {
namespace {

using nlohmann::json;

/// Beyond this no quantity of a scene means anything, and products of a few stay finite.
constexpr double kLargest = 1e30;

/// A number and what may follow it, as a regular expression; which units there are is left to the
/// loader.
std::string quantity_pattern(const Range& range) {
  const bool no_minus = range.least.value_or(-1) >= 0 || range.above.value_or(-1) >= 0;
  return std::string(no_minus ? R"(^[+]?)" : R"(^[-+]?)") +
         R"(([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?([ \t]*([^0-9 \t+.,-]|1/).*)?$)";
}

std::string limits(const Range& range, const std::string& unit) {
  std::string text;
  const auto add = [&](const char* sign, const std::optional<double>& limit) {
    if (!limit) return;
    if (!text.empty()) text += " and ";
    text += fmt::format("{} {}", sign, *limit);
  };
  add(">=", range.least);
  add(">", range.above);
  add("<=", range.most);
  add("<", range.below);
  if (!text.empty() && !unit.empty()) text += ' ' + unit;
  return text;
}

bool contains(const Range& range, double value) {
  return !(range.least && value < *range.least) && !(range.above && value <= *range.above) &&
         !(range.most && value > *range.most) && !(range.below && value >= *range.below);
}

/// A plain scalar that YAML 1.2 reads as something other than text or a number.
bool is_no_text(const YamlNode& node) {
  if (!node.plain) return false;
  for (const char* word : {"true", "True", "TRUE", "false", "False", "FALSE"}) {
    if (node.text == word) return true;
  }
  return false;
}

constexpr std::size_t kLongestName = 64;

/// What names of a style may be made of, for people and as a pattern of the schema.
struct NameForm {
  const char* rule;
  const char* pattern;
};

NameForm form_of(NameStyle style) {
  switch (style) {
    case NameStyle::lower_case:
      return {"must be a name of a-z, 0-9 and -, up to 64", "^[a-z0-9-]+$"};
    case NameStyle::engine:
      return {"must be a name of a-z, 0-9, -, _, . and @ that begins with a letter, up to 64",
              "^[a-z][a-z0-9_.@-]*$"};
    case NameStyle::any_case:
      break;
  }
  return {"must be a name of letters, digits and _, joined by -, up to 64",
          "^[A-Za-z0-9_]+(-[A-Za-z0-9_]+)*$"};
}

bool may_stand_in(NameStyle style, char c) {
  const bool lower = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
  if (lower || c == '-') return true;
  if (style == NameStyle::engine) return c == '_' || c == '.' || c == '@';
  return style == NameStyle::any_case && ((c >= 'A' && c <= 'Z') || c == '_');
}

bool is_name(const std::string& text, NameStyle style) {
  if (text.empty() || text.size() > kLongestName) return false;
  for (const char c : text)
    if (!may_stand_in(style, c)) return false;
  if (style == NameStyle::engine) return text[0] >= 'a' && text[0] <= 'z';
  return style == NameStyle::lower_case ||
         (text.front() != '-' && text.back() != '-' && text.find("--") == std::string::npos);
}

}  // namespace

Rule<double> number(const Dimension& dimension, const Range& range) {
  const auto read = [dimension, range](const YamlNode& node, Reading& reading, double& target) {
    const std::string unit = unit_name(dimension, reading.units());
    if (!is_scalar(node)) {
      std::string rule = fmt::format("must be {}", with_article(dimension));
      if (!unit.empty()) rule += fmt::format(" in {}, or with its own unit", unit);
      reading.fault(node, rule + fmt::format(" as in \"{}\"", dimension.example));
      return false;
    }
    Quantity quantity;
    try {
      quantity = parse_quantity(node.text, dimension);
    } catch (const BadQuantity& bad) {
      reading.fault(node, bad.what());
      return false;
    }
    const double si =
        quantity.has_unit ? quantity.value : to_si(quantity.value, dimension, reading.units());
    // Limits other than 0 belong to pure numbers and angles, the same in both systems of units.
    const double in_limits = quantity.has_unit && dimension.angle == 1 && dimension.time == 0
                                 ? quantity.value * 180 / std::numbers::pi
                                 : quantity.value;
    if (!contains(range, in_limits)) {
      reading.fault(node, "must be " + limits(range, unit));
      return false;
    }
    if (std::abs(si) > kLargest || (si != 0 && std::abs(si) < 1 / kLargest)) {
      reading.fault(node, "must be 0 or of a magnitude between 1e-30 and 1e30 in SI units");
      return false;
    }
    target = si;
    reading.note_number(si, dimension);
    return true;
  };
  const auto schema = [dimension, range] {
    json result = {{"type", {"number", "string"}}, {"pattern", quantity_pattern(range)}};
    if (range.least) result["minimum"] = *range.least;
    if (range.above) result["exclusiveMinimum"] = *range.above;
    if (range.most) result["maximum"] = *range.most;
    if (range.below) result["exclusiveMaximum"] = *range.below;
    std::string text = dimension.name;
    const std::string si = dimension.si;
    if (!si.empty()) {
      text += si == dimension.cgs ? fmt::format(" [{}]", si)
                                  : fmt::format(" [{}; {} in a cgs file]", si, dimension.cgs);
    }
    const std::string limit = limits(range, "");
    if (!limit.empty()) text += ", " + limit;
    result["description"] =
        fmt::format("{}; or with its own unit, \"{}\"", text, dimension.example);
    return result;
  };
  return {read, schema};
}

Rule<std::int64_t> integer(std::int64_t least, std::int64_t most) {
  const std::string rule = least == most
                               ? fmt::format("must be {}", least)
                               : fmt::format("must be a whole number from {} to {}", least, most);
  return {[=](const YamlNode& node, Reading& reading, std::int64_t& target) {
            double value = 0.5;
            if (is_scalar(node) && node.plain) {
              try {
                value = parse_number(node.text);
              } catch (const BadQuantity&) {
                value = 0.5;
              }
            }
            if (value != std::floor(value) || value < static_cast<double>(least) ||
                value > static_cast<double>(most)) {
              reading.fault(node, rule);
              return false;
            }
            target = static_cast<std::int64_t>(value);
            reading.note_number(value, kPureNumber);
            return true;
          },
          [=] {
            return json{{"type", "integer"}, {"minimum", least}, {"maximum", most}};
          }};
}

Rule<bool> boolean() {
  return {[](const YamlNode& node, Reading& reading, bool& target) {
            const bool plain = is_scalar(node) && node.plain;
            for (const char* word : {"true", "True", "TRUE"}) {
              if (plain && node.text == word) {
                target = true;
                return true;
              }
            }
            for (const char* word : {"false", "False", "FALSE"}) {
              if (plain && node.text == word) {
                target = false;
                return true;
              }
            }
            reading.fault(node, "must be true or false");
            return false;
          },
          [] {
            return json{{"type", "boolean"}};
          }};
}

Rule<std::string> free_text() {
  return {[](const YamlNode& node, Reading& reading, std::string& target) {
            if (!is_scalar(node) || node.text.empty() || is_no_text(node)) {
              reading.fault(node, "must be a text");
              return false;
            }
            target = node.text;
            return true;
          },
          [] {
            return json{{"type", {"string", "number"}}, {"minLength", 1}};
          }};
}

Rule<std::string> name_text(NameStyle style) {
  return {[style](const YamlNode& node, Reading& reading, std::string& target) {
            if (!is_scalar(node) || is_no_text(node) || !is_name(node.text, style)) {
              reading.fault(node, form_of(style).rule);
              return false;
            }
            target = node.text;
            return true;
          },
          [style] {
            json schema = {{"type", {"string", "integer"}}, {"maxLength", kLongestName}};
            schema["pattern"] = form_of(style).pattern;
            if (style == NameStyle::engine) {  // no number is one
              schema["type"] = "string";
              return schema;
            }
            if (style != NameStyle::lower_case) schema["minimum"] = 0;  // no name begins with '-'
            return schema;
          }};
}

Rule<std::vector<double>> numbers(const Dimension& dimension, const Range& range,
                                  const std::vector<std::size_t>& counts) {
  const Rule<double> entry = number(dimension, range);
  std::vector<std::string> words;
  for (const std::size_t count : counts) words.push_back(std::to_string(count));
  const std::string rule = "must be a list of " + joined(words) + " numbers";
  return {[=](const YamlNode& node, Reading& reading, std::vector<double>& target) {
            if (!is_list(node) || std::ranges::find(counts, node.items.size()) == counts.end()) {
              reading.fault(node, rule);
              return false;
            }
            return list(entry, 0).read(node, reading, target);
          },
          [=] {
            json alternatives = json::array();
            for (const std::size_t count : counts) {
              alternatives.push_back(list_schema(entry.schema(), count, count));
            }
            return alternatives.size() == 1 ? alternatives[0] : json{{"anyOf", alternatives}};
          }};
}

Rule<std::vector<double>> row(const std::vector<std::pair<Dimension, Range>>& columns) {
  std::vector<Rule<double>> entries;
  for (const auto& [dimension, range] : columns) entries.push_back(number(dimension, range));
  return {[=](const YamlNode& node, Reading& reading, std::vector<double>& target) {
            if (!is_list(node, reading, entries.size(), entries.size())) return false;
            bool good = true;
            target.assign(entries.size(), 0);
            for (std::size_t i = 0; i < entries.size(); ++i) {
              const auto step = reading.item(i, *node.items[i]);
              good = entries[i].read(*node.items[i], reading, target[i]) && good;
            }
            return good;
          },
          [=] {
            json items = json::array();
            for (const Rule<double>& entry : entries) items.push_back(entry.schema());
            return list_schema(items, entries.size(), entries.size());
          }};
}

Rule<Vector2> pair_of(const Dimension& dimension, const Range& range) {
  return made_from<Vector2>(numbers(dimension, range, {2}),
                            [](const std::vector<double>& xy) { return Vector2(xy[0], xy[1]); });
}

Rule<Vector3> triple_of(const Dimension& dimension, const Range& range) {
  return made_from<Vector3>(numbers(dimension, range, {3}), [](const std::vector<double>& xyz) {
    return Vector3(xyz[0], xyz[1], xyz[2]);
  });
}

Rule<std::size_t> word(std::vector<std::string> words) {
  return {[words](const YamlNode& node, Reading& reading, std::size_t& target) {
            const auto found = is_scalar(node) ? std::ranges::find(words, node.text) : words.end();
            if (found == words.end()) {
              std::string rule = "must be " + joined(words);
              if (is_scalar(node) && words.size() > 1) rule += did_you_mean(node.text, words);
              reading.fault(node, rule);
              return false;
            }
            target = static_cast<std::size_t>(found - words.begin());
            return true;
          },
          [words] {
            return json{{"type", "string"}, {"enum", words}};
          }};
}

bool is_list(const YamlNode& node, Reading& reading, std::size_t least, std::size_t most) {
  const std::size_t size = node.items.size();
  if (is_list(node) && size >= least && (most == kNoLimit || size <= most)) return true;
  std::string rule = "must be a list";
  if (most == least && most != kNoLimit) {
    rule += fmt::format(" of {}", least);
  } else if (least > 0) {
    rule += fmt::format(" of at least {}", least);
  }
  reading.fault(node, rule);
  return false;
}

json list_schema(json items, std::size_t least, std::size_t most) {
  json result = {{"type", "array"}, {"items", std::move(items)}};
  if (least > 0) result["minItems"] = least;
  if (most != kNoLimit) result["maxItems"] = most;
  return result;
}

bool is_scalar(const YamlNode& node) { return node.kind == YamlNode::Kind::scalar; }
bool is_list(const YamlNode& node) { return node.kind == YamlNode::Kind::list; }
bool is_mapping(const YamlNode& node) { return node.kind == YamlNode::Kind::mapping; }

std::function<bool(const YamlNode&)> is_word(std::string expected) {
  return [expected = std::move(expected)](const YamlNode& node) {
    return is_scalar(node) && node.text == expected;
  };
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

std::string nearest(const std::string& written, const std::vector<std::string>& words) {
  if (written.size() > 64) return "";
  std::string best;
  std::size_t fewest = std::max<std::size_t>(1, written.size() / 3) + 1;
  for (const std::string& candidate : words) {
    // Edits from what is written up to i to the candidate up to j; two neighbours that are swapped
    // are one.
    std::vector<std::vector<std::size_t>> edits(written.size() + 1,
                                                std::vector<std::size_t>(candidate.size() + 1));
    for (std::size_t i = 0; i <= written.size(); ++i)
      for (std::size_t j = 0; j <= candidate.size(); ++j) {
        if (i == 0 || j == 0) {
          edits[i][j] = i + j;
          continue;
        }
        const bool same = written[i - 1] == candidate[j - 1];
        edits[i][j] = std::min(
            {edits[i - 1][j - 1] + (same ? 0 : 1), edits[i - 1][j] + 1, edits[i][j - 1] + 1});
        if (i > 1 && j > 1 && written[i - 1] == candidate[j - 2] &&
            written[i - 2] == candidate[j - 1])
          edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
      }
    if (edits.back().back() < fewest) {
      fewest = edits.back().back();
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& written, const std::vector<std::string>& words) {
  const std::string near = nearest(written, words);
  return near.empty() ? "" : " (did you mean " + near + "?)";
}

}  // namespace slipcheck
