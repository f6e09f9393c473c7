#include "harness/run/engine_grid.h"

#include <algorithm>

#include "engine/engine_registry.h"

namespace slipcheck {
namespace {

using Precision = EngineRequest::Precision;

struct Installed {
  std::string engine, precision;
};

/// What is asked for by name although it is not installed stays, so that its runs say so.
std::vector<Installed> chosen(const EngineGrid& grid) {
  std::vector<std::string> engines = grid.engines;
  const std::vector<EngineExecutable> found = find_engines();
  if (engines.empty())
    for (const EngineExecutable& each : found)
      if (engines.empty() || engines.back() != each.engine) engines.push_back(each.engine);
  std::vector<Installed> chosen;
  for (const std::string& engine : engines) {
    std::vector<std::string> precisions = grid.precisions;
    if (precisions.empty())
      for (const EngineExecutable& each : found)
        if (each.engine == engine) precisions.push_back(each.precision);
    if (precisions.empty()) precisions = {"double"};
    for (const std::string& precision : precisions) chosen.push_back({engine, precision});
  }
  return chosen;
}

}  // namespace

void ask_for(Scenario& scenario, const EngineGrid& grid, std::span<const double> rates) {
  scenario.compare.engines.clear();
  for (const auto& [engine, precision] : chosen(grid))
    for (const std::string& profile : grid.profiles) {
      EngineRequest request;
      request.engine = engine;
      request.precision = precision == "single" ? Precision::single_ : Precision::double_;
      request.profile = profile;
      request.of_grid = true;
      request.rates.assign(rates.begin(), rates.end());
      scenario.compare.engines.push_back(std::move(request));
    }
}

}  // namespace slipcheck
