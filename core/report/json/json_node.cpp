#include "report/json/json_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "report/terminal/text.h"

namespace slipcheck {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr std::string_view kBetweenReasons = "; ";
constexpr std::string_view kKinds[] = {" is not a number", " is infinite", " is minus infinite"};

std::string shown(const nlohmann::json& value) {
  constexpr std::size_t kMost = 60;  // columns
  if (value.is_object()) return "an object";
  if (value.is_array()) return "a list";
  return shortened(printable(value.dump()), kMost);
}

/// Whether a reason was put beside a null by put_number() alone.
bool tells_of_null(const nlohmann::json& object, std::string_view reason) {
  return std::ranges::any_of(kKinds, [&](std::string_view kind) {
    if (!reason.ends_with(kind)) return false;
    const auto key = object.find(std::string(reason.substr(0, reason.size() - kind.size())));
    return key != object.end() && key->is_null();
  });
}

}  // namespace

void throw_bad_results(const std::string& file, const std::string& place, const std::string& rule,
                       const nlohmann::json* value) {
  throw BadResults(fmt::format("{}: {}{}{}{}{}", file, place, place.empty() ? "" : ": ", rule,
                               value ? ", got " : "", value ? shown(*value) : ""));
}

JsonNode::JsonNode(const Json& json, const std::string& file, std::string place)
    : json_(&json), file_(&file), place_(std::move(place)) {
  if (!json.is_object()) throw_bad_results(file, place_, "must be an object", &json);
}

std::string JsonNode::place_of(const std::string& key) const {
  return place_.empty() ? key : fmt::format("{}.{}", place_, key);
}

void JsonNode::fault(const std::string& key, const std::string& rule) const {
  const auto found = json_->find(key);
  throw_bad_results(*file_, place_of(key), rule, found == json_->end() ? nullptr : &*found);
}

const JsonNode::Json& JsonNode::member(const std::string& key) const {
  const auto found = json_->find(key);
  if (found == json_->end()) fault(key, "must be there");
  return *found;
}

JsonNode JsonNode::at(const std::string& key) const { return {member(key), *file_, place_of(key)}; }

const JsonNode::Json& JsonNode::list_of(const std::string& key) const {
  const Json& list = member(key);
  if (!list.is_array()) fault(key, "must be a list");
  return list;
}

std::vector<JsonNode> JsonNode::list(const std::string& key) const {
  std::vector<JsonNode> nodes;
  for (const Json& each : list_of(key))
    nodes.push_back({each, *file_, fmt::format("{}[{}]", place_of(key), nodes.size())});
  return nodes;
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members(const std::string& key) const {
  const JsonNode object = at(key);
  std::vector<std::pair<std::string, JsonNode>> nodes;
  for (const auto& [name, value] : object.json().items())
    nodes.emplace_back(name, JsonNode(value, *file_, object.place_of(name)));
  return nodes;
}

std::string JsonNode::text(const std::string& key) const {
  const Json& value = member(key);
  if (!value.is_string()) fault(key, "must be a text");
  return value.get<std::string>();
}

std::string JsonNode::text_or(const std::string& key, const std::string& otherwise) const {
  return has(key) ? text(key) : otherwise;
}

std::vector<std::string> JsonNode::texts(const std::string& key) const {
  const Json& list = list_of(key);
  if (!std::ranges::all_of(list, &Json::is_string)) fault(key, "must be a list of texts");
  return list.get<std::vector<std::string>>();
}

bool JsonNode::flag(const std::string& key) const {
  const Json& value = member(key);
  if (!value.is_boolean()) fault(key, "must be true or false");
  return value.get<bool>();
}

bool JsonNode::flag_or(const std::string& key, bool otherwise) const {
  return has(key) ? flag(key) : otherwise;
}

std::size_t JsonNode::count(const std::string& key) const {
  const Json& value = member(key);
  const bool is_whole =
      value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
  if (!is_whole) fault(key, "must be a whole number >= 0");
  return value.get<std::size_t>();
}

std::size_t JsonNode::count_or(const std::string& key, std::size_t otherwise) const {
  return has(key) ? count(key) : otherwise;
}

double JsonNode::number(const std::string& key) const {
  const Json& value = member(key);
  if (value.is_null())
    return has_reason(key + " is infinite")         ? kInfinity
           : has_reason(key + " is minus infinite") ? -kInfinity
                                                    : kNaN;
  if (!value.is_number()) fault(key, "must be a number");
  return value.get<double>();
}

double JsonNode::number_or(const std::string& key, double otherwise) const {
  return has(key) ? number(key) : otherwise;
}

std::optional<double> JsonNode::find_number(const std::string& key) const {
  const auto found = json_->find(key);
  if (found == json_->end() || found->is_null()) return std::nullopt;
  return number(key);
}

std::vector<double> JsonNode::numbers(const std::string& key) const {
  std::vector<double> result;
  for (const Json& value : list_of(key)) {
    if (!value.is_null() && !value.is_number())
      throw_bad_results(*file_, fmt::format("{}[{}]", place_of(key), result.size()),
                        "must be a number", &value);
    result.push_back(value.is_null() ? kNaN : value.get<double>());
  }
  return result;
}

std::string JsonNode::own_reason(const std::vector<std::string>& others) const {
  std::string reason = text_or("reason", "");
  while (!reason.empty()) {
    const std::size_t between = reason.rfind(kBetweenReasons);
    const std::size_t begin = between == std::string::npos ? 0 : between + kBetweenReasons.size();
    const std::string last = reason.substr(begin);
    if (!tells_of_null(*json_, last) && std::ranges::find(others, last) == others.end()) break;
    reason.resize(begin == 0 ? 0 : between);
  }
  return reason;
}

bool JsonNode::has_reason(std::string_view part) const {
  std::string_view rest;
  if (const auto found = json_->find("reason"); found != json_->end() && found->is_string())
    rest = found->get_ref<const std::string&>();
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(kBetweenReasons), rest.size());
    if (rest.substr(0, end) == part) return true;
    rest.remove_prefix(std::min(end + kBetweenReasons.size(), rest.size()));
  }
  return false;
}

}  // namespace slipcheck
