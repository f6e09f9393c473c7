// The settings that an engine says it takes, in JSON, and a value for each: read, or refused.

#include <nlohmann/json.hpp>

#include "engine/setting_json.h"
#include "engine/settings.h"
#include "fuzz_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slipcheck;
  try {
    const nlohmann::json json = JsonNode::parse(fuzz::text(data, size), "settings.json");
    const std::vector<SettingInfo> infos =
        protocol::setting_infos_from_json(JsonNode(json, "settings.json"));
    Settings shipped;
    for (const SettingInfo& info : infos) shipped[info.name] = info.shipped;
    fuzz::require(check_settings(infos, shipped).empty(), "what is shipped is taken");
    const nlohmann::json written = protocol::setting_infos_to_json(infos);
    const std::vector<SettingInfo> again =
        protocol::setting_infos_from_json(JsonNode(written, "settings.json"));
    fuzz::require(protocol::setting_infos_to_json(again) == written, "settings read back");
  } catch (const BadJson&) {
  }
  return 0;
}
