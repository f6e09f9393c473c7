#include "report/json/common_fields.h"

#include "scenario/load.h"

namespace slipcheck {

void put_context(nlohmann::ordered_json& file) { file.update(written(context())); }

Scenario scenario_of_text(const FieldReader& scene) {
  Scenario scenario;
  try {
    scenario = parse_scenario(scene["text"].text(), scene["file"].text());
  } catch (const BadScenario& bad) {
    scene["text"].fault_alone("must be a scene that this version reads: " +
                              bad.faults().front().message());
  }
  if (scenario.sha256 != scene["sha256"].text()) scene["sha256"].fault("must be that of the text");
  return scenario;
}

}  // namespace slipcheck
