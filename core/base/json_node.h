#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/enum_names.h"

namespace slipcheck {

/// Data that somebody else wrote do not keep to their format; the message says file, place, rule
/// and value, as in `results/x.json: runs[2].rate: must be a number, got "fast"`.
class BadJson : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Stands for "> 0" as the least of a range.
inline constexpr double kTiny = std::numeric_limits<double>::min();

/// A value of JSON or CBOR with its place. Whatever is asked of it is checked first, and BadJson
/// thrown where it is something else.
class JsonNode {
 public:
  using Json = nlohmann::json;

  /// The whole, of which `file` is the name in messages; both outlive the node.
  JsonNode(const Json& json, const std::string& file) : json_(&json), file_(&file) {}
  /// Parsed JSON; throws BadJson with line and column for other text.
  static Json parse(const std::string& text, const std::string& file);

  const Json& json() const { return *json_; }
  const std::string& file() const { return *file_; }

  // Of an object.
  bool has(const std::string& key) const { return json_->is_object() && json_->contains(key); }
  JsonNode operator[](const std::string& key) const;
  std::vector<std::pair<std::string, JsonNode>> members() const;

  // Of a list.
  std::vector<JsonNode> items() const;
  std::vector<JsonNode> items(std::size_t size) const;
  std::vector<double> numbers() const;  ///< all finite
  std::vector<double> numbers(std::size_t size) const;

  /// A finite number in [least, most].
  double number(double least = std::numeric_limits<double>::lowest(),
                double most = std::numeric_limits<double>::max()) const;
  /// A number or null, of which number_of_null() says what it stands for: maybe nothing.
  std::optional<double> number_or_null() const;
  std::size_t count(std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  bool flag() const;
  std::string text() const;  ///< valid UTF-8
  const std::vector<std::uint8_t>& bytes() const;

  template <class Enum>
  Enum one_of() const {
    std::string names;
    for (std::size_t k = 0; k < kNamesOf<Enum>.size(); ++k) {
      const char* name = kNamesOf<Enum>[k];
      if (*json_ == name) return static_cast<Enum>(k);
      names += (k == 0 ? "" : ", ") + std::string(name);
    }
    fault("must be one of " + names);
  }

  /// Throws BadJson: what the value must be and what it is.
  [[noreturn]] void fault(const std::string& rule) const;
  /// The same without the value.
  [[noreturn]] void fault_alone(const std::string& rule) const;

 private:
  JsonNode(const Json& json, const std::string& file, std::string place)
      : json_(&json), file_(&file), place_(std::move(place)) {}
  std::string place_of(const std::string& key) const;

  const Json* json_;
  const std::string* file_;
  std::string place_;             // "runs[2].rate", empty of the whole
  const Json* object_ = nullptr;  // that it, or the list that it is in, is a member of
  std::size_t key_begin_ = 0;     // in the place, of what leads to it from there
};

}  // namespace slipcheck
