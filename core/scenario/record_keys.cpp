#include "scenario/record_keys.h"

#include <fmt/format.h>

#include <algorithm>

namespace slipcheck {

using nlohmann::json;

std::vector<std::string> RecordKeys::names() const {
  std::vector<std::string> result;
  for (const Key& key : keys_) result.push_back(key.name);
  return result;
}

bool RecordKeys::has_required_keys() const {
  return std::ranges::any_of(groups_,
                             [](const Group& group) {
                               return group.kind == Group::Kind::exactly_one ||
                                      group.kind == Group::Kind::at_least_one;
                             }) ||
         std::ranges::any_of(keys_,
                             [](const Key& key) { return key.presence != Presence::optional; });
}

/// Looks for keys that are unknown or stand there twice.
bool RecordKeys::read_entries(const YamlNode& node, Reading& reading) const {
  bool good = true;
  const std::vector<std::string> known = names();
  for (const YamlNode::Entry& entry : node.entries) {
    const auto path = [&] {
      return reading.path() + (reading.path().empty() ? "" : ".") + shown(entry.key);
    };
    if (std::ranges::find(known, entry.key) == known.end()) {
      const std::string near = nearest(entry.key, known);
      reading.fault(entry.location, path(),
                    near.empty() ? "is not a key here (there are: " + joined(known) + ")"
                                 : "is not a key here (did you mean " + near + "?)");
      good = false;
      continue;
    }
    const auto first = std::ranges::find(node.entries, entry.key, &YamlNode::Entry::key);
    if (&*first != &entry) {
      reading.fault(
          entry.location, path(),
          fmt::format("must stand here once, but stands in line {} too", first->location.line));
      good = false;
    }
  }
  return good;
}

bool RecordKeys::read(const YamlNode& node, Reading& reading, void* target) const {
  if (!is_mapping(node)) {
    reading.fault(node, "must be a mapping with " + joined(names()));
    return false;
  }
  bool good = read_entries(node, reading);
  const auto missing = [&](const std::string& rule) {
    reading.fault(node.location, reading.path(), rule);
    good = false;
  };
  // A preset that brings nothing is none, which is a fault by itself.
  const bool has_preset = node.find("preset") != nullptr;
  for (const Key& key : keys_) {
    const auto entry = std::ranges::find(node.entries, key.name, &YamlNode::Entry::key);
    if (entry != node.entries.end()) {
      const auto step = reading.key(key.name, entry->location, *entry->value);
      good = key.read(*entry->value, reading, target) && good;
    } else if (key.presence == Presence::required ||
               (key.presence == Presence::or_preset && !has_preset)) {
      missing("needs the key " + key.name);
    }
  }
  for (const Group& group : groups_) {
    const auto is_there = [&](const std::string& name) { return node.find(name) != nullptr; };
    const auto count = std::ranges::count_if(group.names, is_there);
    const bool exactly = group.kind == Group::Kind::exactly_one;
    if (group.kind == Group::Kind::together) {
      if (count == 0) continue;
      const std::string& present = *std::ranges::find_if(group.names, is_there);
      for (const std::string& name : group.names) {
        if (!is_there(name)) missing(fmt::format("needs the key {} with {}", name, present));
      }
    } else if (group.kind == Group::Kind::at_most_one) {
      if (count > 1) missing("may have one of " + joined(group.names) + " alone");
    } else if (count == 0 && group.presence == Presence::or_preset && has_preset) {
      continue;
    } else if (count == 0 || (count > 1 && exactly)) {
      missing(
          fmt::format("needs {} one of {}", exactly ? "exactly" : "at least", joined(group.names)));
    }
  }
  return good;
}

json RecordKeys::schema() const {
  json properties = json::object();
  json needed = json::array();
  for (const Key& key : keys_) {
    json schema = key.schema();
    // What the key means, then what its value looks like.
    const std::string form = schema.value("description", "");
    const std::string between = key.doc.empty() || form.empty() ? "" : ": ";
    if (!(key.doc + form).empty()) schema["description"] = key.doc + between + form;
    properties[key.name] = std::move(schema);
    if (key.presence == Presence::required) needed.push_back(key.name);
  }
  json result = {{"type", "object"}, {"additionalProperties", false}, {"properties", properties}};
  if (!needed.empty()) result["required"] = needed;
  const auto having = [](const std::string& name) {
    return json{{"required", json::array({name})}};
  };
  json groups = json::array();
  for (const Key& key : keys_)
    if (key.presence == Presence::or_preset)
      groups.push_back({{"anyOf", json::array({having("preset"), having(key.name)})}});
  for (const Group& group : groups_) {
    const bool may_be_none =
        group.kind == Group::Kind::at_most_one || group.presence == Presence::or_preset;
    if (may_be_none)
      for (std::size_t a = 0; a < group.names.size(); ++a)
        for (std::size_t b = a + 1; b < group.names.size(); ++b)
          groups.push_back(
              {{"not", {{"required", json::array({group.names[a], group.names[b]})}}}});
    if (group.kind == Group::Kind::at_most_one) continue;
    if (group.kind == Group::Kind::together) {
      json needs = json::object();
      for (const std::string& name : group.names) needs[name] = group.names;
      groups.push_back({{"dependencies", needs}});
      continue;
    }
    json alternatives = json::array();
    for (const std::string& name : group.names) alternatives.push_back(having(name));
    if (group.presence == Presence::or_preset) alternatives.push_back(having("preset"));
    const bool exactly = group.kind == Group::Kind::exactly_one && !may_be_none;
    groups.push_back({{exactly ? "oneOf" : "anyOf", alternatives}});
  }
  if (!groups.empty()) result["allOf"] = groups;
  return result;
}

std::optional<std::size_t> find_alternative(const YamlNode& node, Reading& reading,
                                            const std::string& discriminator,
                                            const std::vector<NamedRecord>& records) {
  std::vector<std::string> names;
  for (const NamedRecord& record : records) names.push_back(record.name);
  std::size_t index = 0;
  if (is_mapping(node)) {
    const auto entry = std::ranges::find(node.entries, discriminator, &YamlNode::Entry::key);
    if (entry == node.entries.end()) {
      reading.fault(node.location, reading.path(),
                    fmt::format("needs the key {}: {}", discriminator, joined(names)));
      return std::nullopt;
    }
    const auto step = reading.key(discriminator, entry->location, *entry->value);
    if (!word(names).read(*entry->value, reading, index)) return std::nullopt;
    return index;
  }
  if (!is_scalar(node)) {
    reading.fault(node, "must be a mapping with the key " + discriminator);
    return std::nullopt;
  }
  if (!word(names).read(node, reading, index)) return std::nullopt;
  if (records[index].stands_alone) return index;
  reading.fault(node, fmt::format("must be a mapping with its parameters, {{{}: {}, …}}",
                                  discriminator, node.text));
  return std::nullopt;
}

YamlNode as_mapping(const YamlNode& node, const std::string& discriminator) {
  if (is_mapping(node)) return node;
  YamlNode mapping;
  mapping.kind = YamlNode::Kind::mapping;
  mapping.location = node.location;
  mapping.entries = {{discriminator, node.location, std::make_shared<YamlNode>(node)}};
  return mapping;
}

NamedRecord named_record(const std::string& discriminator, std::string name, std::string doc,
                         const RecordKeys& keys) {
  NamedRecord record{name, std::move(doc), !keys.has_required_keys(),
                     std::make_shared<RecordKeys>(keys)};
  // find_alternative has read it already.
  record.keys->add(RecordKeys::Key{discriminator, Presence::required, "",
                                   [](const YamlNode&, Reading&, void*) { return true; },
                                   [name] {
                                     return json{{"const", name}};
                                   }});
  return record;
}

json alternatives_schema(const std::vector<NamedRecord>& records) {
  json alternatives = json::array();
  json bare_names = json::array();
  for (const NamedRecord& record : records) {
    json schema = record.keys->schema();
    schema["description"] = record.doc;
    alternatives.push_back(std::move(schema));
    if (record.stands_alone) bare_names.push_back(record.name);
  }
  if (!bare_names.empty()) alternatives.push_back({{"enum", bare_names}});
  return {{"oneOf", alternatives}};
}

}  // namespace slipcheck
