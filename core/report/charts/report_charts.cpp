#include "report/charts/report_charts.h"

#include <set>
#include <string>

#include "report/charts/engine_charts.h"
#include "report/charts/precision_charts.h"
#include "report/charts/stability_charts.h"

namespace slipcheck {

ReportCharts report_charts(const ReportContent& content, ChartExtent extent) {
  ReportCharts charts;
  std::set<std::string> taken;
  if (auto engines = engine_chart(engine_matrix(content.scenes), taken))
    charts.engines.push_back(std::move(*engines));
  for (const SceneRecord& scene : content.scenes) {
    std::vector<Chart>& motions = charts.motions.emplace_back();
    if (auto motion = motion_chart(scene, taken)) motions.push_back(std::move(*motion));
    std::vector<Chart>& all = charts.scenes.emplace_back();
    if (auto series = series_chart(scene, taken)) all.push_back(std::move(*series));
    for (Chart& assembly : assembly_charts(scene, taken)) all.push_back(std::move(assembly));
    for (Chart& phases : phase_charts(scene, extent, taken)) all.push_back(std::move(phases));
  }
  const auto looks = method_looks(content.precision);
  for (const PrecisionScene& scene : content.precision)
    charts.precision.push_back(precision_charts(scene, looks, taken));
  if (extent == ChartExtent::all && !content.cases.empty())
    charts.catalogue.push_back(catalogue_chart(content.cases, taken));
  for (const LimitGroup& group : limit_groups(content.limits.limits))
    charts.limits.push_back(limits_chart(group, taken));
  for (const OutcomeMap* map : complete_maps(content.limits))
    charts.maps.push_back(map_chart(*map, taken));
  return charts;
}

std::vector<Chart> ReportCharts::all() const {
  std::vector<Chart> all;
  const auto add = [&](const std::vector<Chart>& charts) {
    all.insert(all.end(), charts.begin(), charts.end());
  };
  add(engines);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    add(motions[k]);
    add(scenes[k]);
  }
  for (const std::vector<Chart>& charts : precision) add(charts);
  for (const auto* charts : {&catalogue, &limits, &maps}) add(*charts);
  return all;
}

}  // namespace slipcheck
