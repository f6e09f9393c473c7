#include "base/json_node.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "base/not_finite.h"
#include "base/text.h"

namespace slipcheck {
namespace {

std::string shown(const nlohmann::json& value) {
  constexpr std::size_t kMost = 60;  // columns
  if (value.is_object()) return "an object";
  if (value.is_array()) return "a list";
  if (value.is_binary()) return "bytes";
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
    return fmt::format("{}", value.get<double>());
  const auto replace = nlohmann::json::error_handler_t::replace;
  return shortened(printable(value.dump(-1, ' ', false, replace)), kMost);
}

}  // namespace

nlohmann::json JsonNode::parse(const std::string& text, const std::string& file) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 3, column 5: …", or, of a number that
    // no double holds, "[json.exception.out_of_range.406] number overflow parsing '1e400'"
    const std::string_view words = error.what();
    const std::size_t end = words.find("] ");
    throw BadJson(fmt::format("{}: must be JSON: {}", file,
                              end == std::string_view::npos ? words : words.substr(end + 2)));
  }
}

void JsonNode::fault(const std::string& rule) const {
  fault_alone(fmt::format("{}, got {}", rule, shown(*json_)));
}

void JsonNode::fault_alone(const std::string& rule) const {
  throw BadJson(fmt::format("{}: {}{}{}", *file_, place_, place_.empty() ? "" : ": ", rule));
}

std::string JsonNode::place_of(const std::string& key) const {
  return place_.empty() ? key : fmt::format("{}.{}", place_, key);
}

JsonNode JsonNode::operator[](const std::string& key) const {
  if (!json_->is_object()) fault("must be an object");
  const auto found = json_->find(key);
  if (found == json_->end()) JsonNode(*json_, *file_, place_of(key)).fault_alone("must be there");
  JsonNode node(*found, *file_, place_of(key));
  node.object_ = json_;
  node.key_begin_ = node.place_.size() - key.size();
  return node;
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
  if (!json_->is_object()) fault("must be an object");
  std::vector<std::pair<std::string, JsonNode>> nodes;
  for (const auto& [key, value] : json_->items()) {
    if (valid_utf8(key) != key) fault("must have names of valid UTF-8");
    nodes.emplace_back(key, (*this)[key]);
  }
  return nodes;
}

std::vector<JsonNode> JsonNode::items() const {
  if (!json_->is_array()) fault("must be a list");
  std::vector<JsonNode> nodes;
  nodes.reserve(json_->size());
  for (const Json& each : *json_) {
    JsonNode& node =
        nodes.emplace_back(JsonNode(each, *file_, fmt::format("{}[{}]", place_, nodes.size())));
    node.object_ = object_;
    node.key_begin_ = key_begin_;
  }
  return nodes;
}

std::vector<JsonNode> JsonNode::items(std::size_t size) const {
  if (!json_->is_array() || json_->size() != size) fault(fmt::format("must be a list of {}", size));
  return items();
}

std::vector<double> JsonNode::numbers() const {
  if (!json_->is_array()) fault("must be a list");
  std::vector<double> numbers;
  numbers.reserve(json_->size());
  for (const Json& each : *json_) {
    const bool is_number = each.is_number() && std::isfinite(each.get<double>());
    numbers.push_back(is_number ? each.get<double>() : items()[numbers.size()].number());
  }
  return numbers;
}

std::vector<double> JsonNode::numbers(std::size_t size) const {
  if (!json_->is_array() || json_->size() != size)
    fault(fmt::format("must be a list of {} numbers", size));
  return numbers();
}

double JsonNode::number(double least, double most) const {
  if (!json_->is_number()) fault("must be a number");
  const double number = json_->get<double>();
  if (!std::isfinite(number)) fault("must be finite");
  if (number >= least && number <= most) return number;
  if (most < std::numeric_limits<double>::max())
    fault(fmt::format("must be from {} to {}", least, most));
  fault(least == kTiny ? "must be > 0" : fmt::format("must be >= {}", least));
}

std::optional<double> JsonNode::number_or_null() const {
  if (json_->is_null() && object_ == nullptr) return std::nullopt;
  if (json_->is_null()) return number_of_null(*object_, place_.substr(key_begin_));
  if (!json_->is_number()) fault("must be a number");
  return json_->get<double>();
}

std::size_t JsonNode::count(std::size_t most) const {
  const bool is_whole = json_->is_number_unsigned() ||
                        (json_->is_number_integer() && json_->get<std::int64_t>() >= 0);
  if (!is_whole) fault("must be a whole number >= 0");
  const auto number = json_->get<std::size_t>();
  if (number > most) fault(fmt::format("must be a whole number from 0 to {}", most));
  return number;
}

bool JsonNode::flag() const {
  if (!json_->is_boolean()) fault("must be true or false");
  return json_->get<bool>();
}

std::string JsonNode::text() const {
  if (!json_->is_string()) fault("must be a text");
  const auto& text = json_->get_ref<const std::string&>();
  if (valid_utf8(text) != text) fault("must be valid UTF-8");
  return text;
}

const std::vector<std::uint8_t>& JsonNode::bytes() const {
  if (!json_->is_binary()) fault("must be a byte string");
  return json_->get_binary();
}

}  // namespace slipcheck
