#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include "figures/box_convergence.h"
#include "figures/columns.h"
#include "figures/paper_figure.h"

namespace slipcheck {
namespace {

/// d ln y/d ln x over the first decade, three of the intervals.
double order(const std::vector<double>& x, const std::vector<double>& y) {
  return std::log(y[3] / y[0]) / std::log(x[3] / x[0]);
}

Panel trajectory_chart(Table& table, std::string& orders) {
  const std::vector<double> times = logarithmically_spaced(1e-7, 1e-4, 10);
  const TrajectoriesApart smooth = trajectories_apart(0, times);
  const TrajectoriesApart rough = trajectories_apart(kConvergenceFriction, times);
  table.add("t_col of trajectories [s]", times);
  table.add("position apart smooth [m]", smooth.position);
  table.add("velocity apart smooth [m/s]", smooth.velocity);
  table.add("position apart with friction [m]", rough.position);
  table.add("velocity apart with friction [m/s]", rough.velocity);
  table.add("R times spin apart with friction [m/s]", rough.surface);
  orders = fmt::format("{:.3f}, {:.3f} and {:.3f}", order(times, smooth.velocity),
                       order(times, rough.velocity), order(times, rough.surface));

  const std::vector<double> ends = {times.front(), times.back()};
  const auto first_order = [&](const std::vector<double>& seen) {
    return Curve{
        "", {Ink::grey, Line::dashed}, ends, {seen[0], seen[0] * times.back() / times.front()}};
  };
  Panel chart{"(a) trajectories after 16 ms",
              {"t_{col} [s]", true, 0.7e-7, 1.4e-4},
              {"Δr [m], Δv [m/s]", true}};
  chart.curves = {
      {"slope 1", {Ink::grey, Line::dashed}, {}, {}},
      first_order(smooth.position),
      first_order(smooth.velocity),
      first_order(rough.surface),
      {"Δr, smooth", {Ink::blue, Line::none, Marker::circle}, times, smooth.position},
      {"Δr, with friction", {Ink::vermilion, Line::none, Marker::circle}, times, rough.position},
      {"Δv, smooth", {Ink::blue, Line::none, Marker::triangle}, times, smooth.velocity},
      {"Δv, with friction", {Ink::vermilion, Line::none, Marker::triangle}, times, rough.velocity},
      {"R Δω, with friction", {Ink::green, Line::none, Marker::square}, times, rough.surface}};
  return chart;
}

struct Averages {
  std::vector<double> times, ratios;  ///< t_col [s], and over the mean time between collisions
  BoxObservables event;
  std::vector<BoxObservables> contact;
};

/// One of H, K, R over t_col; `worst`: how many standard errors of both together a point with
/// t_col <= `few` [s] is off at most.
Panel average_chart(const Averages& all, BlockedMean BoxObservables::*what, double unit,
                    const std::string& title, const std::string& name, const std::string& unit_name,
                    bool in_legend, double few, double& worst, Table& table) {
  const BlockedMean& exact = all.event.*what;
  std::vector<double> mean, error;
  for (std::size_t k = 0; k < all.times.size(); ++k) {
    const BlockedMean& seen = all.contact[k].*what;
    mean.push_back(seen.mean / unit);
    error.push_back(seen.standard_error / unit);
    const double apart = std::abs(seen.mean - exact.mean);
    if (all.times[k] <= few)
      worst = std::max(worst, apart / std::hypot(seen.standard_error, exact.standard_error));
  }
  const double line = exact.mean / unit, band = exact.standard_error / unit;
  table.add(fmt::format("{} contact [{}]", name, unit_name), mean);
  table.add(fmt::format("standard error of {} contact [{}]", name, unit_name), error);
  table.add(fmt::format("{} event driven [{}]", name, unit_name),
            std::vector<double>(mean.size(), line));
  table.add(fmt::format("standard error of {} event driven [{}]", name, unit_name),
            std::vector<double>(mean.size(), band));

  const std::vector<double> ends = {0.7 * all.ratios.front(), 1.4 * all.ratios.back()};
  Panel chart{title,
              {"t_{col}/t_E [-]", true, ends[0], ends[1]},
              {fmt::format("{} [{}]", name, unit_name)}};
  chart.curves = {{in_legend ? "event driven" : "", {Ink::black, Line::solid}, ends, {line, line}},
                  {in_legend ? "± standard error" : "",
                   {Ink::black, Line::dotted},
                   {ends[0], ends[1], NAN, ends[0], ends[1]},
                   {line - band, line - band, NAN, line + band, line + band}},
                  error_bars(Ink::blue, all.ratios, mean, error),
                  {in_legend ? "contacts that last" : "",
                   {Ink::blue, Line::none, Marker::square},
                   all.ratios,
                   mean}};
  return chart;
}

/// What a mean with contacts that last is of that without, with its error.
std::string share_of(const BlockedMean& contact, const BlockedMean& event) {
  const double share = contact.mean / event.mean;
  const double error =
      share * std::hypot(contact.standard_error / contact.mean, event.standard_error / event.mean);
  return fmt::format("{:.3f} ± {:.3f}", share, error);
}

}  // namespace

PaperFigure figure_soft_box_convergence() {
  constexpr double kFew = 1e-4;  // [s]
  Averages all;
  all.times = {1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 1.5e-3};
  // All at once, on whatever cores there are: each is a run of its own.
  std::future<EventMeans> event = std::async(std::launch::async, dilute_box_by_events);
  std::vector<std::future<BoxObservables>> runs;
  for (double time : all.times)
    runs.push_back(std::async(std::launch::async, dilute_box_by_contacts, time));

  PaperFigure figure;
  figure.name = "soft-box-convergence";
  figure.title = "Event driven against contacts that last";
  std::string orders;
  Table shorter;  // of the averages, with fewer rows
  const Panel trajectories = trajectory_chart(figure.table, orders);
  const EventMeans exact = event.get();
  all.event = exact.seen;
  for (std::future<BoxObservables>& run : runs) all.contact.push_back(run.get());
  for (double time : all.times) all.ratios.push_back(time / exact.between);
  shorter.add("t_col of averages [s]", all.times);
  shorter.add("t_col/t_E [-]", all.ratios);
  double worst = 0;
  figure.panels = {
      trajectories,
      average_chart(all, &BoxObservables::height, 1e-3, "(b) height", "H", "mm", true, kFew, worst,
                    shorter),
      average_chart(all, &BoxObservables::kinetic_energy, 1e-6, "(c) energy of translation", "K",
                    "µJ", false, kFew, worst, shorter),
      average_chart(all, &BoxObservables::rotational_energy, 1e-9, "(d) energy of rotation", "R",
                    "nJ", false, kFew, worst, shorter)};
  const std::size_t rows = figure.table.columns().front().values.size();
  for (Table::Column column : shorter.columns()) {
    column.values.resize(rows, NAN);
    figure.table.add(column.name, std::move(column.values));
  }

  const VibratedBox box = dilute_box();
  figure.caption = fmt::format(
      "The same box from event to event with hard contacts, and with a spring and dashpot that "
      "last t_{{col}}; both have e = {:g}, friction μ = {:g}, β_0 = 0, the contact as a viscous "
      "force that stops the slip within a small part of t_{{col}}, under Coulomb's cap. Steel, "
      "d_0 = 1 mm, f = 100 Hz. (a) 6 spheres, V = 0.3 m/s: the largest difference of a place, a "
      "velocity and a spin after 16 ms, 3 collisions and 7 bounces, which amplify what each adds. "
      "All are of first order in t_{{col}}: over the first decade Δv smooth, Δv and R Δω with "
      "friction have slopes {}. (b)-(d) {} spheres in 10 d_0, V = 1 m/s: means at phase zero, bars "
      "are standard errors by blocking. A sphere meets something every t_E = {:.1f} ms. Up to "
      "t_{{col}} = {:g} ms the means are at most {:.1f} standard errors apart; beyond, R falls "
      "first, then H and K rise, which comes from the contacts between spheres: softened floor "
      "and walls alone do not do it. The project's own; L says in Sec. I that both ways agree.",
      kConvergenceRestitution, kConvergenceFriction, orders, box.count, exact.between * 1e3,
      kFew * 1e3, worst);
  figure.notes =
      "`SoftBoxSolver` has springs and dashpots that end at zero force; its viscous tangential "
      "force "
      "stops the slip within t_col/15 or less, which stands for β0 = 0. `PlanarSolver` goes from "
      "event to event. What the means are of its, by t_col:\n\n"
      "| t_col [ms] | H | K | R |\n|---|---|---|---|\n";
  for (std::size_t k = 0; k < all.times.size(); ++k)
    figure.notes +=
        fmt::format("| {:g} | {} | {} | {} |\n", all.times[k] * 1e3,
                    share_of(all.contact[k].height, all.event.height),
                    share_of(all.contact[k].kinetic_energy, all.event.kinetic_energy),
                    share_of(all.contact[k].rotational_energy, all.event.rotational_energy));
  figure.notes +=
      "\nThat H and K rise comes from the contacts between spheres. Likely spheres that touch "
      "several others at once lose less energy, the detachment effect of S. Luding et al., Phys. "
      "Rev. E 50, 4113 (1994); that was not looked at apart.";
  return figure;
}

}  // namespace slipcheck
