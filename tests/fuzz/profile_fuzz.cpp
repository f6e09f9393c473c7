// Profiles of engines: any text is one or is refused; one that was read is written and read again
// alike.

#include "engine/profile.h"
#include "fuzz_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slipcheck;
  try {
    const Profile profile = parse_profile(fuzz::text(data, size), "p.yaml");
    const Profile again = parse_profile(profile_yaml(profile), "p.yaml");
    fuzz::require(again.settings == profile.settings && again.engine == profile.engine &&
                      again.name == profile.name,
                  "a profile that is written reads back");
  } catch (const BadScenario& bad) {
    fuzz::require(!bad.faults().empty(), "a refusal has a fault");
  }
  return 0;
}
