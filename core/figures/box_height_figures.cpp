#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "figures/box_runs.h"
#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "harness/compare/power_law.h"

namespace slipcheck {
namespace {

constexpr double kFast = 1;  ///< [m/s]: the exponents' second range begins here

/// One kind of box, at all speeds.
struct Kind {
  std::string label, name;  ///< in the legend and in the table
  VibratedBox box;
  Ink ink = Ink::black;
  Marker marker = Marker::circle;
};

struct Fit {
  PowerLaw law;
  double exponent() const { return law.exponent[0]; }
  std::string text() const {
    return fmt::format("{:.2f} ± {:.2f}", law.exponent[0], law.exponent_error[0]);
  }
};

/// H = c V^δ over the speeds from `slowest` [m/s] on.
Fit fit_from(double slowest, const std::vector<double>& speed, std::span<const BoxMeans> runs) {
  std::vector<double> v, h, error;
  for (std::size_t k = 0; k < speed.size(); ++k) {
    if (speed[k] < slowest * (1 - 1e-9)) continue;
    v.push_back(speed[k]);
    h.push_back(runs[k].height);
    error.push_back(runs[k].height_error);
  }
  return {fit_power_law(v, h, error)};
}

PaperFigure height_figure(const std::string& name, const std::string& title,
                          const std::vector<Kind>& kinds, double papers, const std::string& text) {
  // Four points below 1 m/s and seven from there on.
  std::vector<double> speed = logarithmically_spaced(0.3, 1, 5);
  speed.pop_back();
  for (double v : logarithmically_spaced(kFast, 5, 7)) speed.push_back(v);
  std::vector<VibratedBox> boxes;
  for (const Kind& kind : kinds)
    for (double v : speed) {
      boxes.push_back(kind.box);
      boxes.back().speed = v;
    }
  const std::vector<BoxMeans> runs = run_boxes(boxes);

  PaperFigure figure;
  figure.name = name;
  figure.title = title;
  figure.table.add("V [m/s]", speed);
  const AxisSpec axis{"V [m/s]", true, 0.25, 6};
  Panel a{"(a) height of the centre of mass", axis, {"H [mm]", true}};
  Panel b{"(b) over the fit for V ≥ 1 m/s", axis, {"H/(c V^δ) [-]"}};
  std::string exponents;
  for (std::size_t n = 0; n < kinds.size(); ++n) {
    const Kind& kind = kinds[n];
    const std::span seen = std::span(runs).subspan(n * speed.size(), speed.size());
    const Fit whole = fit_from(0, speed, seen), fast = fit_from(kFast, speed, seen);
    std::vector<double> fitted, over, over_error, steady;
    for (std::size_t k = 0; k < speed.size(); ++k) {
      fitted.push_back(fast.law({speed[k]}) / 1e-3);
      over.push_back(seen[k].height / 1e-3 / fitted.back());
      over_error.push_back(seen[k].height_error / 1e-3 / fitted.back());
      steady.push_back(seen[k].steady ? 1 : 0);
    }
    const std::vector<double> height = scaled(column(seen, &BoxMeans::height), 1e3);
    const std::vector<double> error = scaled(column(seen, &BoxMeans::height_error), 1e3);
    a.curves.push_back({"", {kind.ink, Line::dashed}, speed, fitted});
    a.curves.push_back(error_bars(kind.ink, speed, height, error));
    a.curves.push_back(
        {kind.label + ", δ = " + fast.text(), {kind.ink, Line::none, kind.marker}, speed, height});
    b.curves.push_back(error_bars(kind.ink, speed, over, over_error));
    b.curves.push_back({"", {kind.ink, Line::none, kind.marker}, speed, over});
    b.marks = {{kFast, "1 m/s", true}};

    const std::string of = kind.name.empty() ? "" : " " + kind.name;
    const auto constant = [&](double value) { return std::vector<double>(speed.size(), value); };
    figure.table.add("H" + of + " [mm]", height);
    figure.table.add("standard error of H" + of + " [mm]", error);
    figure.table.add("steady" + of + " [-]", steady);
    figure.table.add("delta from 1 m/s" + of + " [-]", constant(fast.exponent()));
    figure.table.add("standard error of delta from 1 m/s" + of + " [-]",
                     constant(fast.law.exponent_error[0]));
    figure.table.add("delta from 0.3 m/s" + of + " [-]", constant(whole.exponent()));
    figure.table.add("standard error of delta from 0.3 m/s" + of + " [-]",
                     constant(whole.law.exponent_error[0]));
    if (seen.front().ratio < INFINITY) figure.table.add("K/R [-]", column(seen, &BoxMeans::ratio));
    exponents +=
        fmt::format("{}δ = {} for V ≥ 1 m/s and {} over all V{}", n > 0 ? "; " : "", fast.text(),
                    whole.text(), kinds.size() > 1 ? " (" + kind.label + ")" : "");
  }
  figure.table.add("delta of the paper [-]", std::vector<double>(speed.size(), papers));
  figure.panels = {a, b};
  figure.caption = fmt::format(
      "50 spheres in a box 10 d_0 wide (d_0 = 1 mm, f = 100 Hz), {}. H is the height of the centre "
      "of mass over that at rest, at phase zero; bars are standard errors. (a) Dashed: H = c V^δ "
      "fitted to V ≥ 1 m/s. {}; in the paper δ = {:g}. (b) What the fit leaves over. L Fig. {}.",
      text, exponents, papers, name.substr(1));
  return figure;
}

VibratedBox smooth_box(double floor, double wall) {
  VibratedBox box;
  box.floor = PairContact{floor, 0, 0};
  box.wall = PairContact{wall, 0, 0};
  return box;
}

}  // namespace

PaperFigure figure_l10() {
  return height_figure("L10", "Height over the floor's speed: elastic smooth walls",
                       {{"e = 0.9", "", smooth_box(1, 1)}}, 2,
                       "smooth; two spheres restitute e = 0.9, floor and walls 1");
}

PaperFigure figure_l11() {
  return height_figure("L11", "Height over the floor's speed: dissipative smooth walls",
                       {{"floor and walls 0.9", "floor and walls 0.9", smooth_box(0.9, 0.9)},
                        {"walls 0.9, floor 1", "walls 0.9 floor 1", smooth_box(1, 0.9),
                         Ink::vermilion, Marker::triangle}},
                       1.5, "smooth; two spheres restitute e = 0.9, and so do the walls");
}

PaperFigure figure_l12() {
  VibratedBox box;
  box.set_contacts(0.9, 0.2, 0);
  box.moving_walls = true;
  return height_figure("L12", "Height over the floor's speed: rough moving walls",
                       {{"e = 0.9, μ = 0.2, β_0 = 0", "", box}}, 1.33,
                       "all contacts with e = 0.9, μ = 0.2, β_0 = 0, the walls moving with the "
                       "floor");
}

}  // namespace slipcheck
