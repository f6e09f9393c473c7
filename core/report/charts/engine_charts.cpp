#include "report/charts/engine_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/charts/plot_text.h"
#include "report/files/file_stem.h"

namespace slipcheck {
namespace {

constexpr double kLeastError = 1e-3, kMostError = 1e4;  // [tolerances]; beyond, at the edge

/// The method without its rate.
EngineMethod line_of(EngineMethod method) {
  method.rate = 0;
  return method;
}

std::string name_of_line(const EngineMethod& line, bool with_precision) {
  return fmt::format("{} {}{}{} {}", line.engine, line.version, with_precision ? " " : "",
                     with_precision ? line.precision : "", line.profile);
}

}  // namespace

std::optional<Chart> engine_chart(const EngineMatrix& matrix, std::set<std::string>& taken) {
  if (matrix.methods.size() < 2) return std::nullopt;
  const std::vector<MethodScore> scores = scores_of(matrix);
  std::map<EngineMethod, Curve> curves;
  for (std::size_t c = 0; c < matrix.methods.size(); ++c) {
    const EngineMethod& method = matrix.methods[c];
    const MethodScore& score = scores[c];
    if (!(score.cost > 0) || std::isnan(score.median_error)) continue;
    Curve& curve = curves[line_of(method)];
    curve.x.push_back(score.cost);
    curve.y.push_back(std::clamp(score.median_error, kLeastError, kMostError));
    curve.notes.push_back(
        fmt::format("{}\nwithin in {} of {} scenes", method.label(true), score.within,
                    score.within + score.deviates + score.undecided + score.failed));
  }
  if (curves.size() < 2) return std::nullopt;
  Chart chart{file_stem("engines", taken),
              "Error against run time, all engines",
              plot_literal(fmt::format(
                  "Over {} scenes the median of the worst phase's error, in tolerances, beside the "
                  "CPU time of a simulated second (geometric mean); a line joins the rates of an "
                  "engine. Below 1 half of the scenes are within.",
                  matrix.rows.size())),
              {},
              1,
              360};
  Panel panel;
  panel.x = {"CPU time of a simulated second [s]", true};
  panel.y = {"median of the worst errors [tolerances]", true};
  double low = INFINITY, high = 0;
  std::size_t k = 0;
  for (auto& [line, curve] : curves) {
    curve.label = plot_literal(name_of_line(line, matrix.has_both_precisions()));
    curve.look = look_of_run(k++);
    curve.at_edge = true;
    for (const double x : curve.x) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
    panel.curves.push_back(std::move(curve));
  }
  panel.curves.insert(panel.curves.begin(),
                      {"one tolerance", {Ink::grey, Line::dotted}, {low, high}, {1, 1}});
  chart.panels.push_back(std::move(panel));
  return chart;
}

}  // namespace slipcheck
