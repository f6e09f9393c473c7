#include "report/json/json_number.h"

#include <cmath>
#include <variant>

#include "report/rows/context.h"
#include "report/terminal/text.h"

namespace slipcheck {

using Json = nlohmann::ordered_json;

void put_number(Json& object, const std::string& key, double value, const std::string& reason) {
  object[key] = std::isfinite(value) ? Json(value) : Json(nullptr);
  if (std::isfinite(value)) return;
  const char* kind = std::isnan(value) ? " is not a number"
                     : value > 0       ? " is infinite"
                                       : " is minus infinite";
  add_reason(object, reason.empty() ? key + kind : reason);
}

void add_reason(Json& object, const std::string& reason) {
  if (reason.empty()) return;
  const std::string text = valid_utf8(reason);
  if (!object.contains("reason")) {
    object["reason"] = text;
    return;
  }
  const std::string known = object["reason"];
  if (known.find(text) == std::string::npos) object["reason"] = known + "; " + text;
}

Json settings_json(const Settings& settings) {
  Json json = Json::object();
  for (const auto& [key, setting] : settings) {
    const std::string name = valid_utf8(key);
    if (const auto* word = std::get_if<std::string>(&setting))
      json[name] = valid_utf8(*word);
    else if (const auto* flag = std::get_if<bool>(&setting))
      json[name] = *flag;
    else
      put_number(json, name, std::get<double>(setting));
  }
  return json;
}

void put_context(Json& object) {
  const Context& c = context();
  object["slipcheck"] = {{"version", c.version}, {"commit", c.commit}, {"build", c.build}};
  object["machine"] = {{"processor", c.cpu},
                       {"hardware_threads", c.cores},
                       {"system", c.system},
                       {"compiler", c.compiler}};
}

}  // namespace slipcheck
