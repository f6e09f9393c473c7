#pragma once

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/json_node.h"
#include "base/not_finite.h"
#include "base/text.h"

/// A record names its fields once, for writing and for reading, in the order of the file:
///
///   template <class Fields>
///   void describe(Fields& f, WorkCost& cost) {
///     f("cpu_per_step", cost.per_step);
///     f("repeats", cost.repeats);
///   }
///
/// What one direction alone does stands under `if constexpr (Fields::kReads)`; a record that is
/// written is only looked at. Fields are numbers, counts, flags, texts, enumerations with names
/// (enum_names.h), records that are described themselves, and lists, sets, maps by name, pairs,
/// variants and optionals of these; an optional one that has no value is left out.
namespace slipcheck {

/// The range that a number must be in.
struct NumberRange {
  double least = std::numeric_limits<double>::lowest();
  double most = std::numeric_limits<double>::max();
};
inline constexpr NumberRange kAboveZero{.least = kTiny};
inline constexpr NumberRange kNotBelowZero{.least = 0};

namespace json_fields {

template <class Value>
concept Map = requires {
  typename Value::mapped_type;
};
template <class Value>
concept List = !Map<Value> && requires(Value list) {
  typename Value::value_type;
  list.insert(list.end(), *list.begin());
};
template <class Value>
inline constexpr bool kIsOptional = false;
template <class Value>
inline constexpr bool kIsOptional<std::optional<Value>> = true;
template <class Value>
inline constexpr bool kIsPair = false;
template <class First, class Second>
inline constexpr bool kIsPair<std::pair<First, Second>> = true;
using Setting = std::variant<bool, double, std::string>;
/// What it has to say of its numbers stands in it.
template <class Value>
inline constexpr bool kHasNoReasons = std::is_class_v<Value> && !List<Value> &&
                                      !kIsOptional<Value> && !std::is_same_v<Value, Setting>;

}  // namespace json_fields

/// How a number that is not finite is written.
enum class NotFinite { null_with_reason, null, as_it_is };

/// Puts the fields of a record into an object.
template <class Json, NotFinite not_finite = NotFinite::null_with_reason>
class FieldWriter {
 public:
  static constexpr bool kReads = false;

  explicit FieldWriter(Json& object) : object_(object) {}

  /// `why` there is no number where it is null, or some of a list are.
  template <class Value>
  void operator()(const std::string& key, const Value& value, const std::string& why = {}) {
    if constexpr (json_fields::kIsOptional<Value>) {
      if (value) (*this)(key, *value, why);
    } else if constexpr (std::is_same_v<Value, json_fields::Setting>) {
      std::visit([&](const auto& each) { (*this)(key, each, why); }, value);
    } else if constexpr (std::is_floating_point_v<Value> &&
                         not_finite == NotFinite::null_with_reason) {
      put_number(object_, key, value, why);
      put_own_reason();
    } else {
      object_[key] = json_of_value(value);
      if constexpr (not_finite == NotFinite::null_with_reason) {
        note_infinities(key, value);
        if (!why.empty() && has_null(object_[key])) add_reason(object_, why);
        put_own_reason();
      }
    }
  }
  void operator()(const std::string& key, double value, NumberRange) { (*this)(key, value); }

  /// A number of which reason() says why it is null.
  void untold(const std::string& key, double value) {
    object_[key] = json_of_value(value);
    if (!std::isfinite(value)) note_null(object_, key, value);
    put_own_reason();
  }
  /// Left out where it is what a fresh one is.
  template <class Value>
  void if_any(const std::string& key, const Value& value, const std::string& why = {}) {
    if (value != Value{}) (*this)(key, value, why);
  }
  /// Left out where it is what it usually is, and then keeps what it has.
  template <class Value>
  void unless(const std::string& key, const Value& value, const Value& usual) {
    if (value != usual) (*this)(key, value);
  }
  /// Left out where it is not finite, and then keeps what it has.
  void if_finite(const std::string& key, double value) {
    if (std::isfinite(value)) (*this)(key, value);
  }
  /// null where there is none.
  void or_null(const std::string& key, const std::optional<double>& value,
               const std::string& why = {}) {
    if (value)
      put_number(object_, key, *value, why);
    else
      put_nothing(object_, key, why);
    put_own_reason();
  }
  /// What follows from other fields, and is not read.
  template <class Make>
  void derived(const std::string& key, const Make& make, const std::string& why = {}) {
    (*this)(key, make(), why);
  }
  /// Why the record is as it is; where it does not say, `otherwise` for people.
  void reason(const std::string& reason, const std::string& otherwise = {}) {
    add_reason(object_, reason.empty() ? otherwise : reason);
    own_reason_ = valid_utf8(reason);
    put_own_reason();
  }
  /// An object whose fields `describe_fields` lists.
  template <class Describe>
  void object(const std::string& key, const Describe& describe_fields) {
    Json& inner = object_[key] = Json::object();
    FieldWriter fields(inner);
    describe_fields(fields);
  }

  /// A value that has no key.
  template <class Value>
  static Json json_of_value(const Value& value) {
    if constexpr (std::is_floating_point_v<Value>) {
      return not_finite == NotFinite::as_it_is || std::isfinite(value) ? Json(value) : Json();
    } else if constexpr (std::is_enum_v<Value>) {
      return name_of(value);
    } else if constexpr (std::is_convertible_v<Value, std::string_view>) {
      return valid_utf8(value);
    } else if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, Json>) {
      return value;
    } else if constexpr (std::is_same_v<Value, json_fields::Setting>) {
      return std::visit([](const auto& each) { return json_of_value(each); }, value);
    } else if constexpr (json_fields::List<Value>) {
      Json list = Json::array();
      for (const auto& each : value) list.push_back(json_of_value(each));
      return list;
    } else if constexpr (json_fields::kIsPair<Value>) {
      return Json::array({json_of_value(value.first), json_of_value(value.second)});
    } else {
      Json object = Json::object();
      FieldWriter fields(object);
      if constexpr (json_fields::Map<Value>) {
        for (const auto& [name, each] : value) {
          std::string key = valid_utf8(name);
          if constexpr (json_fields::kHasNoReasons<typename Value::mapped_type>) {
            if (key == name) {  // and no other one, which need not be looked for
              append(object, std::move(key), json_of_value(each));
              continue;
            }
          }
          fields(key, each);
        }
      } else {
        describe(fields, const_cast<Value&>(value));
      }
      return object;
    }
  }

 private:
  /// A member that is not there yet: an object that keeps its order goes through all to see that.
  static void append(Json& object, std::string key, Json value) {
    auto& members = object.template get_ref<typename Json::object_t&>();
    if constexpr (requires { members.emplace_back(std::move(key), std::move(value)); })
      members.emplace_back(std::move(key), std::move(value));
    else
      members.emplace(std::move(key), std::move(value));
  }
  /// Of a list, or a list of lists.
  static bool has_null(const Json& json) {
    return json.is_null() || (json.is_array() && std::ranges::any_of(json, has_null));
  }

  /// Entries of lists: a null of which nothing is said is NaN.
  template <class Value>
  void note_infinities(const std::string&, const Value&) {}
  void note_infinities(const std::string& key, double value) {
    if (std::isinf(value)) note_null(object_, key, value);
  }
  template <class Value>
  void note_infinities(const std::string& key, const std::vector<Value>& values) {
    for (std::size_t k = 0; k < values.size(); ++k)
      note_infinities(key + "[" + std::to_string(k) + "]", values[k]);
  }
  /// What "reason" tells of nulls is not the record's own.
  void put_own_reason() {
    if (!own_reason_.empty() && object_.contains("nulls")) object_["own_reason"] = own_reason_;
  }

  Json& object_;
  std::string own_reason_;
};

/// Takes the fields of a record from an object; throws BadJson for what is no such record.
/// `all_finite`: numbers must be there and finite, but for settings, which may be infinite.
template <bool all_finite>
class BasicFieldReader {
 public:
  static constexpr bool kReads = true;

  explicit BasicFieldReader(JsonNode object) : node_(std::move(object)) {
    if (!node_.json().is_object()) node_.fault("must be an object");
  }

  bool has(const std::string& key) const { return node_.has(key); }
  JsonNode operator[](const std::string& key) const { return node_[key]; }

  template <class Value>
  void operator()(const std::string& key, Value& value, const std::string& = {}) {
    if constexpr (json_fields::kIsOptional<Value>) {
      value.reset();
      // Clang 16 does not see that a nested record can be made from nothing.
      if (has(key)) read(node_[key], value.emplace(typename Value::value_type{}));
    } else {
      read(node_[key], value);
    }
  }
  void operator()(const std::string& key, double& value, NumberRange range) {
    value = node_[key].number(range.least, range.most);
  }
  void untold(const std::string& key, double& value) { read(node_[key], value); }
  template <class Value>
  void if_any(const std::string& key, Value& value, const std::string& = {}) {
    if (has(key)) read(node_[key], value);
  }
  template <class Value>
  void unless(const std::string& key, Value& value, const Value&) {
    if_any(key, value);
  }
  void if_finite(const std::string& key, double& value) { if_any(key, value); }
  void or_null(const std::string& key, std::optional<double>& value, const std::string& = {}) {
    value = has(key) ? node_[key].number_or_null() : std::nullopt;
  }
  template <class Make>
  void derived(const std::string&, const Make&, const std::string& = {}) {}
  void reason(std::string& reason, const std::string& = {}) { reason = own_reason(node_.json()); }
  template <class Describe>
  void object(const std::string& key, const Describe& describe_fields) {
    BasicFieldReader fields(node_[key]);
    describe_fields(fields);
  }

  template <class Value>
  static void read(const JsonNode& node, Value& value) {
    if constexpr (std::is_same_v<Value, bool>) {
      value = node.flag();
    } else if constexpr (std::is_unsigned_v<Value>) {
      value = static_cast<Value>(node.count(std::numeric_limits<Value>::max()));
    } else if constexpr (std::is_floating_point_v<Value> && all_finite) {
      value = node.number();
    } else if constexpr (std::is_floating_point_v<Value>) {
      value = node.number_or_null().value_or(std::numeric_limits<double>::quiet_NaN());
    } else if constexpr (std::is_enum_v<Value>) {
      value = node.one_of<Value>();
    } else if constexpr (std::is_same_v<Value, std::string>) {
      value = node.text();
    } else if constexpr (std::is_same_v<Value, json_fields::Setting>) {
      if (node.json().is_boolean())
        value = node.flag();
      else if (node.json().is_string())
        value = node.text();
      else if (all_finite && node.json().is_null())
        node.fault("must be a number, a text, true or false");
      else
        BasicFieldReader<false>::read(node, value.template emplace<double>());
    } else if constexpr (json_fields::List<Value>) {
      value.clear();
      for (const JsonNode& item : node.items()) {
        typename Value::value_type each{};
        read(item, each);
        value.insert(value.end(), std::move(each));
      }
    } else if constexpr (json_fields::kIsPair<Value>) {
      const std::vector<JsonNode> both = node.items(2);
      read(both[0], value.first);
      read(both[1], value.second);
    } else if constexpr (json_fields::Map<Value>) {
      value.clear();
      const std::vector<std::pair<std::string, JsonNode>> members = node.members();
      const bool any_null = std::ranges::any_of(node.json(), &nlohmann::json::is_null);
      for (const auto& [name, member] : members)
        if (!any_null || (name != "reason" && name != "nulls")) read(member, value[name]);
    } else {
      BasicFieldReader fields(node);
      describe(fields, value);
    }
  }

 private:
  JsonNode node_;
};
using FieldReader = BasicFieldReader<false>;

/// A record as an object.
template <class Record>
nlohmann::ordered_json written(const Record& record) {
  return FieldWriter<nlohmann::ordered_json>::json_of_value(record);
}

/// A record that written() wrote.
template <class Record>
Record read_record(const JsonNode& node) {
  Record record{};
  FieldReader::read(node, record);
  return record;
}

}  // namespace slipcheck
