#include "studies/stability/engine_limits.h"

#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "scenario/scaled_lengths.h"
#include "studies/stability/limit_scenes.h"
#include "studies/stability/limit_search.h"
#include "studies/stability/scene_variation.h"

namespace slipcheck {
namespace {

using GoodEnd = LimitRange::GoodEnd;

// Of all trials but those of steps [s]: small enough that engines are accurate where they can be.
constexpr double kStep = 1e-3;
constexpr double kBounceStep = 5e-4;

/// What is varied, and how a value becomes a scene and a step.
struct Question {
  Limit::Kind kind;
  std::string scene;
  double low, high;
  GoodEnd good_end;
  Outcome worst;  ///< that still counts as good
  std::function<Scenario(double)> vary;
  std::function<double(double)> step;
  /// Whether every value is a scene of its own; else they share one.
  bool varies = true;
};

Question step_question(Limit::Kind kind, Scenario (*scene)(), double least_step) {
  const Outcome worst = kind == Limit::Kind::stable_step ? Outcome::degraded : Outcome::accurate;
  return {kind,
          scene().name,
          least_step,
          1,
          GoodEnd::low,
          worst,
          [scene](double) { return scene(); },
          [](double step) { return step; },
          false};
}

/// `step` [s] is at factor 1.
Question length_question(Scenario (*scene)(), double step) {
  // Steps in proportion to the scene's times: as many of them at every scale.
  return {Limit::Kind::length_scale,
          scene().name,
          1e-6,
          1e3,
          GoodEnd::high,
          Outcome::accurate,
          [scene](double lambda) { return scaled_lengths(scene(), lambda); },
          [step](double lambda) { return step * std::sqrt(lambda); }};
}

Question mass_question(Scenario (*scene)()) {
  return {Limit::Kind::mass_ratio,
          scene().name,
          1,
          1e6,
          GoodEnd::low,
          Outcome::accurate,
          [scene](double q) { return with_mass_ratio(scene(), q); },
          [](double) { return kStep; }};
}

std::vector<Question> questions(double least_step) {
  std::vector<Question> all;
  for (const Limit::Kind kind : {Limit::Kind::stable_step, Limit::Kind::accurate_step}) {
    all.push_back(step_question(kind, limit_pair, least_step));
    // Longer runs; what steps that small do is seen in the pair.
    for (const auto scene : {limit_bounce, limit_roll})
      all.push_back(step_question(kind, scene, 10 * least_step));
  }
  all.push_back(length_question(limit_pair, kStep));
  all.push_back(length_question(limit_bounce, kBounceStep));
  all.push_back(length_question(limit_roll, kStep));
  for (const auto scene : {limit_strikes_heavier, limit_struck_by_heavier})
    all.push_back(mass_question(scene));
  return all;
}

/// A question put to a method.
struct Asked {
  Limit limit;
  const Question* question;
  const EngineRecord* method;
  LimitSearch search;
};

Asked ask(const Question& question, const EngineRecord& method, const LimitGrid& grid) {
  Limit limit;
  limit.kind = question.kind;
  limit.method = method.engine;
  limit.precision = method.precision;
  limit.profile = method.profile;
  limit.scene = question.scene;
  limit.low = question.low;
  limit.high = question.high;
  limit.reason = method.reason;
  const LimitRange range{question.low, question.high, question.good_end, grid.per_decade,
                         grid.ratio};
  return {std::move(limit), &question, &method, LimitSearch(range)};
}

}  // namespace

std::vector<Limit> engine_limits(std::span<const EngineRecord> methods, const LimitGrid& grid,
                                 VariedScenes& scenes, EnsembleTrials& trials) {
  const std::vector<Question> all = questions(grid.least_step);
  std::vector<Asked> asked;
  for (const EngineRecord& method : methods)
    for (const Question& question : all) asked.push_back(ask(question, method, grid));

  while (!trials.is_interrupted()) {
    std::vector<Asked*> open;
    std::vector<EnsembleRequest> requests;
    std::size_t most = 0;
    for (Asked& each : asked) {
      if (!each.limit.reason.empty() || each.search.is_done()) continue;
      open.push_back(&each);
      most += each.search.most_trials_left();
      const Question& question = *each.question;
      for (const double value : each.search.wanted()) {
        const VariedScene& scene = scenes.get(question.scene, question.varies ? value : 0,
                                              [&] { return question.vary(value); });
        requests.push_back({&scene, each.method, question.step(value)});
      }
    }
    if (open.empty()) break;
    trials.expect(most);
    const std::vector<EnsembleTrial> made = trials.make(requests);
    if (trials.is_interrupted()) break;
    auto next = made.begin();
    for (Asked* each : open) {
      std::vector<Trial> told;
      for (std::size_t k = 0; k < each->search.wanted().size(); ++k, ++next) {
        told.push_back({next->outcome <= each->question->worst, next->outcome, next->why});
        if (!next->version.empty()) each->limit.version = next->version;
      }
      each->search.tell(told);
    }
  }

  std::vector<Limit> limits;
  for (Asked& each : asked) {
    if (each.limit.reason.empty()) fill_in(each.limit, each.search);
    limits.push_back(std::move(each.limit));
  }
  return limits;
}

}  // namespace slipcheck
