#include "report/html/page_data.h"

#include <fmt/format.h>

#include "base/text.h"
#include "report/html/packed_text.h"
#include "report/html/page_channel.h"
#include "report/html/page_chart.h"
#include "report/html/page_data_parts.h"
#include "report/rows/verdict_look.h"

namespace slipcheck {

using Json = nlohmann::json;

namespace {

Json run_data(const EngineRecord& run, std::size_t k) {
  return {{"label", printable(fmt::format("{} {} {} {}", run.engine, run.precision, run.profile,
                                          run.rate_text()))},
          {"engine", printable(run.engine)},
          {"precision", printable(run.precision)},
          {"profile", printable(run.profile)},
          {"rate", page_number(run.rate)},
          {"verdict", class_of(run.verdict())},
          {"look", page_look(look_of_run(k))}};
}

Json scene_data(const SceneRecord& scene, std::size_t k, const std::vector<Chart>& charts,
                const MotionDetail& detail) {
  Json runs = Json::array();
  for (const EngineRecord& run : scene.runs) runs.push_back(run_data(run, runs.size()));
  return {{"id", fmt::format("scene-{}", k + 1)},
          {"name", printable(scene.scenario.name)},
          {"runs", std::move(runs)},
          {"charts", page_charts(charts)},
          {"motion", motion_page_data(scene, detail)}};
}

}  // namespace

Json page_data(const ReportContent& content, const ReportCharts& charts) {
  Json scenes = Json::array(), precision = Json::array();
  const MotionDetail detail = motion_detail(content.scenes);
  for (std::size_t k = 0; k < content.scenes.size(); ++k)
    scenes.push_back(scene_data(content.scenes[k], k, charts.scenes[k], detail));
  for (std::size_t k = 0; k < content.precision.size(); ++k)
    precision.push_back({{"id", fmt::format("precision-{}", k + 1)},
                         {"name", printable(content.precision[k].scenario.name)},
                         {"charts", page_charts(charts.precision[k])}});
  Json stability;
  if (!charts.limits.empty() || !charts.maps.empty())
    stability = {{"maps", page_charts(charts.maps)}, {"limits", page_charts(charts.limits)}};
  return {{"schema", "slipcheck-page/2"},           {"palette", page_palette()},
          {"engines", page_charts(charts.engines)}, {"scenes", std::move(scenes)},
          {"precision", std::move(precision)},      {"stability", std::move(stability)}};
}

std::string packed_page_data(const ReportContent& content, const ReportCharts& charts) {
  return base64_of(deflated(page_data(content, charts).dump()));
}

}  // namespace slipcheck
