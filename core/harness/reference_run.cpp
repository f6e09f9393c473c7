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
  const Observables up = solve(scene, end, FE_UPWARD, 1.5).seen;
  const Observables down = solve(scene, end, FE_DOWNWARD, 0.5).seen;
  const double begin = thread_cpu_seconds();
  const Solved solved = solve(scene, end, FE_TONEAREST, 1);
  result.cpu_seconds = thread_cpu_seconds() - begin;
  result.run = solved.run;
  result.first_contact = EventSolver(scene, scene.initial).first_contact(end.limit);

  // Closed forms are of a body alone, or of two that have met once and not again.
  const bool has_closed_form =
      result.run.reached && result.run.collisions + 1 == scene.bodies.size();
  const auto flat = [&](const Observables& other) {
    return flat_values(aligned(other, solved.seen));
  };
  std::vector<std::string> value_name = value_names(solved.seen, names);
  const std::vector<double> values = flat_values(solved.seen);
  const std::vector<double> above = flat(up), below = flat(down);
  const std::vector<double> closed =
      flat(has_closed_form ? closed_form_observables(scene) : Observables{});
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double value = values[k];
    if (std::isnan(value)) continue;
    const double units = 2 * std::numeric_limits<double>::epsilon() * std::abs(value);
    const double spread = std::max(std::abs(above[k] - value), std::abs(below[k] - value));
    const bool comparable = !std::isnan(above[k]) && !std::isnan(below[k]);
    if (!std::isnan(closed[k])) result.closed_form.emplace(value_name[k], closed[k]);
    result.observables.emplace(
        std::move(value_name[k]),
        UncertainValue{
            value, comparable ? std::max(units, spread) : std::numeric_limits<double>::infinity()});
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
