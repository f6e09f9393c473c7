#include "report/rows/stability_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "report/rows/outcome_look.h"
#include "report/rows/quantity.h"

namespace slipcheck {
namespace {

StabilityMethod method_of(const StabilityRun& run) {
  return {run.record.engine, run.record.precision, run.record.profile};
}

std::size_t index_of(std::vector<StabilityMethod>& methods, const StabilityMethod& method) {
  const auto found = std::find(methods.begin(), methods.end(), method);
  const auto index = static_cast<std::size_t>(found - methods.begin());
  if (found == methods.end()) methods.push_back(method);
  return index;
}

void count(StabilityOverview& overview, const ReferenceOutcome& reference) {
  ++(reference.accurate  ? overview.accurate
     : reference.refused ? overview.refused
                         : overview.failed);
}

void add_rows(StabilityOverview& overview, const StabilityCase& scene) {
  std::set<double> rates;
  for (const StabilityRun& run : scene.runs) rates.insert(run.record.rate);
  if (rates.empty()) overview.rows.push_back({&scene, {}, {}, scene.scenario.name});
  for (const double rate : rates) {
    StabilityRow row{&scene, rate, {}, scene.scenario.name};
    if (!overview.rate) row.label += fmt::format(" @ {:g} Hz", rate);
    row.runs.resize(overview.methods.size());
    for (const StabilityRun& run : scene.runs)
      if (run.record.rate == rate) row.runs[index_of(overview.methods, method_of(run))] = &run;
    overview.rows.push_back(std::move(row));
  }
}

}  // namespace

std::string StabilityMethod::label() const {
  return fmt::format("{} {} {}", engine, precision, profile);
}

StabilityOverview overview_of(const std::vector<StabilityCase>& cases) {
  StabilityOverview overview;
  std::set<double> rates;
  for (const StabilityCase& scene : cases) {
    count(overview, scene.reference);
    for (const StabilityRun& run : scene.runs) {
      const std::size_t method = index_of(overview.methods, method_of(run));
      overview.totals.resize(overview.methods.size());
      ++overview.totals[method][static_cast<std::size_t>(run.outcome)];
      rates.insert(run.record.rate);
    }
  }
  if (rates.size() == 1) overview.rate = *rates.begin();
  for (const StabilityCase& scene : cases) add_rows(overview, scene);
  for (StabilityRow& row : overview.rows) row.runs.resize(overview.methods.size());
  return overview;
}

TextTable totals_table(const StabilityOverview& overview, Tone none) {
  TextTable table{{{"method"}}, {}, "Runs by class"};
  for (std::size_t k = 0; k < kOutcomes; ++k)
    table.columns.push_back({name_of(static_cast<Outcome>(k)), true});
  for (std::size_t m = 0; m < overview.methods.size(); ++m) {
    std::vector<Cell>& row = table.rows.emplace_back(1, Cell{overview.methods[m].label()});
    for (std::size_t k = 0; k < kOutcomes; ++k)
      row.push_back(count_cell(overview.totals[m][k], tone_of(static_cast<Outcome>(k)), none));
  }
  return table;
}

const char* word_of(const ReferenceOutcome& reference) {
  return reference.accurate ? "accurate" : reference.refused ? "refused" : "FAILED";
}

Outcome outcome_of(const ReferenceOutcome& reference) {
  return reference.accurate  ? Outcome::accurate
         : reference.refused ? Outcome::refused
                             : Outcome::crashed;
}

std::string words_of(const StabilityRun& run) {
  std::size_t phases = 0;
  for (std::size_t count : run.phases) phases += count;
  const std::size_t so = run.phases[static_cast<std::size_t>(run.outcome)];
  std::string words = name_of(run.outcome);
  if (so > 0 && so < phases) words += fmt::format(" in {} of {} phases", so, phases);
  return run.why.empty() ? words : fmt::format("{}: {}", words, run.why);
}

std::vector<LimitGroup> limit_groups(const std::vector<Limit>& limits) {
  std::vector<LimitGroup> groups;
  for (const Limit& limit : limits) {
    auto group = std::find_if(groups.begin(), groups.end(), [&](const LimitGroup& other) {
      return other.kind == limit.kind && other.scene == limit.scene;
    });
    if (group == groups.end()) group = groups.insert(group, {limit.kind, limit.scene, {}});
    group->limits.push_back(&limit);
  }
  return groups;
}

std::vector<const OutcomeMap*> complete_maps(const LimitResults& results) {
  std::vector<const OutcomeMap*> maps;
  for (const OutcomeMap& map : results.maps) {
    const std::size_t cells = map.x.values.size() * map.y.values.size();
    if (cells > 0 && map.outcome.size() == cells) maps.push_back(&map);
  }
  return maps;
}

const char* words_of(Limit::Kind kind) {
  switch (kind) {
    case Limit::Kind::stable_step:
      return "largest stable step";
    case Limit::Kind::accurate_step:
      return "largest accurate step";
    case Limit::Kind::length_scale:
      return "smallest accurate length scale";
    case Limit::Kind::mass_ratio:
      return "largest accurate mass ratio";
  }
  return "";
}

std::string label_of(const Limit& limit) {
  std::string label = limit.method;
  if (!limit.precision.empty()) label += " " + limit.precision;
  if (!limit.profile.empty()) label += " " + limit.profile;
  return label;
}

std::string value_text(Limit::Kind kind, double value) {
  const bool is_time = kind == Limit::Kind::stable_step || kind == Limit::Kind::accurate_step;
  return is_time ? quantity(value, kTime) : plain_number(value);
}

std::string range_text(const Limit& limit) {
  const auto text = [&](double value) { return value_text(limit.kind, value); };
  if (limit.good && limit.bad) return fmt::format("{} … {}", text(*limit.good), text(*limit.bad));
  if (!limit.good && !limit.bad) return "–";
  return fmt::format("{} from {} to {}", limit.good ? "all" : "none", text(limit.low),
                     text(limit.high));
}

double ratio_to_theory(const Limit& limit) {
  return limit.theory ? limit.value() / *limit.theory : kNotObserved;
}

TextTable limits_table(const std::vector<const Limit*>& limits) {
  TextTable table{{{"method"},
                   {"limit"},
                   {"scene"},
                   {"last good … first bad", true},
                   {"theory"},
                   {"ratio", true},
                   {"beyond"},
                   {"why"}},
                  {},
                  "Limits"};
  for (const Limit* limit : limits) {
    std::string theory = limit->theory ? value_text(limit->kind, *limit->theory) : "";
    if (!limit->theory_name.empty()) theory += " = " + limit->theory_name;
    const double ratio = ratio_to_theory(*limit);
    std::string why = limit->reason.empty() ? limit->why : limit->reason;
    for (const double island : limit->islands)
      why += fmt::format("{}bad all the same at {}", why.empty() ? "" : "; ",
                         value_text(limit->kind, island));
    table.rows.push_back(
        {{label_of(*limit)},
         {words_of(limit->kind)},
         {limit->scene},
         {range_text(*limit), Tone::plain, limit->value()},
         {theory, Tone::plain, limit->theory.value_or(kNotObserved)},
         {std::isfinite(ratio) ? fmt::format("{:.4f}", ratio) : "", Tone::plain, ratio},
         {limit->bad ? name_of(limit->beyond) : "",
          limit->bad ? tone_of(limit->beyond) : Tone::plain},
         {.text = why, .css_class = "reason"}});
  }
  return table;
}

}  // namespace slipcheck
