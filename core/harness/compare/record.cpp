#include "harness/compare/record.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/compare/comparison.h"
#include "harness/observe/observables.h"
#include "reference/reference_solver.h"
#include "scenario/fault.h"

namespace slipcheck {

std::string EngineRecord::rate_text() const {
  return scale == 1 ? fmt::format("{:g} Hz", rate)
                    : fmt::format("{:g} Hz, scale {:g}", rate, scale);
}

std::vector<ExpectationResult> EngineRecord::expectations() const {
  if (!expect) return {};
  std::vector<ExpectationResult> results = expectation_results(*expect, observables);
  if (status == Status::ok) return results;
  for (ExpectationResult& result : results) {
    result.met = false;
    result.value = kNotObserved;
    result.reason = std::string("the run is ") + name_of(status);
  }
  return results;
}

Verdict EngineRecord::verdict() const {
  const auto judged = [](bool good) { return good ? Verdict::within : Verdict::deviates; };
  if (expect && expect->status) return judged(status == *expect->status);
  if (status == Status::skipped) return Verdict::undecided;
  if (status != Status::ok) return Verdict::failed;
  if (expect) return judged(std::ranges::all_of(expectations(), &ExpectationResult::met));
  Verdict worst = Verdict::unjudged;
  for (const auto& [name, error] : errors) worst = std::max(worst, error.verdict);
  return worst;
}

Verdict SceneRecord::verdict() const {
  // Where every run is judged by what is expected of it, the reference judges nothing.
  const bool by_reference = runs.empty() || !std::ranges::all_of(runs, [](const EngineRecord& run) {
                              return run.expect.has_value();
                            });
  const bool has_end = reference.run.reached || reference.left_out || !by_reference;
  Verdict worst = has_end ? Verdict::unjudged : Verdict::undecided;
  for (const EngineRecord& run : runs) worst = std::max(worst, run.verdict());
  return worst;
}

std::shared_ptr<const ContactScene> solved_scene(const Scenario& scenario) {
  try {
    const ContactScene scene = make_contact_scene(scenario);
    const ReferenceSolver solver(scene, reference_settings(scenario));
    return std::make_shared<const ContactScene>(solver.scene());
  } catch (const Unsupported&) {
    return nullptr;
  } catch (const BadScenario&) {  // a restitution that a law of this version cannot reach
    return nullptr;
  }
}

}  // namespace slipcheck
