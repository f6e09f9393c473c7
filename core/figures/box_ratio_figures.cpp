#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "figures/box_energy_balance.h"
#include "figures/box_fits.h"
#include "figures/box_runs.h"
#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "harness/observe/box_observer.h"

namespace slipcheck {
namespace {

constexpr double kTwoG = 2 * 9.81;  // [m/s²]

/// A floor that one of a figure's curves belongs to.
struct ShakenSet {
  double speed, frequency;  ///< V [m/s], f [Hz]
  Look look;

  std::string text() const { return fmt::format("V = {:g} m/s, f = {:g} Hz", speed, frequency); }
};

constexpr ShakenSet kFast{1.57, 100, {Ink::blue, Line::none, Marker::circle}};
constexpr ShakenSet kSlow{0.314, 100, {Ink::green, Line::none, Marker::square}};

/// H, K/R and K/H over one of the parameters.
struct BoxSweep {
  const char* name;
  const char* title;
  const char* symbol;  ///< in the table, without signs of its own
  AxisSpec axis;
  std::vector<double> values;  ///< of the runs
  std::vector<ShakenSet> sets;
  std::function<void(VibratedBox&, double)> set;
  const char* held;  ///< the parameters that stay, for the caption

  std::size_t index(double value) const {
    return static_cast<std::size_t>(std::ranges::find(values, value) - values.begin());
  }
};

/// What was run, by set and value.
struct SweptBoxes {
  std::vector<std::vector<BoxMeans>> runs;
  std::vector<std::vector<Measured>> over_15;  ///< K/R over (15); none where nothing spins
};

RoughGas gas_of(const VibratedBox& box) {
  return {std::get<double>(box.pair.restitution), std::get<double>(box.pair.friction),
          box.pair.tangential_restitution, box.shape_factor};
}

Measured ratio_seen(const BoxMeans& run) { return {run.ratio, run.ratio_error}; }
Measured kinetic_share(const BoxMeans& run) { return {run.kinetic_share, run.kinetic_share_error}; }

/// Runs everything; leaves statements and notes to the figure.
PaperFigure swept(const BoxSweep& sweep, Effort effort, SweptBoxes& seen) {
  const auto box_at = [&](double value, const ShakenSet& set) {
    VibratedBox box;
    box.speed = set.speed;
    box.frequency = set.frequency;
    sweep.set(box, value);
    return box;
  };
  std::vector<VibratedBox> boxes;
  for (const ShakenSet& set : sweep.sets)
    for (double value : sweep.values) boxes.push_back(box_at(value, set));
  const std::vector<BoxMeans> runs = run_boxes(boxes, times_longer(effort));

  const auto ratio_15 = [&](double value) {
    const double ratio = gas_of(box_at(value, kSlow)).ratio_15();
    return ratio > 0 && std::isfinite(ratio) ? ratio : NAN;  // none at μ = 0, nor up to β0 = −1
  };
  const double low = *sweep.axis.low, high = *sweep.axis.high;
  const std::vector<double> fine = sweep.axis.logarithmic ? logarithmically_spaced(low, high, 61)
                                                          : equally_spaced(low, high, 61);
  std::vector<double> by_15, fine_15;
  for (double value : sweep.values) by_15.push_back(ratio_15(value));
  for (double value : fine) fine_15.push_back(ratio_15(value));

  PaperFigure figure;
  figure.name = sweep.name;
  figure.title = sweep.title;
  figure.table.add(fmt::format("{} [-]", sweep.symbol), sweep.values);
  figure.table.add("K/R (15) [-]", by_15);
  Panel a{"(a) height of the centre of mass", sweep.axis, {"H [mm]", true}};
  Panel b{"(b) energies of translation and rotation", sweep.axis, {"K/R [-]", true}};
  Panel c{"(c) kinetic energy over height", sweep.axis, {"K/H [m/s²]"}};
  Panel d{"(d) K/R over (15)", sweep.axis, {"(K/R)/(15) [-]", false, 0.7, 2.3}};
  b.curves.push_back({"(15)", {Ink::black, Line::solid}, fine, fine_15});
  c.curves.push_back({"2g", {Ink::grey, Line::dashed}, {low, high}, {kTwoG, kTwoG}});
  d.curves.push_back({"the paper's 1.3 ± 0.2",
                      {Ink::grey, Line::dotted},
                      {low, high, NAN, low, high},
                      {1.1, 1.1, NAN, 1.5, 1.5}});
  for (std::size_t n = 0; n < sweep.sets.size(); ++n) {
    const ShakenSet& set = sweep.sets[n];
    const std::span one = std::span(runs).subspan(n * sweep.values.size(), sweep.values.size());
    seen.runs.emplace_back(one.begin(), one.end());
    std::vector<Measured>& quotients = seen.over_15.emplace_back();
    std::vector<double> quotient, quotient_error;
    for (std::size_t k = 0; k < one.size(); ++k) {
      quotient.push_back(one[k].ratio / by_15[k]);
      quotient_error.push_back(one[k].ratio_error / by_15[k]);
      if (std::isfinite(quotient.back()))
        quotients.push_back({quotient.back(), quotient_error.back()});
    }
    const auto draw = [&](Panel& panel, const std::vector<double>& y,
                          const std::vector<double>& error, const std::string& label) {
      panel.curves.push_back(error_bars(set.look.ink, sweep.values, y, error));
      panel.curves.push_back({label, set.look, sweep.values, y});
    };
    const std::string of = fmt::format("V = {:g} f = {:g}", set.speed, set.frequency);
    const auto add = [&](const char* what, const char* unit, Panel& panel, double BoxMeans::*mean,
                         double BoxMeans::*error, double factor, const std::string& label) {
      const std::vector<double> y = scaled(column(one, mean), factor);
      const std::vector<double> bar = scaled(column(one, error), factor);
      draw(panel, y, bar, label);
      figure.table.add(fmt::format("{} {} [{}]", what, of, unit), y);
      figure.table.add(fmt::format("standard error of {} {} [{}]", what, of, unit), bar);
    };
    add("H", "mm", a, &BoxMeans::height, &BoxMeans::height_error, 1e3, set.text());
    add("K/R", "-", b, &BoxMeans::ratio, &BoxMeans::ratio_error, 1, "");
    add("K/H", "m/s²", c, &BoxMeans::kinetic_share, &BoxMeans::kinetic_share_error, kTwoG, "");
    draw(d, quotient, quotient_error, "");
    // What a logarithmic axis cannot show.
    const double first = one.front().height * 1e3;
    if (sweep.axis.logarithmic && sweep.values.front() == 0)
      a.curves.push_back({"", {set.look.ink, Line::dotted}, {low, high}, {first, first}});
  }
  figure.panels = {a, b, c, d};
  figure.caption = fmt::format(
      "50 spheres in an elastic smooth box 10 d_0 wide (d_0 = 1 ± 0.1 mm), e = 0.9, {}. H is the "
      "height of the centre of mass over that at rest (14), K = Σ m v²/M and R = Σ q m (ω d/2)²/M "
      "as the paper has them, all at phase zero; bars are standard errors. (15) is (2/q + 1/μ)/(1 "
      "+ β_0); where heights and kinetic energies share alike K/H = 2g.",
      sweep.held);
  return figure;
}

/// The largest over the smallest.
Measured spread_of(const std::vector<Measured>& values) {
  const auto by_value = [](const Measured& a, const Measured& b) { return a.value < b.value; };
  const auto [least, most] = std::ranges::minmax_element(values, by_value);
  return ratio_of(*most, *least);
}

/// A ratio that is below 1, or above it.
Statement falls(std::string what, std::string stated, const Measured& ratio,
                std::string remark = {}) {
  return {std::move(what), std::move(stated), 0, 1, ratio.value, ratio.error, std::move(remark)};
}
Statement rises(std::string what, std::string stated, const Measured& ratio,
                std::string remark = {}) {
  return {std::move(what), std::move(stated), 1, INFINITY, ratio.value,
          ratio.error,     std::move(remark)};
}

/// K/R over (15), the mean over all runs of a set.
Statement low_by(const ShakenSet& set, const std::vector<Measured>& over_15) {
  const Measured mean = mean_of(over_15);
  Statement statement{fmt::format("K/R over (15), mean over the runs with {} [-]", set.text()),
                      "1.3 ± 0.2",
                      1.1,
                      1.5,
                      mean.value,
                      mean.error};
  if (!statement.agrees())
    statement.remark = "Only with f = 40 Hz, whose A0 = 1.25 mm is the largest beside H.";
  return statement;
}

}  // namespace

PaperFigure figure_l7(Effort effort) {
  BoxSweep sweep;
  sweep.name = "L7";
  sweep.title = "A vibrated box over the friction";
  sweep.symbol = "mu";
  sweep.axis = {"μ [-]", true, 5e-4, 40};
  sweep.values = {0, 1e-3, 0.01, 0.02, 0.05, 0.2, 1, 20};
  if (effort == Effort::full)
    sweep.values = {0, 1e-3, 3e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 20};
  sweep.sets = {kFast,
                {0.314, 40, {Ink::vermilion, Line::none, Marker::triangle}},
                kSlow,
                {0.314, 500, {Ink::purple, Line::none, Marker::diamond}}};
  sweep.set = [](VibratedBox& box, double mu) { box.pair.friction = mu; };
  sweep.held = "β_0 = 0.5, q = 2/5";
  SweptBoxes seen;
  PaperFigure figure = swept(sweep, effort, seen);

  const auto one = [&](std::size_t set, double mu) -> const BoxMeans& {
    return seen.runs[set][sweep.index(mu)];
  };
  const auto height = [&](std::size_t set, double mu) { return height_of(one(set, mu)); };
  std::vector<Statement>& stated = figure.statements;
  stated.push_back(stated_number("h_cm0 of 50 spheres, (14) with n_b = 9 [mm]", "2.492", 2.492,
                                 0.5e-3, resting_height(VibratedBox{}.scene()) / 1e-3));
  std::vector<Measured> smooth_over_rough;
  for (std::size_t n = 0; n < sweep.sets.size(); ++n) {
    smooth_over_rough.push_back(ratio_of(height(n, 0), height(n, 20)));
    const Measured& ratio = smooth_over_rough.back();
    stated.push_back({fmt::format("H at μ = 0 over that at μ = 20, {} [-]", sweep.sets[n].text()),
                      "approximately 2", 1.5, 2.5, ratio.value, ratio.error});
    if (!stated.back().agrees())
      stated.back().remark = "The text gives one factor for both V; V = 0.314 m/s has it.";
  }
  for (std::size_t n : {1u, 3u})
    stated.push_back(equal_heights(
        fmt::format("H with f = {:g} Hz over that with 100 Hz at V = 0.314 m/s, mean over μ [-]",
                    sweep.sets[n].frequency),
        "unchanged", height_ratio(seen.runs[n], seen.runs[2])));
  for (std::size_t n : {0u, 2u}) {
    const std::string set = sweep.sets[n].text();
    stated.push_back(equal_heights(fmt::format("H at μ = 20 over that at 1, {} [-]", set),
                                   "saturates", ratio_of(height(n, 20), height(n, 1))));
    stated.push_back(equal_heights(fmt::format("H at μ = 0.001 over that at 0, {} [-]", set),
                                   "saturates", ratio_of(height(n, 1e-3), height(n, 0))));
  }
  for (std::size_t n = 0; n < sweep.sets.size(); ++n)
    stated.push_back(low_by(sweep.sets[n], seen.over_15[n]));
  Measured widest{1, 0};  // of the K/R at one μ under all floors
  for (std::size_t k = 0; k < seen.over_15[0].size(); ++k) {
    std::vector<Measured> here;
    for (const auto& set : seen.over_15) here.push_back(set[k]);
    if (const Measured spread = spread_of(here); spread.value > widest.value) widest = spread;
  }
  stated.push_back({"largest K/R over smallest at one μ, for all V and f [-]", "coincide", 1,
                    1.5 / 1.1, widest.value, widest.error,
                    "Equal is read as within 1.3 ± 0.2. On the paper's axis of four decades such a "
                    "factor is hardly seen."});
  const Measured weak = ratio_of(ratio_seen(one(0, 1e-3)), ratio_seen(one(0, 0.01)));
  stated.push_back({"exponent of μ in K/R from 0.001 to 0.01, V = 1.57 m/s [-]", "−1", -1.5, -0.5,
                    -std::log10(weak.value), weak.error / weak.value / std::log(10)});
  for (std::size_t n = 0; n < sweep.sets.size(); ++n) {
    const bool slow = sweep.sets[n].frequency == 40;
    Measured most;
    for (const BoxMeans& run : seen.runs[n])
      if (run.kinetic_share > most.value) most = kinetic_share(run);
    const std::string largest = fmt::format("largest K/H over 2g, {} [-]", sweep.sets[n].text());
    const std::string change =
        fmt::format("K/H at μ = 20 over that at 0, {} [-]", sweep.sets[n].text());
    const Measured ratio = ratio_of(kinetic_share(one(n, 20)), kinetic_share(one(n, 0)));
    if (slow) {
      stated.push_back(rises(largest, "not below 1, unlike the others", most));
      if (!stated.back().agrees())
        stated.back().remark = "Larger than with the other f at this V, but below 2g.";
      stated.push_back(rises(change, "does not fall, unlike the others", ratio));
    } else {
      stated.push_back(falls(largest, "< 1", most));
      stated.push_back(falls(change, "falls slightly", ratio));
    }
  }
  figure.caption += fmt::format(
      " Dotted: μ = 0. H there is {} times that at μ = 20 with V = 1.57 m/s, and {}, {} and {} "
      "times with 0.314 m/s and 40, 100 and 500 Hz; the paper says about 2. K/R is {:.2f} times "
      "(15) with 1.57 m/s, and {:.2f}, {:.2f} and {:.2f} times, in the mean. L Fig. 7.",
      smooth_over_rough[0].text(), smooth_over_rough[1].text(), smooth_over_rough[2].text(),
      smooth_over_rough[3].text(), mean_of(seen.over_15[0]).value, mean_of(seen.over_15[1]).value,
      mean_of(seen.over_15[2]).value, mean_of(seen.over_15[3]).value);
  return figure;
}

PaperFigure figure_l8(Effort effort) {
  BoxSweep sweep;
  sweep.name = "L8";
  sweep.title = "A vibrated box over the tangential restitution";
  sweep.symbol = "beta0";
  sweep.axis = {"β_0 [-]", false, -1.05, 1.05};
  sweep.values = {-1, -0.9, -0.75, -0.5, -0.25, 0, 0.5, 1};
  if (effort == Effort::full)
    sweep.values = {-1, -0.95, -0.9, -0.75, -0.5, -0.25, 0, 0.25, 0.5, 0.75, 1};
  sweep.sets = {kFast, kSlow};
  sweep.set = [](VibratedBox& box, double beta) { box.pair.tangential_restitution = beta; };
  sweep.held = "μ = 0.2, q = 2/5";
  SweptBoxes seen;
  PaperFigure figure = swept(sweep, effort, seen);
  std::string below;
  for (std::size_t n = 0; n < sweep.sets.size(); ++n) {
    const std::string set = sweep.sets[n].text();
    const auto one = [&](double beta) -> const BoxMeans& {
      return seen.runs[n][sweep.index(beta)];
    };
    std::vector<Measured> flat;
    for (double beta : sweep.values)
      if (beta > -0.5) flat.push_back(height_of(one(beta)));
    figure.statements.push_back(
        equal_heights(fmt::format("largest H over smallest for β0 > −0.5, {} [-]", set),
                      "almost constant", spread_of(flat)));
    figure.statements.push_back(rises(fmt::format("H at β0 = −1 over that at −0.5, {} [-]", set),
                                      "increases",
                                      ratio_of(height_of(one(-1)), height_of(one(-0.5)))));
    figure.statements.push_back(rises(fmt::format("K/R at β0 = −0.9 over that at 0, {} [-]", set),
                                      "diverges towards −1",
                                      ratio_of(ratio_seen(one(-0.9)), ratio_seen(one(0)))));
    figure.statements.push_back(low_by(sweep.sets[n], seen.over_15[n]));
    figure.statements.push_back(falls(fmt::format("K/H at β0 = 1 over that at −1, {} [-]", set),
                                      "falls slightly",
                                      ratio_of(kinetic_share(one(1)), kinetic_share(one(-1)))));
    below += fmt::format("{}{}", n > 0 ? " and " : "",
                         ratio_of(height_of(one(-0.5)), height_of(one(0))).text());
  }
  figure.caption += fmt::format(
      " H at β_0 = −0.5 is {} times that at 0 with both V, and K/R {:.2f} and {:.2f} times (15) in "
      "the mean. L Fig. 8.",
      below, mean_of(seen.over_15[0]).value, mean_of(seen.over_15[1]).value);
  return figure;
}

PaperFigure figure_l9(Effort effort) {
  const auto paper = [](VibratedBox& box, double q) {
    box.shape_factor = q;
    box.pair.friction = 0.25;
    box.pair.tangential_restitution = 0;
  };
  BoxSweep sweep;
  sweep.name = "L9";
  sweep.title = "A vibrated box over the shape factor";
  sweep.symbol = "q";
  sweep.axis = {"q [-]", true, 5e-4, 2};
  sweep.values = {1e-3, 0.01, 0.05, 0.1, 0.2, 0.4, 0.5, 0.7, 1};
  if (effort == Effort::full)
    sweep.values = {1e-3, 3e-3, 0.01, 0.03, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1};
  sweep.sets = {kFast, kSlow};
  sweep.set = paper;
  sweep.held = "β_0 = 0, μ = 0.25";
  SweptBoxes seen;
  PaperFigure figure = swept(sweep, effort, seen);
  std::vector<VibratedBox> smooth(sweep.sets.size());
  for (std::size_t n = 0; n < smooth.size(); ++n) {
    smooth[n].speed = sweep.sets[n].speed;
    smooth[n].pair.friction = 0;
  }
  const std::vector<BoxMeans> unspun = run_boxes(smooth, times_longer(effort));
  std::string equal;
  for (std::size_t n = 0; n < sweep.sets.size(); ++n) {
    const std::string set = sweep.sets[n].text();
    const auto one = [&](double q) -> const BoxMeans& { return seen.runs[n][sweep.index(q)]; };
    const Measured solid = ratio_of(height_of(one(0.4)), height_of(one(0.5)));
    figure.statements.push_back(falls(fmt::format("H at q = 1 over that at 0.001, {} [-]", set),
                                      "falls", ratio_of(height_of(one(1)), height_of(one(1e-3)))));
    figure.statements.push_back(equal_heights(
        fmt::format("H at q = 2/5 over that at 1/2, {} [-]", set), "no dependence", solid));
    figure.statements.push_back(equal_heights(
        fmt::format("H at q = 0.001 over that at μ = 0, {} [-]", set),
        "q = 0, μ = 0, β0 = −1 coincide", ratio_of(height_of(one(1e-3)), height_of(unspun[n]))));
    figure.statements.push_back(falls(fmt::format("K/H at q = 1 over that at 0.001, {} [-]", set),
                                      "falls slightly",
                                      ratio_of(kinetic_share(one(1)), kinetic_share(one(1e-3)))));
    equal += fmt::format("{}{}", n > 0 ? " and " : "", solid.text());
  }
  figure.caption += fmt::format(
      " Of the μ in the paper this is the one that its text names. H at q = 2/5 is {} times that "
      "at "
      "1/2 with both V, and K/R {:.2f} and {:.2f} times (15) in the mean. L Fig. 9.",
      equal, mean_of(seen.over_15[0]).value, mean_of(seen.over_15[1]).value);
  return figure;
}

}  // namespace slipcheck
