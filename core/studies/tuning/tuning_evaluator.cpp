#include "studies/tuning/tuning_evaluator.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

namespace slipcheck {
namespace {

/// Starting workers takes time too, however short the run: the least share that a run counts of
/// what an average one of a whole evaluation does.
constexpr double kLeastShare = 0.1;

}  // namespace

TuningEvaluator::TuningEvaluator(std::vector<TuningTask> tasks, std::string identity,
                                 const TuningObservables& observables, std::size_t phases,
                                 TuningRuns runs, TuningJournal& journal,
                                 const TuningBudget& budget)
    : tasks_(std::move(tasks)),
      identity_(std::move(identity)),
      observables_(observables),
      phases_(phases),
      runs_(std::move(runs)),
      journal_(&journal),
      budget_(budget) {
  for (const TuningTask& task : tasks_)
    if (!task.held_out) whole_ += task.rate * static_cast<double>(phases_);
}

std::string TuningEvaluator::question(const Settings& settings, std::size_t phases,
                                      const TuningTask& task) const {
  using Json = nlohmann::ordered_json;
  Json chosen = Json::object();
  for (const auto& [name, value] : settings)
    std::visit([&chosen, &key = name](const auto& plain) { chosen[key] = plain; }, value);
  return Json{{"identity", identity_}, {"scene", task.scene},
              {"sha256", task.sha256}, {"observables", observables_.named},
              {"rate", task.rate},     {"phases", phases},
              {"settings", chosen}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<RunScore> TuningEvaluator::evaluate(const Settings& settings, std::size_t phases,
                                                std::span<const std::size_t> tasks) {
  if (heeds_budget_ && (spent_ >= budget_.evaluations || seconds_ >= budget_.seconds))
    throw TuningBudgetSpent();
  std::vector<std::string> questions;
  std::vector<const TuningTask*> missing;
  std::vector<std::string> missing_questions;
  for (std::size_t task : tasks) {
    questions.push_back(question(settings, phases, tasks_[task]));
    if (journal_->find(questions.back())) continue;
    missing.push_back(&tasks_[task]);
    missing_questions.push_back(questions.back());
  }

  if (!missing.empty()) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const std::vector<std::optional<RunScore>> scores = runs_(settings, phases, missing);
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count() /
                           static_cast<double>(missing.size());
    std::vector<std::pair<std::string, TuningJournal::Answer>> answers;
    for (std::size_t k = 0; k < missing.size(); ++k)
      if (scores[k]) answers.push_back({missing_questions[k], {*scores[k], seconds}});
    journal_->add(answers);
    if (answers.size() < missing.size()) throw TuningInterrupted();
  }

  std::vector<RunScore> result;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const TuningJournal::Answer& answer = *journal_->find(questions[k]);
    count(questions[k], tasks_[tasks[k]], phases, answer.seconds);
    result.push_back(answer.score);
  }
  return result;
}

void TuningEvaluator::count(const std::string& question, const TuningTask& task, std::size_t phases,
                            double seconds) {
  if (!counted_.insert(question).second) return;
  const double average = 1 / static_cast<double>(tasks_.size());
  const double share = task.rate * static_cast<double>(phases) / whole_;
  spent_ += std::max(share, kLeastShare * average);
  seconds_ += seconds;
}

}  // namespace slipcheck
