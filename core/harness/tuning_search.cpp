#include "harness/tuning_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>

namespace slipcheck {
namespace {

/// Of the phases of a whole evaluation, in the first stages of a race.
constexpr std::size_t kFewerPhases = 4;

Settings with(Settings settings, const TuningMove& move) {
  settings[move.setting->name] = move.value;
  return settings;
}

}  // namespace

TuningSearch::TuningSearch(const TuningSpace& space, TuningEvaluator& evaluator,
                           TuningSearchOptions options)
    : space_(&space), evaluator_(&evaluator), options_(std::move(options)), random_(options_.seed) {
  for (std::size_t k = 0; k < evaluator.tasks().size(); ++k)
    if (!evaluator.tasks()[k].held_out) training_.push_back(k);
  make_stages();
}

void TuningSearch::make_stages() {
  std::map<double, std::vector<std::size_t>> by_rate;
  for (std::size_t k = 0; k < training_.size(); ++k)
    by_rate[evaluator_->tasks()[training_[k]].rate].push_back(k);
  std::vector<std::size_t> slow = by_rate.begin()->second, fast;
  for (auto rate = std::next(by_rate.begin()); rate != by_rate.end(); ++rate)
    fast.insert(fast.end(), rate->second.begin(), rate->second.end());

  const std::size_t all = evaluator_->phases();
  const std::size_t few = std::max<std::size_t>(all / kFewerPhases, 2);
  if (few < all) {
    stages_.push_back({few, slow});
    stages_.push_back({few, fast});
  }
  stages_.push_back({all, slow});
  stages_.push_back({all, fast});
  std::erase_if(stages_, [](const Stage& stage) { return stage.tasks.empty(); });
}

TuningSearch::Outcome TuningSearch::race(const Settings& settings, double limit) {
  Outcome outcome;
  outcome.candidate.settings = space_->canonical(settings);
  outcome.candidate.runs.resize(training_.size());
  for (const Stage& stage : stages_) {
    std::vector<std::size_t> tasks;
    for (std::size_t place : stage.tasks) tasks.push_back(training_[place]);
    const std::vector<RunScore> runs =
        evaluator_->evaluate(outcome.candidate.settings, stage.phases, tasks);
    outcome.objective =
        std::max(outcome.objective, objective(score_of(runs, options_.goal), options_.goal));
    // The worst of some is no more than the worst of all; their mean may be.
    if (score_of(runs, options_.goal).worst > limit) return outcome;
    if (stage.phases == evaluator_->phases())
      for (std::size_t k = 0; k < runs.size(); ++k)
        outcome.candidate.runs[stage.tasks[k]] = runs[k];
  }
  outcome.whole = true;
  outcome.candidate.score = score_of(outcome.candidate.runs, options_.goal);
  outcome.objective = objective(outcome.candidate.score, options_.goal);
  const bool is_new = std::ranges::none_of(evaluated_, [&](const TuningCandidate& earlier) {
    return earlier.settings == outcome.candidate.settings;
  });
  if (is_new) evaluated_.push_back(outcome.candidate);
  return outcome;
}

void TuningSearch::adopt(const TuningCandidate& candidate, const std::string& step) {
  best_ = candidate;
  if (options_.improved) options_.improved(step, best_);
}

bool TuningSearch::consider(const Settings& settings, const std::string& step) {
  const Outcome outcome = race(settings, objective(best_.score, options_.goal));
  if (!outcome.whole || !is_better(outcome.candidate.score, best_.score, options_.goal))
    return false;
  adopt(outcome.candidate, step);
  return true;
}

bool TuningSearch::run() {
  evaluator_->heed_budget(false);
  adopt(race(space_->start, std::numeric_limits<double>::infinity()).candidate, "start");
  evaluator_->heed_budget(true);
  bool converged = true;
  try {
    search_discrete();
    if (search_continuous()) search_discrete();
    prune();
  } catch (const TuningBudgetSpent&) {
    converged = false;
  }
  evaluator_->heed_budget(false);
  return converged;
}

// --- candidates one by one and in pairs ----------------------------------------------------------

template <class T>
void TuningSearch::shuffle(std::vector<T>& list) {
  // The library's shuffle differs between platforms.
  std::mt19937_64 random(random_++);
  for (std::size_t k = list.size(); k > 1; --k) std::swap(list[k - 1], list[random() % k]);
}

void TuningSearch::search_discrete() {
  do {
    while (try_single_moves()) {
    }
  } while (try_pairs_of_moves());
}

bool TuningSearch::try_single_moves() {
  bool improved = false;
  std::vector<TuningMove> moves = moves_from(*space_, best_.settings);
  shuffle(moves);
  for (const TuningMove& move : moves)
    improved |= consider(with(best_.settings, move), "one by one");
  return improved;
}

bool TuningSearch::try_pairs_of_moves() {
  const std::vector<TuningMove> moves = moves_from(*space_, best_.settings);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < moves.size(); ++a)
    for (std::size_t b = a + 1; b < moves.size(); ++b)
      if (moves[a].setting != moves[b].setting) pairs.emplace_back(a, b);
  shuffle(pairs);
  for (const auto& [a, b] : pairs)
    if (consider(with(with(best_.settings, moves[a]), moves[b]), "in pairs")) return true;
  return false;
}

void TuningSearch::prune() {
  const double limit = (1 + kPruningCost) * objective(best_.score, options_.goal);
  std::vector<std::string> names;
  for (const SettingInfo& info : space_->vary)
    if (best_.settings.contains(info.name)) names.push_back(info.name);
  shuffle(names);
  for (const std::string& name : names) {
    Settings fewer = best_.settings;
    fewer.erase(name);
    const Outcome outcome = race(fewer, limit);
    const bool cheap = !options_.goal.within ||
                       outcome.candidate.score.cost <= (1 + kPruningCost) * best_.score.cost;
    if (outcome.whole && outcome.objective <= limit && cheap) adopt(outcome.candidate, "pruning");
  }
}

}  // namespace slipcheck
