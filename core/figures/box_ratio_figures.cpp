#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "figures/box_energy_balance.h"
#include "figures/box_runs.h"
#include "figures/columns.h"
#include "figures/paper_figure.h"

namespace slipcheck {
namespace {

/// K/R over one of the parameters.
struct Sweep {
  int number = 0;  ///< in the paper
  const char* title = "";
  const char* symbol = "";  ///< in the table, without signs of its own
  AxisSpec axis;
  std::vector<double> values;  ///< of the runs
  double low = 0, high = 0;    ///< of the formulas' curves
  std::function<void(RoughGas&, double)> set;
  const char* held = "";  ///< the parameters that stay, for the caption
};

constexpr Look kFormula15{Ink::blue, Line::solid};
constexpr Look kChaos{Ink::vermilion, Line::dashed};
constexpr Look kSmoothWalls{Ink::black, Line::none, Marker::circle};
constexpr Look kRoughWalls{Ink::green, Line::none, Marker::square};

/// The box of that gas; walls and floor either elastic and smooth or as the spheres.
VibratedBox box_of(const RoughGas& gas, bool rough_walls) {
  VibratedBox box;
  box.shape_factor = gas.shape_factor;
  box.set_contacts(gas.restitution, gas.friction, gas.tangential_restitution);
  if (!rough_walls) box.floor = box.wall = PairContact{1.0, 0, 0};
  return box;
}

PaperFigure ratio_figure(const Sweep& sweep) {
  const auto gas_at = [&](double value) {
    RoughGas gas;
    sweep.set(gas, value);
    return gas;
  };
  std::vector<VibratedBox> boxes;
  for (bool rough_walls : {false, true})
    for (double value : sweep.values) boxes.push_back(box_of(gas_at(value), rough_walls));
  const std::vector<BoxMeans> runs = run_boxes(boxes);
  const std::span smooth = std::span(runs).first(sweep.values.size());
  const std::span rough = std::span(runs).last(sweep.values.size());

  std::vector<double> by_15, by_chaos, by_sticking;
  for (double value : sweep.values) {
    const RoughGas gas = gas_at(value);
    by_15.push_back(gas.ratio_15());
    by_chaos.push_back(gas.ratio_of_chaos());
    by_sticking.push_back(gas.ratio_of_sticking_chaos());
  }
  const std::vector<double> fine = sweep.axis.logarithmic
                                       ? logarithmically_spaced(sweep.low, sweep.high, 31)
                                       : equally_spaced(sweep.low, sweep.high, 31);
  std::vector<double> fine_15, fine_chaos, fine_quotient;
  for (double value : fine) {
    const RoughGas gas = gas_at(value);
    fine_15.push_back(gas.ratio_15());
    fine_chaos.push_back(gas.ratio_of_chaos());
    fine_quotient.push_back(fine_chaos.back() / fine_15.back());
  }

  PaperFigure figure;
  figure.name = fmt::format("L{}", sweep.number);
  figure.title = sweep.title;
  figure.table.add(fmt::format("{} [-]", sweep.symbol), sweep.values);
  Panel a{"(a) energies of translation and rotation", sweep.axis, {"K/R [-]", true}};
  Panel b{"(b) over (15)", sweep.axis, {"(K/R)/(15) [-]", false, 0.5, 2.1}};
  a.curves = {{"(15)", kFormula15, fine, fine_15}, {"molecular chaos", kChaos, fine, fine_chaos}};
  b.curves = {{"", kChaos, fine, fine_quotient},
              {"the paper's 1.3 ± 0.2",
               {Ink::grey, Line::dotted},
               {fine.front(), fine.back(), NAN, fine.front(), fine.back()},
               {1.1, 1.1, NAN, 1.5, 1.5}}};
  const auto add = [&](std::span<const BoxMeans> seen, const char* label, const char* where,
                       const Look& look) {
    const std::vector<double> ratio = column(seen, &BoxMeans::ratio);
    const std::vector<double> error = column(seen, &BoxMeans::ratio_error);
    std::vector<double> quotient, quotient_error;
    for (std::size_t k = 0; k < ratio.size(); ++k) {
      quotient.push_back(ratio[k] / by_15[k]);
      quotient_error.push_back(error[k] / by_15[k]);
    }
    a.curves.push_back(error_bars(look.ink, sweep.values, ratio, error));
    a.curves.push_back({label, look, sweep.values, ratio});
    b.curves.push_back(error_bars(look.ink, sweep.values, quotient, quotient_error));
    b.curves.push_back({"", look, sweep.values, quotient});
    figure.table.add(fmt::format("K/R {} [-]", where), ratio);
    figure.table.add(fmt::format("standard error of K/R {} [-]", where), error);
    figure.table.add(fmt::format("K/R {} over (15) [-]", where), quotient);
    const auto [least, most] = std::ranges::minmax(quotient);
    return fmt::format("{:.2f} to {:.2f}", least, most);
  };
  const std::string range_smooth =
      add(smooth, "smooth elastic floor and walls", "smooth walls", kSmoothWalls);
  const std::string range_rough =
      add(rough, "floor and walls as the spheres", "rough walls", kRoughWalls);
  figure.table.add("K/R (15) [-]", by_15);
  figure.table.add("K/R molecular chaos [-]", by_chaos);
  figure.table.add("K/R molecular chaos, all stick [-]", by_sticking);
  figure.panels = {a, b};
  std::vector<double> over_chaos;
  for (std::size_t k = 0; k < by_chaos.size(); ++k)
    over_chaos.push_back(smooth[k].ratio / by_chaos[k]);
  const auto [least, most] = std::ranges::minmax(over_chaos);
  figure.caption = fmt::format(
      "50 spheres in a box 10 d_0 wide (d_0 = 1 mm, f = 100 Hz, V = 1 m/s), e = 0.9, {}; K and R "
      "at phase zero, bars are standard errors. (15) is (2/q + 1/μ)/(1 + β_0); K/R over it is {} "
      "with smooth elastic floor and walls, {} with floor and walls as the spheres, and by the "
      "paper 1.3 ± 0.2. Molecular chaos: collisions of Maxwellian, independent velocities and "
      "spins keep R as it is; where all stick that is (2/q)(1 + 2q − β_0)/(1 + β_0). With smooth "
      "elastic walls K/R is {:.2f} to {:.2f} of it. L Fig. {}.",
      sweep.held, range_smooth, range_rough, least, most, sweep.number);
  return figure;
}

}  // namespace

PaperFigure figure_l7() {
  Sweep sweep;
  sweep.number = 7;
  sweep.title = "Energies of translation and rotation over the friction";
  sweep.symbol = "mu";
  sweep.axis = {"μ [-]", true, 0.02, 2};
  sweep.values = {0.03, 0.06, 0.1, 0.2, 0.35, 0.6, 1};
  sweep.low = 0.02, sweep.high = 2;
  sweep.set = [](RoughGas& gas, double mu) { gas.friction = mu; };
  sweep.held = "q = 2/5, β_0 = 0";
  return ratio_figure(sweep);
}

PaperFigure figure_l8() {
  Sweep sweep;
  sweep.number = 8;
  sweep.title = "Energies of translation and rotation over β_0";
  sweep.symbol = "beta0";
  sweep.axis = {"β_0 [-]", false, -0.7, 1.1};
  sweep.values = {-0.6, -0.3, 0, 0.3, 0.6, 1};
  sweep.low = -0.7, sweep.high = 1;
  sweep.set = [](RoughGas& gas, double beta) { gas.tangential_restitution = beta; };
  sweep.held = "q = 2/5, μ = 0.5";
  return ratio_figure(sweep);
}

PaperFigure figure_l9() {
  Sweep sweep;
  sweep.number = 9;
  sweep.title = "Energies of translation and rotation over the shape factor";
  sweep.symbol = "q";
  sweep.axis = {"q [-]", true, 0.08, 1.25};
  sweep.values = {0.1, 0.2, 0.4, 0.5, 2.0 / 3, 1};
  sweep.low = 0.08, sweep.high = 1.25;
  sweep.set = [](RoughGas& gas, double q) { gas.shape_factor = q; };
  sweep.held = "μ = 0.5, β_0 = 0";
  return ratio_figure(sweep);
}

}  // namespace slipcheck
