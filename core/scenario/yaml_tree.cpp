#include "scenario/yaml_tree.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

#include "base/text.h"
#include "scenario/fault.h"

namespace slipcheck {
namespace {

Location location_of(const YAML::Mark& mark) {
  if (mark.is_null()) return {};
  return {mark.line + 1, mark.column + 1};
}

/// What yaml-cpp read from well-formed text, which writes the escapes \N and \_ as the bytes 85 and
/// A0 alone: with the characters U+0085 and U+00A0 that YAML 1.2, 5.7, means by them.
std::string whole_characters(const std::string& value) {
  std::string result;
  for (std::string_view rest = value; !rest.empty();) {
    const auto first = static_cast<unsigned char>(rest[0]);
    append_code_point(result, take_code_point(rest).value_or(first));
  }
  return result;
}

/// Leaves the parser at the first thing that makes the rest meaningless.
struct Refusal {
  Location location;
  std::string rule;
};

/// Builds the tree from the parser's events. Unlike YAML::Load this sees duplicate keys, and counts
/// what an alias stands for without writing it out.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(std::string_view content) : content_(content) {}

  YamlPointer root() const { return root_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (started_)
      throw Refusal{location_of(mark), "a file holds one " + content_ + ", one YAML document"};
    started_ = true;
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    auto node = std::make_shared<YamlNode>();
    node->location = location_of(mark);
    add(std::move(node), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) {
      throw Refusal{location_of(mark), "an alias must not stand inside of what it names"};
    }
    place(found->second, location_of(mark));
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_tag(tag, mark);
    auto node = std::make_shared<YamlNode>();
    node->kind = YamlNode::Kind::scalar;
    node->location = location_of(mark);
    node->text = whole_characters(value);
    node->plain = tag != "!";
    add(std::move(node), anchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::list, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::mapping, mark, tag, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Level {
    std::shared_ptr<YamlNode> node;
    YAML::anchor_t anchor;
    YamlPointer key;  ///< of a mapping, while its value is awaited
    Location key_location;
  };

  static void refuse_tag(const std::string& tag, const YAML::Mark& mark) {
    if (tag.empty() || tag == "?" || tag == "!") return;
    throw Refusal{location_of(mark), "YAML tags have no meaning here, got " + tag};
  }

  void open(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
            YAML::anchor_t anchor) {
    refuse_tag(tag, mark);
    if (levels_.size() >= kMostLevels) throw too_deep(location_of(mark));
    auto node = std::make_shared<YamlNode>();
    node->kind = kind;
    node->location = location_of(mark);
    levels_.push_back({std::move(node), anchor, nullptr, {}});
  }

  void close() {
    Level level = std::move(levels_.back());
    levels_.pop_back();
    add(std::move(level.node), level.anchor);
  }

  void add(YamlPointer node, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) anchors_[anchor] = node;
    const Location location = node->location;
    place(std::move(node), location);
  }

  /// Puts a finished node where the parser stands, which for an alias is not where it was written.
  void place(YamlPointer node, Location location) {
    if (levels_.empty()) {
      root_ = std::move(node);
      return;
    }
    Level& level = levels_.back();
    YamlNode& parent = *level.node;
    parent.size += node->size;
    parent.depth = std::max(parent.depth, node->depth + 1);
    if (parent.size > kMostNodes) {
      throw Refusal{location, "a " + content_ + " must have at most " + std::to_string(kMostNodes) +
                                  " YAML nodes with its aliases written out"};
    }
    if (parent.depth > kMostLevels) throw too_deep(location);
    if (parent.kind == YamlNode::Kind::list) {
      parent.items.push_back(std::move(node));
    } else if (!level.key) {
      if (node->kind == YamlNode::Kind::list || node->kind == YamlNode::Kind::mapping) {
        throw Refusal{location, "a key must be a word"};
      }
      level.key = std::move(node);
      level.key_location = location;
    } else {
      parent.entries.push_back({level.key->text, level.key_location, std::move(node)});
      level.key = nullptr;
    }
  }

  Refusal too_deep(Location location) const {
    return {location, "a " + content_ + " must be nested at most " + std::to_string(kMostLevels) +
                          " levels deep"};
  }

  std::string content_;
  bool started_ = false;
  YamlPointer root_;
  std::vector<Level> levels_;
  std::map<YAML::anchor_t, YamlPointer> anchors_;
};

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  for (const Entry& entry : entries) {
    if (entry.key == key) return entry.value.get();
  }
  return nullptr;
}

YamlPointer parse_yaml(std::string_view text, const std::string& file, const char* content) {
  TreeBuilder builder(content);
  try {
    std::istringstream stream{std::string(text)};
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const Refusal& refusal) {
    throw BadScenario({{file, refusal.location, "", refusal.rule, ""}});
  } catch (const YAML::Exception& error) {
    throw BadScenario({{file, location_of(error.mark), "", "must be YAML: " + error.msg, ""}});
  }
  if (!builder.root() || builder.root()->kind == YamlNode::Kind::null) {
    throw BadScenario({{file, {}, "", fmt::format("must hold a {}, but is empty", content), ""}});
  }
  return builder.root();
}

}  // namespace slipcheck
