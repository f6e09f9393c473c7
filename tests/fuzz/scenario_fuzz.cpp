// The scenario loader: any text is a scene or is refused with the place of a fault.

#include "fuzz_text.h"
#include "scenario/load.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    slipcheck::parse_scenario(slipcheck::fuzz::text(data, size), "s.yaml");
  } catch (const slipcheck::BadScenario& bad) {
    slipcheck::fuzz::require(!bad.faults().empty(), "a refusal without a fault");
  }
  return 0;
}
