#pragma once

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "scenario/rules/rules.h"

namespace slipcheck {

/// `or_preset`: required, but a preset may bring it (presets.h).
enum class Presence { required, optional, or_preset };
inline constexpr Presence required = Presence::required;
inline constexpr Presence optional = Presence::optional;
inline constexpr Presence or_preset = Presence::or_preset;

/// The keys of a mapping, with the type of what they are read into left out: one body of code for
/// all records.
class RecordKeys {
 public:
  struct Key {
    std::string name;
    Presence presence;
    std::string doc;
    std::function<bool(const YamlNode&, Reading&, void*)> read;
    std::function<nlohmann::json()> schema;
  };

  void add(Key key) { keys_.push_back(std::move(key)); }
  /// Exactly one of these keys, at least one, not several, or all or none.
  struct Group {
    enum class Kind { exactly_one, at_least_one, at_most_one, together };
    std::vector<std::string> names;
    Kind kind;
    Presence presence = Presence::required;  ///< of exactly one: a preset may bring it
  };
  void add(Group group) { groups_.push_back(std::move(group)); }

  /// Reads the keys in the order of the table, so that a later rule can look at earlier fields.
  bool read(const YamlNode& node, Reading& reading, void* target) const;
  nlohmann::json schema() const;
  bool has_required_keys() const;

 private:
  std::vector<std::string> names() const;
  bool read_entries(const YamlNode& node, Reading& reading) const;

  std::vector<Key> keys_;
  std::vector<Group> groups_;
};

/// The rule of a mapping that is read into a T, key by key into its fields.
template <class T>
class Record {
 public:
  /// A field of the rule's type, or an optional of it.
  template <class Field, class Value>
  Record& key(std::string name, Field T::*field, Rule<Value> rule, Presence presence,
              std::string doc) {
    static_assert(std::is_same_v<Field, Value> || std::is_same_v<Field, std::optional<Value>>);
    keys_->add(RecordKeys::Key{
        name, presence, doc,
        [field, read = rule.read](const YamlNode& node, Reading& reading, void* target) {
          Field& value = static_cast<T*>(target)->*field;
          if constexpr (std::is_same_v<Field, Value>) {
            return read(node, reading, value);
          } else {
            const bool good = read(node, reading, value.emplace());
            if (!good) value.reset();
            return good;
          }
        },
        rule.schema});
    return *this;
  }

  /// A key whose rule looks at the whole record.
  Record& whole(std::string name, Rule<T> rule, Presence presence, std::string doc) {
    keys_->add(
        RecordKeys::Key{name, presence, doc,
                        [read = rule.read](const YamlNode& node, Reading& reading, void* target) {
                          return read(node, reading, *static_cast<T*>(target));
                        },
                        rule.schema});
    return *this;
  }

  Record& exactly_one_of(std::vector<std::string> names, Presence presence = required) {
    keys_->add(RecordKeys::Group{std::move(names), RecordKeys::Group::Kind::exactly_one, presence});
    return *this;
  }
  Record& at_most_one_of(std::vector<std::string> names) {
    keys_->add(RecordKeys::Group{std::move(names), RecordKeys::Group::Kind::at_most_one});
    return *this;
  }
  Record& at_least_one_of(std::vector<std::string> names) {
    keys_->add(RecordKeys::Group{std::move(names), RecordKeys::Group::Kind::at_least_one});
    return *this;
  }
  /// Each of them needs the others.
  Record& together(std::vector<std::string> names) {
    keys_->add(RecordKeys::Group{std::move(names), RecordKeys::Group::Kind::together});
    return *this;
  }

  Rule<T> rule() const {
    return {[keys = keys_](const YamlNode& node, Reading& reading, T& target) {
              return keys->read(node, reading, &target);
            },
            [keys = keys_] { return keys->schema(); }};
  }

  std::shared_ptr<RecordKeys> keys() const { return keys_; }

 private:
  std::shared_ptr<RecordKeys> keys_ = std::make_shared<RecordKeys>();
};

/// One way to fill a variant: by a mapping whose discriminator has this name.
template <class V>
struct Alternative {
  std::string name;
  std::string doc;
  std::shared_ptr<RecordKeys> keys;
  void* (*emplace)(V&);
};

template <class V, class T>
Alternative<V> alternative(const char* name, const char* doc, const Record<T>& record) {
  return {name, doc, record.keys(),
          [](V& target) -> void* { return &target.template emplace<T>(); }};
}

/// The alternatives without what they are read into.
struct NamedRecord {
  std::string name;
  std::string doc;
  bool stands_alone;  ///< may be written as its bare name, as it has no required keys
  std::shared_ptr<RecordKeys> keys;
};

/// Which alternative a node names; nothing after noting a fault.
std::optional<std::size_t> find_alternative(const YamlNode& node, Reading& reading,
                                            const std::string& discriminator,
                                            const std::vector<NamedRecord>& records);
/// {discriminator: name} for a bare name, else the node itself.
YamlNode as_mapping(const YamlNode& node, const std::string& discriminator);
nlohmann::json alternatives_schema(const std::vector<NamedRecord>& records);
NamedRecord named_record(const std::string& discriminator, std::string name, std::string doc,
                         const RecordKeys& keys);

/// A variant by the key `discriminator`: {model: linear, …}. An alternative without required keys
/// may be written as its bare name.
template <class V>
Rule<V> one_of(const std::string& discriminator, const std::vector<Alternative<V>>& alternatives) {
  std::vector<NamedRecord> records;
  std::vector<void* (*)(V&)> emplace;
  for (const Alternative<V>& each : alternatives) {
    records.push_back(named_record(discriminator, each.name, each.doc, *each.keys));
    emplace.push_back(each.emplace);
  }
  return {[=](const YamlNode& node, Reading& reading, V& target) {
            const auto index = find_alternative(node, reading, discriminator, records);
            return index && records[*index].keys->read(as_mapping(node, discriminator), reading,
                                                       emplace[*index](target));
          },
          [=] { return alternatives_schema(records); }};
}

}  // namespace slipcheck
