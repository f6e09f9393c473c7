#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "figures/box_energy_balance.h"
#include "figures/box_runs.h"
#include "figures/columns.h"
#include "figures/paper_figure.h"

namespace slipcheck {
namespace {

/// One panel: K/R over one of a gas's parameters.
struct EnergyRatioSweep {
  const char* title;
  AxisSpec axis;
  std::vector<double> values;
  std::function<void(RoughGas&, double)> set;
};

/// Equal spheres of that gas at V = 1 m/s; walls and floor elastic and smooth, or as the spheres.
VibratedBox box_of(const RoughGas& gas, bool rough_walls) {
  VibratedBox box;
  box.spread = 0;
  box.shape_factor = gas.shape_factor;
  box.pair = PairContact{gas.restitution, gas.friction, gas.tangential_restitution};
  if (rough_walls) box.floor = box.wall = box.pair;
  return box;
}

constexpr Look kLook15{Ink::blue, Line::solid}, kLookChaos{Ink::vermilion, Line::dashed};

}  // namespace

PaperFigure figure_box_energy_ratio(Effort effort) {
  const std::vector<EnergyRatioSweep> sweeps = {
      {"(a) q = 2/5, β_0 = 0",
       {"μ [-]", true, 0.02, 2},
       {0.03, 0.06, 0.1, 0.2, 0.35, 0.6, 1},
       [](RoughGas& gas, double mu) { gas.friction = mu; }},
      {"(b) q = 2/5, μ = 0.5",
       {"β_0 [-]", false, -0.7, 1.1},
       {-0.6, -0.3, 0, 0.3, 0.6, 1},
       [](RoughGas& gas, double beta) { gas.tangential_restitution = beta; }},
      {"(c) μ = 0.5, β_0 = 0",
       {"q [-]", true, 0.08, 1.25},
       {0.1, 0.2, 0.4, 0.5, 2.0 / 3, 1},
       [](RoughGas& gas, double q) { gas.shape_factor = q; }}};

  std::vector<RoughGas> gases;
  for (const EnergyRatioSweep& sweep : sweeps)
    for (double value : sweep.values) sweep.set(gases.emplace_back(), value);
  std::vector<VibratedBox> boxes;
  for (bool rough_walls : {false, true})
    for (const RoughGas& gas : gases) boxes.push_back(box_of(gas, rough_walls));
  const std::vector<BoxMeans> runs = run_boxes(boxes, times_longer(effort));
  const std::span smooth = std::span(runs).first(gases.size());
  const std::span rough = std::span(runs).last(gases.size());

  PaperFigure figure;
  figure.name = "box-energy-ratio";
  figure.title = "Energies of translation and rotation beside molecular chaos";
  std::vector<double> mu, beta, q, by_15, by_chaos, by_sticking, over_chaos, over_15;
  for (std::size_t k = 0; k < gases.size(); ++k) {
    mu.push_back(gases[k].friction);
    beta.push_back(gases[k].tangential_restitution);
    q.push_back(gases[k].shape_factor);
    by_15.push_back(gases[k].ratio_15());
    by_chaos.push_back(gases[k].ratio_of_chaos());
    by_sticking.push_back(gases[k].ratio_of_sticking_chaos());
    over_chaos.push_back(smooth[k].ratio / by_chaos.back());
    over_15.push_back(smooth[k].ratio / by_15.back());
  }
  figure.table.add("mu [-]", mu);
  figure.table.add("beta0 [-]", beta);
  figure.table.add("q [-]", q);
  const auto add = [&](std::span<const BoxMeans> seen, const std::string& where) {
    figure.table.add("K/R " + where + " [-]", column(seen, &BoxMeans::ratio));
    figure.table.add("standard error of K/R " + where + " [-]",
                     column(seen, &BoxMeans::ratio_error));
  };
  add(smooth, "smooth walls");
  add(rough, "rough walls");
  figure.table.add("K/R (15) [-]", by_15);
  figure.table.add("K/R molecular chaos [-]", by_chaos);
  figure.table.add("K/R molecular chaos, all stick [-]", by_sticking);

  std::size_t first = 0;
  for (const EnergyRatioSweep& sweep : sweeps) {
    Panel panel{sweep.title, sweep.axis, {"K/R [-]", true}};
    const double low = *sweep.axis.low, high = std::min(*sweep.axis.high, 2.0);
    std::vector<double> fine_15, fine_chaos;
    const std::vector<double> fine =
        sweep.axis.logarithmic ? logarithmically_spaced(low, high, 31) : equally_spaced(low, 1, 31);
    for (double value : fine) {
      RoughGas gas;
      sweep.set(gas, value);
      fine_15.push_back(gas.ratio_15());
      fine_chaos.push_back(gas.ratio_of_chaos());
    }
    const auto named = [&](const char* name) { return first == 0 ? name : ""; };
    panel.curves = {{named("(15)"), kLook15, fine, fine_15},
                    {named("molecular chaos"), kLookChaos, fine, fine_chaos}};
    const auto draw = [&](std::span<const BoxMeans> all, const Look& look, const char* name) {
      const std::span seen = all.subspan(first, sweep.values.size());
      const std::vector<double> ratio = column(seen, &BoxMeans::ratio);
      panel.curves.push_back(
          error_bars(look.ink, sweep.values, ratio, column(seen, &BoxMeans::ratio_error)));
      panel.curves.push_back({named(name), look, sweep.values, ratio});
    };
    draw(smooth, {Ink::black, Line::none, Marker::circle}, "smooth elastic floor and walls");
    draw(rough, {Ink::green, Line::none, Marker::square}, "floor and walls as the spheres");
    figure.panels.push_back(panel);
    first += sweep.values.size();
  }
  const auto [least, most] = std::ranges::minmax(over_chaos);
  const auto [least_15, most_15] = std::ranges::minmax(over_15);
  figure.caption = fmt::format(
      "50 equal spheres in a box 10 d_0 wide (d_0 = 1 mm, f = 100 Hz, V = 1 m/s), e = 0.9; K and R "
      "at phase zero, bars are standard errors. L (15) is (2/q + 1/μ)/(1 + β_0). Molecular chaos: "
      "collisions of Maxwellian, independent velocities and spins keep R as it is; it has no free "
      "parameter, and where all stick is (2/q)(1 + 2q − β_0)/(1 + β_0). With smooth elastic walls "
      "K/R is {:.2f} to {:.2f} of it, and {:.2f} to {:.2f} of (15).",
      least, most, least_15, most_15);
  figure.notes =
      "A collision adds −P_t S + P_t²/(q m) to the energy of rotation, S = R(ω1 + ω2); its mean "
      "over "
      "the collisions of a gas without correlations vanishes at one K/R (box_energy_balance.h). "
      "(15) is low by a factor that is no constant:\n\n"
      "| μ | β0 | q | K/R, smooth walls | over (15) | over chaos | K/R, rough walls | over (15) |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (std::size_t k = 0; k < gases.size(); ++k)
    figure.notes +=
        fmt::format("| {:g} | {:g} | {:.3g} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n",
                    mu[k], beta[k], q[k], smooth[k].ratio, over_15[k], over_chaos[k],
                    rough[k].ratio, rough[k].ratio / by_15[k]);
  return figure;
}

}  // namespace slipcheck
