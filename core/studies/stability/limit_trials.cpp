#include "studies/stability/limit_trials.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "harness/run/requested_runs.h"
#include "scenario/observable_key.h"
#include "studies/stability/limit_scenes.h"
#include "studies/stability/stability.h"

namespace slipcheck {

const VariedScene& VariedScenes::get(const std::string& name, double value,
                                     const std::function<Scenario()>& make) {
  const auto [place, is_new] = scenes_.try_emplace({name, value});
  VariedScene& scene = place->second;
  if (!is_new) return scene;
  try {
    scene.prepared = std::move(prepare_scenes({make()}).front());
    if (scene.prepared->reference.run.failed) {
      scene.why = "the reference gave up: " + scene.prepared->reference.run.reason;
      scene.prepared.reset();
    }
  } catch (const std::exception& error) {
    // Far out in a range the reference may refuse; the other values go on.
    scene.why = std::string("the reference: ") + error.what();
  }
  return scene;
}

std::vector<EngineRecord> methods_of(const EngineGrid& grid, const RunOptions& options) {
  Scenario scenario = limit_pair();
  const std::vector<double> any_rate = {1};
  ask_for(scenario, grid, any_rate);
  return requested_runs({scenario}, options.limits, options.stop, options.settings).front();
}

std::vector<EnsembleTrial> EnsembleTrials::make(std::span<const EnsembleRequest> requests) {
  const auto key_of = [](const EnsembleRequest& request) {
    return Key{request.scene, request.method, request.step};
  };
  std::vector<OutcomeTask> tasks;
  std::vector<Key> keys;
  for (const EnsembleRequest& request : requests) {
    const auto [place, is_new] = known_.try_emplace(key_of(request));
    if (!is_new) continue;
    if (!request.scene->prepared) {
      place->second.why = request.scene->why;
      continue;
    }
    tasks.push_back({&*request.scene->prepared, *request.method});
    tasks.back().record.rate = 1 / request.step;
    keys.push_back(place->first);
  }

  RunOptions options = options_;
  const std::size_t before = done_;
  if (options_.progress)
    options.progress = [&](std::size_t done, std::size_t total) {
      options_.progress(before + done, std::max(expected_, before + total));
    };
  const std::vector<StabilityRun> runs =
      tasks.empty() ? std::vector<StabilityRun>() : run_outcomes(tasks, criteria_, options);
  done_ += runs.size();
  for (std::size_t k = 0; k < runs.size(); ++k)
    known_[keys[k]] = {runs[k].outcome, runs[k].why, restitution_error(runs[k].record.errors),
                       runs[k].record.version};

  std::vector<EnsembleTrial> made;
  for (const EnsembleRequest& request : requests) made.push_back(known_.at(key_of(request)));
  return made;
}

void fill_in(Limit& limit, const LimitSearch& search) {
  FoundLimit found = search.found();
  limit.reason = search.is_done() ? std::move(found.refusal) : "interrupted";
  if (!limit.reason.empty()) return;
  limit.good = found.good;
  limit.bad = found.bad;
  limit.beyond = found.beyond.outcome;
  limit.why = std::move(found.beyond.why);
  limit.islands = std::move(found.islands);
  limit.strays = std::move(found.strays);
}

double restitution_error(const std::map<std::string, Deviation>& errors) {
  double largest = kNotObserved;
  for (const auto& [name, deviation] : errors)
    if (observable_key(name).observable == "restitution" && !std::isnan(deviation.max))
      largest = std::fmax(largest, deviation.max);
  return largest;
}

}  // namespace slipcheck
