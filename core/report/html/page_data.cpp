#include "report/html/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/charts/scene_charts.h"
#include "report/html/packed_text.h"
#include "report/html/page_channel.h"
#include "report/html/page_data_parts.h"
#include "report/rows/comparison_rows.h"
#include "report/rows/quantity.h"
#include "report/rows/verdict_look.h"
#include "report/terminal/text.h"

namespace slipcheck {

using Json = nlohmann::json;

namespace {

constexpr std::size_t kMostColumns = 300;  // of a series; each keeps its lowest and highest sample

Json run_data(const EngineRecord& run) {
  return {{"label", printable(fmt::format("{} {} {} {:g} Hz", run.engine, run.precision,
                                          run.profile, run.rate))},
          {"engine", printable(run.engine)},
          {"precision", printable(run.precision)},
          {"profile", printable(run.profile)},
          {"rate", page_number(run.rate)},
          {"verdict", class_of(run.verdict())}};
}

Json phase_data(const SceneRecord& scene, const ChartedPhases& chart) {
  const PhaseSpread& spread = chart.spread;
  const QuantityFormat format(std::max(std::abs(spread.low), std::abs(spread.high)),
                              spread.dimension);
  const double uncertainty =
      spread.is_distance ? 0 : scene.reference.observables.at(spread.name).uncertainty;
  Json values(scene.runs.size(), Json());
  for (const RunSpread& run : spread.runs) {
    Json& list = values[static_cast<std::size_t>(run.run - scene.runs.data())] = Json::array();
    for (const double value : run.values) list.push_back(page_number(value));
  }
  const std::string name =
      spread.is_distance ? spread.name + ", distance from the reference" : spread.name;
  return {{"observable", printable(name)},
          {"unit", format.unit()},
          {"factor", format.factor()},
          {"reference", page_number(spread.reference, 9)},
          {"uncertainty", page_number(uncertainty, 3)},
          {"low", page_number(spread.low, 9)},
          {"high", page_number(spread.high, 9)},
          {"caption", printable(chart.caption)},
          {"values", std::move(values)}};
}

/// The samples that are drawn: all, or of each column the lowest and the highest.
std::vector<std::size_t> drawn_samples(const std::vector<double>& values) {
  const std::size_t width = std::max<std::size_t>(1, values.size() / kMostColumns);
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < values.size(); k += width) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(k);
    const auto end =
        values.begin() + static_cast<std::ptrdiff_t>(std::min(k + width, values.size()));
    const auto [low, high] = std::minmax_element(begin, end);
    const auto a = static_cast<std::size_t>(std::min(low, high) - values.begin());
    const auto b = static_cast<std::size_t>(std::max(low, high) - values.begin());
    result.push_back(a);
    if (b != a) result.push_back(b);
  }
  return result;
}

/// What a box showed at each sample, with the mean and its 95 % interval.
Json series_data(const SceneRecord& scene) {
  Json result = Json::array();
  if (!scene.reference.box || scene.reference.box->series.time.size() < 2) return result;
  const BoxReference& box = *scene.reference.box;
  struct Strip {
    const char *name, *title;
    const std::vector<double>* values;
  };
  const std::array strips = {
      Strip{"all.height", "H, height of the centre of mass over its height at rest",
            &box.series.height},
      Strip{"all.kinetic_energy", "K, energy of translation of a body", &box.series.kinetic_energy},
      Strip{"all.rotational_energy", "R, energy of rotation of a body",
            &box.series.rotational_energy},
      Strip{"all.collision_rate", "collisions of two bodies in a second",
            &box.series.collision_rate}};
  const std::size_t count = box.series.time.size();
  const std::size_t first_averaged = count - std::min(box.samples, count);
  for (const Strip& strip : strips) {
    if (std::ranges::all_of(*strip.values, [](double value) { return value == 0; })) continue;
    const std::vector<std::size_t> samples = drawn_samples(*strip.values);
    std::vector<double> time, values;
    for (const std::size_t k : samples) {
      time.push_back(box.series.time[k]);
      values.push_back((*strip.values)[k]);
    }
    const QuantityFormat format = format_for(scene, strip.name, nullptr);
    const auto mean = scene.reference.observables.find(strip.name);
    const bool has_mean = mean != scene.reference.observables.end();
    result.push_back(
        {{"title", strip.title},
         {"unit", format.unit()},
         {"factor", format.factor()},
         {"time", page_channel(time)},
         {"values", page_channel(values)},
         {"mean", has_mean ? page_number(mean->second.value) : Json()},
         {"uncertainty", has_mean ? page_number(mean->second.uncertainty) : Json()},
         {"averaged_from", std::ranges::lower_bound(samples, first_averaged) - samples.begin()}});
  }
  return result;
}

Json scene_data(const SceneRecord& scene, std::size_t k, const MotionDetail& detail) {
  Json runs = Json::array(), phases = Json::array();
  for (const EngineRecord& run : scene.runs) runs.push_back(run_data(run));
  for (const ChartedPhases& chart : charted_phases(scene, ChartExtent::page))
    phases.push_back(phase_data(scene, chart));
  return {{"id", fmt::format("scene-{}", k + 1)},
          {"name", printable(scene.scenario.name)},
          {"runs", std::move(runs)},
          {"phases", std::move(phases)},
          {"series", series_data(scene)},
          {"motion", motion_page_data(scene, detail)}};
}

}  // namespace

Json page_data(const ReportContent& content) {
  Json scenes = Json::array(), precision = Json::array();
  const MotionDetail detail = motion_detail(content.scenes);
  for (std::size_t k = 0; k < content.scenes.size(); ++k)
    scenes.push_back(scene_data(content.scenes[k], k, detail));
  for (std::size_t k = 0; k < content.precision.size(); ++k) {
    precision.push_back(precision_page_data(content.precision[k]));
    precision.back()["id"] = fmt::format("precision-{}", k + 1);
  }
  return {{"schema", "slipcheck-page/1"},
          {"scenes", std::move(scenes)},
          {"precision", std::move(precision)},
          {"stability", stability_page_data(content.limits)}};
}

std::string packed_page_data(const ReportContent& content) {
  return base64_of(deflated(page_data(content).dump()));
}

}  // namespace slipcheck
