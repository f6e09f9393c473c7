#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "figures/box_fits.h"
#include "figures/box_runs.h"
#include "figures/columns.h"
#include "figures/paper_figure.h"

namespace slipcheck {
namespace {

constexpr std::size_t kSize = 4;  // of each table of exponents
using Four = std::array<double, kSize>;
constexpr Four kCounts = {27, 40, 60, 90};
constexpr Four kAmplitudes = {0.5e-3, 1.12e-3, 1.84e-3, 2.12e-3};  // A0 [m]

/// Exponents of V at each N and of n_b/N at each A0.
struct PrintedExponents {
  Four delta, nu;
};
constexpr PrintedExponents kLudings = {{1.72, 1.66, 1.57, 1.45}, {0.60, 0.71, 0.81, 0.91}};
/// Warr et al., Phys. Rev. E 52, 5583 (1995), as L prints them.
constexpr PrintedExponents kWarrs = {{1.239, 1.310, 1.326, 1.022}, {0.140, 0.172, 0.396, 0.350}};
/// How far L's four of each kind scatter about their mean; they have no other error.
constexpr double kDeltaError = 0.10, kNuError = 0.11;

constexpr Ink kInks[kSize] = {Ink::blue, Ink::vermilion, Ink::green, Ink::purple};
constexpr Marker kMarkers[kSize] = {Marker::circle, Marker::triangle, Marker::square,
                                    Marker::diamond};

/// The box of the experiment: steel spheres of 5 mm in 165 mm at 50 Hz.
VibratedBox experiments_box(double count, double amplitude) {
  VibratedBox box;
  box.count = static_cast<std::size_t>(count);
  box.diameter = 5e-3;
  box.spread = 0;
  box.width = 33;
  box.frequency = 50;
  box.speed = 2 * std::numbers::pi * box.frequency * amplitude;
  box.set_contacts(0.92, 0.22, 0);
  return box;
}

/// What L varies.
struct BoxVariant {
  const char* name;
  std::function<void(VibratedBox&)> change;
  double longer = 1;  ///< its runs than those of the others
};

/// All exponents of one variant; `weighted` with the errors of H.
struct BoxExponents {
  std::vector<Measured> delta, nu, weighted_delta, weighted_nu;
};

/// The runs of one variant by number of spheres, then by amplitude.
struct BoxTable {
  std::vector<BoxMeans> runs;

  std::span<const BoxMeans> of_count(std::size_t n) const {
    return std::span(runs).subspan(n * kSize, kSize);
  }
  std::vector<BoxMeans> of_amplitude(std::size_t k) const {
    std::vector<BoxMeans> column;
    for (std::size_t n = 0; n < kSize; ++n) column.push_back(runs[n * kSize + k]);
    return column;
  }
};

std::vector<double> speeds_of_amplitudes() {
  std::vector<double> speeds;
  for (double amplitude : kAmplitudes) speeds.push_back(experiments_box(1, amplitude).speed);
  return speeds;
}

/// n_b/N, the inverse of the number of layers; 32 spheres fill a layer.
std::vector<double> inverse_layers() {
  std::vector<double> layers;
  for (double count : kCounts) layers.push_back(32 / count);
  return layers;
}

BoxExponents exponents_of(const BoxTable& table) {
  BoxExponents all;
  for (std::size_t n = 0; n < kSize; ++n) {
    const HeightLaw law = fit_heights(speeds_of_amplitudes(), table.of_count(n));
    all.delta.push_back(law.exponent());
    all.weighted_delta.push_back(law.weighted_exponent());
  }
  for (std::size_t k = 0; k < kSize; ++k) {
    const HeightLaw law = fit_heights(inverse_layers(), table.of_amplitude(k));
    all.nu.push_back(law.exponent());
    all.weighted_nu.push_back(law.weighted_exponent());
  }
  return all;
}

std::string list_of(const std::vector<Measured>& all) {
  std::string text;
  for (const Measured& each : all) text += (text.empty() ? "" : ", ") + each.text();
  return text;
}

std::vector<double> values_of(const std::vector<Measured>& all, double Measured::*what) {
  std::vector<double> values;
  for (const Measured& each : all) values.push_back(each.*what);
  return values;
}

Panel exponent_panel(const std::string& title, const AxisSpec& x, const AxisSpec& y,
                     const std::vector<double>& at, const std::vector<Measured>& seen,
                     const Four& ludings, const Four& warrs, bool in_legend) {
  Panel panel{title, x, y};
  const std::vector<double> value = values_of(seen, &Measured::value);
  const auto named = [&](const char* name) { return in_legend ? name : ""; };
  panel.curves = {{named("L"),
                   {Ink::black, Line::dashed, Marker::square},
                   at,
                   {ludings.begin(), ludings.end()}},
                  {named("experiment"),
                   {Ink::grey, Line::dotted, Marker::diamond},
                   at,
                   {warrs.begin(), warrs.end()}},
                  error_bars(Ink::blue, at, value, values_of(seen, &Measured::error)),
                  {named("event driven"), {Ink::blue, Line::none, Marker::circle}, at, value}};
  return panel;
}

Statement mean_exponent(std::string what, const char* stated, double value, double scatter,
                        const std::vector<Measured>& seen) {
  const Measured mean = mean_of(seen);
  return {std::move(what), stated, value - scatter, value + scatter, mean.value, mean.error};
}

double difference_of(const std::vector<Measured>& a, const std::vector<Measured>& b,
                     double& error) {
  const Measured first = mean_of(a), second = mean_of(b);
  error = std::hypot(first.error, second.error);
  return first.value - second.value;
}

/// The most that exponents are off printed ones.
double farthest(const std::vector<Measured>& seen, const Four& printed) {
  double most = 0;
  for (std::size_t k = 0; k < kSize; ++k)
    most = std::max(most, std::abs(seen[k].value - printed[k]));
  return most;
}

/// The least that exponents are above those of the experiment.
Measured least_excess(const std::vector<Measured>& seen, const Four& warrs) {
  Measured least{INFINITY, 0};
  for (std::size_t k = 0; k < kSize; ++k)
    if (seen[k].value - warrs[k] < least.value) least = {seen[k].value - warrs[k], seen[k].error};
  return least;
}

}  // namespace

PaperFigure figure_l13(Effort effort) {
  const std::vector<BoxVariant> variants = {
      {"as stated, walls at rest", [](VibratedBox&) {}, 3},
      {"walls moving", [](VibratedBox& box) { box.moving_walls = true; }},
      {"side walls smooth, e_w = 0.92",
       [](VibratedBox& box) {
         box.wall = PairContact{0.92, 0, 0};
       }},
      {"lid at 285 mm", [](VibratedBox& box) { box.lid = 0.285; }},
      {"e_b = 0.84", [](VibratedBox& box) { box.floor.restitution = 0.84; }},
      {"e_b = 0.96", [](VibratedBox& box) { box.floor.restitution = 0.96; }}};
  std::vector<BoxTable> tables;
  std::vector<BoxExponents> exponents;
  for (const BoxVariant& variant : variants) {
    std::vector<VibratedBox> boxes;
    for (double count : kCounts)
      for (double amplitude : kAmplitudes) {
        boxes.push_back(experiments_box(count, amplitude));
        variant.change(boxes.back());
      }
    tables.push_back({run_boxes(boxes, times_longer(effort) * variant.longer)});
    exponents.push_back(exponents_of(tables.back()));
  }
  const BoxTable& stated = tables[0];
  const BoxExponents& seen = exponents[0];

  PaperFigure figure;
  figure.name = "L13";
  figure.title = "Height over the floor's speed and the number of layers, beside an experiment";
  const std::vector<double> count(kCounts.begin(), kCounts.end());
  const std::vector<double> speed = speeds_of_amplitudes(), layers = inverse_layers();
  Panel a{"(a) H over V", {"V [m/s]", true, 0.13, 0.8}, {"H [m]", true}};
  Panel b{
      "(b) H over the inverse number of layers", {"n_b/N [-]", true, 0.3, 1.4}, {"H [m]", true}};
  figure.table.add("N [-]", count);
  figure.table.add("A0 [mm]", scaled({kAmplitudes.begin(), kAmplitudes.end()}, 1e3));
  figure.table.add("V [m/s]", speed);
  for (std::size_t n = 0; n < kSize; ++n) {
    const std::vector<double> h = column(stated.of_count(n), &BoxMeans::height);
    const PowerLaw law = fit_heights(speed, stated.of_count(n)).plain;
    a.curves.push_back({"",
                        {kInks[n], Line::dashed},
                        {speed.front(), speed.back()},
                        {law({speed.front()}), law({speed.back()})}});
    a.curves.push_back(
        {fmt::format("N = {:g}", count[n]), {kInks[n], Line::none, kMarkers[n]}, speed, h});
  }
  for (std::size_t k = 0; k < kSize; ++k) {
    const std::vector<BoxMeans> runs = stated.of_amplitude(k);
    const std::vector<double> h = column(runs, &BoxMeans::height);
    const PowerLaw law = fit_heights(layers, runs).plain;
    b.curves.push_back({"",
                        {Ink::grey, Line::dashed},
                        {layers.front(), layers.back()},
                        {law({layers.front()}), law({layers.back()})}});
    b.curves.push_back({fmt::format("A_0 = {:g} mm", kAmplitudes[k] / 1e-3),
                        {Ink::black, Line::none, kMarkers[k]},
                        layers,
                        h});
    const std::string at = fmt::format("at A0 = {:g} mm [mm]", kAmplitudes[k] / 1e-3);
    figure.table.add("H " + at, scaled(h, 1e3));
    figure.table.add("standard error of H " + at,
                     scaled(column(runs, &BoxMeans::height_error), 1e3));
  }
  const auto add = [&](const std::string& what, const std::vector<Measured>& all) {
    figure.table.add(what + " [-]", values_of(all, &Measured::value));
    figure.table.add("standard error of " + what + " [-]", values_of(all, &Measured::error));
  };
  const auto add_printed = [&](const char* whose, const PrintedExponents& printed) {
    figure.table.add(fmt::format("delta of {} [-]", whose),
                     {printed.delta.begin(), printed.delta.end()});
    figure.table.add(fmt::format("nu of {} [-]", whose), {printed.nu.begin(), printed.nu.end()});
  };
  add("delta", seen.delta);
  add("nu", seen.nu);
  add("weighted delta", seen.weighted_delta);
  add("weighted nu", seen.weighted_nu);
  add_printed("L", kLudings);
  add_printed("the experiment", kWarrs);
  for (std::size_t n = 1; n < variants.size(); ++n) {
    add(fmt::format("delta {}", variants[n].name), exponents[n].delta);
    add(fmt::format("nu {}", variants[n].name), exponents[n].nu);
  }
  figure.panels = {
      a, b,
      exponent_panel("(c) exponents of V", {"N [-]", true, 22, 110}, {"δ [-]", false, 0.9, 1.9},
                     count, seen.delta, kLudings.delta, kWarrs.delta, true),
      exponent_panel("(d) exponents of n_b/N", {"V [m/s]", true, 0.13, 0.8},
                     {"ν [-]", false, 0, 1.1}, speed, seen.nu, kLudings.nu, kWarrs.nu, false)};

  std::vector<Statement>& all = figure.statements;
  const auto add_exponents = [&](const char* symbol, const char* of, double unit, const Four& at,
                                 const std::vector<Measured>& here, const Four& printed,
                                 double error) {
    for (std::size_t k = 0; k < kSize; ++k)
      all.push_back(
          {fmt::format("{} at {} = {:g} [-]", symbol, of, at[k] / unit),
           fmt::format("{:.2f}", printed[k]), printed[k] - error, printed[k] + error, here[k].value,
           here[k].error,
           fmt::format("Allowed: the ± {:.2f} that L gives for the mean of the four.", error)});
  };
  add_exponents("δ", "N", 1, kCounts, seen.delta, kLudings.delta, kDeltaError);
  add_exponents("ν", "A0/mm", 1e-3, kAmplitudes, seen.nu, kLudings.nu, kNuError);
  all.push_back(mean_exponent("mean δ [-]", "1.60 ± 0.10", 1.60, kDeltaError, seen.delta));
  all.push_back(mean_exponent("mean ν [-]", "0.76 ± 0.11", 0.76, kNuError, seen.nu));
  const Measured above_delta = least_excess(seen.delta, kWarrs.delta);
  const Measured above_nu = least_excess(seen.nu, kWarrs.nu);
  all.push_back({"least of δ less the experiment's δ of the same N [-]",
                 "larger than 1.239, 1.310, 1.326, 1.022", 0, INFINITY, above_delta.value,
                 above_delta.error});
  all.push_back({"least of ν less the experiment's ν of the same A0 [-]",
                 "larger than 0.140, 0.172, 0.396, 0.350", 0, INFINITY, above_nu.value,
                 above_nu.error});
  const BoxExponents &lid = exponents[3], &soft = exponents[4], &hard = exponents[5];
  all.push_back(
      mean_exponent("mean δ under a lid at 285 mm [-]", "1.52 ± 0.06", 1.52, 0.06, lid.delta));
  all.push_back(
      mean_exponent("mean ν under a lid at 285 mm [-]", "0.70 ± 0.08", 0.70, 0.08, lid.nu));
  double error = 0;
  const double lowered = difference_of(lid.delta, seen.delta, error);
  all.push_back(
      {"mean δ under the lid less that without [-]", "reduced", -INFINITY, 0, lowered, error});
  const Measured lower = height_ratio(tables[4].runs, tables[0].runs);
  const Measured higher = height_ratio(tables[5].runs, tables[0].runs);
  all.push_back({"H with e_b = 0.84 over that with 0.92, mean [-]", "falls with e_b", 0, 1,
                 lower.value, lower.error});
  all.push_back({"H with e_b = 0.96 over that with 0.92, mean [-]", "falls with e_b", 1, INFINITY,
                 higher.value, higher.error});
  const double delta_change = difference_of(soft.delta, hard.delta, error);
  all.push_back({"mean δ with e_b = 0.84 less that with 0.96 [-]", "no significant change",
                 -kDeltaError, kDeltaError, delta_change, error,
                 "Significant is what is beyond L's ± 0.10."});
  const double nu_change = difference_of(soft.nu, hard.nu, error);
  all.push_back({"mean ν with e_b = 0.84 less that with 0.96 [-]", "slightly less", -INFINITY, 0,
                 nu_change, error});

  figure.caption = fmt::format(
      "Equal steel spheres, d_0 = 5 mm, in an open box of 165 mm at f = 50 Hz, A_0 = 0.5, 1.12, "
      "1.84 and 2.12 mm; all contacts with e = 0.92, μ = 0.22, β_0 = 0, walls at rest: L's numbers "
      "for the experiment of S. Warr, J. M. Huntley and G. T. H. Jacques, Phys. Rev. E 52, 5583 "
      "(1995). (a) H ∝ V^δ, N = 27, 40, 60, 90: δ = {}; L 1.72, 1.66, 1.57, 1.45; experiment "
      "1.239, "
      "1.310, 1.326, 1.022. (b) H ∝ (n_b/N)^ν at the four A_0: ν = {}; L 0.60, 0.71, 0.81, 0.91; "
      "experiment 0.140, 0.172, 0.396, 0.350. (c), (d) The exponents of both; bars come from the "
      "scatter about the law, which counts what it misses. L Fig. 13.",
      list_of(seen.delta), list_of(seen.nu));
  figure.notes =
      "| | δ: N = 27 | 40 | 60 | 90 | mean | ν: A_0 = 0.5 mm | 1.12 | 1.84 | 2.12 | mean |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  const auto row = [&](const std::string& name, const std::vector<Measured>& delta,
                       const std::vector<Measured>& nu) {
    figure.notes += "| " + name;
    for (const auto* values : {&delta, &nu}) {
      for (const Measured& each : *values) figure.notes += " | " + each.text();
      figure.notes += " | " + mean_of(*values).text();
    }
    figure.notes += " |\n";
  };
  for (std::size_t n = 0; n < variants.size(); ++n)
    row(variants[n].name, exponents[n].delta, exponents[n].nu);
  row("as stated, weighted with H's errors", seen.weighted_delta, seen.weighted_nu);
  const BoxExponents& smooth = exponents[2];
  figure.notes += fmt::format(
      "\nLeast squares in logarithms over four points, all alike as L has it; L's means are 1.60 ± "
      "0.10 and 0.76 ± 0.11, with the lid 1.52 ± 0.06 and 0.70 ± 0.08. With the coefficients as "
      "stated δ is within {:.2f} of L's and ν within {:.2f}; with smooth side walls, which L does "
      "not have here, δ within {:.2f} and ν within {:.2f}. The experiment's exponents are smaller "
      "than all of these, as L says.",
      farthest(seen.delta, kLudings.delta), farthest(seen.nu, kLudings.nu),
      farthest(smooth.delta, kLudings.delta), farthest(smooth.nu, kLudings.nu));
  return figure;
}

}  // namespace slipcheck
