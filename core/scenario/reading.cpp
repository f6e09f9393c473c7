#include "scenario/reading.h"

#include <fmt/format.h>

#include <utility>

namespace slipcheck {
namespace {

/// More faults than anybody reads; a hostile file could have as many as it has bytes.
constexpr std::size_t kMostFaults = 1000;

constexpr std::size_t kMostShown = 60;

/// Adds a node in YAML's flow style, up to about the length that is shown.
void add_shown(const YamlNode& node, std::string& text) {
  const auto is_full = [&] {
    if (text.size() <= kMostShown) return false;
    if (!text.ends_with("…")) text += "…";
    return true;
  };
  switch (node.kind) {
    case YamlNode::Kind::null:
      text += "nothing";
      break;
    case YamlNode::Kind::scalar:
      text += node.plain ? shown(node.text) : '"' + shown(node.text) + '"';
      break;
    case YamlNode::Kind::list:
      text += '[';
      for (std::size_t i = 0; i < node.items.size(); ++i) {
        if (i > 0) text += ", ";
        if (is_full()) return;
        add_shown(*node.items[i], text);
      }
      text += ']';
      break;
    case YamlNode::Kind::mapping:
      text += '{';
      for (std::size_t i = 0; i < node.entries.size(); ++i) {
        if (i > 0) text += ", ";
        if (is_full()) return;
        text += shown(node.entries[i].key) + ": ";
        add_shown(*node.entries[i].value, text);
      }
      text += '}';
      break;
  }
}

}  // namespace

Reading::Step::Step(Reading& reading, std::string_view name, Location location,
                    const YamlNode& value)
    : reading_(reading), length_(reading.path_.size()) {
  if (length_ > 0 && name[0] != '[') reading.path_ += '.';
  reading.path_ += name;
  // Where a rule over several keys fails, more than a value or a list of them would only be noise.
  const bool is_small = value.kind != YamlNode::Kind::mapping && value.depth <= 2;
  reading.found_.try_emplace(reading.path_,
                             Found{location, value.location, is_small ? shown(value) : ""});
}

std::map<std::string, Location> Reading::locations() const {
  std::map<std::string, Location> result;
  for (const auto& [path, found] : found_) result.emplace_hint(result.end(), path, found.key);
  return result;
}

void Reading::fault(const YamlNode& node, std::string rule) {
  fault(node.location, path_, std::move(rule), shown(node));
}

void Reading::fault(Location location, std::string path, std::string rule, std::string value) {
  if (faults_.size() < kMostFaults) {
    faults_.push_back({file_, location, std::move(path), std::move(rule), std::move(value)});
  } else if (faults_.size() == kMostFaults) {
    faults_.push_back({file_, location, "", "has more faults, which are not listed", ""});
  }
}

void Reading::fault_at(const std::string& path, std::string rule) {
  std::string known = path;
  while (!known.empty() && !has(known)) {
    const std::size_t end = known.find_last_of(".[");
    known.resize(end == std::string::npos ? 0 : end);
  }
  if (known.empty()) {
    fault({1, 1}, path, std::move(rule));
  } else if (known == path) {
    const Found& found = found_.at(path);
    fault(found.value, path, std::move(rule), found.shown);
  } else {
    fault(found_.at(known).value, path, std::move(rule));
  }
}

void Reading::note_number(double value, const Dimension& dimension) {
  if (numbers_ == nullptr) return;
  const auto wanted = numbers_->find(path_);
  if (wanted == numbers_->end()) return;
  const bool is_angle = dimension.angle == 1 && dimension.time == 0;
  wanted->second = ReadNumber{value, is_angle ? "rad" : dimension.si};
}

void Reading::throw_faults() const {
  if (!faults_.empty()) throw BadScenario(faults_);
}

std::string shown(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool starts_character = (byte & 0xC0) != 0x80;
    if (starts_character && result.size() >= kMostShown) return result + "…";
    const bool is_c1 =
        byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0;
    if (byte == '\n') {
      result += "\\n";
    } else if (byte == '\t') {
      result += "\\t";
    } else if (byte < 0x20 || byte == 0x7F) {
      result += fmt::format("\\x{:02x}", byte);
    } else if (is_c1) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[++i]));
    } else {
      result += text[i];
    }
  }
  return result;
}

std::string shown(const YamlNode& node) {
  std::string text;
  add_shown(node, text);
  return text;
}

}  // namespace slipcheck
