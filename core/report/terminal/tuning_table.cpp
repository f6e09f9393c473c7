#include "report/terminal/tuning_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "engine/settings.h"
#include "report/rows/quantity.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

/// CPU time for a second of simulated time.
std::string cost_text(double cost) { return fmt::format("{:.3g} ms/s", 1e3 * cost); }

std::string error_text(const Score& score) {
  return score.failed > 0 ? "✗ fails" : plain_number(score.worst);
}

/// What fails in the runs of `settings`, line by line.
std::string failures(const TuningRecord& tuning, const std::string& settings,
                     const TuningFinalist& finalist, const TableStyle& style) {
  std::string text;
  for (std::size_t k = 0; k < tuning.tasks.size(); ++k)
    if (finalist.runs[k].failed > 0)
      text += fmt::format("  {} {}, {} at {:g} Hz: {}\n", inked("✗", Tone::bad, style), settings,
                          tuning.tasks[k].scene, tuning.tasks[k].rate,
                          printable(finalist.runs[k].reason));
  return text;
}

/// What an error of one means.
std::string error_unit(const TuningGoal& goal) {
  return goal.within ? fmt::format("of {}", percent(*goal.within)) : "of the tolerance";
}

std::size_t count_scenes(const TuningRecord& tuning, bool held_out) {
  std::set<std::string> names;
  for (const TuningTask& task : tuning.tasks)
    if (task.held_out == held_out) names.insert(task.scene);
  return names.size();
}

std::string heading(const TuningRecord& tuning, const TableStyle& style) {
  const std::size_t training = count_scenes(tuning, false);
  std::string text = fmt::format("{} {} {}", tuning.engine, tuning.version, tuning.precision);
  return inked(text, Tone::strong, style) +
         fmt::format(", fitted to {} at {:g} Hz, {} phases\n", counted(training, "scene"),
                     fmt::join(tuning.rates, ", "), tuning.final_phases);
}

std::string runs_table(const TuningRecord& tuning, const TableStyle& style) {
  const TuningFinalist &start = tuning.result.start(), &best = tuning.result.best();
  TextTable table{{{"scene"},
                   {"rate", true},
                   {tuning.start, true},
                   {tuning.profile, true},
                   {""},
                   {"worst in", false, 1},
                   {""}}};
  for (std::size_t k = 0; k < tuning.tasks.size(); ++k) {
    const TuningTask& task = tuning.tasks[k];
    const RunScore &before = start.runs[k], &after = best.runs[k];
    const bool good = after.failed == 0 && after.worst <= 1;
    const auto error = [](const RunScore& run) {
      return run.failed > 0 ? "fails" : tuning_error_text(run);
    };
    table.rows.push_back({{task.scene},
                          {fmt::format("{:g} Hz", task.rate)},
                          {error(before)},
                          {error(after), good ? Tone::good : Tone::bad},
                          {good ? "✓" : "✗", good ? Tone::good : Tone::bad},
                          {after.failed > 0 ? "" : after.observable, Tone::faint},
                          {task.held_out ? "held out" : "", Tone::faint}});
  }
  return terminal_table(std::move(table), style, 2) + failures(tuning, tuning.start, start, style) +
         failures(tuning, tuning.profile, best, style);
}

std::string summary(const TuningRecord& tuning, const TableStyle& style) {
  const TuningFinalist &start = tuning.result.start(), &best = tuning.result.best();
  const auto row = [&](const std::string& name, const Score& before, const Score& after) {
    return std::vector<Cell>{{name},
                             {error_text(before)},
                             {error_text(after)},
                             {cost_text(before.cost)},
                             {cost_text(after.cost)}};
  };
  TextTable table{{{"worst error " + error_unit(tuning.goal)},
                   {tuning.start, true},
                   {tuning.profile, true},
                   {"CPU before", true},
                   {"CPU after", true}},
                  {row("fitted to", start.training, best.training)}};
  if (best.held_out) table.rows.push_back(row("held out", *start.held_out, *best.held_out));
  std::string text = terminal_table(std::move(table), style, 2);
  if (!best.held_out) return text;
  const double ratio = best.held_out->worst / best.training.worst;
  text += fmt::format("  held out: {} times the error of the scenes it was fitted to\n",
                      plain_number(ratio));
  if (tuning.result.overfitted())
    text += fmt::format("  {}\n", inked("! overfitted: more than twice", Tone::bad, style));
  return text;
}

std::string trade_off(const TuningRecord& tuning, const TableStyle& style) {
  TextTable table{{{"CPU", true}, {"worst error", true}, {"changed from " + tuning.start}}};
  for (const TuningCandidate& candidate : tuning.result.front)
    table.rows.push_back(
        {{cost_text(candidate.score.cost)},
         {error_text(candidate.score)},
         {changes_text(tuning.space, tuning.space.start, candidate.settings), Tone::faint}});
  return terminal_table(std::move(table), style, 2);
}

std::string settings_table(const TuningRecord& tuning, const TableStyle& style) {
  TextTable table{{{"setting"}, {"chosen", true}, {"engine's own", true}, {"", false, 1}}};
  for (const SettingInfo& info : tuning.space.known) {
    const auto chosen = tuning.result.best().settings.find(info.name);
    if (chosen == tuning.result.best().settings.end()) continue;
    const std::string unit = info.unit.empty() ? "" : " " + info.unit;
    table.rows.push_back({{info.name},
                          {exact_text(chosen->second) + unit},
                          {exact_text(info.shipped) + unit, Tone::faint},
                          {printable(info.about), Tone::faint}});
  }
  if (table.rows.empty()) return "  every setting has the engine's own value\n";
  return terminal_table(std::move(table), style, 2);
}

}  // namespace

std::string tuning_error_text(const RunScore& run) {
  if (run.failed > 0) return run.reason;
  return run.worst >= kLargestError ? fmt::format("> {:g}", kLargestError)
                                    : fmt::format("{:.3g}", run.worst);
}

std::string tuning_table(const TuningRecord& tuning, const TableStyle& style) {
  const TuningResult& result = tuning.result;
  std::string text = heading(tuning, style);
  text += fmt::format("\n{}\n", inked("Worst phase's error, in tolerances", Tone::strong, style));
  text += runs_table(tuning, style);
  text += '\n';
  text += summary(tuning, style);
  if (!result.improved())
    text += fmt::format("  {} nothing that was tried is better than {}: {} has its settings\n",
                        inked("!", Tone::bad, style), result.best().profile, tuning.profile);
  text += fmt::format("\n{}, {} phases, {} settings seen by all, {:.0f} evaluations{}\n",
                      inked("Accuracy against time", Tone::strong, style), tuning.phases,
                      result.candidates, result.evaluations,
                      result.converged ? "" : " (the budget was spent)");
  text += trade_off(tuning, style);
  text += fmt::format("\n{}\n", inked(tuning.profile, Tone::strong, style));
  text += settings_table(tuning, style);
  return text;
}

}  // namespace slipcheck
