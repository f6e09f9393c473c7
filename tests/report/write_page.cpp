// Writes a page with everything hostile and broken that a record may hold to standard output.
#include <iostream>

#include "records.h"
#include "report/html_report.h"

int main() {
  using namespace slipcheck;
  using namespace slipcheck::testing;
  SceneRecord good = lottery_scene();
  good.runs[0].errors["i-j.effective_restitution"] = {0, 0, 0.2, true, true, ""};
  good.runs.resize(1);

  SceneRecord evil = lottery_scene();
  evil.scenario.title = "<script>alert(1)</script> & \"'\x01\xff\uFFFE]]>-->";
  evil.scenario.bodies[0].name = "<b>&";
  evil.scenario.bodies[1].initial.position.z() = 1;  // seen from the side
  evil.scenario.source = "javascript:alert(1)";
  evil.reference.warnings = {"</style></svg>"};
  evil.runs.push_back(failed_run(EngineRecord::Status::crashed, "<img src=x onerror=alert(1)>"));
  evil.runs.push_back(failed_run(EngineRecord::Status::skipped, ""));
  evil.runs[0].observables["i.sliding_time"].values[3] = kNaN;

  SceneRecord numbers = lottery_scene();
  numbers.reference.observables["i.sliding_time"] = {kNaN, kInfinity};
  numbers.runs[0].errors["i.sliding_time"] = {kNaN, kInfinity, 0.01, false, false, ""};
  numbers.runs[0].observables["i-j.effective_restitution"].values[0] = 1e300;
  numbers.runs[1].observables["i-j.effective_restitution"].max = kInfinity;
  numbers.scenario.bodies.clear();

  SceneRecord box = lottery_scene();
  box.scenario.surroundings = Container{.width = 0.02, .height = 0.03};
  box.runs.clear();

  SceneRecord shaken = box_scene(5000);
  shaken.reference.box->samples = 4000;
  shaken.reference.observables["all.height"] = {kNaN, kInfinity};
  shaken.reference.observables.erase("all.collision_rate");

  SceneRecord gas = lottery_scene();
  gas.scenario.surroundings = Substrate{.periodic = Vector2(0.02, 0.01)};
  std::cout << html_of({good, evil, numbers, box, shaken, gas, SceneRecord()},
                       "slipcheck run <x>.yaml");
}
