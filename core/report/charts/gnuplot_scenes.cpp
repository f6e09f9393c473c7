#include "report/charts/gnuplot_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/observe/motion_quantities.h"
#include "report/charts/plot_axis.h"
#include "report/files/file_stem.h"
#include "report/rows/comparison_rows.h"
#include "report/rows/csv_rows.h"
#include "report/rows/findings.h"
#include "report/rows/phase_spread.h"
#include "report/rows/quantity.h"
#include "report/rows/selection.h"

namespace slipcheck {
namespace {

constexpr int kWidth = 760;             // [px]
constexpr std::size_t kMostBodies = 4;  // drawn; the data have all

std::string unit_text(const QuantityFormat& format) {
  return format.unit().empty() ? "" : " [" + format.unit() + "]";
}

struct Range {
  double low = INFINITY, high = -INFINITY;

  void take(double value) {
    low = std::fmin(low, value);
    high = std::fmax(high, value);
  }
};

/// Covers the tolerance, nine tenths of the values, and what is not far beyond these: a run that
/// left the scene does not squeeze the others.
Range axis_of(const PhaseSpread& spread) {
  std::vector<double> values;
  for (const RunSpread& run : spread.runs)
    for (const double value : run.values)
      if (std::isfinite(value)) values.push_back(value);
  Range range{spread.low, spread.high};
  std::sort(values.begin(), values.end());
  const std::size_t tenth = values.size() / 10;
  if (!values.empty()) {
    range.take(values[tenth]);
    range.take(values[values.size() - 1 - tenth]);
  }
  const double reach = 2 * (range.high - range.low);
  const double lowest = range.low - reach, highest = range.high + reach;
  for (const double value : values)
    if (value >= lowest && value <= highest) range.take(value);
  const double room = std::max(0.04 * (range.high - range.low), 1e-12 * std::abs(range.high));
  return {range.low - (room > 0 ? room : 1), range.high + (room > 0 ? room : 1)};
}

std::string phase_data(const PhaseSpread& spread) {
  CsvRows rows({"run", "phase", "value", "outside", "label"});
  for (std::size_t k = 0; k < spread.runs.size(); ++k) {
    const RunSpread& run = spread.runs[k];
    for (std::size_t phase = 0; phase < run.values.size(); ++phase) {
      const double value = run.values[phase];
      const bool outside = value < spread.low || value > spread.high;
      rows.add({static_cast<double>(k), static_cast<double>(phase), value, outside ? 1.0 : 0.0,
                run_label(*run.run)});
    }
  }
  return rows.text();
}

/// A row for each run, downwards the phase, across the value.
GnuplotChart phase_chart(const SceneRecord& scene, const PhaseSpread& spread, std::string name) {
  const Range axis = axis_of(spread);
  const QuantityFormat format(std::max(std::abs(axis.low), std::abs(axis.high)), spread.dimension);
  std::size_t phases = 1;
  std::string labels;
  for (std::size_t k = 0; k < spread.runs.size(); ++k) {
    phases = std::max(phases, spread.runs[k].values.size());
    labels += fmt::format("{}{} -{}", k > 0 ? ", " : "",
                          gnuplot_label(run_label(*spread.runs[k].run)), k);
  }
  const std::string what = (spread.is_distance ? "distance from the reference's " : "") +
                           spread.name + unit_text(format);
  const std::string data = name + ".csv";
  std::string script = gnuplot_head(name, kWidth, 170 + 48 * static_cast<int>(spread.runs.size()));
  script += fmt::format(
      "unit = {}\nreference = {}\nlow = {}\nhigh = {}   # of what is within the tolerance\n"
      "left = {}\nright = {}   # of the axis\nphases = {}\n",
      gnuplot_number(format.factor()), gnuplot_number(spread.reference / format.factor()),
      gnuplot_number(spread.low / format.factor()), gnuplot_number(spread.high / format.factor()),
      gnuplot_number(axis.low / format.factor()), gnuplot_number(axis.high / format.factor()),
      phases);
  script += fmt::format(
      "set title {} noenhanced\nset xlabel {} noenhanced\nset xrange [left:right]\n"
      "set yrange [{}:0.6]\nset ytics noenhanced ({})\nset border 1\nunset grid\n"
      "set grid xtics lc rgb '#dddddd' dt 1 lw 0.7\nset ytics scale 0\nset bmargin 6.8\n"
      "set key at screen 0.5, screen 0.02 center bottom horizontal maxcols 3\n",
      gnuplot_text(scene.scenario.name), gnuplot_text(what),
      gnuplot_number(0.4 - static_cast<double>(spread.runs.size())), labels);
  script +=
      "set object 1 rectangle from (low < left ? left : low), graph 0 to \\\n"
      "  (high > right ? right : high), graph 1 behind fillcolor rgb '#009e73' \\\n"
      "  fillstyle transparent solid 0.18 noborder\n"
      "set arrow 1 from reference, graph 0 to reference, graph 1 nohead lw 1.5 lc rgb '#000000'\n"
      "inside(x) = x >= left && x <= right ? x : NaN\n"
      "beyond(x) = x > right ? right : x < left ? left : NaN\n"
      "down(run, phase) = -(run + 0.7*((phase + 0.5)/phases - 0.5))\n";
  script += fmt::format(
      "plot {0} using (column('outside') == 0 ? inside(column('value')/unit) : NaN):\\\n"
      "       (down(column('run'), column('phase'))) with points pt 7 ps 0.45 lc rgb '#0072b2' \\\n"
      "       title 'within the tolerance', \\\n"
      "     {0} using (column('outside') == 1 ? inside(column('value')/unit) : NaN):\\\n"
      "       (down(column('run'), column('phase'))) with points pt 2 ps 0.55 lw 1.6 \\\n"
      "       lc rgb '#d55e00' title 'outside', \\\n"
      "     {0} using (beyond(column('value')/unit)):\\\n"
      "       (down(column('run'), column('phase'))) with points pt 8 ps 0.8 lc rgb '#d55e00' \\\n"
      "       title 'beyond the axis', \\\n"
      "     keyentry with lines lw 1.5 lc rgb '#000000' title 'reference', \\\n"
      "     keyentry with boxes fillcolor rgb '#009e73' fillstyle transparent solid 0.18 \\\n"
      "       noborder title {1}\nunset output\n",
      gnuplot_text(data), gnuplot_text("tolerance " + spread.tolerance));
  return {std::move(name), std::move(script), {{data, phase_data(spread)}}};
}

/// The reference's motion, then of each engine's run the phase in the middle.
struct DrawnMotion {
  std::string label;
  const RecordedMotion* motion;
};

std::vector<DrawnMotion> drawn_motions(const SceneRecord& scene) {
  std::vector<DrawnMotion> drawn;
  if (scene.reference.motion) drawn.push_back({"reference", &*scene.reference.motion});
  for (const EngineRecord& run : scene.runs)
    for (const RecordedMotion& motion : run.motions)
      if (motion.role == "median" || run.motions.size() == 1) {
        drawn.push_back({run_label(run), &motion});
        break;
      }
  return drawn;
}

/// One quantity over time, a panel of the chart.
struct MotionPanel {
  const char* column;
  const char* label;
  Dimension dimension;
  Range reference, all;
};

/// What is drawn of it, in a unit fit for the reference.
QuantityFormat format_of(const MotionPanel& panel) {
  const bool has_reference = panel.reference.high > 0;
  return QuantityFormat(has_reference ? panel.reference.high : panel.all.high, panel.dimension);
}

std::string panel_script(const MotionPanel& panel, const std::string& data,
                         const std::vector<DrawnMotion>& motions, std::size_t bodies, bool first,
                         bool last) {
  const QuantityFormat format = format_of(panel);
  std::string script =
      fmt::format("set ylabel {} noenhanced\n", gnuplot_text(panel.label + unit_text(format)));
  // What left the scene does not squeeze the reference.
  const double ceiling = 1.6 * panel.reference.high;
  script += panel.reference.high > 0 && panel.all.high > 2 * ceiling
                ? fmt::format("set yrange [0:{}]\n", gnuplot_number(ceiling / format.factor()))
                : std::string("set yrange [0:*]\n");
  script += first ? "" : "unset key\n";
  script +=
      last ? "set format x\nset xlabel time_label noenhanced\n" : "set format x ''\nunset xlabel\n";
  const bool of_all = std::string_view(panel.column) == "energy";
  script += "plot ";
  std::string separator;
  for (std::size_t k = 0; k < motions.size(); ++k)
    for (std::size_t body = 0; body < (of_all ? 1 : bodies); ++body) {
      const std::string look =
          k == 0 && motions[k].label == "reference"
              ? fmt::format("with lines lw 2 lc rgb '#000000' {}", gnuplot_dash(body))
              : fmt::format("with linespoints lw 1.2 ps 0.5 pointinterval 9 {} {} {}",
                            gnuplot_colour(k - 1), gnuplot_points(k - 1), gnuplot_dash(body));
      script += fmt::format(
          "{}{} using (column('motion') == {} && column('body') == {} ? column('time')/time_unit : "
          "NaN):\\\n  (column('{}')/{}) {} {}",
          separator, gnuplot_text(data), k, body, panel.column, gnuplot_number(format.factor()),
          look, body == 0 ? "title " + gnuplot_label(motions[k].label) : std::string("notitle"));
      separator = ", \\\n     ";
    }
  if (first && bodies > 1)
    for (std::size_t body = 0; body < bodies; ++body)
      script += fmt::format("{}keyentry with lines lc rgb '#808080' {} title body_{}", separator,
                            gnuplot_dash(body), body);
  return script + "\n";
}

void add_motion_chart(const SceneRecord& scene, std::set<std::string>& taken,
                      std::vector<GnuplotChart>& charts) {
  const std::vector<DrawnMotion> motions = drawn_motions(scene);
  if (motions.empty() || !scene.scene) return;
  const Scene& hard = scene.scene->hard;
  CsvRows rows({"motion", "body", "time", "slip_x", "slip_y", "slip", "speed", "energy", "label"});
  std::array<MotionPanel, 3> panels = {MotionPanel{"slip", "slip velocity", kVelocity, {}, {}},
                                       MotionPanel{"speed", "speed", kVelocity, {}, {}},
                                       MotionPanel{"energy", "kinetic energy", kEnergy, {}, {}}};
  double end = 0;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const RecordedMotion& motion = *motions[k].motion;
    const MotionQuantities seen = motion_quantities(hard, motion);
    for (std::size_t body = 0; body < hard.bodies.size(); ++body)
      for (std::size_t frame = 0; frame < motion.frames.size(); ++frame) {
        const Vector3& slip = seen.slip[frame][body];
        const std::array values = {slip.norm(), seen.speed[frame][body],
                                   seen.kinetic_energy[frame]};
        for (std::size_t p = 0; p < panels.size() && body < kMostBodies; ++p) {
          panels[p].all.take(values[p]);
          if (motions[k].label == "reference") panels[p].reference.take(values[p]);
        }
        end = std::max(end, motion.frames[frame].time);
        rows.add({static_cast<double>(k), static_cast<double>(body), motion.frames[frame].time,
                  slip.x(), slip.y(), values[0], values[1], values[2], motions[k].label});
      }
  }
  std::vector<const MotionPanel*> drawn;
  for (const MotionPanel& panel : panels)
    if (panel.all.high >= panel.all.low) drawn.push_back(&panel);
  if (drawn.empty()) return;

  const std::string name = file_stem("motion-" + scene.scenario.name, taken);
  const std::string data = name + ".csv";
  const QuantityFormat time(end, kTime);
  const std::size_t bodies = std::min(hard.bodies.size(), kMostBodies);
  const int height = 90 + 190 * static_cast<int>(drawn.size());
  std::string script = gnuplot_head(name, kWidth + 60, height);
  script += fmt::format("time_unit = {}\ntime_label = {}\n", gnuplot_number(time.factor()),
                        gnuplot_text("time" + unit_text(time)));
  for (std::size_t body = 0; body < bodies; ++body)
    script += fmt::format("body_{} = {}\n", body, gnuplot_label(scene.scenario.bodies[body].name));
  // An engine that stops far too late must not press the rest together; [0:*] shows it.
  const auto& truth = scene.reference.motion;
  const bool is_cut = truth && !truth->frames.empty() && 1.4 * truth->frames.back().time < end;
  script += fmt::format(
      "set xrange [0:{}]\nset key at screen 0.66, screen 0.94 left top vertical maxrows 60\n",
      is_cut ? gnuplot_number(1.4 * truth->frames.back().time / time.factor()) : "*");
  script += gnuplot_column(drawn.size(), height, 0.11, 0.64, scene.scenario.name);
  for (std::size_t p = 0; p < drawn.size(); ++p)
    script += panel_script(*drawn[p], data, motions, bodies, p == 0, p + 1 == drawn.size());
  script += "unset multiplot\nunset output\n";
  charts.push_back({name, std::move(script), {{data, rows.text()}}});
}

void add_series_chart(const SceneRecord& scene, std::set<std::string>& taken,
                      std::vector<GnuplotChart>& charts) {
  if (!scene.reference.box || scene.reference.box->series.time.size() < 2) return;
  const BoxReference& box = *scene.reference.box;
  const BoxSeries& series = box.series;
  struct Strip {
    const char *observable, *column, *label;
    const std::vector<double>* values;
  };
  const Strip all[] = {
      {"all.height", "height", "H", &series.height},
      {"all.kinetic_energy", "kinetic_energy", "K", &series.kinetic_energy},
      {"all.rotational_energy", "rotational_energy", "R", &series.rotational_energy},
      {"all.collision_rate", "collision_rate", "collisions", &series.collision_rate}};
  std::vector<const Strip*> strips;
  for (const Strip& strip : all)
    if (std::ranges::any_of(*strip.values, [](double value) { return value != 0; }))
      strips.push_back(&strip);
  if (strips.empty()) return;

  CsvRows rows({"time", "height", "kinetic_energy", "rotational_energy", "collision_rate"});
  for (std::size_t k = 0; k < series.time.size(); ++k)
    rows.add({series.time[k], series.height[k], series.kinetic_energy[k],
              series.rotational_energy[k], series.collision_rate[k]});
  const std::string name = file_stem("series-" + scene.scenario.name, taken);
  const std::string data = name + ".csv";
  const QuantityFormat time(series.time.back(), kTime);
  const double first = series.time[series.time.size() - std::min(box.samples, series.time.size())];
  const int height = 100 + 140 * static_cast<int>(strips.size());
  std::string script = gnuplot_head(name, kWidth, height);
  script += fmt::format(
      "start = {}   # time from which on means are taken\nset key off\nset xrange [{}:{}]\n",
      gnuplot_number(first / time.factor()), gnuplot_number(series.time.front() / time.factor()),
      gnuplot_number(series.time.back() / time.factor()));
  script += gnuplot_column(strips.size(), height, 0.13, 0.97, scene.scenario.name);
  for (const Strip* strip : strips) {
    const QuantityFormat format = format_for(scene, strip->observable, nullptr);
    const auto [low, high] = std::ranges::minmax(*strip->values);
    const bool varies = high - low > 1e-6 * std::abs(high);
    const std::vector<double> ticks = varies ? round_ticks(low, high) : std::vector<double>();
    script +=
        fmt::format("set ylabel {} noenhanced\n", gnuplot_text(strip->label + unit_text(format)));
    const double step = ticks.size() > 1 ? (ticks[1] - ticks[0]) / format.factor() : 0;
    script += step > 0 ? fmt::format("set ytics {}\n", gnuplot_number(step))
                       : std::string("set ytics autofreq\n");
    script += strip == strips.back() ? fmt::format("set format x\nset xlabel {} noenhanced\n",
                                                   gnuplot_text("time" + unit_text(time)))
                                     : std::string("set format x ''\nunset xlabel\n");
    const auto mean = scene.reference.observables.find(strip->observable);
    std::string line;
    script += "unset object 1\n";
    if (mean != scene.reference.observables.end() && std::isfinite(mean->second.value)) {
      const double value = mean->second.value / format.factor();
      const double error = mean->second.uncertainty / format.factor();
      if (std::isfinite(error))
        script += fmt::format(
            "set object 1 rectangle from start, {} to graph 1, first {} behind fillcolor rgb "
            "'#009e73' fillstyle transparent solid 0.25 noborder\n",
            gnuplot_number(value - error), gnuplot_number(value + error));
      line = fmt::format(", \\\n     (x >= start ? {} : NaN) with lines lw 1.5 lc rgb '#000000'",
                         gnuplot_number(value));
    }
    script += fmt::format(
        "plot {} using (column('time')/{}):(column('{}')/{}) with lines lw 1 lc rgb '#0072b2'{}\n",
        gnuplot_text(data), gnuplot_number(time.factor()), strip->column,
        gnuplot_number(format.factor()), line);
  }
  script += "unset multiplot\nunset output\n";
  charts.push_back({name, std::move(script), {{data, rows.text()}}});
}

}  // namespace

void add_scene_charts(const SceneRecord& scene, std::set<std::string>& taken,
                      std::vector<GnuplotChart>& charts) {
  for (const auto& [name, value] : scene.reference.observables)
    if (has_tolerance(scene.scenario, name))
      if (const auto spread = phase_spread(scene, name))
        charts.push_back(phase_chart(
            scene, *spread, file_stem("phases-" + scene.scenario.name + "-" + name, taken)));
  add_motion_chart(scene, taken, charts);
  add_series_chart(scene, taken, charts);
}

}  // namespace slipcheck
