#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "figures/box_fits.h"
#include "figures/box_runs.h"
#include "figures/columns.h"
#include "figures/paper_figure.h"

namespace slipcheck {
namespace {

// L's ranges of V [m/s]; the slowest speed, 0.1, is drawn and not fitted.
constexpr double kSlowest = 0.1, kFastest = 10, kCrossover = 1;
constexpr double kFitted = 0.12;

/// What "2" and "3/2" may differ by: the scatter that L gives for δ in Fig. 13.
constexpr double kDeltaScatter = 0.10;
constexpr const char* kDeltaRemark = "Allowed: the 0.10 by which L's own δ of Fig. 13 scatter.";
/// One kind of box, at all speeds.
struct HeightCurve {
  std::string label, name;  ///< in the legend and in the table
  VibratedBox box;
  Ink ink = Ink::black;
  Marker marker = Marker::circle;
  double longer = 1;  ///< its runs than those of the other curves
};

/// The runs of one curve and what they are fitted with.
struct HeightRuns {
  std::vector<double> speed;
  std::vector<BoxMeans> runs;
  HeightLaw below, above, all;  ///< V <= 1 m/s, V >= 1 m/s, and both

  std::span<const BoxMeans> between(double least, double most) const {
    std::size_t first = 0, count = 0;
    for (double v : speed) {
      if (v < least * 0.999) ++first;
      if (v >= least * 0.999 && v <= most * 1.001) ++count;
    }
    return std::span(runs).subspan(first, count);
  }
};

/// The exponent between points two apart, about the middle one.
struct LocalSlopes {
  std::vector<double> speed, slope, error;
};

LocalSlopes local_slopes(const HeightRuns& seen) {
  LocalSlopes local;
  for (std::size_t k = 1; k + 1 < seen.speed.size(); ++k) {
    const Measured rise = ratio_of(height_of(seen.runs[k + 1]), height_of(seen.runs[k - 1]));
    const double step = std::log(seen.speed[k + 1] / seen.speed[k - 1]);
    local.speed.push_back(seen.speed[k]);
    local.slope.push_back(std::log(rise.value) / step);
    local.error.push_back(rise.error / rise.value / step);
  }
  return local;
}

/// A line of that slope through (V, H) = (1 m/s, `height` [mm]).
Curve slope_line(const std::string& label, double slope, double height, double from, Line line) {
  return {label,
          {Ink::grey, line},
          {from, kFastest},
          {height * std::pow(from, slope), height * std::pow(kFastest, slope)}};
}

PaperFigure height_figure(const char* name, const char* title,
                          const std::vector<HeightCurve>& curves, Effort effort,
                          std::vector<HeightRuns>& seen) {
  const std::vector<double> speed =
      logarithmically_spaced(kSlowest, kFastest, effort == Effort::full ? 17 : 9);
  for (const HeightCurve& curve : curves) {
    std::vector<VibratedBox> boxes;
    for (double v : speed) {
      boxes.push_back(curve.box);
      boxes.back().speed = v;
    }
    HeightRuns& one = seen.emplace_back();
    one.speed = speed;
    one.runs = run_boxes(boxes, times_longer(effort) * curve.longer);
    one.below = fit_heights(speed, one.runs, kFitted, kCrossover);
    one.above = fit_heights(speed, one.runs, kCrossover);
    one.all = fit_heights(speed, one.runs, kFitted);
  }

  PaperFigure figure;
  figure.name = name;
  figure.title = title;
  figure.table.add("V [m/s]", speed);
  const AxisSpec axis{"V [m/s]", true, 0.08, 12.5};
  Panel a{"(a) height of the centre of mass", axis, {"H [m]", true}};
  Panel b{"(b) exponent about V", axis, {"δ [-]", false, 0.5, 2.5}};
  b.curves.push_back({"", {Ink::grey, Line::dotted}, {0.08, 12.5}, {1.5, 1.5}});
  b.curves.push_back({"", {Ink::grey, Line::dotted}, {0.08, 12.5}, {2, 2}});
  for (std::size_t n = 0; n < curves.size(); ++n) {
    const HeightCurve& curve = curves[n];
    const HeightRuns& one = seen[n];
    const Look look{curve.ink, Line::none, curve.marker};
    const std::vector<double> height = column(one.runs, &BoxMeans::height);
    const std::vector<double> error = column(one.runs, &BoxMeans::height_error);
    a.curves.push_back(error_bars(curve.ink, speed, height, error));
    a.curves.push_back({curve.label, look, speed, height});
    const LocalSlopes local = local_slopes(one);
    b.curves.push_back(error_bars(curve.ink, local.speed, local.slope, local.error));
    b.curves.push_back({"", {curve.ink, Line::solid, curve.marker}, local.speed, local.slope});
    std::vector<double> steady;
    for (const BoxMeans& run : one.runs) steady.push_back(run.steady ? 1 : 0);
    figure.table.add("H " + curve.name + " [mm]", scaled(height, 1e3));
    figure.table.add("standard error of H " + curve.name + " [mm]", scaled(error, 1e3));
    figure.table.add("steady " + curve.name + " [-]", steady);
    const auto add = [&](const std::string& what, const Measured& of) {
      figure.table.add(what + " " + curve.name + " [-]", std::vector(speed.size(), of.value));
      figure.table.add("standard error of " + what + " " + curve.name + " [-]",
                       std::vector(speed.size(), of.error));
    };
    add("delta from 1 m/s", one.above.exponent());
    add("delta to 1 m/s", one.below.exponent());
    add("delta", one.all.exponent());
    add("weighted delta", one.all.weighted_exponent());
  }
  b.marks = {{kCrossover, "1 m/s", true}};
  figure.panels = {a, b};
  return figure;
}

/// All exponents of a figure in a table of Markdown.
std::string exponent_notes(const std::vector<HeightCurve>& curves,
                           const std::vector<HeightRuns>& seen) {
  std::string text =
      "| δ | 0.1 < V ≤ 1 m/s | V ≥ 1 m/s | V > 0.1 m/s | weighted: ≤ 1 m/s | ≥ 1 m/s | > 0.1 m/s "
      "|\n|---|---|---|---|---|---|---|\n";
  for (std::size_t n = 0; n < curves.size(); ++n) {
    text += "| " + curves[n].name;
    for (const HeightLaw* law : {&seen[n].below, &seen[n].above, &seen[n].all})
      text += " | " + law->exponent().text();
    for (const HeightLaw* law : {&seen[n].below, &seen[n].above, &seen[n].all})
      text += " | " + law->weighted_exponent().text();
    text += " |\n";
  }
  text +=
      "\nThe paper's fits are of least squares in logarithms, all runs alike, as the first three "
      "columns; the errors come from the scatter about the line, which counts a bend. Weighted "
      "fits take H's standard errors. Over V > 0.1 m/s their χ² per degree of freedom, about 1 for "
      "a power law, is ";
  for (std::size_t n = 0; n < curves.size(); ++n)
    text += fmt::format("{}{:.3g}", n > 0 ? ", " : "", seen[n].all.weighted.chi2_per_degree);
  return text + ".";
}

/// δ of a power law that L gives as a simple fraction.
Statement delta_of(std::string what, const char* stated, double value, const Measured& seen,
                   std::string remark = kDeltaRemark) {
  return {std::move(what), stated,     value - kDeltaScatter, value + kDeltaScatter,
          seen.value,      seen.error, std::move(remark)};
}

const char* const kHeightSetting =
    "Boxes with an elastic smooth floor, f = 100 Hz, d_0 = 1 ± 0.1 mm, e = 0.9. H is the height of "
    "the centre of mass over that at rest, at phase zero; bars are standard errors.";

VibratedBox box_with(double friction, double wall, double wall_friction, bool moving = false) {
  VibratedBox box;
  box.pair.friction = friction;
  box.wall = PairContact{wall, wall_friction, 0.5};
  box.moving_walls = moving;
  return box;
}

}  // namespace

PaperFigure figure_l10(Effort effort) {
  const auto larger = [](std::size_t count, double width) {
    VibratedBox box = box_with(0.2, 1, 0);
    box.count = count;
    box.width = width;
    return box;
  };
  const std::vector<HeightCurve> curves = {
      {"(1) μ = 0, N = 50", "(1) mu = 0 N = 50", box_with(0, 1, 0), Ink::blue, Marker::circle},
      {"(2) μ = 0.2, N = 50", "(2) mu = 0.2 N = 50", box_with(0.2, 1, 0), Ink::vermilion,
       Marker::triangle},
      {"(3) μ = 0.2, N = 150", "(3) mu = 0.2 N = 150", larger(150, 30), Ink::green, Marker::square,
       1.0 / 3},
      {"(4) μ = 0.2, N = 250", "(4) mu = 0.2 N = 250", larger(250, 50), Ink::purple,
       Marker::diamond, 1.0 / 5}};
  std::vector<HeightRuns> seen;
  PaperFigure figure = height_figure("L10", "Height over the floor's speed: friction and size",
                                     curves, effort, seen);
  figure.panels[0].curves.push_back(
      slope_line("δ = 2", 2, 1.3 * seen[0].above.plain.factor, 1, Line::dashed));
  for (std::size_t n = 0; n < curves.size(); ++n)
    figure.statements.push_back(delta_of("δ for V ≥ 1 m/s, curve " + curves[n].name + " [-]",
                                         "about 2", 2, seen[n].above.exponent()));
  const Measured lowered = height_ratio(seen[1].runs, seen[0].runs);
  figure.statements.push_back({"H with μ = 0.2 over that with μ = 0, mean over V [-]", "reduced", 0,
                               1, lowered.value, lowered.error});
  std::string sizes;
  for (std::size_t n : {2u, 3u}) {
    const Measured ratio = height_ratio(seen[n].runs, seen[1].runs);
    figure.statements.push_back(equal_heights(
        fmt::format("H with N = {} over that with 50, mean over V [-]", curves[n].box.count),
        "no dependence", ratio));
    sizes += fmt::format("{}{}", n > 2 ? " and " : "", ratio.text());
  }
  figure.caption = fmt::format(
      "{} Elastic smooth walls, β_0 = 0.5; N = 50, 150 and 250 spheres in boxes 10, 30 and 50 d_0 "
      "wide. (a) From 1 m/s on δ = {}, {}, {} and {}; the paper has about 2. H with N = 150 and "
      "250 "
      "is {} of that with 50. (b) The slope between points two apart. L Fig. 10.",
      kHeightSetting, seen[0].above.exponent().text(), seen[1].above.exponent().text(),
      seen[2].above.exponent().text(), seen[3].above.exponent().text(), sizes);
  figure.notes = exponent_notes(curves, seen);
  return figure;
}

PaperFigure figure_l11(Effort effort) {
  const std::vector<HeightCurve> curves = {
      {"(1) e_w = 1, μ_w = 0", "(1) e_w = 1 mu_w = 0", box_with(0.2, 1, 0), Ink::blue,
       Marker::circle},
      {"(2) e_w = 0.9, μ_w = 0", "(2) e_w = 0.9 mu_w = 0", box_with(0.2, 0.9, 0), Ink::vermilion,
       Marker::triangle},
      {"(3) e_w = 0.9, μ_w = 0.2", "(3) e_w = 0.9 mu_w = 0.2", box_with(0.2, 0.9, 0.2), Ink::green,
       Marker::square}};
  std::vector<HeightRuns> seen;
  PaperFigure figure =
      height_figure("L11", "Height over the floor's speed: walls at rest", curves, effort, seen);
  const double at_one = seen[0].above.plain.factor;
  figure.panels[0].curves.push_back(slope_line("δ = 3/2", 1.5, at_one, 0.15, Line::dotted));
  figure.panels[0].curves.push_back(slope_line("δ = 2", 2, at_one, 0.6, Line::dash_dot));

  // Where the power laws far below and far above 1 m/s meet.
  const HeightLaw slow = fit_heights(seen[0].speed, seen[0].runs, kFitted, 0.6);
  const HeightLaw fast = fit_heights(seen[0].speed, seen[0].runs, 1.7);
  const double turn = fast.exponent().value - slow.exponent().value;
  const double crossing = std::pow(slow.plain.factor / fast.plain.factor, 1 / turn);
  const double uncertain = std::hypot(slow.weighted.factor_error / slow.weighted.factor,
                                      fast.weighted.factor_error / fast.weighted.factor) /
                           turn * crossing;
  const Measured same = height_ratio(seen[1].between(0.12, 0.99), seen[0].between(0.12, 0.99));
  const Measured lowered_slow =
      ratio_of(height_of(seen[2].runs.front()), height_of(seen[1].runs.front()));
  const Measured lowered_fast =
      ratio_of(height_of(seen[2].runs.back()), height_of(seen[1].runs.back()));
  const Measured further = ratio_of(lowered_fast, lowered_slow);
  VibratedBox moving = curves[1].box;
  moving.moving_walls = true;
  const std::vector<BoxMeans> moved = run_boxes(std::span(&moving, 1), times_longer(effort));
  const LocalSlopes local = local_slopes(seen[2]);
  const Measured first{local.slope.front(), local.error.front()};
  const Measured last{local.slope.back(), local.error.back()};
  figure.statements = {
      delta_of("δ for V > 0.1 m/s, curve (2) [-]", "3/2", 1.5, seen[1].all.exponent()),
      delta_of("δ for V ≤ 1 m/s, curve (1) [-]", "3/2", 1.5, seen[0].below.exponent()),
      delta_of("δ for V ≥ 1 m/s, curve (1) [-]", "2", 2, seen[0].above.exponent()),
      {"V where the laws of curve (1) below 0.6 and above 1.7 m/s meet [m/s]", "about 1", 0.5, 1.5,
       crossing, uncertain},
      equal_heights("H of (2) over (1), mean over 0.1 < V < 1 m/s [-]", "e_w changes nothing",
                    same),
      equal_heights("H of (2) with moving walls over that with walls at rest, V = 1 m/s [-]",
                    "no difference", height_ratio(moved, seen[1].between(1, 1))),
      {"H of (3) over (2) at V = 10 m/s over the same at 0.1 m/s [-]", "more and more reduced", 0,
       1, further.value, further.error},
      {"slope of (3) at the fast end less that at the slow end [-]", "not constant", -INFINITY, 0,
       last.value - first.value, std::hypot(first.error, last.error)}};
  figure.caption = fmt::format(
      "{} N = 50, 10 d_0 wide, μ = 0.2, β_0 = 0.5; walls at rest, elastic and smooth (1), "
      "dissipative (2), dissipative and rough (3), β_{{0w}} = 0.5. (a) δ of (1) is {} up to 1 m/s "
      "and {} from there on, the paper's 3/2 and 2; δ of (2) is {} over all V > 0.1 m/s, the "
      "paper's 3/2. (b) The slope between points two apart: that of (3) falls from {} to {}. "
      "L Fig. 11.",
      kHeightSetting, seen[0].below.exponent().text(), seen[0].above.exponent().text(),
      seen[1].all.exponent().text(), first.text(), last.text());
  figure.notes = exponent_notes(curves, seen);
  return figure;
}

PaperFigure figure_l12(Effort effort) {
  const std::vector<HeightCurve> curves = {
      {"(1) moving, μ_w = 0.2", "(1) moving mu_w = 0.2", box_with(0.2, 0.9, 0.2, true), Ink::blue,
       Marker::circle},
      {"(2) moving, μ_w = 0.5", "(2) moving mu_w = 0.5", box_with(0.2, 0.9, 0.5, true),
       Ink::vermilion, Marker::triangle},
      {"(3) at rest, μ_w = 0.2", "(3) at rest mu_w = 0.2", box_with(0.2, 0.9, 0.2), Ink::green,
       Marker::square}};
  std::vector<HeightRuns> seen;
  PaperFigure figure = height_figure("L12", "Height over the floor's speed: rough moving walls",
                                     curves, effort, seen);
  std::vector<double> speed = seen[0].speed;
  speed.insert(speed.end(), seen[1].speed.begin(), seen[1].speed.end());
  std::vector<BoxMeans> runs = seen[0].runs;
  runs.insert(runs.end(), seen[1].runs.begin(), seen[1].runs.end());
  const HeightLaw both = fit_heights(speed, runs, kFitted);
  figure.panels[0].curves.push_back(slope_line("(4) δ = " + both.exponent().text(),
                                               both.exponent().value, both.plain.factor, kSlowest,
                                               Line::solid));
  const Measured fit = both.exponent();
  figure.table.add("delta of both [-]", std::vector(seen[0].speed.size(), fit.value));
  figure.table.add("standard error of delta of both [-]",
                   std::vector(seen[0].speed.size(), fit.error));
  figure.statements = {stated_number("δ of (1) and (2) together, V > 0.1 m/s [-]", "1.33", 1.33,
                                     0.005, fit.value, fit.error),
                       {"δ of (1), V > 0.1 m/s [-]", "1.3 to 1.4, the experiment's", 1.3, 1.4,
                        seen[0].all.exponent().value, seen[0].all.exponent().error},
                       {"δ of (2), V > 0.1 m/s [-]", "1.3 to 1.4, the experiment's", 1.3, 1.4,
                        seen[1].all.exponent().value, seen[1].all.exponent().error}};
  const auto [flattest, steepest] = std::ranges::minmax(local_slopes(seen[0]).slope);
  figure.caption = fmt::format(
      "{} N = 50, 10 d_0 wide, e = e_w = 0.9, μ = 0.2, β_0 = β_{{0w}} = 0.5; rough walls that move "
      "with the floor (1), (2) and that rest (3), as (3) of Fig. 11. (a) One law for (1) and (2), "
      "V "
      "> 0.1 m/s: δ = {}, the paper's 1.33; {} and {} for each alone. (b) The slope between points "
      "two apart; that of (1) lies between {:.2f} and {:.2f}. L Fig. 12.",
      kHeightSetting, fit.text(), seen[0].all.exponent().text(), seen[1].all.exponent().text(),
      flattest, steepest);
  figure.notes =
      exponent_notes(curves, seen) +
      fmt::format("\n\n(1) and (2) together, weighted: δ = {}.", both.weighted_exponent().text());
  return figure;
}

}  // namespace slipcheck
