#include "studies/sweep/scene_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <memory>
#include <span>

#include "scenario/rules/rules.h"

namespace slipcheck {
namespace {

std::vector<std::string> segments_of(const std::string& name) {
  std::vector<std::string> segments;
  for (std::size_t begin = 0;;) {
    const std::size_t end = name.find('.', begin);
    segments.push_back(name.substr(begin, end - begin));
    if (end == std::string::npos) return segments;
    begin = end + 1;
  }
}

std::optional<std::size_t> item_of(const YamlNode& list, const std::string& segment) {
  std::size_t index = 0;
  const char* const last = segment.data() + segment.size();
  const auto [end, error] = std::from_chars(segment.data(), last, index);
  if (error == std::errc() && end == last)
    return index < list.items.size() ? std::optional(index) : std::nullopt;
  for (std::size_t k = 0; k < list.items.size(); ++k) {
    const YamlNode* name = list.items[k]->find("name");
    if (name != nullptr && name->text == segment) return k;
  }
  return std::nullopt;
}

/// The longest run of segments that is a key, as that of a tolerance may hold dots; 0 if none is.
std::size_t key_length(const YamlNode& mapping, std::span<const std::string> segments) {
  for (std::size_t length = segments.size(); length > 0; --length)
    if (mapping.find(fmt::format("{}", fmt::join(segments.first(length), "."))) != nullptr)
      return length;
  return 0;
}

YamlPointer replaced(const YamlPointer& node, std::span<const ScenePath::Step> steps,
                     const YamlPointer& value, Location location) {
  if (steps.empty()) return value;
  auto copy = std::make_shared<YamlNode>(*node);
  const ScenePath::Step& step = steps.front();
  if (step.index) {
    YamlPointer& item = copy->items[*step.index];
    item = replaced(item, steps.subspan(1), value, location);
    return copy;
  }
  const auto entry = std::ranges::find(copy->entries, step.key, &YamlNode::Entry::key);
  if (entry == copy->entries.end())
    copy->entries.push_back({step.key, location, value});
  else
    entry->value = replaced(entry->value, steps.subspan(1), value, location);
  return copy;
}

}  // namespace

std::string ScenePath::text() const {
  std::string text;
  for (const Step& step : steps) {
    if (step.index)
      text += fmt::format("[{}]", *step.index);
    else
      text += (text.empty() ? "" : ".") + step.key;
  }
  return text;
}

std::string dotted(std::string written) {
  std::string name;
  for (const char c : written) {
    if (c == '[')
      name += '.';
    else if (c != ']')
      name += c;
  }
  return name;
}

ScenePath scene_path(const YamlNode& root, const std::string& written) {
  const std::vector<std::string> all = segments_of(dotted(written));
  std::span<const std::string> left = all;
  ScenePath path;
  const YamlNode* node = &root;
  while (!left.empty()) {
    const std::string above = path.steps.empty() ? "the scene" : path.text();
    if (left.front().empty()) throw BadPath("must be keys of the scene, joined by dots");
    if (node->kind == YamlNode::Kind::list) {
      const auto index = item_of(*node, left.front());
      if (!index)
        throw BadPath(fmt::format("must be a path of the scene, and {} has no item {}", above,
                                  shown(left.front())));
      path.steps.push_back({"", index});
      node = node->items[*index].get();
      left = left.subspan(1);
      continue;
    }
    if (node->kind != YamlNode::Kind::mapping)
      throw BadPath(fmt::format("must be a path of the scene, and {} has no keys", above));
    const std::size_t length = key_length(*node, left);
    if (length == 0 && left.size() > 1) {
      std::vector<std::string> keys;
      for (const YamlNode::Entry& entry : node->entries) keys.push_back(entry.key);
      throw BadPath(fmt::format("must be a path of the scene, and {} has no {}{}", above,
                                shown(left.front()), did_you_mean(left.front(), keys)));
    }
    const std::size_t taken = std::max<std::size_t>(length, 1);
    path.steps.push_back({fmt::format("{}", fmt::join(left.first(taken), ".")), {}});
    node = node->find(path.steps.back().key);
    left = left.subspan(taken);
  }
  return path;
}

YamlPointer with_value(const YamlPointer& root, const ScenePath& path, const YamlPointer& value,
                       Location location) {
  return replaced(root, path.steps, value, location);
}

YamlPointer without_key(const YamlPointer& root, const std::string& key) {
  auto copy = std::make_shared<YamlNode>(*root);
  std::erase_if(copy->entries, [&](const YamlNode::Entry& entry) { return entry.key == key; });
  return copy;
}

}  // namespace slipcheck
