#include "engine/fields.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace slipcheck::protocol {

using nlohmann::json;

Fields::Fields(const json& object, std::string place) : object_(object), place_(std::move(place)) {
  if (!object_.is_object()) throw Rubbish(fmt::format("{} is not a map", place_));
}

std::string Fields::place_of(const char* key) const { return fmt::format("{}.{}", place_, key); }

void Fields::fail(const char* key, const std::string& rule) const {
  throw Rubbish(fmt::format("{} {}", place_of(key), rule));
}

const json& Fields::member(const char* key) const {
  const auto found = object_.find(key);
  if (found == object_.end()) fail(key, "is missing");
  return *found;
}

double Fields::number(const char* key, double least, double most) const {
  const json& value = member(key);
  if (!value.is_number()) fail(key, "is not a number");
  const double number = value.get<double>();
  if (!std::isfinite(number)) fail(key, "is not finite");
  if (number < least || number > most) {
    fail(key, fmt::format("is {}, not in [{}, {}]", number, least, most));
  }
  return number;
}

std::size_t Fields::count(const char* key, std::size_t most) const {
  const json& value = member(key);
  if (!value.is_number_integer() || value < 0) fail(key, "is not a whole number >= 0");
  const auto number = value.get<std::uint64_t>();
  if (number > most) fail(key, fmt::format("is {}, more than {}", number, most));
  return static_cast<std::size_t>(number);
}

bool Fields::flag(const char* key) const {
  const json& value = member(key);
  if (!value.is_boolean()) fail(key, "is neither true nor false");
  return value.get<bool>();
}

std::string Fields::text(const char* key) const {
  const json& value = member(key);
  if (!value.is_string()) fail(key, "is not a text");
  auto text = value.get<std::string>();
  require_utf8(text, place_of(key));
  return text;
}

std::vector<std::string> Fields::texts(const char* key) const {
  std::vector<std::string> texts;
  for (const json& value : list(key)) {
    if (!value.is_string()) fail(key, "holds something that is not a text");
    texts.push_back(value.get<std::string>());
    require_utf8(texts.back(), place_of(key));
  }
  return texts;
}

std::vector<double> Fields::numbers(const char* key) const {
  return finite_numbers(list(key), place_of(key));
}

const Bytes& Fields::bytes(const char* key) const {
  const json& value = member(key);
  if (!value.is_binary()) fail(key, "is not a byte string");
  return value.get_binary();
}

const json& Fields::list(const char* key) const {
  const json& value = member(key);
  if (!value.is_array()) fail(key, "is not a list");
  return value;
}

const json& Fields::object(const char* key) const {
  const json& value = member(key);
  if (!value.is_object()) fail(key, "is not a map");
  return value;
}

std::vector<double> finite_numbers(const json& list, const std::string& place) {
  if (!list.is_array()) throw Rubbish(place + " is not a list");
  std::vector<double> numbers;
  numbers.reserve(list.size());
  for (const json& value : list) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      throw Rubbish(place + " holds something that is not a finite number");
    }
    numbers.push_back(value.get<double>());
  }
  return numbers;
}

void require_utf8(const std::string& text, const std::string& place) {
  try {
    static_cast<void>(json(text).dump());  // strict about UTF-8, unlike the CBOR reader
  } catch (const json::type_error&) {
    throw Rubbish(fmt::format("{} is not valid UTF-8", place));
  }
}

}  // namespace slipcheck::protocol
