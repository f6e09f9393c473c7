#include "report/charts/gnuplot_studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "report/charts/precision_charts.h"
#include "report/files/file_stem.h"
#include "report/rows/csv_rows.h"
#include "report/rows/outcome_look.h"
#include "report/rows/precision_rows.h"
#include "report/rows/stability_rows.h"

namespace slipcheck {
namespace {

constexpr int kWidth = 820, kHeight = 460;  // [px]
constexpr double kErrorCeiling = 1e4;       // what is worse has left the scene

double step_of(const MethodCurve& curve, const WorkPrecision& point) {
  return curve.kind == MethodCurve::Kind::engine       ? 1 / point.knob
         : curve.kind == MethodCurve::Kind::fixed_step ? point.knob
                                                       : kNotObserved;
}

/// The solvers of the reference in black; an engine's profile has a colour and a point type, its
/// single precision a dash.
struct CurveLooks {
  std::vector<std::string> profiles;

  std::string of(const MethodCurve& curve) {
    switch (curve.kind) {
      case MethodCurve::Kind::contact:
        return "with lines lw 1.5 lc rgb '#000000' dt 1";
      case MethodCurve::Kind::fixed_step:
        return "with lines lw 1.5 lc rgb '#000000' dt (9,3,2,3)";
      case MethodCurve::Kind::event:
        return "with points pt 13 ps 1 lc rgb '#000000'";
      case MethodCurve::Kind::engine:
        break;
    }
    const std::string profile = curve.engine + "\n" + curve.profile;
    const auto found = std::find(profiles.begin(), profiles.end(), profile);
    const auto k = static_cast<std::size_t>(found - profiles.begin());
    if (found == profiles.end()) profiles.push_back(profile);
    const std::size_t dash = curve.iterations ? 2 : curve.precision == "single" ? 1 : 0;
    return fmt::format("with linespoints lw 1.4 ps 0.7 {} {} {}", gnuplot_colour(k),
                       gnuplot_points(k), gnuplot_dash(dash));
  }
};

enum class Abscissa { cpu_time, step };

/// Worst error of each method against CPU time or the step, both axes logarithmic.
std::optional<GnuplotChart> error_chart(const PrecisionScene& scene, const std::string& quantity,
                                        Abscissa abscissa, std::set<std::string>& taken) {
  const bool over_time = abscissa == Abscissa::cpu_time;
  CsvRows rows({"method", "knob", "x", "error", "front", "label"});
  CurveLooks looks;
  std::vector<std::string> plots;
  std::optional<double> tolerance;
  bool has_front = false;
  double largest = 0;
  for (std::size_t k = 0; k < scene.curves.size(); ++k) {
    const MethodCurve& curve = scene.curves[k];
    const std::string look = looks.of(curve);
    if (!is_main_curve(curve, quantity)) continue;
    bool drawn = false;
    for (const WorkPrecision& point : curve.points) {
      const PhaseErrors* errors = errors_of(point, quantity);
      const double x = !over_time   ? step_of(curve, point)
                       : point.cost ? point.cost->per_simulated_second
                                    : kNotObserved;
      if (!errors || !std::isfinite(errors->worst) || !(x > 0)) continue;
      if (errors->tolerance) tolerance = errors->tolerance;
      const bool front = over_time && point.pareto.contains(quantity);
      has_front |= front;
      drawn = true;
      largest = std::max(largest, errors->worst);
      rows.add({static_cast<double>(k), point.knob, x, errors->worst, front ? 1.0 : 0.0,
                label_of(curve)});
    }
    if (drawn)
      plots.push_back(
          fmt::format("using (column('method') == {} ? column('x') : NaN):\\\n"
                      "       (drawn(column('error'))) {} title {}",
                      k, look, gnuplot_label(label_of(curve))));
  }
  if (plots.empty()) return std::nullopt;

  const std::string name = file_stem(
      fmt::format("{}-{}-{}", over_time ? "precision" : "step", scene.scenario.name, quantity),
      taken);
  const std::string data = gnuplot_text(name + ".csv");
  const Dimension& dimension = error_dimension(scene, quantity);
  std::string script =
      gnuplot_head(name, kWidth, std::max(kHeight, 90 + 20 * static_cast<int>(plots.size())));
  script += gnuplot_logarithmic('x') + gnuplot_logarithmic('y');
  script += "set offsets graph 0.03, graph 0.03, graph 0.03, graph 0.03\n";
  script += fmt::format(
      "set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n"
      "floor_error = {}   # no error at all is drawn here\n"
      "drawn(error) = error > floor_error ? error : floor_error\n",
      gnuplot_text(scene.scenario.name + ", " + quantity),
      over_time ? "'CPU time for a simulated second [s]'" : "'step [s]'",
      gnuplot_text(fmt::format("worst error [{}]", dimension.si[0] == '\0' ? "-" : dimension.si)),
      gnuplot_number(kErrorFloor));
  if (largest > kErrorCeiling)
    script += fmt::format("set yrange [*:{}]\n", gnuplot_number(kErrorCeiling));
  script += "plot ";
  for (std::size_t k = 0; k < plots.size(); ++k)
    script += fmt::format("{}{} {}", k > 0 ? ", \\\n     " : "", data, plots[k]);
  if (tolerance && *tolerance > 0)
    script += fmt::format(
        ", \\\n     {} with lines lw 1 dt (2,3) lc rgb '#606060' title "
        "'tolerance of the scene'",
        gnuplot_number(*tolerance));
  if (has_front)
    script += fmt::format(
        ", \\\n     {} using (column('front') == 1 ? column('x') : NaN):\\\n"
        "       (drawn(column('error'))) with points pt 6 ps 1.6 lw 1.2 lc rgb '#000000' \\\n"
        "       title 'none cheaper and no worse'",
        data);
  return GnuplotChart{name, script + "\nunset output\n", {{name + ".csv", rows.text()}}};
}

bool works_above(Limit::Kind kind) { return kind == Limit::Kind::length_scale; }

const char* axis_label(Limit::Kind kind) {
  switch (kind) {
    case Limit::Kind::stable_step:
    case Limit::Kind::accurate_step:
      return "'step [s]'";
    case Limit::Kind::length_scale:
      return "'factor on all lengths [-]'";
    case Limit::Kind::mass_ratio:
      return "'ratio of masses [-]'";
  }
  return "''";
}

/// Bars over the range that was searched: where it works, and how it comes out beyond.
std::optional<GnuplotChart> limit_chart(const LimitGroup& group, std::set<std::string>& taken) {
  CsvRows rows({"row", "low", "high", "works", "outcome", "theory", "label"});
  std::string labels;
  std::set<Outcome> outcomes;
  bool has_theory = false, any_works = false;
  const bool above = works_above(group.kind);
  std::size_t row = 0;
  for (const Limit* limit : group.limits) {
    if (!limit->good && !limit->bad) continue;
    const double border = limit->good && limit->bad          ? std::sqrt(*limit->good * *limit->bad)
                          : above == limit->good.has_value() ? limit->low
                                                             : limit->high;
    const double theory = limit->theory.value_or(kNotObserved);
    has_theory |= limit->theory.has_value();
    const auto add = [&](double low, double high, bool works) {
      if (!(high > low)) return;
      if (works) any_works = true;
      if (!works) outcomes.insert(limit->beyond);
      rows.add({static_cast<double>(row), low, high, works ? 1.0 : 0.0,
                static_cast<double>(limit->beyond), theory, label_of(*limit)});
    };
    add(limit->low, border, !above);
    add(border, limit->high, above);
    labels += fmt::format("{}{} -{}", row > 0 ? ", " : "", gnuplot_label(label_of(*limit)), row);
    ++row;
  }
  if (row == 0) return std::nullopt;

  const std::string name =
      file_stem(fmt::format("limit-{}-{}", name_of(group.kind), group.scene), taken);
  const std::string data = gnuplot_text(name + ".csv");
  std::string script = gnuplot_head(name, kWidth, 160 + 30 * static_cast<int>(row));
  script += gnuplot_logarithmic('x');
  script += fmt::format(
      "set title {} noenhanced\nset xlabel {}\nset ytics noenhanced ({})\nset yrange [{}:0.6]\n"
      "set border 1\nunset grid\nset grid xtics lc rgb '#dddddd' dt 1 lw 0.7\n"
      "set autoscale xfix\nset ytics scale 0\nset bmargin 5.4\n"
      "set key at screen 0.5, screen 0.02 center bottom horizontal maxcols 4\n",
      gnuplot_text(fmt::format("{}, {}", words_of(group.kind), group.scene)),
      axis_label(group.kind), labels, gnuplot_number(0.4 - static_cast<double>(row)));
  const char* bars =
      "     {} using ({} ? column('low') : NaN):(-column('row')):(column('low')):\\\n"
      "       (column('high')):(-column('row') - 0.3):(-column('row') + 0.3) with boxxyerror \\\n"
      "       fillcolor rgb '{}' fillstyle {} border lc rgb '#404040' title {}";
  script += "plot \\\n";
  std::vector<std::string> plots;
  if (any_works)
    plots.push_back(fmt::format(fmt::runtime(bars), data, "column('works') == 1", "#0072b2",
                                "solid 1", "'works'"));
  for (const Outcome outcome : outcomes)
    plots.push_back(fmt::format(
        fmt::runtime(bars), data,
        fmt::format("column('works') == 0 && column('outcome') == {}", static_cast<int>(outcome)),
        look_of(outcome).fill, "solid 1", gnuplot_text(name_of(outcome))));
  if (has_theory)
    for (const auto& [width, colour, title] :
         {std::tuple("6", "#ffffff", "notitle"), std::tuple("2.5", "#000000", "title 'theory'")})
      plots.push_back(fmt::format(
          "     {} using (column('theory')):(-column('row') - 0.42):(0):(0.84) with vectors nohead "
          "\\\n       lw {} lc rgb '{}' {}",
          data, width, colour, title));
  for (std::size_t k = 0; k < plots.size(); ++k)
    script += plots[k] + (k + 1 < plots.size() ? ", \\\n" : "\nunset output\n");
  return GnuplotChart{name, std::move(script), {{name + ".csv", rows.text()}}};
}

/// Borders of cells about rising values: half-way, on a logarithmic axis in the logarithm.
std::vector<double> borders_of(const OutcomeMap::Axis& axis) {
  const auto to = [&](double v) { return axis.logarithmic ? std::log(v) : v; };
  const auto from = [&](double v) { return axis.logarithmic ? std::exp(v) : v; };
  const std::vector<double>& v = axis.values;
  std::vector<double> borders;
  const double half = v.size() > 1 ? (to(v[1]) - to(v[0])) / 2 : 0.5;
  borders.push_back(from(to(v[0]) - half));
  for (std::size_t k = 0; k + 1 < v.size(); ++k)
    borders.push_back(from((to(v[k]) + to(v[k + 1])) / 2));
  borders.push_back(from(2 * to(v.back()) - to(borders.back())));
  return borders;
}

bool is_dark(Outcome outcome) { return std::string_view(look_of(outcome).ink) == "#ffffff"; }

std::optional<GnuplotChart> map_chart(const OutcomeMap& map, std::set<std::string>& taken) {
  const std::size_t columns = map.x.values.size(), cells = columns * map.y.values.size();
  if (cells == 0 || map.outcome.size() != cells) return std::nullopt;  // interrupted
  const std::vector<double> x = borders_of(map.x), y = borders_of(map.y);
  CsvRows rows(
      {"x", "y", "x_low", "x_high", "y_low", "y_high", "outcome", "worst_error", "dark", "letter"});
  std::set<Outcome> outcomes;
  for (std::size_t k = 0; k < cells; ++k) {
    const std::size_t c = k % columns, r = k / columns;
    const OutcomeLook& look = look_of(map.outcome[k]);
    outcomes.insert(map.outcome[k]);
    rows.add({map.x.values[c], map.y.values[r], x[c], x[c + 1], y[r], y[r + 1],
              static_cast<double>(map.outcome[k]),
              k < map.worst_error.size() ? map.worst_error[k] : kNotObserved,
              is_dark(map.outcome[k]) ? 1.0 : 0.0, std::string(look.letter)});
  }
  const std::string name = file_stem("map-" + map.name, taken);
  const std::string data = gnuplot_text(name + ".csv");
  std::vector<std::pair<std::string, std::string>> files = {{name + ".csv", rows.text()}};
  std::string script = gnuplot_head(name, 720, 460);
  if (map.x.logarithmic) script += gnuplot_logarithmic('x');
  if (map.y.logarithmic) script += gnuplot_logarithmic('y');
  script += fmt::format(
      "set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n"
      "set xrange [{}:{}]\nset yrange [{}:{}]\nunset grid\nset border 15\nset tics out\n"
      "set key width 2 spacing 1.3\nplot \\\n",
      gnuplot_text(map.title), gnuplot_text(map.x.label), gnuplot_text(map.y.label),
      gnuplot_number(x.front()), gnuplot_number(x.back()), gnuplot_number(y.front()),
      gnuplot_number(y.back()));
  for (const Outcome outcome : outcomes)
    script += fmt::format(
        "     {} using (column('outcome') == {} ? column('x') : NaN):(column('y')):\\\n"
        "       (column('x_low')):(column('x_high')):(column('y_low')):(column('y_high')) \\\n"
        "       with boxxyerror fillcolor rgb '{}' fillstyle solid 1 border lc rgb '#ffffff' \\\n"
        "       title {}, \\\n",
        data, static_cast<int>(outcome), look_of(outcome).fill,
        gnuplot_text(fmt::format("{}  {}", look_of(outcome).letter, name_of(outcome))));
  // White letters on dark cells; gnuplot 5.4 dies of labels without a point.
  std::string separator;
  for (const int dark : {0, 1}) {
    if (std::ranges::none_of(outcomes, [&](Outcome o) { return is_dark(o) == (dark == 1); }))
      continue;
    script += fmt::format(
        "{}     {} using (column('dark') == {} ? column('x') : NaN):(column('y')):'letter' \\\n"
        "       with labels textcolor rgb '{}' font ',11' noenhanced notitle",
        separator, data, dark, dark == 1 ? "#ffffff" : "#1b1b1b");
    separator = ", \\\n";
  }
  if (!map.theory.empty()) {
    CsvRows line({"x", "y"});
    for (const auto& [at, border] : map.theory) line.add({at, border});
    files.emplace_back(name + "-theory.csv", line.text());
    script += fmt::format(
        ", \\\n     {0} using 'x':'y' with lines lw 5 lc rgb '#ffffff' notitle, \\\n"
        "     {0} using 'x':'y' with lines lw 2 dt (6,3) lc rgb '#000000' title {1}",
        gnuplot_text(name + "-theory.csv"),
        gnuplot_text(map.theory_name.empty() ? "theory" : map.theory_name));
  }
  return GnuplotChart{name, script + "\nunset output\n", std::move(files)};
}

}  // namespace

void add_precision_charts(const PrecisionScene& scene, std::set<std::string>& taken,
                          std::vector<GnuplotChart>& charts) {
  for (const std::string& quantity : drawn_quantities(scene))
    for (const Abscissa abscissa : {Abscissa::cpu_time, Abscissa::step})
      if (auto chart = error_chart(scene, quantity, abscissa, taken))
        charts.push_back(std::move(*chart));
}

void add_stability_charts(const LimitResults& limits, std::set<std::string>& taken,
                          std::vector<GnuplotChart>& charts) {
  for (const LimitGroup& group : limit_groups(limits.limits))
    if (auto chart = limit_chart(group, taken)) charts.push_back(std::move(*chart));
  for (const OutcomeMap& map : limits.maps)
    if (auto chart = map_chart(map, taken)) charts.push_back(std::move(*chart));
}

}  // namespace slipcheck
