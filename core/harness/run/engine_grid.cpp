#include "harness/run/engine_grid.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/engine_registry.h"
#include "engine/profile.h"

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
        if ((each.engine == engine || engine_family(each.engine) == engine) &&
            std::ranges::count(precisions, each.precision) == 0)
          precisions.push_back(each.precision);
    if (precisions.empty()) precisions = {"double"};
    for (const std::string& precision : precisions) chosen.push_back({engine, precision});
  }
  return chosen;
}

bool has_profile(const Installed& each, const std::string& profile) {
  if (profile == "default" || is_profile_path(profile)) return true;
  const auto executable = find_engine(each.engine, each.precision);
  return executable && std::ranges::count(profile_names(*executable), profile) > 0;
}

/// A grid of all engines or some, of the profiles that they have.
EngineGrid grid_where_there(std::vector<std::string> engines, std::vector<std::string> precisions,
                            const std::vector<std::string>& profiles) {
  EngineGrid grid;
  grid.engines = std::move(engines);
  grid.precisions = std::move(precisions);
  grid.where_there = true;
  grid.profiles = profiles;
  if (!profiles.empty()) return grid;
  grid.profiles = {"default"};
  if (std::ranges::any_of(chosen(grid),
                          [](const Installed& each) { return has_profile(each, "physical"); }))
    grid.profiles.emplace_back("physical");
  return grid;
}

Precision precision_of(const std::string& name) {
  return name == "single" ? Precision::single_ : Precision::double_;
}

/// The request with what is chosen in place of its own.
std::vector<EngineRequest> changed(EngineRequest request, const EngineChoice& choice) {
  request.expect.reset();
  if (!choice.rates.empty()) request.rates = choice.rates;
  request.of_grid = request.of_grid || !choice.profiles.empty();
  std::vector<EngineRequest> requests;
  const std::size_t precisions = std::max<std::size_t>(choice.precisions.size(), 1);
  const std::size_t profiles = std::max<std::size_t>(choice.profiles.size(), 1);
  for (std::size_t k = 0; k < precisions * profiles; ++k) {
    EngineRequest& each = requests.emplace_back(request);
    if (!choice.precisions.empty()) each.precision = precision_of(choice.precisions[k / profiles]);
    if (!choice.profiles.empty()) each.profile = choice.profiles[k % profiles];
  }
  return requests;
}

/// Adds a request, or to one of the same kind the rates that it lacks.
void add(EngineRequest request, std::vector<EngineRequest>& requests) {
  const auto same = std::ranges::find_if(requests, [&](const EngineRequest& each) {
    return each.engine == request.engine && each.precision == request.precision &&
           each.profile == request.profile;
  });
  if (same == requests.end()) {
    requests.push_back(std::move(request));
    return;
  }
  for (const double rate : request.rates)
    if (std::ranges::count(same->rates, rate) == 0) same->rates.push_back(rate);
}

}  // namespace

std::vector<EngineRequest> requests_of(const EngineGrid& grid, std::span<const double> rates) {
  std::vector<EngineRequest> requests;
  const std::vector<Installed> engines = chosen(grid);
  const auto is_asked_for = [&](const Installed& each, const std::string& profile) {
    const auto has_it = [&](const Installed& other) { return has_profile(other, profile); };
    return !grid.where_there || has_it(each) || std::ranges::none_of(engines, has_it);
  };
  for (const Installed& each : engines)
    for (const std::string& profile : grid.profiles) {
      if (!is_asked_for(each, profile)) continue;
      EngineRequest request;
      request.engine = each.engine;
      request.precision = precision_of(each.precision);
      request.profile = profile;
      request.of_grid = true;
      request.rates.assign(rates.begin(), rates.end());
      requests.push_back(std::move(request));
    }
  return requests;
}

std::vector<EngineRequest> requests_of(const Scenario& scenario) {
  const std::optional<AllEngines>& all = scenario.compare.all_engines;
  if (!all) return scenario.compare.engines;
  return requests_of(grid_where_there({}, {}, all->profiles), all->rates);
}

void choose_engines(Scenario& scenario, const EngineChoice& choice) {
  if (choice.engines.empty() && choice.precisions.empty() && choice.profiles.empty() &&
      choice.rates.empty())
    return;
  Compare& compare = scenario.compare;
  if (!choice.engines.empty() || compare.all_engines) {
    AllEngines asked = choice.engines.empty() ? *compare.all_engines : AllEngines{};
    if (!choice.profiles.empty()) asked.profiles = choice.profiles;
    if (!choice.rates.empty()) asked.rates = choice.rates;
    const bool is_all = choice.engines.empty() || choice.engines == std::vector<std::string>{"all"};
    compare.engines =
        requests_of(grid_where_there(is_all ? std::vector<std::string>{} : choice.engines,
                                     choice.precisions, asked.profiles),
                    asked.rates);
    compare.all_engines.reset();
    return;
  }
  std::vector<EngineRequest> requests;
  for (const EngineRequest& request : compare.engines)
    for (EngineRequest& each : changed(request, choice)) add(std::move(each), requests);
  compare.engines = std::move(requests);
}

void ask_for(Scenario& scenario, const EngineGrid& grid, std::span<const double> rates) {
  Compare& compare = scenario.compare;
  compare.engines = requests_of(grid, rates);
  compare.all_engines.reset();
  compare.headings = 1;
  compare.scales = {1};
}

}  // namespace slipcheck
