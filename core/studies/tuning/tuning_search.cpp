#include "studies/tuning/tuning_search.h"

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
    stages_.push_back({few, fast.empty(), slow});
    stages_.push_back({few, true, fast});
  }
  stages_.push_back({all, false, slow});
  stages_.push_back({all, false, fast});
  std::erase_if(stages_, [](const Stage& stage) { return stage.tasks.empty(); });
}

bool TuningSearch::may_go_on(const TuningCandidate& candidate, const Stage& stage,
                             Entry entry) const {
  if (entry == Entry::free || stage.phases == evaluator_->phases()) return true;
  std::vector<RunScore> here, there;
  for (std::size_t place : stage.tasks) {
    here.push_back(candidate.few[place]);
    there.push_back(best_.few[place]);
  }
  const TuningGoal& goal = options_.goal;
  if (entry == Entry::gain && !stage.ends_few)
    return !is_better(score_of(there, goal), score_of(here, goal), goal);
  if (!stage.ends_few) return true;
  const Score mine = score_of(candidate.few, goal), best = score_of(best_.few, goal);
  if (entry == Entry::gain) return is_better(mine, best, goal);
  const bool same =
      std::ranges::equal(candidate.few, best_.few, [](const RunScore& one, const RunScore& other) {
        return one.worst == other.worst && one.deviation == other.deviation &&
               one.failed == other.failed;
      });
  return !same || is_better(mine, best, goal);
}

TuningSearch::Outcome TuningSearch::race(const Settings& settings, double limit, Entry entry) {
  Outcome outcome;
  TuningCandidate& candidate = outcome.candidate;
  candidate.settings = space_->canonical(settings);
  candidate.runs.resize(training_.size());
  candidate.few.resize(training_.size());
  for (const Stage& stage : stages_) {
    std::vector<std::size_t> tasks;
    for (std::size_t place : stage.tasks) tasks.push_back(training_[place]);
    const std::vector<RunScore> runs =
        evaluator_->evaluate(candidate.settings, stage.phases, tasks);
    const Score score = score_of(runs, options_.goal);
    outcome.objective = std::max(outcome.objective, objective(score, options_.goal));
    // The worst of some is no more than the worst of all; their mean may be.
    if (score.worst > limit) return outcome;
    auto& whole_or_few = stage.phases == evaluator_->phases() ? candidate.runs : candidate.few;
    for (std::size_t k = 0; k < runs.size(); ++k) whole_or_few[stage.tasks[k]] = runs[k];
    if (!may_go_on(candidate, stage, entry)) return outcome;
  }
  outcome.whole = true;
  candidate.score = score_of(candidate.runs, options_.goal);
  outcome.objective = objective(candidate.score, options_.goal);
  const bool is_new = std::ranges::none_of(evaluated_, [&](const TuningCandidate& earlier) {
    return earlier.settings == candidate.settings;
  });
  if (is_new) evaluated_.push_back(candidate);
  return outcome;
}

void TuningSearch::adopt(const TuningCandidate& candidate, const std::string& step) {
  best_ = candidate;
  if (options_.improved) options_.improved(step, best_);
}

bool TuningSearch::consider(const Settings& settings, const std::string& step, Entry entry) {
  const Outcome outcome = race(settings, objective(best_.score, options_.goal), entry);
  if (!outcome.whole || !is_better(outcome.candidate.score, best_.score, options_.goal))
    return false;
  adopt(outcome.candidate, step);
  return true;
}

bool TuningSearch::run() {
  evaluator_->heed_budget(false);
  const double no_limit = std::numeric_limits<double>::infinity();
  adopt(race(space_->start, no_limit, Entry::free).candidate, "start");
  for (const TuningStart& other : space_->others)
    consider(other.settings, other.profile, Entry::free);
  origin_ = best_.settings;
  evaluator_->heed_budget(true);
  bool converged = true;
  try {
    search_discrete();
    if (search_continuous()) search_discrete();
  } catch (const TuningBudgetSpent&) {
    converged = false;
  }
  evaluator_->heed_budget(false);
  prune();
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
    if (consider(with(with(best_.settings, moves[a]), moves[b]), "in pairs", Entry::gain))
      return true;
  return false;
}

void TuningSearch::prune() {
  const TuningGoal& goal = options_.goal;
  const double limit = (1 + kPruningCost) * objective(best_.score, goal);
  std::vector<std::string> names;
  for (const SettingInfo& info : space_->vary)
    if (best_.settings.contains(info.name)) names.push_back(info.name);
  shuffle(names);
  for (const std::string& name : names) {
    Settings fewer = best_.settings;
    fewer.erase(name);
    const Outcome outcome = race(fewer, limit, Entry::free);
    if (outcome.whole && outcome.objective <= limit &&
        (!goal.within || outcome.candidate.score.cost <= (1 + kSameCost) * best_.score.cost))
      adopt(outcome.candidate, "pruning");
  }
}

}  // namespace slipcheck
