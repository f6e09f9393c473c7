#include "studies/stability/limits.h"

#include <cmath>
#include <optional>
#include <utility>

#include "base/stop_scope.h"
#include "studies/stability/engine_limits.h"
#include "studies/stability/fixed_step_limits.h"
#include "studies/stability/limit_trials.h"
#include "studies/stability/outcome_map.h"

namespace slipcheck {

double Limit::value() const { return good && bad ? std::sqrt(*good * *bad) : kNotObserved; }

LimitResults find_limits(const LimitGrid& grid, const RunOptions& options) {
  const StopScope scope(options.stop);
  const std::vector<EngineRecord> methods = methods_of(grid.engines, options);
  std::vector<const EngineRecord*> mapped;
  for (const EngineRecord& method : methods) {
    const bool is_asked = !grid.engines.precisions.empty() || method.precision == "double";
    if (method.reason.empty() && is_asked) mapped.push_back(&method);
  }
  VariedScenes scenes;
  EnsembleTrials trials(grid.criteria, options);
  const std::size_t of_maps = 2 * mapped.size() * grid.cells * grid.cells;
  trials.expect_later(of_maps);

  LimitResults results;
  results.limits = engine_limits(methods, grid, scenes, trials);
  for (Limit& limit : fixed_step_limits(grid, options)) results.limits.push_back(std::move(limit));

  trials.expect_later(0);
  trials.expect(of_maps);
  const auto keep = [&](std::optional<OutcomeMap> map) {
    if (map) results.maps.push_back(std::move(*map));
  };
  for (const EngineRecord* method : mapped) {
    keep(speed_restitution_map(*method, grid, scenes, trials));
    keep(step_speed_map(*method, grid, scenes, trials));
  }
  try {
    heed_stop();
    keep(step_stiffness_map(grid, options));
  } catch (const Interrupted&) {
    // A map with holes is none.
  }
  return results;
}

}  // namespace slipcheck
