#include "report/html/page_data.h"

#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "engine/engine_registry.h"
#include "report/html/html_engines.h"
#include "report/html/html_scene.h"
#include "report/html/packed_text.h"
#include "report/html/page_channel.h"
#include "report/html/page_chart.h"
#include "report/html/page_data_parts.h"
#include "report/html/page_scenes.h"
#include "report/rows/engine_matrix.h"
#include "report/rows/findings.h"
#include "report/rows/told_verdict.h"
#include "report/rows/topic.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {

using Json = nlohmann::json;

namespace {

/// The worst phase's error in tolerances; a word where it is no number.
Json error_data(double error) {
  if (std::isinf(error)) return "infinite";
  return page_number(error, 9);
}

Json run_data(const SceneRecord& scene, const EngineRecord& run, std::size_t k) {
  Json data = {
      {"label", run_label(run)},
      {"engine", printable(engine_family(run.engine))},
      {"version", printable(run.version.empty() ? engine_version(run.engine) : run.version)},
      {"precision", printable(run.precision)},
      {"profile", printable(run.profile)},
      {"rate", page_number(run.rate)},
      {"verdict", class_of(run.verdict())},
      {"naive", is_naive(run)},
      {"expected", run.expect.has_value()},
      {"skipped", run.status == RunStatus::skipped},
      {"error", error_data(worst_phase(run))},
      {"look", page_look(look_of_run(k))}};
  if (const auto worst = worst_deviation(scene, run))
    data["worst"] = {
        {"text", off_text(*worst)},
        {"severity", std::isfinite(worst->severity) ? page_number(worst->severity, 9) : Json(0)}};
  return data;
}

Json scene_data(const SceneRecord& scene, const std::string& id, const std::string& runs_html,
                const std::vector<Chart>& charts, const MotionDetail& detail) {
  Json runs = Json::array();
  for (const EngineRecord& run : scene.runs) runs.push_back(run_data(scene, run, runs.size()));
  return {{"id", id},
          {"name", printable(scene.scenario.name)},
          {"topic", printable(topic_of(scene.scenario))},
          {"reached", scene.reference.run.reached},
          {"runs", std::move(runs)},
          {"html", runs_html},
          {"charts", page_charts(charts)},
          {"motion", motion_page_data(scene, detail)}};
}

Json method_data(const EngineMethod& method) {
  return {{"engine", printable(method.engine)},
          {"version", printable(method.version)},
          {"precision", printable(method.precision)},
          {"profile", printable(method.profile)},
          {"rate", page_number(method.rate)}};
}

}  // namespace

Json page_data(const ReportContent& content, const ReportCharts& charts) {
  Json scenes = Json::array(), precision = Json::array(), methods = Json::array();
  const MotionDetail detail = motion_detail(content.scenes);
  const SharedSettings shared(content.scenes);
  const std::vector<std::string> ids = scene_ids(content.scenes);
  for (std::size_t k = 0; k < content.scenes.size(); ++k)
    scenes.push_back(scene_data(content.scenes[k], ids[k], html_runs(content.scenes[k], shared),
                                charts.scenes[k], detail));
  for (const EngineMethod& method : engine_matrix(content.scenes, MatrixExtent::all).methods)
    methods.push_back(method_data(method));
  for (std::size_t k = 0; k < content.precision.size(); ++k)
    precision.push_back({{"id", fmt::format("precision-{}", k + 1)},
                         {"name", printable(content.precision[k].scenario.name)},
                         {"charts", page_charts(charts.precision[k])}});
  Json stability;
  if (!charts.limits.empty() || !charts.maps.empty())
    stability = {{"maps", page_charts(charts.maps)}, {"limits", page_charts(charts.limits)}};
  return {{"schema", "slipcheck-page/3"},     {"palette", page_palette()},
          {"methods", std::move(methods)},    {"engines", page_charts(charts.engines)},
          {"scenes", std::move(scenes)},      {"precision", std::move(precision)},
          {"stability", std::move(stability)}};
}

std::string packed_page_data(const ReportContent& content, const ReportCharts& charts) {
  return base64_of(deflated(page_data(content, charts).dump()));
}

}  // namespace slipcheck
