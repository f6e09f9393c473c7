#include "harness/reference_run.h"

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <ctime>
#include <limits>

#include "harness/closed_form_values.h"
#include "harness/observer.h"

namespace slipcheck {
namespace {

/// Restores the rounding mode on leaving.
class RoundingMode {
 public:
  explicit RoundingMode(int mode) : before_(std::fegetround()) { std::fesetround(mode); }
  ~RoundingMode() { std::fesetround(before_); }
  RoundingMode(const RoundingMode&) = delete;
  RoundingMode& operator=(const RoundingMode&) = delete;

 private:
  int before_;
};

double thread_cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Solved {
  EventRun run;
  Observables seen;
};

Solved solve(const HardScene& scene, const RunEnd& end, int rounding, double cut_offs) {
  const RoundingMode mode(rounding);
  EventSettings settings;
  settings.collapse_fraction *= cut_offs;
  settings.landing_fraction *= cut_offs;
  EventSolver solver(scene, scene.initial, settings);
  Observer observer(scene, 0, speed_scale(scene, scene.initial));
  Solved solved;
  solved.run = solver.run(end, &observer);
  solved.seen = observer.finish(solved.run.end_time);
  return solved;
}

}  // namespace

ReferenceResult run_reference(const HardScene& scene, const RunEnd& end,
                              const std::vector<std::string>& names) {
  ReferenceResult result;
  const auto up = named_values(solve(scene, end, FE_UPWARD, 1.5).seen, names);
  const auto down = named_values(solve(scene, end, FE_DOWNWARD, 0.5).seen, names);
  const double begin = thread_cpu_seconds();
  const Solved solved = solve(scene, end, FE_TONEAREST, 1);
  result.cpu_seconds = thread_cpu_seconds() - begin;
  result.run = solved.run;
  result.first_contact = EventSolver(scene, scene.initial).first_contact(end.limit);

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const auto& [name, value] : named_values(solved.seen, names)) {
    double uncertainty = 2 * std::numeric_limits<double>::epsilon() * std::abs(value);
    for (const auto* other : {&up, &down}) {
      const auto found = other->find(name);
      uncertainty = std::max(
          uncertainty, found == other->end() ? kInfinity : std::abs(found->second - value));
    }
    result.observables[name] = {value, uncertainty};
  }
  if (result.run.collisions <= 1 && result.run.reached) {
    // The closed form speaks of what the run can have shown.
    for (const auto& [name, value] : closed_form_values(scene, names))
      if (result.observables.count(name)) result.closed_form[name] = value;
  }
  if (!result.run.reached) result.warnings.push_back("the run did not end: " + result.run.reason);
  if (result.run.collapses > 0)
    result.warnings.push_back(
        "inelastic collapse: " + std::to_string(result.run.collapses) + " of " +
        std::to_string(result.run.collisions) +
        " collisions were slower than 1e-6 of the scene's speed and part with that speed");
  return result;
}

RunEnd run_end(const Scenario& scenario) {
  return {scenario.run.until, scenario.run.time, scenario.run.limit};
}

std::vector<std::string> body_names(const Scenario& scenario) {
  std::vector<std::string> names;
  names.reserve(scenario.bodies.size());
  for (const Body& body : scenario.bodies) names.push_back(body.name);
  return names;
}

}  // namespace slipcheck
