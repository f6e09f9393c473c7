#include "report/rows/engine_matrix.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "engine/engine_registry.h"
#include "harness/compare/comparison.h"
#include "report/rows/quantity.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {
namespace {

EngineMethod method_of(const EngineRecord& run) {
  return {engine_family(run.engine), run.version.empty() ? engine_version(run.engine) : run.version,
          run.precision, run.profile, run.rate};
}

bool counts(const EngineRecord& run) { return !run.expect; }

bool has_failed(const EngineRecord& run) {
  return run.status != RunStatus::ok && run.status != RunStatus::skipped;
}

/// In the order of names, versions, profiles and rates; those that are common enough, or all with
/// naive ones last.
std::vector<EngineMethod> methods_of(const std::vector<SceneRecord>& scenes, MatrixExtent extent) {
  std::map<EngineMethod, std::size_t> scenes_of;
  for (const SceneRecord& scene : scenes) {
    std::set<EngineMethod> here;
    for (const EngineRecord& run : scene.runs)
      if (counts(run)) here.insert(method_of(run));
    for (const EngineMethod& method : here) ++scenes_of[method];
  }
  std::size_t most = 0;
  for (const auto& [method, count] : scenes_of) most = std::max(most, count);
  std::vector<EngineMethod> methods;
  for (const auto& [method, count] : scenes_of)
    if (extent == MatrixExtent::all || 2 * count >= most) methods.push_back(method);
  if (extent == MatrixExtent::all)
    std::ranges::stable_partition(
        methods, [](const EngineMethod& method) { return method.profile != "naive"; });
  return methods;
}

double simulated_seconds(const EngineRecord& run) {
  return static_cast<double>(run.steps) / run.rate;
}

MethodScore score_of(const EngineMatrix& matrix, std::size_t column) {
  MethodScore score;
  std::vector<double> errors;
  double log_cost = 0;
  std::size_t costs = 0;
  for (const EngineMatrix::Row& row : matrix.rows) {
    const auto& [run, error] = row.cells[column];
    if (run == nullptr) continue;
    const Verdict verdict = run->verdict();
    if (run->status == RunStatus::skipped)
      ++score.skipped;
    else if (has_failed(*run))
      ++score.failed;
    else if (verdict == Verdict::within)
      ++score.within;
    else if (verdict == Verdict::deviates)
      ++score.deviates;
    else
      ++score.undecided;
    if (!std::isnan(error)) errors.push_back(error);
    if (run->status == RunStatus::ok && run->steps > 0 && run->cpu_seconds > 0) {
      log_cost += std::log(run->cpu_seconds / simulated_seconds(*run));
      ++costs;
    }
  }
  if (!errors.empty()) score.median_error = median(errors);
  if (costs > 0) score.cost = std::exp(log_cost / static_cast<double>(costs));
  return score;
}

/// The best first.
std::vector<std::size_t> ranked(const std::vector<MethodScore>& scores) {
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    if (scores[a].within != scores[b].within) return scores[a].within > scores[b].within;
    return scores[a].median_error < scores[b].median_error;
  });
  return order;
}

std::size_t judged(const MethodScore& score) {
  return score.within + score.deviates + score.undecided + score.failed;
}

std::string standing_of(const EngineMatrix& matrix, std::size_t column, const MethodScore& score) {
  return fmt::format("{} is within all tolerances in {} of the {} that it runs",
                     matrix.methods[column].label(matrix.has_both_precisions()), score.within,
                     counted(judged(score), "scene"));
}

/// How the two profiles of an engine that both run compare, where there are such.
std::vector<std::string> cures(const EngineMatrix& matrix) {
  std::vector<std::string> sentences;
  for (std::size_t a = 0; a < matrix.methods.size(); ++a)
    for (std::size_t b = 0; b < matrix.methods.size(); ++b) {
      EngineMethod other = matrix.methods[b];
      if (matrix.methods[a].profile != "default" || other.profile != "physical") continue;
      other.profile = "default";
      if (other != matrix.methods[a]) continue;
      std::size_t cured = 0, spoilt = 0;
      for (const EngineMatrix::Row& row : matrix.rows) {
        const EngineRecord* before = row.cells[a].run;
        const EngineRecord* after = row.cells[b].run;
        if (before == nullptr || after == nullptr) continue;
        const bool was = before->verdict() == Verdict::within;
        const bool is = after->verdict() == Verdict::within;
        cured += !was && is ? 1 : 0;
        spoilt += was && !is ? 1 : 0;
      }
      if (cured + spoilt > 0)
        sentences.push_back(
            fmt::format("{} {}{}{} at {:g} Hz: physical brings {} within tolerances that default "
                        "is not within, "
                        "and loses {}",
                        other.engine, other.version, matrix.has_both_precisions() ? " " : "",
                        matrix.has_both_precisions() ? other.precision : "", other.rate,
                        counted(cured, "scene"), spoilt));
    }
  return sentences;
}

bool any_is(const EngineMatrix::Row& row, Verdict verdict) {
  return std::ranges::any_of(row.cells, [&](const MatrixCell& cell) {
    return cell.run != nullptr && cell.run->verdict() == verdict;
  });
}

/// "" where all ensembles of more than one phase have equally many.
std::string small_ensembles(const EngineMatrix& matrix) {
  std::size_t several = 0, small = 0, most = 0;
  const auto each = [&](const auto& take) {
    for (const EngineMatrix::Row& row : matrix.rows)
      for (const MatrixCell& cell : row.cells)
        if (cell.run != nullptr && cell.run->status == RunStatus::ok && cell.run->phases > 1)
          take(cell.run->phases);
  };
  each([&](std::size_t phases) { most = std::max(most, phases); });
  each([&](std::size_t phases) {
    ++several;
    small += phases < most ? 1 : 0;
  });
  if (small == 0) return {};
  return fmt::format("Of {} of more than one phase {} {} fewer than {}",
                     counted(several, "ensemble"), small, small == 1 ? "has" : "have", most);
}

}  // namespace

std::string EngineMethod::label(bool with_precision) const {
  return fmt::format("{} {}{}{} {} {:g} Hz", engine, version, with_precision ? " " : "",
                     with_precision ? precision : "", profile, rate);
}

bool EngineMatrix::has_both_precisions() const {
  std::map<std::string, std::string> precision_of;
  return std::ranges::any_of(methods, [&](const EngineMethod& method) {
    const auto [known, is_new] =
        precision_of.emplace(method.engine + ' ' + method.version, method.precision);
    return !is_new && known->second != method.precision;
  });
}

double worst_phase(const EngineRecord& run) {
  if (has_failed(run)) return INFINITY;
  double worst = NAN;
  for (const auto& [name, error] : run.errors) {
    if (!error.tolerance || error.verdict == Verdict::undecided) continue;
    const bool is_absent = error.verdict == Verdict::deviates && !std::isfinite(error.max);
    worst = std::fmax(worst, is_absent ? INFINITY : error.max / *error.tolerance);
  }
  return worst;
}

Cell matrix_cell(const MatrixCell& cell) {
  if (cell.run == nullptr) return {""};
  const Verdict verdict = cell.run->verdict();
  if (has_failed(*cell.run)) return {"✗", Tone::bad, INFINITY};
  if (cell.run->status == RunStatus::skipped) return {"–", Tone::faint};
  if (std::isnan(cell.error))
    return {verdict == Verdict::unjudged ? "·" : symbol_of(verdict), Tone::doubtful};
  const std::string text = !std::isfinite(cell.error) ? "∞"
                           : cell.error < 0.005       ? "0"
                           : cell.error > 99 && cell.error < 99999.5
                               ? fmt::format("{:.0f}", cell.error)
                               : fmt::format("{:.2g}", cell.error);
  return {text, cell.error > 1 ? Tone::bad : Tone::good, cell.error};
}

EngineMatrix engine_matrix(const std::vector<SceneRecord>& scenes, MatrixExtent extent) {
  EngineMatrix matrix;
  matrix.methods = methods_of(scenes, extent);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    EngineMatrix::Row row{&scenes[k], k, std::vector<MatrixCell>(matrix.methods.size())};
    bool any = false;
    for (const EngineRecord& run : scenes[k].runs) {
      const auto method = std::ranges::find(matrix.methods, method_of(run));
      if (!counts(run) || method == matrix.methods.end()) continue;
      // Of several scales the worst.
      MatrixCell& cell = row.cells[static_cast<std::size_t>(method - matrix.methods.begin())];
      const double error = worst_phase(run);
      if (cell.run == nullptr || error > cell.error) cell = {&run, error};
      any = true;
    }
    if (any || extent == MatrixExtent::all) matrix.rows.push_back(std::move(row));
  }
  if (extent == MatrixExtent::common && (matrix.methods.size() < 2 || matrix.rows.size() < 2))
    return {};
  return matrix;
}

std::vector<MethodScore> scores_of(const EngineMatrix& matrix) {
  std::vector<MethodScore> scores;
  for (std::size_t c = 0; c < matrix.methods.size(); ++c) scores.push_back(score_of(matrix, c));
  return scores;
}

TextTable matrix_table(const EngineMatrix& matrix, const std::string& anchor) {
  TextTable table{{{"scene"}}, {}, "The worst phase's error in tolerances, scene by engine"};
  for (const EngineMethod& method : matrix.methods)
    table.columns.push_back({method.label(matrix.has_both_precisions()), true});
  for (const EngineMatrix::Row& row : matrix.rows) {
    Cell scene{row.scene->scenario.name};
    if (!anchor.empty()) scene.link = anchor + std::to_string(row.place + 1);
    std::vector<Cell>& cells = table.rows.emplace_back();
    cells.push_back(std::move(scene));
    for (const MatrixCell& cell : row.cells) cells.push_back(matrix_cell(cell));
  }
  return table;
}

TextTable score_table(const EngineMatrix& matrix) {
  TextTable table{{{"engine"},
                   {"within", true},
                   {"deviates", true},
                   {"undecided", true},
                   {"failed", true},
                   {"cannot", true},
                   {"median error", true},
                   {"CPU/simulated", true}},
                  {},
                  "Engines over all scenes"};
  const std::vector<MethodScore> scores = scores_of(matrix);
  for (const std::size_t c : ranked(scores)) {
    const MethodScore& score = scores[c];
    table.rows.push_back({{matrix.methods[c].label(matrix.has_both_precisions())},
                          count_cell(score.within, Tone::good),
                          count_cell(score.deviates, Tone::bad),
                          count_cell(score.undecided, Tone::doubtful),
                          count_cell(score.failed, Tone::bad),
                          count_cell(score.skipped, Tone::faint),
                          {plain_number(score.median_error), Tone::plain, score.median_error},
                          {percent(score.cost), Tone::plain, score.cost}});
  }
  return table;
}

std::vector<std::string> matrix_findings(const EngineMatrix& matrix) {
  std::vector<std::string> sentences;
  const std::vector<MethodScore> scores = scores_of(matrix);
  const std::vector<std::size_t> order = ranked(scores);
  if (order.empty()) return sentences;
  sentences.push_back("Best: " + standing_of(matrix, order.front(), scores[order.front()]));
  sentences.push_back("Worst: " + standing_of(matrix, order.back(), scores[order.back()]));
  std::vector<std::string> nowhere;
  for (const EngineMatrix::Row& row : matrix.rows)
    if (any_is(row, Verdict::deviates) && !any_is(row, Verdict::within))
      nowhere.push_back(row.scene->scenario.name);
  if (!nowhere.empty())
    sentences.push_back(fmt::format("In {} no engine is within all tolerances: {}",
                                    counted(nowhere.size(), "scene"), fmt::join(nowhere, ", ")));
  for (std::string& sentence : cures(matrix)) sentences.push_back(std::move(sentence));
  if (std::string small = small_ensembles(matrix); !small.empty())
    sentences.push_back(std::move(small));
  return sentences;
}

}  // namespace slipcheck
