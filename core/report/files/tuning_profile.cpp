#include "report/files/tuning_profile.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/engine_registry.h"
#include "report/rows/context.h"
#include "report/rows/quantity.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

/// A text as JSON writes it, which YAML reads.
std::string quoted(const std::string& text) { return nlohmann::json(valid_utf8(text)).dump(); }

void add_scenes(std::vector<std::string>& lines, const std::string& key, const TuningRecord& tuning,
                bool held_out) {
  std::vector<std::string> scenes;
  for (const TuningTask& task : tuning.tasks) {
    if (task.held_out != held_out) continue;
    std::string scene = fmt::format("  - {{name: {}, sha256: {}}}", task.scene, task.sha256);
    if (scenes.empty() || scenes.back() != scene) scenes.push_back(std::move(scene));
  }
  if (scenes.empty()) return;
  lines.push_back(key + ":");
  lines.insert(lines.end(), scenes.begin(), scenes.end());
}

/// Of the runs that are held out or not: their worst error, or what fails in them.
std::string score_text(const TuningRecord& tuning, const TuningFinalist& finalist, bool held_out) {
  const Score& score = held_out ? *finalist.held_out : finalist.training;
  if (score.failed == 0) return fmt::format("{:.4g}", score.worst);
  std::size_t worst = 0;
  for (std::size_t k = 0, run = 0; k < tuning.tasks.size(); ++k)
    if (tuning.tasks[k].held_out == held_out && run++ == score.worst_run) worst = k;
  return quoted(fmt::format("{}: {}", tuning.tasks[worst].scene, finalist.runs[worst].reason));
}

std::string goal_text(const TuningRecord& tuning) {
  if (!tuning.goal.within) return "least worst error";
  return fmt::format("least CPU time within {}", percent(*tuning.goal.within));
}

std::vector<std::string> provenance(const TuningRecord& tuning) {
  const TuningResult& result = tuning.result;
  const auto named = [](const std::string& profile) {
    // A path would tell of the machine.
    return quoted(std::filesystem::path(profile).filename().string());
  };
  std::vector<std::string> lines = {
      fmt::format("slipcheck: {{version: {}, commit: {}}}", quoted(context().version),
                  quoted(context().commit)),
      fmt::format("engine: {{name: {}, version: {}, precision: {}}}", quoted(tuning.engine),
                  quoted(tuning.version), tuning.precision),
      fmt::format("start: {}", named(tuning.start)),
      fmt::format("goal: {}", quoted(goal_text(tuning)))};
  add_scenes(lines, "scenes", tuning, false);
  add_scenes(lines, "held_out", tuning, true);
  if (!tuning.observables.named.empty())
    lines.push_back(fmt::format("observables: [{}]", fmt::join(tuning.observables.named, ", ")));
  lines.push_back(fmt::format("rates: [{:g}]  # Hz", fmt::join(tuning.rates, ", ")));
  lines.push_back(
      fmt::format("phases: {{search: {}, final: {}}}", tuning.phases, tuning.final_phases));
  lines.push_back(fmt::format("seed: {}", tuning.seed));
  lines.push_back(fmt::format("evaluations: {:.0f}", result.evaluations));
  lines.push_back(fmt::format("converged: {}", result.converged));
  for (const TuningFinalist& each : result.finalists)
    if (!each.profile.empty() && each.settings != result.start().settings)
      lines.push_back("begun_from: " + named(each.profile));
  if (!result.improved())
    lines.push_back("no_better_than: " + named(result.best().profile) + "  # its settings");
  lines.push_back("worst_error:  # in tolerances, or of what it must be within");
  lines.push_back(fmt::format("  start: {}", score_text(tuning, result.start(), false)));
  lines.push_back(fmt::format("  profile: {}", score_text(tuning, result.best(), false)));
  if (result.best().held_out)
    lines.push_back(fmt::format("  held_out: {}", score_text(tuning, result.best(), true)));
  return lines;
}

}  // namespace

Profile tuned_profile(const TuningRecord& tuning) {
  Profile profile;
  profile.engine = engine_family(tuning.engine);
  profile.name = tuning.profile;
  profile.about = fmt::format("Fitted by slipcheck tune: {}", goal_text(tuning));
  profile.settings = tuning.result.best().settings;
  return profile;
}

std::string tuned_profile_yaml(const TuningRecord& tuning) {
  return profile_yaml(tuned_profile(tuning), provenance(tuning));
}

}  // namespace slipcheck
