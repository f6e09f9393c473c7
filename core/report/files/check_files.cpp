#include "report/files/check_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/files/markdown.h"
#include "report/json/common_fields.h"
#include "report/rows/quantity.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

Json change_json(const Change& change) {
  Json json = {{"part", change.part}};
  if (!change.observable.empty()) json["observable"] = change.observable;
  json["statistic"] = name_of(change.statistic);
  if (!change.was.empty() || !change.is.empty()) {
    json["before"] = change.was.empty() ? Json(nullptr) : Json(change.was);
    json["now"] = change.is.empty() ? Json(nullptr) : Json(change.is);
  } else {
    json["before"] = std::isfinite(change.before) ? Json(change.before) : Json(nullptr);
    json["now"] = std::isfinite(change.after) ? Json(change.after) : Json(nullptr);
    if (std::isfinite(change.allowed)) json["allowed"] = change.allowed;
  }
  json["direction"] = name_of(change.direction);
  json["gates"] = change.gates;
  add_reason(json, change.note);
  return json;
}

void put_ratio(Json& json, const char* key, double ratio) {
  if (std::isfinite(ratio)) json[key] = ratio;
}

Json scene_json(const SceneCheck& scene) {
  Json json = {{"name", scene.scene},
               {"verdict", scene.is_green() ? "unchanged" : "moved"},
               {"compared", scene.compared},
               {"drifted", scene.drifted},
               {"uncertain", scene.uncertain}};
  if (!scene.versions.empty()) json["versions"] = scene.versions;
  put_ratio(json, "reference_time_ratio", scene.reference_time_ratio);
  put_ratio(json, "engine_time_ratio", scene.engine_time_ratio);
  Json& changes = json["changes"] = Json::array();
  for (const Change& change : scene.changes) changes.push_back(change_json(change));
  return json;
}

TestOutcome outcome_of(const SceneCheck& scene, const std::string& label, const CheckedPart* part) {
  TestOutcome outcome;
  outcome.suite = scene.scene;
  outcome.name = label;
  if (part) outcome.seconds = part->cpu_seconds;
  const Change* worst = nullptr;
  std::size_t gating = 0;
  for (const Change& change : scene.changes) {
    if (change.part != label) continue;
    outcome.text += change_message(change) + '\n';
    gating += change.gates;
    if (change.gates && (!worst || is_more_severe(change, *worst))) worst = &change;
  }
  if (worst) outcome.message = change_message(*worst);
  if (gating > 0) outcome.kind = TestOutcome::Kind::failed;
  if (gating > 1) outcome.message += fmt::format("; and {} more", gating - 1);
  if (gating == 0 && part && !part->skipped.empty()) {
    outcome.kind = TestOutcome::Kind::skipped;
    outcome.message = part->skipped;
  }
  if (!scene.versions.empty() && label != "reference" && label != "scene") {
    const std::string versions = fmt::format("baseline: {}", fmt::join(scene.versions, ", "));
    outcome.text += versions + '\n';
    if (gating > 0) outcome.message += fmt::format(" [{}]", versions);
  }
  return outcome;
}

}  // namespace

Json json_of(const CheckReport& report) {
  Json json = {{"schema", "slipcheck-check/1"}};
  put_context(json);
  const CheckTotals totals = totals_of(report);
  json["baselines"] = report.baselines;
  json["phases"] = report.phases;
  json["verdict"] = totals.moved_scenes == 0 ? "unchanged" : "moved";
  json["better"] = totals.better;
  json["worse"] = totals.worse;
  json["neither"] = totals.neither;
  Json& scenes = json["scenes"] = Json::array();
  for (const SceneCheck& scene : report.scenes) scenes.push_back(scene_json(scene));
  return json;
}

std::vector<TestOutcome> test_outcomes(const CheckReport& report) {
  std::vector<TestOutcome> outcomes;
  for (const SceneCheck& scene : report.scenes) {
    const bool has_scene_change =
        std::ranges::any_of(scene.changes, [](const Change& c) { return c.part == "scene"; });
    const bool has_scene_part =
        std::ranges::any_of(scene.parts, [](const CheckedPart& p) { return p.label == "scene"; });
    if (has_scene_change && !has_scene_part)
      outcomes.push_back(outcome_of(scene, "scene", nullptr));
    for (const CheckedPart& part : scene.parts)
      outcomes.push_back(outcome_of(scene, part.label, &part));
  }
  return outcomes;
}

std::string markdown_of(const CheckReport& report, std::size_t most) {
  constexpr std::size_t kRoom = 160;  // for what is said about what is left out
  const CheckTotals totals = totals_of(report);
  std::string head =
      fmt::format("## {} Slipcheck: {}\n\n{} in {} and {} held against the baselines.\n",
                  totals.moved_scenes == 0 ? "✓" : "✗", check_verdict(report),
                  counted(totals.compared, "value"), counted(report.scenes.size(), "scene"),
                  counted(totals.runs, "run"));
  std::string remarks;
  for (const std::string& remark : check_remarks(report))
    remarks += fmt::format("- {}\n", markdown_escaped(remark));
  if (!remarks.empty()) remarks = '\n' + remarks;

  TextTable changes = change_table(report);
  auto& rows = changes.rows;
  if (rows.empty()) return head + remarks;
  const std::size_t count = rows.size();
  std::string text = '\n' + markdown_table(changes);
  while (!rows.empty() && head.size() + text.size() + remarks.size() + kRoom > most) {
    rows.resize(rows.size() * 4 / 5);
    text = '\n' + markdown_table(changes);
  }
  if (rows.size() < count)
    text += fmt::format("\n… and {}; there is no room for them here.\n",
                        counted(count - rows.size(), "more row"));
  return head + text + remarks;
}

}  // namespace slipcheck
