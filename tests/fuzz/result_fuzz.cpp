// Result files: any text is one or is refused; one that was read is written and read again alike.

#include "fuzz_text.h"
#include "report/json/json_report.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slipcheck;
  try {
    const nlohmann::json json = JsonNode::parse(fuzz::text(data, size), "r.json");
    const std::string once = json_of(read_result(JsonNode(json, "r.json"))).dump();
    const nlohmann::json written = JsonNode::parse(once, "r.json");
    const std::string again = json_of(read_result(JsonNode(written, "r.json"))).dump();
    fuzz::require(again == once, "a result reads back");
  } catch (const BadJson&) {
  }
  return 0;
}
