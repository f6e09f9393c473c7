#include "base/old_reasons.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <vector>

#include "base/not_finite.h"

namespace slipcheck {
namespace {

constexpr double kNotFinite[] = {std::numeric_limits<double>::quiet_NaN(),
                                 std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity()};

constexpr std::string_view kBetweenReasons = "; ";

/// The parts of "reason".
std::vector<std::string_view> reasons_of(const nlohmann::json& object) {
  std::vector<std::string_view> parts;
  const auto found = object.find("reason");
  if (found == object.end() || !found->is_string()) return parts;
  for (std::string_view rest = found->get_ref<const std::string&>(); !rest.empty();) {
    const std::size_t end = std::min(rest.find(kBetweenReasons), rest.size());
    parts.push_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + kBetweenReasons.size(), rest.size()));
  }
  return parts;
}

/// Whether a part of a reason was put beside a null alone.
bool tells_of_null(const nlohmann::json& object, std::string_view part) {
  static constexpr std::string_view kSentences[] = {
      "the error is infinite",    "the error is not a number", "no error could be taken",
      "no energy could be taken", "no overlap could be taken", "nothing rests in the reference",
      "no value was found good",  "no value was found bad",    "there is no limit to divide"};
  return std::ranges::find(kSentences, part) != std::end(kSentences) ||
         std::ranges::any_of(kNotFinite, [&](double value) {
           const std::string words = if_not_finite("", value);
           if (!part.ends_with(words)) return false;
           const auto key = object.find(std::string(part.substr(0, part.size() - words.size())));
           return key != object.end() && key->is_null();
         });
}

}  // namespace

std::optional<double> number_of_reason(const nlohmann::json& object, const std::string& key) {
  for (const std::string_view part : reasons_of(object))
    for (const double value : kNotFinite)
      if (part == if_not_finite(key, value) ||
          (key == "max" && part == if_not_finite("the error", value)))
        return value;
  return std::nullopt;
}

std::string reason_without_nulls(const nlohmann::json& object) {
  std::vector<std::string_view> parts = reasons_of(object);
  while (!parts.empty() && tells_of_null(object, parts.back())) parts.pop_back();
  if (parts.empty()) return {};
  return {parts.front().begin(), parts.back().end()};
}

std::string kind_in_words(const std::string& text) {
  const std::string words = text.substr(0, text.find(" ("));
  std::string kind;
  for (const char* at = words.c_str(); *at != '\0';) {
    if (*at < '0' || *at > '9') {
      kind += *at++;
      continue;
    }
    kind += "…";
    char* end = nullptr;
    std::strtod(at, &end);
    at = end;
  }
  return kind;
}

}  // namespace slipcheck
