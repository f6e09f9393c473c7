#include "report/json/tuning_json.h"

#include "report/json/common_fields.h"
#include "studies/tuning/tuning_fields.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

Json score_json(const Score& score) {
  return {{"worst", score.worst},
          {"mean", score.mean},
          {"failed", score.failed},
          {"cpu_per_simulated_second", score.cost}};
}

Json finalist_json(const TuningRecord& tuning, const TuningFinalist& finalist) {
  Json json{{"settings", written(finalist.settings)}, {"training", score_json(finalist.training)}};
  if (finalist.held_out) json["held_out"] = score_json(*finalist.held_out);
  json["runs"] = Json::array();
  for (std::size_t k = 0; k < tuning.tasks.size(); ++k) {
    const TuningTask& task = tuning.tasks[k];
    const RunScore& run = finalist.runs[k];
    Json one{{"scene", task.scene}, {"rate", task.rate}, {"held_out", task.held_out}};
    one.update(FieldWriter<Json, NotFinite::null>::json_of_value(run));
    if (!run.reason.empty()) one["reason"] = valid_utf8(run.reason);
    json["runs"].push_back(std::move(one));
  }
  return json;
}

Json scenes_json(const TuningRecord& tuning, bool held_out) {
  Json scenes = Json::array();
  for (const TuningTask& task : tuning.tasks) {
    Json scene{{"name", task.scene}, {"sha256", task.sha256}};
    if (task.held_out == held_out && (scenes.empty() || scenes.back() != scene))
      scenes.push_back(std::move(scene));
  }
  return scenes;
}

}  // namespace

Json json_of(const TuningRecord& tuning) {
  const TuningResult& result = tuning.result;
  Json json{
      {"schema", "slipcheck-tuning/1"},
      {"slipcheck", written(context())["slipcheck"]},
      {"engine",
       {{"name", tuning.engine}, {"version", tuning.version}, {"precision", tuning.precision}}},
      {"profile", tuning.profile},
      {"start_profile", valid_utf8(tuning.start)},
      {"within", tuning.goal.within ? Json(*tuning.goal.within) : Json(nullptr)},
      {"scenes", scenes_json(tuning, false)},
      {"held_out", scenes_json(tuning, true)},
      {"observables", tuning.observables.named},
      {"rates", tuning.rates},
      {"phases", {{"search", tuning.phases}, {"final", tuning.final_phases}}},
      {"seed", tuning.seed},
      {"evaluations", result.evaluations},
      {"candidates", result.candidates},
      {"converged", result.converged},
      {"improved", result.improved()},
      {"no_better_than",
       result.improved() ? Json(nullptr) : Json(valid_utf8(result.best().profile))},
      {"overfitted", result.overfitted()},
      {"start", finalist_json(tuning, result.start())},
      {"chosen", finalist_json(tuning, result.best())}};
  Json& front = json["trade_off"] = Json::array();
  for (const TuningCandidate& candidate : result.front) {
    Json one = score_json(candidate.score);
    one["settings"] = written(candidate.settings);
    front.push_back(std::move(one));
  }
  return json;
}

}  // namespace slipcheck
