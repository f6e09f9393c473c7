#include "base/not_finite.h"

#include <cmath>
#include <limits>

#include "base/old_reasons.h"
#include "base/text.h"

namespace slipcheck {
namespace {

NullMeaning meaning_of(double not_finite) {
  return std::isnan(not_finite) ? NullMeaning::nan
         : not_finite > 0       ? NullMeaning::infinite
                                : NullMeaning::minus_infinite;
}

}  // namespace

std::string if_not_finite(const std::string& what, double value) {
  if (std::isfinite(value)) return {};
  return what + (std::isnan(value) ? " is not a number"
                 : value > 0       ? " is infinite"
                                   : " is minus infinite");
}

void note_null(nlohmann::ordered_json& object, const std::string& key, double value) {
  object["nulls"][key] = name_of(meaning_of(value));
}

void put_number(nlohmann::ordered_json& object, const std::string& key, double value,
                const std::string& reason) {
  if (std::isfinite(value)) {
    object[key] = value;
    return;
  }
  object[key] = nullptr;
  note_null(object, key, value);
  add_reason(object, reason.empty() ? if_not_finite(key, value) : reason);
}

void put_nothing(nlohmann::ordered_json& object, const std::string& key,
                 const std::string& reason) {
  object[key] = nullptr;
  object["nulls"][key] = name_of(NullMeaning::absent);
  add_reason(object, reason);
}

void add_reason(nlohmann::ordered_json& object, const std::string& reason) {
  if (reason.empty()) return;
  const std::string text = valid_utf8(reason);
  if (!object.contains("reason")) {
    object["reason"] = text;
    return;
  }
  const std::string known = object["reason"];
  if (known.find(text) == std::string::npos) object["reason"] = known + "; " + text;
}

std::optional<double> number_of_null(const nlohmann::json& object, const std::string& key) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto nulls = object.find("nulls");
  if (nulls == object.end() || !nulls->is_object()) return number_of_reason(object, key);
  const auto meaning = nulls->find(key);
  if (meaning == nulls->end()) return std::nullopt;
  if (*meaning == name_of(NullMeaning::infinite)) return kInfinity;
  if (*meaning == name_of(NullMeaning::minus_infinite)) return -kInfinity;
  if (*meaning == name_of(NullMeaning::nan)) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

std::string own_reason(const nlohmann::json& object) {
  if (!object.contains("nulls")) return reason_without_nulls(object);
  const auto own = object.find("own_reason");
  return own == object.end() || !own->is_string() ? std::string() : own->get<std::string>();
}

}  // namespace slipcheck
