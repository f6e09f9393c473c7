#include "studies/tuning/tuning.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace slipcheck {
namespace {

/// So many of the search's best at least go to the last comparison, beside the start: with few
/// phases the order of the best is uncertain.
constexpr std::size_t kFinalists = 4;
/// More error than this times that of the training scenes is overfitted.
constexpr double kOverfitted = 2;

TuningFinalist finalist(TuningEvaluator& evaluator, const Settings& settings,
                        const TuningOptions& options, const std::string& profile = "") {
  const std::vector<TuningTask>& tasks = evaluator.tasks();
  std::vector<std::size_t> all(tasks.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  TuningFinalist result;
  result.profile = profile;
  result.settings = settings;
  result.runs = evaluator.evaluate(settings, options.final_phases, all);
  std::vector<RunScore> training, held_out;
  for (std::size_t k = 0; k < tasks.size(); ++k)
    (tasks[k].held_out ? held_out : training).push_back(result.runs[k]);
  result.training = score_of(training, options.search.goal);
  if (!held_out.empty()) result.held_out = score_of(held_out, options.search.goal);
  return result;
}

/// The search's own choice, the first that is no profile, unless another is better by more than
/// pruning may cost; the best profile to begin from, where that is no better.
std::size_t choice(const std::vector<TuningFinalist>& finalists, const TuningGoal& goal) {
  std::size_t profile = 0, chosen = finalists.size();
  for (std::size_t k = 1; k < finalists.size(); ++k) {
    const Score& one = finalists[k].training;
    if (!finalists[k].profile.empty()) {
      if (is_better(one, finalists[profile].training, goal)) profile = k;
    } else if (chosen == finalists.size()) {
      chosen = k;
    } else {
      const Score& other = finalists[chosen].training;
      const bool clearly =
          objective(one, goal) < (1 - TuningSearch::kPruningCost) * objective(other, goal);
      if (clearly || (goal.within && is_better(one, other, goal))) chosen = k;
    }
  }
  if (chosen == finalists.size()) return profile;
  return is_better(finalists[chosen].training, finalists[profile].training, goal) ? chosen
                                                                                  : profile;
}

/// Where a goal is to be met, further ones have their turn until one meets it on all phases.
bool are_enough(const std::vector<TuningFinalist>& finalists, const TuningGoal& goal) {
  const auto profiles = static_cast<std::size_t>(std::ranges::count_if(
      finalists, [](const TuningFinalist& each) { return !each.profile.empty(); }));
  if (finalists.size() < profiles + kFinalists) return false;
  return !goal.within || std::ranges::any_of(finalists, [](const TuningFinalist& each) {
    return each.training.worst <= 1;
  });
}

}  // namespace

bool TuningResult::overfitted() const {
  return best().held_out && best().held_out->worst > kOverfitted * best().training.worst;
}

std::vector<TuningCandidate> pareto_front(std::vector<TuningCandidate> candidates) {
  std::ranges::stable_sort(candidates, [](const TuningCandidate& a, const TuningCandidate& b) {
    return std::pair(a.score.cost, a.score.worst) < std::pair(b.score.cost, b.score.worst);
  });
  double least = std::numeric_limits<double>::infinity();
  std::erase_if(candidates, [&](const TuningCandidate& candidate) {
    if (candidate.score.worst >= least) return true;
    least = candidate.score.worst;
    return false;
  });
  return candidates;
}

TuningResult tune(const TuningSpace& space, TuningEvaluator& evaluator,
                  const TuningOptions& options, const std::string& start) {
  const TuningGoal& goal = options.search.goal;
  TuningSearch search(space, evaluator, options.search);
  TuningResult result;
  result.converged = search.run();
  result.candidates = search.evaluated().size();
  result.evaluations = evaluator.spent();
  result.front = pareto_front(search.evaluated());

  std::vector<TuningCandidate> ranked;
  for (const TuningCandidate& candidate : search.evaluated())
    if (candidate.settings != space.start && candidate.settings != search.origin())
      ranked.push_back(candidate);
  // The search's own choice goes first: pruning prefers fewer settings to the last percent. Times
  // decide where they are what is searched for.
  std::ranges::stable_sort(ranked, [&](const TuningCandidate& a, const TuningCandidate& b) {
    const auto rank = [&](const TuningCandidate& candidate) {
      return std::tuple(candidate.settings != search.best().settings,
                        objective(candidate.score, goal), goal.within ? candidate.score.cost : 0);
    };
    return rank(a) < rank(b);
  });

  result.finalists.push_back(finalist(evaluator, space.start, options, start));
  for (const TuningStart& other : space.others)
    if (other.settings == search.origin())
      result.finalists.push_back(finalist(evaluator, other.settings, options, other.profile));
  for (const TuningCandidate& candidate : ranked) {
    if (search.best().settings == search.origin() || are_enough(result.finalists, goal)) break;
    result.finalists.push_back(finalist(evaluator, candidate.settings, options));
  }
  result.chosen = choice(result.finalists, goal);
  return result;
}

}  // namespace slipcheck
