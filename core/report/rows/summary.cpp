#include "report/rows/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "engine/engine_registry.h"
#include "harness/compare/comparison.h"
#include "report/rows/engine_matrix.h"
#include "report/rows/quantity.h"
#include "report/rows/told_verdict.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

constexpr std::size_t kMostNamed = 4;  // scores in a sentence

std::string version_of(const EngineRecord& run) {
  return run.version.empty() ? engine_version(run.engine) : run.version;
}

/// Larger shares first; of equal ones the smaller error.
bool is_better(const ProfileScore& one, const ProfileScore& other) {
  if (one.is_naive != other.is_naive) return other.is_naive;
  const double a = one.judged() > 0 ? one.share() : -1, b = other.judged() > 0 ? other.share() : -1;
  if (a != b) return a > b;
  return one.median_error < other.median_error;
}

std::vector<ProfileScore> scores_of(const std::vector<SceneRecord>& scenes) {
  std::map<std::tuple<std::string, std::string, std::string>, ProfileScore> scores;
  std::map<const ProfileScore*, std::vector<double>> errors;
  for (const SceneRecord& scene : scenes)
    for (const EngineRecord& run : scene.runs) {
      if (run.expect) continue;
      const std::string engine = engine_family(run.engine), version = version_of(run);
      ProfileScore& score = scores[{engine, version, run.profile}];
      score.engine = engine;
      score.version = version;
      score.profile = run.profile;
      score.is_naive = is_naive(run);
      score.runs.add(run.verdict());
      score.skipped += run.status == RunStatus::skipped ? 1 : 0;
      if (const double error = worst_phase(run); !std::isnan(error))
        errors[&score].push_back(error);
    }
  std::vector<ProfileScore> result;
  for (auto& [key, score] : scores) {
    if (auto& all = errors[&score]; !all.empty()) score.median_error = median(all);
    result.push_back(std::move(score));
  }
  std::ranges::stable_sort(result, is_better);
  return result;
}

std::string standing(const ProfileScore& score, bool with_engine, bool is_first) {
  return printable(
      fmt::format("{} {}in {} of {}", score.label(with_engine),
                  is_first ? "is within all tolerances " : "", score.runs.of(Verdict::within),
                  is_first ? counted(score.judged(), "run") : std::to_string(score.judged())));
}

/// The best, and of many the last.
std::string standings(const Summary& summary) {
  std::vector<const ProfileScore*> judged;
  for (const ProfileScore& score : summary.scores)
    if (!score.is_naive && score.judged() > 0) judged.push_back(&score);
  std::string text;
  const std::size_t named = judged.size() > kMostNamed ? kMostNamed - 1 : judged.size();
  for (std::size_t k = 0; k < named; ++k)
    text += (k > 0 ? ", " : "") + standing(*judged[k], summary.has_engines, k == 0);
  if (named < judged.size())
    text += ", last of " + std::to_string(judged.size()) + " " +
            standing(*judged.back(), summary.has_engines, false);
  return text;
}

std::string finding_of(const Summary& summary) {
  std::vector<std::string> parts;
  if (std::string text = standings(summary); !text.empty()) parts.push_back(std::move(text));
  if (summary.expected_runs > 0)
    parts.push_back(fmt::format("{} of {} of which something is expected do as expected",
                                summary.as_expected, counted(summary.expected_runs, "run")));
  if (!summary.worst.empty()) parts.push_back("worst: " + worst_text(summary.worst.front()));
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : "; ") + part;
  return text.empty() ? text : text + ".";
}

std::string naive_text(const Summary& summary) {
  std::size_t within = 0, judged = 0;
  for (const ProfileScore& score : summary.scores) {
    if (!score.is_naive) continue;
    within += score.runs.of(Verdict::within);
    judged += score.judged();
  }
  if (judged == 0) return {};
  std::string text = fmt::format(
      "naive, the coefficients typed straight into the engine, is within in {} of {} and decides "
      "no scene's verdict beside other runs",
      within, counted(judged, "run"));
  if (summary.naive_alone > 0)
    text += fmt::format("; in {} only it is not within, which the exit code counts",
                        counted(summary.naive_alone, "scene"));
  return text + ".";
}

std::string heading_of(const AllVerdicts& all) {
  const std::size_t bad = all.scenes.of(Verdict::undecided) + all.scenes.of(Verdict::deviates) +
                          all.scenes.of(Verdict::failed);
  if (bad > 0)
    return fmt::format("{} of {} not within tolerance", bad, counted(all.scene_count, "scene"));
  return all.scenes.of(Verdict::within) > 0 ? "all within tolerance" : "nothing was judged";
}

}  // namespace

std::size_t ProfileScore::judged() const {
  return runs.of(Verdict::within) + runs.of(Verdict::deviates) + runs.of(Verdict::undecided) +
         runs.of(Verdict::failed) - skipped;
}

double ProfileScore::share() const {
  return judged() == 0
             ? std::numeric_limits<double>::quiet_NaN()
             : static_cast<double>(runs.of(Verdict::within)) / static_cast<double>(judged());
}

std::string ProfileScore::label(bool with_engine) const {
  if (!with_engine) return profile;
  return fmt::format("{} {}{}{}", engine, version, version.empty() ? "" : " ", profile);
}

Summary summarize(const std::vector<SceneRecord>& scenes, std::size_t most_worst) {
  Summary summary;
  summary.counts = count_verdicts(scenes);
  summary.scores = scores_of(scenes);
  const auto same_engine = [&](const ProfileScore& score) {
    return score.engine == summary.scores.front().engine &&
           score.version == summary.scores.front().version;
  };
  summary.has_engines = !std::ranges::all_of(summary.scores, same_engine);
  summary.worst = worst_findings(scenes, most_worst);
  for (const SceneRecord& scene : scenes) {
    const Verdict told = told_verdict(scene);
    summary.verdict = std::max(summary.verdict, told);
    summary.naive_alone += told <= Verdict::within && scene.verdict() > Verdict::within ? 1 : 0;
    for (const EngineRecord& run : scene.runs) {
      if (!run.expect) continue;
      ++summary.expected_runs;
      summary.as_expected += run.verdict() == Verdict::within ? 1 : 0;
    }
  }
  summary.heading = heading_of(summary.counts);
  summary.finding = finding_of(summary);
  summary.naive = naive_text(summary);
  return summary;
}

std::string scenes_text(const Summary& summary) {
  const AllVerdicts& all = summary.counts;
  std::string text = all.scenes.list();
  if (all.scenes_alone > 0) text += fmt::format(", {} of the reference alone", all.scenes_alone);
  return text;
}

TextTable score_table(const Summary& summary) {
  TextTable table{{{"engine"},
                   {"profile"},
                   {"within", true},
                   {"of runs", true},
                   {"deviate", true},
                   {"undecided", true},
                   {"failed", true},
                   {"cannot run", true},
                   {"median error", true}},
                  {},
                  "Runs within all tolerances, by engine and profile"};
  for (const ProfileScore& score : summary.scores) {
    const std::string engine =
        score.version.empty() ? score.engine : score.engine + " " + score.version;
    table.rows.push_back(
        {{engine},
         {score.profile},
         count_cell(score.runs.of(Verdict::within), Tone::good),
         {std::to_string(score.judged()), Tone::plain, static_cast<double>(score.judged())},
         count_cell(score.runs.of(Verdict::deviates), Tone::bad),
         count_cell(score.runs.of(Verdict::undecided) - score.skipped, Tone::doubtful),
         count_cell(score.runs.of(Verdict::failed), Tone::bad),
         count_cell(score.skipped, Tone::faint),
         {plain_number(score.median_error), Tone::plain, score.median_error}});
  }
  return table;
}

}  // namespace slipcheck
