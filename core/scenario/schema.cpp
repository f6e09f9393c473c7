#include "scenario/schema.h"

#include "scenario/rules/scene_rules.h"

namespace slipcheck {

nlohmann::json scenario_schema() {
  nlohmann::json schema = scene_rule().schema();
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = "Slipcheck scenario, format version 1";
  return schema;
}

}  // namespace slipcheck
