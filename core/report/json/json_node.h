#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slipcheck {

/// Results cannot be read; the message says file, place, rule and value, as in
/// `results/x.json: runs[2].rate: must be a number, got "fast"`.
class BadResults : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An object of a result file with its place in it. Every access checks that the member is there
/// and of its type, and throws BadResults otherwise; those ending with `_or` take another value
/// where it is absent.
class JsonNode {
 public:
  using Json = nlohmann::json;

  /// The whole file, of which `file` is the name in messages; both outlive the node.
  JsonNode(const Json& json, const std::string& file) : JsonNode(json, file, "") {}

  const Json& json() const { return *json_; }
  const std::string& file() const { return *file_; }
  bool has(const std::string& key) const { return json_->contains(key); }

  JsonNode at(const std::string& key) const;
  const Json& list_of(const std::string& key) const;  ///< of anything
  /// Of a list of objects.
  std::vector<JsonNode> list(const std::string& key) const;
  /// Of an object of objects, by their keys.
  std::vector<std::pair<std::string, JsonNode>> members(const std::string& key) const;

  std::string text(const std::string& key) const;
  std::string text_or(const std::string& key, const std::string& otherwise) const;
  std::vector<std::string> texts(const std::string& key) const;
  bool flag(const std::string& key) const;
  bool flag_or(const std::string& key, bool otherwise) const;
  std::size_t count(const std::string& key) const;
  std::size_t count_or(const std::string& key, std::size_t otherwise) const;
  /// Of null what its reason says: infinite, minus infinite, or else NaN.
  double number(const std::string& key) const;
  double number_or(const std::string& key, double otherwise) const;
  /// Nothing where it is null or absent.
  std::optional<double> find_number(const std::string& key) const;
  /// null in the list is NaN.
  std::vector<double> numbers(const std::string& key) const;

  /// One of `count` values of an enumeration, from 0 on, by its name.
  template <class Value, class Name>
  Value one_of(const std::string& key, std::size_t count, Name name_of_value) const {
    const std::string written = text(key);
    std::string names;
    for (std::size_t k = 0; k < count; ++k) {
      const std::string name = name_of_value(static_cast<Value>(k));
      if (name == written) return static_cast<Value>(k);
      names += (k == 0 ? "" : ", ") + name;
    }
    fault(key, "must be one of " + names);
  }

  /// "reason" without what only tells of a null: the last parts that say that a key is not finite,
  /// or that are among `others`. Empty where there is none.
  std::string own_reason(const std::vector<std::string>& others = {}) const;
  /// Whether one of the parts of "reason" is this.
  bool has_reason(std::string_view part) const;

  /// "runs[2].rate"
  std::string place_of(const std::string& key) const;
  /// Throws BadResults about a member.
  [[noreturn]] void fault(const std::string& key, const std::string& rule) const;

 private:
  JsonNode(const Json& json, const std::string& file, std::string place);

  const Json& member(const std::string& key) const;

  const Json* json_;
  const std::string* file_;
  std::string place_;  // empty of the whole file
};

/// Throws BadResults: "FILE: PLACE: RULE, got VALUE", without an empty place.
[[noreturn]] void throw_bad_results(const std::string& file, const std::string& place,
                                    const std::string& rule, const nlohmann::json* value);

}  // namespace slipcheck
