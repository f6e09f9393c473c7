#include "studies/baseline/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/by_name.h"
#include "scenario/observable_key.h"
#include "scenario/tolerances.h"

namespace slipcheck {
namespace {

using Statistic = Change::Statistic;

constexpr double kReferenceLimit = 1e-9;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double finite_or_zero(double value) { return std::isfinite(value) ? value : 0; }

template <class Map>
std::set<std::string> names_of(const Map& one, const Map& other) {
  std::set<std::string> names;
  for (const auto& [name, value] : one) names.emplace(name);
  for (const auto& [name, value] : other) names.emplace(name);
  return names;
}

bool is_failure(RunStatus status) {
  return status != RunStatus::ok && status != RunStatus::skipped;
}

Direction direction_of(double before, double after, double reference) {
  const double error_before = std::abs(before - reference);
  const double error_after = std::abs(after - reference);
  if (std::isnan(error_before) || std::isnan(error_after) || error_before == error_after)
    return Direction::moved;
  return error_after < error_before ? Direction::better : Direction::worse;
}

Direction direction_of(bool was_good, bool is_good) {
  return was_good == is_good ? Direction::moved : is_good ? Direction::better : Direction::worse;
}

/// now/before, NaN where there is no such ratio.
double time_ratio(double before, double now) { return before > 0 && now > 0 ? now / before : kNaN; }

/// Holds one scene against its baseline, part by part.
class Checker {
 public:
  Checker(const SceneBaseline& old, const SceneRecord& scene)
      : old_(old), scene_(scene), now_(baseline_of(scene, old.phases, "")) {
    check_.scene = now_.scene;
  }

  SceneCheck check() {
    check_.parts.push_back({"reference", scene_.reference.cpu_seconds, ""});
    if (old_.sha256 != now_.sha256 && old_.sha256 != scene_.scenario.sha256)
      words("scene", Statistic::file, old_.sha256.substr(0, 12), now_.sha256.substr(0, 12)).note =
          "the scene is not that of the baseline";
    check_reference();
    check_runs();
    check_times();
    return std::move(check_);
  }

 private:
  Change& change(const std::string& part, const std::string& observable, Statistic statistic) {
    Change& added = check_.changes.emplace_back();
    added.scene = check_.scene;
    added.part = part;
    added.observable = observable;
    added.statistic = statistic;
    return added;
  }
  Change& words(const std::string& part, Statistic statistic, std::string was, std::string is) {
    Change& added = change(part, "", statistic);
    added.was = std::move(was);
    added.is = std::move(is);
    return added;
  }

  void check_reference() {
    if (old_.solver != now_.solver) words("reference", Statistic::solver, old_.solver, now_.solver);
    for (const std::string& name : names_of(old_.reference, now_.reference)) {
      const UncertainValue* before = find_in(old_.reference, name);
      const UncertainValue* after = find_in(now_.reference, name);
      ++check_.compared;
      if (before && after) {
        check_reference_value(name, *before, *after);
        continue;
      }
      Change& added = change("reference", name, Statistic::value);
      added.before = before ? before->value : kNaN;
      added.after = after ? after->value : kNaN;
      added.note = before ? "it no longer shows" : "the baseline does not have it";
      if (is_decided(before ? *before : *after)) continue;
      ++check_.uncertain;
      added.gates = false;
      added.note += ", but rounding decides whether it shows";
    }
  }

  /// The uncertainty is infinite where a run under another rounding does not show the value.
  static bool is_decided(const UncertainValue& value) { return std::isfinite(value.uncertainty); }

  void check_reference_value(const std::string& name, const UncertainValue& before,
                             const UncertainValue& after) {
    const ObservableName* observable = observable_key(name).known();
    const bool is_pure_number = observable != nullptr && observable->dimension.si[0] == '\0';
    const double scale =
        is_pure_number ? 1 : observable_scale(scene_.scenario, old_.reference, name);
    const double strict = kReferenceLimit * scale;
    const double uncertainty = is_decided(before) && is_decided(after)
                                   ? before.uncertainty + after.uncertainty
                                   : std::numeric_limits<double>::infinity();
    if (uncertainty > strict) ++check_.uncertain;
    if (before.value == after.value) return;
    const double move = std::abs(after.value - before.value);
    const bool gates = !(move <= std::max(strict, uncertainty));
    if (!gates) ++check_.drifted;
    if (move <= strict) return;
    Change& added = change("reference", name, Statistic::value);
    added.before = before.value;
    added.after = after.value;
    added.allowed = std::max(strict, uncertainty);
    added.gates = gates;
    if (!gates) added.note = "within the uncertainties";
  }

  void check_runs() {
    std::vector<const BaselineRun*> left;
    for (const BaselineRun& run : old_.runs) left.push_back(&run);
    for (std::size_t k = 0; k < now_.runs.size(); ++k) {
      const BaselineRun& run = now_.runs[k];
      const EngineRecord& record = scene_.runs[k];
      const std::string label = run_label(run);
      const auto before = std::ranges::find_if(
          left, [&](const BaselineRun* each) { return run_label(*each) == label; });
      const bool was_skipped = before != left.end() && (*before)->status == RunStatus::skipped;
      const bool stays_skipped = run.status == RunStatus::skipped && was_skipped;
      check_.parts.push_back({label, run.cpu_seconds, stays_skipped ? record.reason : ""});
      if (before == left.end()) {
        words(label, Statistic::presence, "", name_of(run.status)).note =
            "the baseline does not have this run";
        check_.failed |= is_failure(run.status) && run.verdict == Verdict::failed;
        continue;
      }
      check_run(label, **before, run, record);
      left.erase(before);
    }
    for (const BaselineRun* run : left) {
      check_.parts.push_back({run_label(*run), 0, ""});
      words(run_label(*run), Statistic::presence, name_of(run->status), "").note =
          "the scene no longer asks for this run";
    }
  }

  void check_run(const std::string& label, const BaselineRun& before, const BaselineRun& after,
                 const EngineRecord& record) {
    if (before.version != after.version && !before.version.empty() && !after.version.empty())
      note_version(fmt::format("{} {}, now {}", after.engine, before.version, after.version));
    if (before.status != after.status) {
      Change& added =
          words(label, Statistic::status, name_of(before.status), name_of(after.status));
      added.direction = direction_of(before.status == RunStatus::ok, after.status == RunStatus::ok);
      added.note = record.reason;
      check_.failed |= is_failure(after.status) && !is_failure(before.status);
      return;
    }
    if (before.verdict && after.verdict && before.verdict != after.verdict) {
      Change& added =
          words(label, Statistic::verdict, name_of(*before.verdict), name_of(*after.verdict));
      added.direction =
          direction_of(before.verdict == Verdict::within, after.verdict == Verdict::within);
      added.gates = record.expect.has_value();
    }
    for (const std::string& name : names_of(before.observables, after.observables)) {
      const BaselineSpread* was = find_in(before.observables, name);
      const BaselineSpread* is = find_in(after.observables, name);
      check_missing(label, name, was ? was->missing : before.phases,
                    is ? is->missing : after.phases);
      if (!was || !is) continue;
      check_statistic(label, name, Statistic::median, was->median, is->median, record);
      check_statistic(label, name, Statistic::min, was->min, is->min, record);
      check_statistic(label, name, Statistic::max, was->max, is->max, record);
    }
  }

  void check_missing(const std::string& label, const std::string& name, std::size_t before,
                     std::size_t after) {
    ++check_.compared;
    if (before == after) return;
    Change& added = change(label, name, Statistic::missing);
    added.before = static_cast<double>(before);
    added.after = static_cast<double>(after);
    const bool is_right = (find_in(now_.reference, name) != nullptr) == (after < before);
    added.direction = is_right ? Direction::better : Direction::worse;
  }

  void check_statistic(const std::string& label, const std::string& name, Statistic statistic,
                       double before, double after, const EngineRecord& record) {
    const double allowed = allowed_move(name, statistic, before, record);
    if (std::isnan(allowed)) return;
    ++check_.compared;
    if (before == after || (std::isnan(before) && std::isnan(after))) return;
    if (std::abs(after - before) <= allowed) {
      ++check_.drifted;
      return;
    }
    const UncertainValue* reference = find_in(now_.reference, name);
    Change& added = change(label, name, statistic);
    added.before = before;
    added.after = after;
    added.allowed = allowed;
    added.direction = direction_of(before, after, reference ? reference->value : kNaN);
  }

  /// NaN where nothing says how far a statistic may move.
  double allowed_move(const std::string& name, Statistic statistic, double before,
                      const EngineRecord& record) const {
    const UncertainValue* was = find_in(old_.reference, name);
    const UncertainValue* is = find_in(now_.reference, name);
    const double uncertainty =
        (was ? finite_or_zero(was->uncertainty) : 0) + (is ? finite_or_zero(is->uncertainty) : 0);
    if (const auto tolerance = tolerance_of_part(scene_.scenario, name)) {
      double scale =
          tolerance->absolute ? 1 : observable_scale(scene_.scenario, now_.reference, name);
      // Of a reference of zero nothing is a share; then the baseline's own value is the measure.
      if (!tolerance->absolute && scale <= uncertainty) scale = std::abs(before);
      return tolerance->value * scale + (scene_.reference.box ? uncertainty : 0);
    }
    const ExpectedObservable* expected =
        record.expect ? find_in(record.expect->observables, name) : nullptr;
    if (expected == nullptr) return kNaN;
    const auto& range = statistic == Statistic::min   ? expected->min
                        : statistic == Statistic::max ? expected->max
                                                      : expected->median;
    return range ? 0.5 * (range->high - range->low) : kNaN;
  }

  void note_version(std::string text) {
    if (std::ranges::find(check_.versions, text) == check_.versions.end())
      check_.versions.push_back(std::move(text));
  }

  void check_times() {
    check_.reference_time_ratio = time_ratio(old_.cpu_seconds, now_.cpu_seconds);
    double before = 0, now = 0;
    for (const BaselineRun& run : old_.runs) before += finite_or_zero(run.cpu_seconds);
    for (const BaselineRun& run : now_.runs) now += finite_or_zero(run.cpu_seconds);
    check_.engine_time_ratio = time_ratio(before, now);
  }

  const SceneBaseline& old_;
  const SceneRecord& scene_;
  SceneBaseline now_;
  SceneCheck check_;
};

SceneCheck lone(const std::string& scene, const char* was, const char* is, std::string note) {
  SceneCheck check;
  check.scene = scene;
  check.parts.push_back({"scene", 0, ""});
  Change& change = check.changes.emplace_back();
  change.scene = scene;
  change.part = "scene";
  change.statistic = Statistic::presence;
  change.was = was;
  change.is = is;
  change.note = std::move(note);
  return check;
}

}  // namespace

bool SceneCheck::is_green() const { return std::ranges::none_of(changes, &Change::gates); }

SceneCheck check_scene(const SceneBaseline& baseline, const SceneRecord& scene) {
  return Checker(baseline, scene).check();
}

SceneCheck scene_without_baseline(const std::string& scene) {
  return lone(scene, "no baseline", "scene",
              "it has no baseline; slipcheck check --update makes one");
}

SceneCheck baseline_without_scene(const std::string& scene, const std::string& file) {
  return lone(scene, "baseline", "no scene",
              fmt::format("no scene has this name; {} is left over", file));
}

CheckReport check_scenes(const std::string& folder, std::size_t phases,
                         const std::map<std::string, SceneBaseline>& baselines,
                         const std::vector<SceneRecord>& scenes) {
  CheckReport report{folder, phases, {}, {}};
  for (const SceneRecord& scene : scenes) {
    const auto baseline = baselines.find(scene.scenario.name);
    const bool compares = baseline != baselines.end() && baseline->second.phases == phases;
    report.scenes.push_back(compares ? check_scene(baseline->second, scene)
                                     : scene_without_baseline(scene.scenario.name));
  }
  return report;
}

}  // namespace slipcheck
