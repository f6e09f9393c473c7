#include <fmt/format.h>

#include <array>
#include <cmath>

#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "figures/steel_pair.h"
#include "physics/contact/elastic_pair.h"
#include "scene/impact.h"

namespace slipcheck {
namespace {

constexpr double kDiameter = 2 * kSteel.radius;
constexpr std::array kRestitutions = {1.0, 0.9, 0.8, 0.7};
constexpr std::array kInks = {Ink::black, Ink::blue, Ink::green, Ink::purple};
constexpr std::array kLines = {Line::solid, Line::dashed, Line::dash_dot, Line::dotted};

SteelPair symmetric(double v_rel, double restitution) {
  return {v_rel / 2, -v_rel / 2, restitution};
}

/// (39) as printed, to first order in ε: a factor 1 − (π/2) ε where 1 − (π/4) ε is right.
double printed_largest(double v_rel, const LinearContact& contact) {
  return v_rel / (kDiameter * contact.contact_frequency()) *
         (1 - M_PI / 2 * contact.damping_ratio());
}

/// (33) as printed, half of what is right.
double printed_onset(const LinearContact& contact) {
  return (1 + steel_sphere().inverse_shape_factor()) * kSteel.static_friction * kSteel.gravity /
         (kDiameter * std::pow(contact.contact_frequency(), 2));
}

/// The overlap in diameters at a time [s] of an integrated collision.
double overlap_at(const SteelPair& pair, double time) {
  const auto states = states_at(pair.scene(), time);
  return (kDiameter - (states[1].position - states[0].position).norm()) / kDiameter;
}

/// d ln y/d ln x between two points.
double exponent(double x1, double y1, double x2, double y2) {
  return std::log(y2 / y1) / std::log(x2 / x1);
}

/// t_col [s] of Hertz' law for K's steel, App. B with the factor that (B1) lacks.
double hertz_time(double radius, double v) {
  const ElasticMaterial steel{2.06e11, 0.28, 0};
  const double mass = steel_sphere().mass * std::pow(radius / kSteel.radius, 3);
  return impact(HertzForce{hertz_modulus(steel, steel, radius / 2)}, mass / 2, v,
                ContactEnd::zero_overlap)
      .duration;
}

}  // namespace

PaperFigure figure_k5() {
  PaperFigure figure;
  figure.name = "K5";
  figure.title = "Compression in a symmetric collision";
  Table& table = figure.table;
  const std::vector<double> speeds = equally_spaced(1, 100, 100);  // v_rel [cm/s]
  const std::vector<double> points(kSpeedPoints.begin(), kSpeedPoints.end());
  table.add("v_rel [cm/s]", speeds);
  table.add("v_rel of points [cm/s]", points);

  Panel a{"(a) largest compression",
          {"v_{rel} [cm/s]", false, 0, 102},
          {"x_{max} [10^{−4} diameters]", false, 0}};
  std::vector<std::vector<double>> seen(kRestitutions.size());
  for (std::size_t k = 0; k < kRestitutions.size(); ++k) {
    const double e = kRestitutions[k];
    std::vector<double> exact, printed, closed;
    for (double v : speeds) {
      const LinearContact contact = symmetric(v * kCentimetre, e).contact();
      exact.push_back(contact.largest_overlap(v * kCentimetre) / kDiameter);
      printed.push_back(printed_largest(v * kCentimetre, contact));
    }
    for (double v : points) {
      const SteelPair pair = symmetric(v * kCentimetre, e);
      seen[k].push_back(value_of(pair.solve(), "i-j.max_overlap") / kDiameter);
      closed.push_back(pair.contact().largest_overlap(v * kCentimetre) / kDiameter);
    }
    table.add(fmt::format("x_max closed form e_n = {:g} [-]", e), exact);
    table.add(fmt::format("x_max of (39) as printed e_n = {:g} [-]", e), printed);
    table.add(fmt::format("x_max reference e_n = {:g} [-]", e), seen[k]);
    table.add(fmt::format("x_max residual e_n = {:g} [-]", e), difference(seen[k], closed));
    a.curves.push_back(
        {fmt::format("e_n = {:g}", e), {kInks[k], kLines[k]}, speeds, scaled(exact, 1e4)});
    if (e == SteelPair{}.restitution)
      a.curves.push_back({fmt::format("(39) as printed, e_n = {:g}", e),
                          {Ink::vermilion, Line::dotted},
                          speeds,
                          scaled(printed, 1e4)});
    a.curves.push_back({k == 0 ? kReferenceLabel : "", kReference, points, scaled(seen[k], 1e4)});
  }

  std::vector<double> corrected, as_printed, onset, onset_time, onset_residual;
  for (double v : speeds) {
    const SteelPair pair = symmetric(v * kCentimetre, 1);
    corrected.push_back(pair.insight().onset.overlap / kDiameter);
    as_printed.push_back(printed_onset(pair.contact()));
  }
  for (double v : points) {
    const SteelPair pair = symmetric(v * kCentimetre, 1);
    onset_time.push_back(value_of(pair.solve(), "i-j.sliding_onset"));
    onset.push_back(overlap_at(pair, onset_time.back()));
    onset_residual.push_back(onset.back() - pair.insight().onset.overlap / kDiameter);
  }
  table.add("x_min corrected e_n = 1 [-]", corrected);
  table.add("x_min of (33) as printed e_n = 1 [-]", as_printed);
  table.add("x_min reference e_n = 1 [-]", onset);
  table.add("x_min residual e_n = 1 [-]", onset_residual);
  table.add("t_min reference e_n = 1 [s]", onset_time);
  Panel b{"(b) compression at the onset of sliding, e_n = 1",
          {"v_{rel} [cm/s]", false, 0, 102},
          {"x_{min} [10^{−7} diameters]", false, 0}};
  b.curves = {{"(33) corrected", {Ink::black, Line::solid}, speeds, scaled(corrected, 1e7)},
              {"(33) as printed", {Ink::vermilion, Line::dotted}, speeds, scaled(as_printed, 1e7)},
              {"", kReference, points, scaled(onset, 1e7)}};
  figure.panels = {a, b};
  figure.caption =
      "In diameters. (a) The deepest compression over the relative speed v_{rel} for several e_n: "
      "v_{rel}/(2Rω_0), (32), damped by exp(−γ_N τ/2), τ = atan(2ω/γ_N)/ω. (b) Without damping, "
      "the compression from which on both spheres slide, (1+A) μ_s g/(R ω_0²), twice (33) as "
      "printed; damped they slide from the first touch on. ω_0 = π/t_{col}. K Fig. 5. ";
  figure.caption += steel_caption();

  const double v = 0.1;  // of the numbers in the text [m/s]
  const std::size_t ten = kTenCentimetres, last = points.size() - 1;
  const SteelPair elastic = symmetric(v, 1), damped = symmetric(v, SteelPair{}.restitution);
  const LinearContact contact = elastic.contact();
  const double A = steel_sphere().inverse_shape_factor(), g = kSteel.gravity;
  const double damping = damped.contact().damping_ratio();
  const double force_ratio =  // 2μ_s m g R x over 2k (R x)²
      kSteel.static_friction * steel_sphere().mass * g /
      (contact.stiffness() * kSteel.radius * seen[0][ten]);
  const double onset_damped =
      value_of(symmetric(0.01, SteelPair{}.restitution).solve(), "i-j.sliding_onset");
  const std::string doubled = "twice the printed formula: the compression is half the overlap in R";
  const std::string softer =
      "(B1) has half of Hertz' force, which makes t_col 2^(2/5) too long; "
      "the figures keep the printed number";
  figure.statements = {
      stated_number("x_max^0 at 10 cm/s, e_n = 1", "2e-4", 2e-4, 0.5e-4, seen[0][ten]),
      stated_order("x_max at 10 cm/s, e_n = 0.9", "10^-4", 1e-4, seen[1][ten]),
      stated_number("x_max/x_max^0 at e_n = 0.9, (39)",
                    fmt::format("1 − (π/2)ε = {:.3f}", 1 - M_PI / 2 * damping),
                    1 - M_PI / 2 * damping, damping * damping, seen[1][ten] / seen[0][ten], 0,
                    fmt::format("1 − (π/4)ε = {:.3f} is right to the same order; allowed is ε²",
                                1 - M_PI / 4 * damping)),
      stated_number("power of v_rel in x_max, e_n = 0.9", "4/5", 0.8, 0.005,
                    exponent(points[0], seen[1][0], points[last], seen[1][last]), 0,
                    "from 1 to 100 cm/s"),
      stated_number("x_min^0 at 10 cm/s", "3e-7", 3e-7, 0.5e-7, onset[ten], 0, doubled),
      {"power of v_rel in x_min^0", "grows as v → 0", -kUnbounded, 0,
       exponent(points[0], onset[0], points[last], onset[last])},
      stated_order("t_min^0 at 10 cm/s [s]", "10^-8", 1e-8, onset_time[ten]),
      stated_number("t_min^0/t_col", "5e-4", 5e-4, 0.5e-4,
                    onset_time[ten] / steel_collision_time(v), 0, doubled),
      stated_number("t_min at e_n = 0.9, 1 cm/s [s]", "0", 0, 0, onset_damped),
      stated_order("v^b, from which on an elastic collision makes them slide [cm/s]", "10^-2", 1e-2,
                   elastic.insight().onset.v_b / kCentimetre, 0,
                   "with t_col of 10 cm/s; twice (35) as printed"),
      stated_number(
          "v^c, from which on damping makes them slide at once [cm/s]", "0.05", 0.05, 0.005,
          2 * (1 + A) * kSteel.static_friction * g / damped.contact().damping_rate() / kCentimetre,
          0, "App. C prints g μ_s/γ_N for 2(1+A) g μ_s/γ_N"),
      stated_number("E_ps/E_col at 10 cm/s, (38)", "2e-3", 2e-3, 0.5e-3, force_ratio, 0,
                    "2μ_s m g R x_max over 2k (R x_max)², x_max integrated"),
      stated_number("t_col at 10 cm/s, App. B [s]", "2.55e-5", 2.55e-5, 0.005e-5,
                    hertz_time(kSteel.radius, 0.1), 0, softer),
      stated_number("t_col at 100 cm/s, App. B [s]", "1.61e-5", 1.61e-5, 0.005e-5,
                    hertz_time(kSteel.radius, 1), 0, softer),
      stated_number("power of v_0 in t_col, App. B", "−1/5", -0.2, 0.005,
                    exponent(0.1, hertz_time(kSteel.radius, 0.1), 1, hertz_time(kSteel.radius, 1))),
      stated_number(
          "power of R in t_col, App. B", "1", 1, 0.005,
          exponent(1, hertz_time(kSteel.radius, 0.1), 2, hertz_time(2 * kSteel.radius, 0.1)))};
  return figure;
}

}  // namespace slipcheck
