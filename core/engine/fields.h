#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace slipcheck::protocol {

using Bytes = std::vector<std::uint8_t>;

/// Stands for "> 0" as the least of a range.
inline constexpr double kTiny = std::numeric_limits<double>::min();

/// What came in does not keep to the protocol; the message says where and how.
class Rubbish : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The members of a JSON object that somebody else sent: every access checks that the member is
/// there, of the right type and in range, and throws Rubbish with its place otherwise.
class Fields {
 public:
  /// `place` names the object in messages, as in "scene.bodies[2]".
  Fields(const nlohmann::json& object, std::string place);

  /// A finite number in [least, most].
  double number(const char* key, double least = std::numeric_limits<double>::lowest(),
                double most = std::numeric_limits<double>::max()) const;
  /// A whole number in [0, most].
  std::size_t count(const char* key, std::size_t most) const;
  bool flag(const char* key) const;
  /// Valid UTF-8.
  std::string text(const char* key) const;
  std::vector<std::string> texts(const char* key) const;
  const Bytes& bytes(const char* key) const;
  /// Finite numbers.
  std::vector<double> numbers(const char* key) const;
  const nlohmann::json& list(const char* key) const;
  const nlohmann::json& object(const char* key) const;
  const nlohmann::json& member(const char* key) const;
  bool has(const char* key) const { return object_.contains(key); }

  /// The place of a member, for messages.
  std::string place_of(const char* key) const;

 private:
  [[noreturn]] void fail(const char* key, const std::string& rule) const;

  const nlohmann::json& object_;
  std::string place_;
};

/// A list of finite numbers; throws Rubbish with `place` where it is none.
std::vector<double> finite_numbers(const nlohmann::json& list, const std::string& place);

/// Throws Rubbish unless `text` is valid UTF-8: what follows prints it and writes it to JSON.
void require_utf8(const std::string& text, const std::string& place);

}  // namespace slipcheck::protocol
