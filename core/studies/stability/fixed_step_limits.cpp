#include "studies/stability/fixed_step_limits.h"

#include <fmt/format.h>

#include <functional>
#include <utility>

#include "base/stop_scope.h"
#include "harness/run/prepared_scene.h"
#include "reference/steps/step_solver.h"
#include "studies/stability/closed_contact.h"
#include "studies/stability/fixed_step_outcome.h"
#include "studies/stability/limit_scenes.h"
#include "studies/stability/limit_search.h"
#include "studies/stability/limit_trials.h"
#include "studies/stability/reference_path.h"

namespace slipcheck {
namespace {

/// ω0 of the closed contact [1/s]; the limit times it does not depend on it.
constexpr double kOmega0 = 2e5;
/// γ/ω0: none, that of e_n = 0.9, strong, nearly critical.
constexpr double kDampingRatios[] = {0, 0.07, 0.5, 1.5};
/// Of the bisection on the closed contact, for a limit within 1 % of theory; a trial takes 0.5 ms.
constexpr double kRatio = 1.001;

Limit limit_of(Limit::Kind kind, std::string scene) {
  Limit limit;
  limit.kind = kind;
  limit.method = "fixed-step";
  limit.precision = "double";
  limit.scene = std::move(scene);
  return limit;
}

void search(Limit& limit, LimitRange range, const std::function<Trial(double)>& trial) {
  limit.low = range.low;
  limit.high = range.high;
  LimitSearch search(range);
  try {
    while (!search.is_done()) {
      heed_stop();
      std::vector<Trial> trials;
      for (const double value : search.wanted()) trials.push_back(trial(value));
      search.tell(trials);
    }
  } catch (const Interrupted&) {
    // fill_in() says so.
  }
  fill_in(limit, search);
}

Limit closed_contact_limit(double damping_ratio) {
  Limit limit =
      limit_of(Limit::Kind::stable_step, fmt::format("closed-contact, γ/ω0 = {:g}", damping_ratio));
  limit.theory = step_limit(kOmega0, damping_ratio * kOmega0);
  limit.theory_name = damping_ratio == 0 ? "2/ω0" : "2 (√(1 + ε²) − ε)/ω0, ε = γ/ω0";
  search(limit, {0.01 / kOmega0, 10 / kOmega0, LimitRange::GoodEnd::low, 4, kRatio},
         [&](double step) { return closed_contact_trial(kOmega0, damping_ratio * kOmega0, step); });
  return limit;
}

/// `by_restitution`: that alone counts.
Limit collision_limit(bool by_restitution, const LimitGrid& grid, const RunOptions& options) {
  Scenario scenario = limit_soft_pair();
  if (by_restitution) scenario.compare.tolerance.erase("contact_time");
  Limit limit = limit_of(Limit::Kind::accurate_step,
                         scenario.name + (by_restitution ? ", restitution alone" : ""));
  const std::vector<PreparedScene> prepared = prepare_scenes({std::move(scenario)});
  const ReferenceResult& reference = prepared.front().reference;
  if (reference.run.failed) {
    limit.reason = reference.run.reason;
    return limit;
  }
  const ReferencePath path(prepared.front());
  const double duration = reference.observables.at("i-j.contact_time").value;
  search(limit,
         {duration / 1000, 10 * duration, LimitRange::GoodEnd::low, grid.per_decade, grid.ratio},
         [&](double step) {
           FixedStepOutcome seen = fixed_step_outcome(path, step, options.phases, grid.criteria);
           return Trial{seen.outcome == Outcome::accurate, seen.outcome, std::move(seen.why)};
         });
  return limit;
}

}  // namespace

std::vector<Limit> fixed_step_limits(const LimitGrid& grid, const RunOptions& options) {
  std::vector<Limit> limits;
  for (const double damping_ratio : kDampingRatios)
    limits.push_back(closed_contact_limit(damping_ratio));
  for (const bool by_restitution : {false, true})
    limits.push_back(collision_limit(by_restitution, grid, options));
  return limits;
}

}  // namespace slipcheck
