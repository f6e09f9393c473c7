#include "scenario/content_digest.h"

#include <charconv>
#include <nlohmann/json.hpp>

#include "scenario/file_text.h"
#include "scenario/yaml_tree.h"

namespace slipcheck {
namespace {

using nlohmann::json;  // whose objects are sorted by their keys

json scalar_content(const YamlNode& node) {
  double number = 0;
  const char* const end = node.text.data() + node.text.size();
  const auto [stop, error] = std::from_chars(node.text.data(), end, number);
  if (node.plain && error == std::errc() && stop == end) return number;
  return node.text;
}

json content_of(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::null:
      break;
    case YamlNode::Kind::scalar:
      return scalar_content(node);
    case YamlNode::Kind::list: {
      json list = json::array();
      for (const YamlPointer& item : node.items) list.push_back(content_of(*item));
      return list;
    }
    case YamlNode::Kind::mapping: {
      json mapping = json::object();
      for (const YamlNode::Entry& entry : node.entries)
        mapping[entry.key] = content_of(*entry.value);
      return mapping;
    }
  }
  return nullptr;
}

}  // namespace

std::string content_digest(const Scenario& scenario) {
  if (scenario.text.empty()) return scenario.sha256;
  return content_digest(*parse_yaml(checked_text(scenario.text, scenario.file), scenario.file));
}

std::string content_digest(const YamlNode& root) {
  json content = content_of(root);
  if (content.is_object())
    for (const char* words : {"title", "source"}) content.erase(words);
  return sha256_hex(content.dump());
}

std::string content_text(const YamlNode& node) { return content_of(node).dump(); }

}  // namespace slipcheck
