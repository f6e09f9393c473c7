#include <algorithm>
#include <array>
#include <exception>
#include <nlopt.hpp>
#include <variant>

#include "studies/tuning/tuning_search.h"

namespace slipcheck {
namespace {

/// How far a setting is varied to see whether it matters, in its coordinate.
constexpr std::array<double, 4> kProbes = {-0.05, 0.05, -0.25, 0.25};
constexpr double kFirstStep = 0.1;
/// Where Sbplx ends: in the coordinates, and relative to the objective.
constexpr double kSmallestStep = 1e-3, kSmallestGain = 1e-3;
constexpr int kEvaluationsForEach = 40;

double number_of(const SettingInfo& info, const Settings& settings) {
  return std::get<double>(value_of(info, settings));
}

}  // namespace

std::vector<const SettingInfo*> TuningSearch::settings_that_matter() {
  std::vector<const SettingInfo*> matter;
  for (const SettingInfo& info : space_->vary) {
    if (!info.range) continue;
    const double here = coordinate(info, number_of(info, best_.settings));
    bool any = false;
    for (double step : kProbes) {
      if (here + step < 0 || here + step > 1) continue;
      Settings varied = best_.settings;
      varied[info.name] = value_at(info, here + step);
      any |= consider(varied, "screening");
    }
    if (any) matter.push_back(&info);
  }
  return matter;
}

bool TuningSearch::search_continuous() {
  const std::vector<const SettingInfo*> matter = settings_that_matter();
  if (matter.empty()) return false;

  std::exception_ptr thrown;
  const auto objective_at = [&](const std::vector<double>& x) {
    Settings settings = best_.settings;
    for (std::size_t k = 0; k < matter.size(); ++k)
      settings[matter[k]->name] = value_at(*matter[k], x[k]);
    try {
      const Outcome outcome =
          race(settings, slipcheck::objective(best_.score, options_.goal), Entry::different);
      if (outcome.whole && is_better(outcome.candidate.score, best_.score, options_.goal))
        adopt(outcome.candidate, "continuous");
      return outcome.objective;
    } catch (...) {
      // NLopt is C: what is thrown through it has to wait.
      thrown = std::current_exception();
      throw nlopt::forced_stop();
    }
  };
  using Objective = decltype(objective_at);

  std::vector<double> x;
  for (const SettingInfo* info : matter)
    x.push_back(coordinate(*info, number_of(*info, best_.settings)));
  nlopt::opt search(nlopt::LN_SBPLX, static_cast<unsigned>(matter.size()));
  search.set_min_objective([](const std::vector<double>& at, std::vector<double>&,
                              void* data) { return (*static_cast<const Objective*>(data))(at); },
                           const_cast<void*>(static_cast<const void*>(&objective_at)));
  search.set_lower_bounds(0.0);
  search.set_upper_bounds(1.0);
  search.set_initial_step(kFirstStep);
  search.set_xtol_abs(kSmallestStep);
  search.set_ftol_rel(kSmallestGain);
  search.set_maxeval(kEvaluationsForEach * static_cast<int>(matter.size()));
  nlopt::srand(static_cast<unsigned long>(options_.seed));
  double least = 0;
  try {
    search.optimize(x, least);
  } catch (const nlopt::forced_stop&) {
    if (thrown) std::rethrow_exception(thrown);
    throw;
  } catch (const nlopt::roundoff_limited&) {
    // It can get no further: as good as the end.
  }
  return true;
}

}  // namespace slipcheck
