#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "physics/contact/elastic_pair.h"
#include "physics/contact/hard_contact.h"
#include "scene/impact.h"

namespace slipcheck {
namespace {

constexpr double kYoungModulus = 1e10, kPoissonRatio = 0.3, kDensity = 1000;
constexpr double kRadius = 0.2;                         // R_eff against a wall of ice [m]
constexpr double kSlowest = 0.015e-2, kFastest = 5e-2;  // of the fit [m/s]
constexpr double kTolerance = 1e-9;

/// A sphere of ice against a wall of ice.
struct IceOnWall {
  double mass = kDensity * 4 * M_PI / 3 * std::pow(kRadius, 3);  // the wall does not move
  double modulus =
      hertz_modulus({kYoungModulus, kPoissonRatio}, {kYoungModulus, kPoissonRatio}, kRadius);
  double restitution(double dissipation_time, double speed) const {
    return impact(ViscoelasticForce{modulus, dissipation_time}, mass, speed,
                  ContactEnd::zero_overlap, kTolerance)
        .restitution;
  }
  /// x = A κ_v^{2/5} g^{1/5} of the series.
  double small_parameter(double dissipation_time, double speed) const {
    return dissipation_time * std::pow(viscoelastic_constant(mass, modulus), 0.4) *
           std::pow(speed, 0.2);
  }
};

double measured(double speed) {
  static const RestitutionLaw law = PowerLawRestitution{};
  return restitution_at(law, speed);
}

/// Where a function with one minimum between them is smallest, to 1e-7 of the place.
double golden_section(const std::function<double(double)>& f, double low, double high) {
  const double share = (std::sqrt(5.0) - 1) / 2;
  double a = high - share * (high - low), b = low + share * (high - low);
  double f_a = f(a), f_b = f(b);
  while (high - low > 1e-7 * high) {
    if (f_a < f_b) {
      high = b, b = a, f_b = f_a;
      f_a = f(a = high - share * (high - low));
    } else {
      low = a, a = b, f_a = f_b;
      f_b = f(b = low + share * (high - low));
    }
  }
  return 0.5 * (low + high);
}

struct Fit {
  double dissipation_time = 0;  ///< A [s]
  double deviation = 0;         ///< root mean square [-]
};

/// A by least squares of ε^N over these speeds.
Fit fitted(const IceOnWall& ice, const std::vector<double>& speeds) {
  const auto square = [&](double A) {
    double sum = 0;
    for (double speed : speeds) sum += std::pow(ice.restitution(A, speed) - measured(speed), 2);
    return sum / static_cast<double>(speeds.size());
  };
  const double A = golden_section(square, 1e-5, 1e-2);
  return {A, std::sqrt(square(A))};
}

}  // namespace

PaperFigure figure_b1() {
  const IceOnWall ice;
  constexpr std::size_t kPoints = 41;
  const Fit even = fitted(ice, equally_spaced(kSlowest, kFastest, kPoints));
  const Fit in_logarithm = fitted(ice, logarithmically_spaced(kSlowest, kFastest, kPoints));

  // 1 − ε = C1 x − C2 x² + …: C1 is the loss along the elastic course, 0.8^{2/5} B(3/5, 3/2).
  const double c1 = std::pow(0.8, 0.4) * std::tgamma(0.6) * std::tgamma(1.5) / std::tgamma(2.1);
  const double c2 = 0.6 * c1 * c1;

  // Down to where the series holds; close and with both ends in the measured range.
  std::vector<double> speeds = logarithmically_spaced(1e-12, 1e-4, 25);
  for (double speed : logarithmically_spaced(kSlowest, kFastest, kPoints)) speeds.push_back(speed);
  for (double speed : {7e-2, 0.1}) speeds.push_back(speed);
  std::vector<double> cm_s, data, curve, other, first, second, residual, residual_other, lost,
      lost_first, lost_second, series_residual;
  for (double speed : speeds) {
    cm_s.push_back(speed / 1e-2);
    const bool in_range = speed >= 0.999 * kSlowest && speed <= 1.001 * kFastest;
    data.push_back(in_range ? measured(speed) : NAN);
    curve.push_back(ice.restitution(even.dissipation_time, speed));
    other.push_back(ice.restitution(in_logarithm.dissipation_time, speed));
    const double x = ice.small_parameter(even.dissipation_time, speed);
    first.push_back(1 - c1 * x);
    second.push_back(1 - c1 * x + c2 * x * x);
    residual.push_back(curve.back() - data.back());
    residual_other.push_back(other.back() - data.back());
    series_residual.push_back(curve.back() - second.back());
    lost.push_back(1 - curve.back());
    lost_first.push_back(1 - first.back());
    lost_second.push_back(1 - second.back());
  }

  PaperFigure figure;
  figure.name = "B1";
  figure.title = "Normal restitution of ice";
  const double duration = hertz_duration(ice.mass, ice.modulus, 0.01);
  figure.caption = fmt::format(
      "A sphere of ice (R = {:g} cm, Y = {:g} Pa, ν = {:g}, ρ = {:g} kg/m³) against a wall of "
      "ice. (a) The published power law of Bridges, Hatzes and Lin, ε = 0.32 v^{{−0.234}} (v in "
      "cm/s, 0.015–5 cm/s), and the integrated law (24), ended at zero overlap, its one parameter "
      "A found by least squares of ε^N at {} speeds: even in v, A = {:.3g} s (root mean square "
      "{:.3f}); even in ln v, A = {:.3g} s ({:.3f}). ",
      kRadius / kCentimetre, kYoungModulus, kPoissonRatio, kDensity, kPoints, even.dissipation_time,
      even.deviation, in_logarithm.dissipation_time, in_logarithm.deviation);
  figure.caption += fmt::format(
      "ε^N of (24) depends on A⁵v alone and falls more slowly than the power law: no A follows it "
      "over the whole range. (b) 1 − ε^N beside the series for small dissipation, {:.4f} x − "
      "{:.4f} x², x = A κ_v^{{2/5}} v^{{1/5}}, from which the measured range is far (x = {:.2f} "
      "at 1 cm/s). A/t_c = {:.2f} there, so that (B12) does not hold well either. B Fig. 1.",
      c1, c2, ice.small_parameter(even.dissipation_time, 0.01), even.dissipation_time / duration);

  Table& table = figure.table;
  table.add("v [cm/s]", cm_s);
  table.add("eps^N power law [-]", data);
  table.add("eps^N reference even in v [-]", curve);
  table.add("eps^N reference even in ln v [-]", other);
  table.add("eps^N series first order [-]", first);
  table.add("eps^N series second order [-]", second);
  table.add("residual even in v - power law [-]", residual);
  table.add("residual even in ln v - power law [-]", residual_other);
  table.add("residual even in v - series second order [-]", series_residual);

  const Look integrated{Ink::blue, Line::solid};
  Panel a{"(a) ε^N of ice", {"v [cm/s]", true, 0.01, 10}, {"ε^N", false, 0, 1}};
  a.curves = {{"Bridges, Hatzes and Lin, 0.32 v^{−0.234}", {Ink::black, Line::dashed}, cm_s, data},
              {"integrated, A fitted evenly in v", integrated, cm_s, curve},
              {"integrated, A fitted evenly in ln v", {Ink::green, Line::dashed}, cm_s, other},
              {"series, first order", {Ink::grey, Line::dotted}, cm_s, first},
              {"series, second order", {Ink::vermilion, Line::dash_dot}, cm_s, second}};
  Panel b{"(b) small dissipation", {"v [cm/s]", true, 1e-10, 10}, {"1 − ε^N", true, 5e-3, 2}};
  b.curves = {{"", integrated, cm_s, lost},
              {"", {Ink::grey, Line::dotted}, cm_s, lost_first},
              {"", {Ink::vermilion, Line::dash_dot}, cm_s, lost_second}};
  figure.panels = {a, b};
  return figure;
}

}  // namespace slipcheck
