#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "figures/box_runs.h"
#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "harness/compare/power_law.h"

namespace slipcheck {
namespace {

constexpr std::size_t kSize = 4;  // of each table of exponents
constexpr double kCounts[kSize] = {27, 40, 60, 90};
constexpr double kAmplitudes[kSize] = {0.5e-3, 1.12e-3, 1.84e-3, 2.12e-3};  // A0 [m]
constexpr double kPapersDelta[kSize] = {1.72, 1.66, 1.57, 1.45};
constexpr double kPapersNu[kSize] = {0.60, 0.71, 0.81, 0.91};
constexpr Ink kInks[kSize] = {Ink::blue, Ink::vermilion, Ink::green, Ink::purple};
constexpr Marker kMarkers[kSize] = {Marker::circle, Marker::triangle, Marker::square,
                                    Marker::circle};

/// The box of Warr et al., Phys. Rev. E 52, 5583 (1995): steel spheres of 5 mm in 165 mm at 50 Hz.
VibratedBox warrs_box(double count, double amplitude) {
  VibratedBox box;
  box.count = static_cast<std::size_t>(count);
  box.diameter = 5e-3;
  box.width = 33;
  box.frequency = 50;
  box.speed = 2 * std::numbers::pi * box.frequency * amplitude;
  box.set_contacts(0.92, 0.1, 0);
  return box;
}

struct Exponents {
  std::vector<double> value, error;
  void take(const PowerLaw& law, double sign) {
    value.push_back(sign * law.exponent[0]);
    error.push_back(law.exponent_error[0]);
  }
  std::string text() const {
    std::string all;
    for (std::size_t k = 0; k < value.size(); ++k)
      all += fmt::format("{}{:.2f} ± {:.2f}", k > 0 ? ", " : "", value[k], error[k]);
    return all;
  }
};

Panel exponent_chart(const std::string& title, const AxisSpec& x, const AxisSpec& y,
                     const std::vector<double>& at, const Exponents& seen,
                     const double (&papers)[kSize], bool in_legend) {
  Panel chart{title, x, y};
  const std::vector<double> paper(papers, papers + kSize);
  chart.curves = {
      {in_legend ? "paper" : "", {Ink::black, Line::dashed, Marker::square}, at, paper},
      error_bars(Ink::blue, at, seen.value, seen.error),
      {in_legend ? "event driven" : "", {Ink::blue, Line::none, Marker::circle}, at, seen.value}};
  return chart;
}

}  // namespace

PaperFigure figure_l13() {
  std::vector<VibratedBox> boxes;
  for (double count : kCounts)
    for (double amplitude : kAmplitudes) boxes.push_back(warrs_box(count, amplitude));
  const std::vector<BoxMeans> runs = run_boxes(boxes, 1.5);

  PaperFigure figure;
  figure.name = "L13";
  figure.title = "Height over the floor's speed and the number of spheres";
  const std::vector<double> count(kCounts, kCounts + kSize);
  std::vector<double> speed;
  for (double amplitude : kAmplitudes) speed.push_back(warrs_box(1, amplitude).speed);
  Panel a{"(a) H over V", {"V [m/s]", true, 0.13, 0.8}, {"H [mm]", true}};
  Panel b{"(b) H over N", {"N [-]", true, 22, 110}, {"H [mm]", true}};
  Exponents delta, nu;
  std::vector<std::vector<double>> height(kSize), error(kSize);  // by speed
  for (std::size_t n = 0; n < kSize; ++n) {
    const std::span seen = std::span(runs).subspan(n * kSize, kSize);
    const std::vector<double> h = scaled(column(seen, &BoxMeans::height), 1e3);
    const std::vector<double> e = scaled(column(seen, &BoxMeans::height_error), 1e3);
    const PowerLaw law = fit_power_law(speed, h, e);
    delta.take(law, 1);
    a.curves.push_back({"",
                        {kInks[n], Line::dashed},
                        {speed.front(), speed.back()},
                        {law({speed.front()}), law({speed.back()})}});
    a.curves.push_back(
        {fmt::format("N = {:g}", count[n]), {kInks[n], Line::none, kMarkers[n]}, speed, h});
    for (std::size_t k = 0; k < kSize; ++k) {
      height[k].push_back(h[k]);
      error[k].push_back(e[k]);
    }
  }
  figure.table.add("N [-]", count);
  for (std::size_t k = 0; k < kSize; ++k) {
    const PowerLaw law = fit_power_law(count, height[k], error[k]);
    nu.take(law, -1);
    b.curves.push_back({"",
                        {Ink::grey, Line::dashed},
                        {count.front(), count.back()},
                        {law({count.front()}), law({count.back()})}});
    b.curves.push_back({"", {Ink::black, Line::none, kMarkers[k]}, count, height[k]});
    figure.table.add(fmt::format("H at A0 = {:g} mm [mm]", kAmplitudes[k] / 1e-3), height[k]);
    figure.table.add(fmt::format("standard error of H at A0 = {:g} mm [mm]", kAmplitudes[k] / 1e-3),
                     error[k]);
  }
  figure.table.add("delta [-]", delta.value);
  figure.table.add("standard error of delta [-]", delta.error);
  figure.table.add("delta of the paper [-]", {kPapersDelta, kPapersDelta + kSize});
  figure.table.add("V of nu [m/s]", speed);
  figure.table.add("nu [-]", nu.value);
  figure.table.add("standard error of nu [-]", nu.error);
  figure.table.add("nu of the paper [-]", {kPapersNu, kPapersNu + kSize});

  figure.panels = {a, b,
                   exponent_chart("(c) exponents of V", {"N [-]", true, 22, 110},
                                  {"δ [-]", false, 1.3, 1.8}, count, delta, kPapersDelta, true),
                   exponent_chart("(d) exponents of 1/N", {"V [m/s]", true, 0.13, 0.8},
                                  {"ν [-]", false, 0.4, 1}, speed, nu, kPapersNu, false)};
  figure.caption = fmt::format(
      "Steel spheres (d_0 = 5 mm) in a box of 165 mm at f = 50 Hz, as Warr et al., Phys. Rev. E "
      "52, 5583 (1995), have them; chosen here: all contacts with e = 0.92, μ = 0.1, β_0 = 0, and "
      "A_0 = 0.5, "
      "1.12, 1.84 and 2.12 mm, V = 2π f A_0. (a) H ∝ V^δ, N = 27, 40, 60, 90: δ = {}; the paper's "
      "1.72, 1.66, 1.57, 1.45. (b) H ∝ N^{{−ν}} at the four V: ν = {}; the paper's 0.60, 0.71, "
      "0.81, 0.91. (c), (d) The exponents with standard errors, which count what the power law "
      "misses. L Fig. 13.",
      delta.text(), nu.text());
  return figure;
}

}  // namespace slipcheck
