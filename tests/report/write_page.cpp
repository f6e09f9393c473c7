// Writes a page with everything hostile and broken that records may hold to standard output; unless
// "without" is given together with its script, if the program has it.
#include <iostream>
#include <string_view>

#include "records.h"
#include "report/html/report_page.h"
#include "study_records.h"

namespace {

using namespace slipcheck;
using namespace slipcheck::testing;

const std::string kEvil =
    "<script>alert(1)</script> & \"'\x01\xff\uFFFE]]>--></style></svg></noscript>_^{";

std::vector<SceneRecord> scenes() {
  SceneRecord good = lottery_scene();
  good.runs[0].errors["i-j.effective_restitution"] = {0, 0, 0.2, true, Verdict::within, ""};
  good.runs.resize(1);

  SceneRecord evil = lottery_scene();
  evil.scenario.name = evil.scenario.title = evil.scenario.source = kEvil;
  evil.scenario.bodies[0].name = "<b>&";
  evil.scenario.bodies[1].initial.position.z() = 1;  // seen from the side
  evil.reference.warnings = {"</style></svg>"};
  evil.runs[0].engine = evil.runs[0].profile = evil.runs[0].version = kEvil;
  evil.runs[0].applied.settings = {{kEvil, kEvil}, {"nan", kNaN}};
  evil.runs[0].applied.not_represented = {Lack{kEvil, kEvil}};
  evil.runs[0].observables["i.sliding_time"].values[3] = kNaN;
  evil.runs.push_back(failed_run(EngineRecord::Status::crashed, "<img src=x onerror=alert(1)>"));
  evil.runs.push_back(failed_run(EngineRecord::Status::skipped, ""));

  SceneRecord numbers = lottery_scene();
  numbers.reference.observables["i.sliding_time"] = {kNaN, kInfinity};
  numbers.runs[0].errors["i.sliding_time"] = {kNaN, kInfinity, 0.01, false, Verdict::deviates, ""};
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
  return {good, evil, numbers, box, shaken, gas, SceneRecord()};
}

std::vector<PrecisionScene> precision() {
  PrecisionScene bad = precision_scene(kEvil);
  bad.scenario.title = kEvil;
  for (MethodCurve& curve : bad.curves) curve.profile = kEvil;
  for (WorkPrecision& point : bad.curves[0].points) {
    point.errors.clear();
    point.cost.reset();
    point.status = RunStatus::crashed;
    point.reason = kEvil;
  }
  bad.curves[1].points[0].errors["i-j.effective_restitution"].worst = kInfinity;
  bad.curves[1].points[1].errors["i-j.effective_restitution"].worst = 1e300;
  bad.curves[2].points[0].errors[kTrajectory] = {};
  PrecisionScene empty;
  empty.scenario.name = kEvil;
  return {precision_scene(), bad, empty, precision_scene()};
}

void add_stability(ReportContent& content) {
  content.cases = stability_cases();
  content.cases[0].scenario.name = content.cases[0].scenario.title = kEvil;
  content.cases[0].reference = {false, false, kEvil, kInfinity, 0};
  content.cases[0].runs[0].why = content.cases[0].runs[0].record.profile = kEvil;
  content.cases[0].runs[1].record.rate = 60;
  content.cases[0].runs[1].worst_error = kInfinity;
  LimitResults& limits = content.limits = limit_results();
  limits.limits[0].scene = limits.limits[0].why = limits.limits[2].reason = kEvil;
  limits.maps[0].title = limits.maps[0].error_label = limits.maps[0].theory_name = kEvil;
  limits.maps[0].x.label = limits.maps[0].name = kEvil;
  limits.maps[0].theory.emplace_back(1, kInfinity);
  limits.maps.push_back(limit_results().maps[0]);
  limits.maps.push_back({});
}

}  // namespace

int main(int count, char** arguments) {
  ReportContent content;
  content.context.cpu = kEvil;
  content.commands = {"slipcheck run <x>.yaml", kEvil};
  content.scenes = scenes();
  content.precision = precision();
  add_stability(content);
  const bool has_script = count < 2 || std::string_view(arguments[1]) != "without";
  std::cout << report_page(content, has_script ? PageScript::included : PageScript::left_out);
}
