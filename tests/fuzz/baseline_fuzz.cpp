// Baselines: any text is one or is refused; one that was read is written and read again alike.

#include "fuzz_text.h"
#include "studies/baseline/baseline_json.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slipcheck;
  try {
    const std::string once = baseline_text(parse_baseline(fuzz::text(data, size), "b.json"));
    fuzz::require(baseline_text(parse_baseline(once, "b.json")) == once, "a baseline reads back");
  } catch (const BadJson&) {
  }
  return 0;
}
