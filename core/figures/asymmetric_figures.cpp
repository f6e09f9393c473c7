#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "figures/asymmetric_slides.h"
#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "figures/secant.h"

namespace slipcheck {
namespace {

constexpr double kSpeed = 0.1;  // |v_m| of the numbers in the text [m/s]
// How K's words about the dependence on v_p are read: by how much of the symmetric value it changes
// for v_p between −|v_m| and |v_m|.
constexpr double kWeak = 0.2, kStrong = 1;
constexpr double kPrintedShare = 0.13;  // C as the captions have it

/// A quantity of sphere i over the plane of v_m and v_p.
struct SlideQuantity {
  std::string name, unit;  ///< "t^s", "s"
  double unit_in_si;
  double AsymmetricSlide::*of;
  bool size = false;  ///< its size is drawn
};

double drawn(const SlideQuantity& quantity, const AsymmetricSlide& slide) {
  const double value = slide.*quantity.of / quantity.unit_in_si;
  return quantity.size ? std::abs(value) : value;
}

/// The line v_p = slope · v_m over the map.
Curve line_of(const std::string& label, const Look& look, double slope) {
  return {label, look, {-100, 0}, {-100 * slope, 0}};
}

/// Where the slide ends at −v^f, (61) corrected: s_i and ΔE_i are zero.
Curve zero_line(const std::string& what) {
  const HeadOnCollision rule{steel_sphere().inverse_shape_factor(), SteelPair{}.restitution,
                             first_order_share()};
  const double ratio = rule.zero_sliding_distance_ratio();
  return line_of(fmt::format("{}, v_i = −{:.2f} v_j", what, -ratio),
                 {Ink::vermilion, Line::dashed, Marker::none, true}, (ratio + 1) / (ratio - 1));
}

/// (a) the closed form over the plane; (b) over v_m for a few v_p, and the integrated points.
PaperFigure asymmetric_figure(const std::string& name, const std::string& title,
                              const SlideQuantity& quantity) {
  PaperFigure figure;
  figure.name = name;
  figure.title = title;
  Table& table = figure.table;
  const std::string symbol = quantity.size ? "|" + quantity.name + "|" : quantity.name;
  const std::string axis = fmt::format("{}_i [{}]", symbol, quantity.unit);
  const auto closed_at = [&](double v_m, double v_p) {
    return drawn(quantity, asymmetric_closed_form(v_m * kCentimetre, v_p * kCentimetre));
  };

  const std::vector<double> v_m = equally_spaced(-100, -2.5, 40),
                            v_p = equally_spaced(-100, 100, 41);
  std::vector<double> map, row_m, row_p;
  double most = 0;
  for (double p : v_p)
    for (double m : v_m) {
      row_m.push_back(m), row_p.push_back(p);
      map.push_back(std::abs(p) <= 2 * std::abs(m) ? closed_at(m, p) : NAN);
      if (std::abs(p) <= std::abs(m)) most = std::max(most, std::abs(map.back()));
    }
  table.add("v_m [cm/s]", row_m);
  table.add("v_p [cm/s]", row_p);
  table.add(fmt::format("{} closed form [{}]", symbol, quantity.unit), map);
  Panel plane{fmt::format("(a) {}_i, closed form", symbol),
              {"v_m [cm/s]", false, -100, 0},
              {"v_p [cm/s]", false, -100, 100}};
  plane.colours = ColourMap{v_m, v_p, map, axis, -most, most};
  plane.curves = {line_of("v_p = 0, symmetric", {Ink::black, Line::solid, Marker::none, true}, 0)};

  Panel curves{fmt::format("(b) {}_i over v_m", symbol), {"v_m [cm/s]", false, -102, 0}, {axis}};
  const std::array<std::pair<double, Look>, 5> chosen = {{{0, {Ink::black, Line::solid}},
                                                          {-50, {Ink::vermilion, Line::dotted}},
                                                          {-25, {Ink::orange, Line::dash_dot}},
                                                          {25, {Ink::green, Line::dashed}},
                                                          {50, {Ink::blue, Line::dotted}}}};
  for (const auto& [p, look] : chosen) {
    Curve curve{p == 0 ? "" : fmt::format("v_p = {}{:g} cm/s", p < 0 ? "−" : "", std::abs(p)),
                look};
    for (double m : equally_spaced(-100, -std::max(1.0, std::abs(p)), 100)) {
      curve.x.push_back(m);
      curve.y.push_back(closed_at(m, p));
    }
    curves.curves.push_back(std::move(curve));
  }
  std::vector<double> point_m, point_p, seen, residual;
  for (const AsymmetricPoint& point : asymmetric_points()) {
    point_m.push_back(point.v_m / kCentimetre);
    point_p.push_back(point.v_p / kCentimetre);
    seen.push_back(drawn(quantity, point.slide));
    residual.push_back(seen.back() - closed_at(point_m.back(), point_p.back()));
  }
  curves.curves.push_back({kReferenceLabel, kReference, point_m, seen});
  table.add("v_m of points [cm/s]", point_m);
  table.add("v_p of points [cm/s]", point_p);
  table.add(fmt::format("{} reference [{}]", symbol, quantity.unit), seen);
  table.add(fmt::format("{} residual [{}]", symbol, quantity.unit), residual);
  figure.panels = {plane, curves};
  figure.caption = fmt::format(
      "Sphere i rests or rolls along −i when j meets it from that side; v_m = (v_i − v_j)·i, v_p = "
      "(v_i + v_j)·i, signs along i. Closed forms (57)–(60) with C = πAγ_S/(2ω_0) = {:.4f} to "
      "first "
      "order; (a) is left white where |v_m| < |v_p|/2, as K excludes |v_m| ≪ |v_p|; (b) has his "
      "case, |v_p| ≤ |v_m|, one sphere at rest or both towards each other. Solid: the symmetric "
      "case. Points: integrated, held on the plane; the share that they exchange is smaller than "
      "C (spin-exchange). K Fig. {}. ",
      first_order_share(), name.substr(1));
  figure.caption += steel_caption();
  return figure;
}

/// The two integrated spheres of a collision at |v_m| = 10 cm/s.
std::array<AsymmetricSlide, 2> at_ten(double v_p_share, double restitution = 0.9,
                                      double rubbing_ratio = kSteel.rubbing_ratio) {
  return asymmetric_reference(
      asymmetric_pair(-kSpeed, v_p_share * kSpeed, restitution, rubbing_ratio));
}

/// How a quantity depends on v_p: its greatest change from the symmetric value, in that.
double dependence(double AsymmetricSlide::*of, double rubbing_ratio = kSteel.rubbing_ratio) {
  const double symmetric = at_ten(0, 0.9, rubbing_ratio)[0].*of;
  double most = 0;
  for (const AsymmetricSlide& slide : at_ten(1, 0.9, rubbing_ratio))
    most = std::max(most, std::abs(slide.*of / symmetric - 1));
  return most;
}

Statement weak(const char* of_what, double AsymmetricSlide::*of) {
  return {fmt::format("change of {} by v_p = ±|v_m|, of the symmetric one", of_what),
          "very weak",
          0,
          kWeak,
          dependence(of),
          0,
          fmt::format("read as below {:g}; to first order 2C/(1+e_n) = {:.3f}", kWeak,
                      2 * first_order_share() / 1.9)};
}

Statement strong(const char* of_what, double AsymmetricSlide::*of) {
  return {fmt::format("change of {} by v_p = ±|v_m|, of the symmetric one", of_what),
          "strong",
          kStrong,
          kUnbounded,
          dependence(of),
          0,
          "read as above itself"};
}

/// v_i/v_j at which i is back where it was struck when its slide ends, integrated.
double returning_ratio(double restitution) {
  const double share = secant_zero(
      [&](double v_p_share) { return at_ten(v_p_share, restitution)[0].distance; }, -0.6, -0.7);
  return (share - 1) / (share + 1);  // v_m = −1
}

/// What a pair loses while it slides, of the translational energy that it had [-].
double pair_loss(double v_p_share, double restitution, double rubbing_ratio) {
  const auto both = at_ten(v_p_share, restitution, rubbing_ratio);
  const double v_i = (v_p_share - 1) / 2 * kSpeed, v_j = (v_p_share + 1) / 2 * kSpeed;
  return (both[0].energy_change + both[1].energy_change) / (v_i * v_i + v_j * v_j);
}

}  // namespace

PaperFigure figure_k8() {
  PaperFigure figure = asymmetric_figure("K8", "Sliding time after asymmetric collisions",
                                         {"t^s", "s", 1, &AsymmetricSlide::time});
  const double order = left_out_by_k(kSpeed);
  figure.statements = {weak("t^s", &AsymmetricSlide::time),
                       {"the same for C = 0", "0", 0, order, dependence(&AsymmetricSlide::time, 0),
                        0, "within g t_col/v_rel, (38), which K leaves out"}};
  return figure;
}

PaperFigure figure_k9() {
  PaperFigure figure =
      asymmetric_figure("K9", "Sliding distance after asymmetric collisions",
                        {"s", "cm", kCentimetre, &AsymmetricSlide::distance, true});
  const auto rule = [](double restitution, double share) {
    return HeadOnCollision{steel_sphere().inverse_shape_factor(), restitution, share}
        .zero_sliding_distance_ratio();
  };
  const double corrected = rule(0.9, kPrintedShare);
  figure.panels[0].curves.push_back(zero_line("s_i = 0"));
  // (61) as it is printed.
  const double A = steel_sphere().inverse_shape_factor(), e = 0.9, c = kPrintedShare;
  const double printed = ((e + 2) * (1 + A) + e * A - 2 * c) / ((e - 2) * (1 + A) + e * A + 2 * c);
  const double seen = returning_ratio(e);
  figure.statements = {
      strong("s", &AsymmetricSlide::distance),
      stated_number("v_i/v_j for which s_i = 0, elastic", "−6", -6, 0.5, returning_ratio(1)),
      stated_number("v_i/v_j for which s_i = 0, e_n = 0.9, C = 0.13, (61) as printed",
                    fmt::format("−{:.2f}", -printed), printed, 0.005, seen, 0,
                    fmt::format("a misprint: it gives −13 for elastic spheres; corrected −{:.3f} "
                                "with C to first order",
                                -corrected)),
      {"v_i/v_j for which s_i = 0, (61) corrected", fmt::format("−{:.2f}", -corrected),
       corrected - c * c, corrected + c * c, seen, 0,
       fmt::format("allowed is C²; −{:.3f} with the exponential share",
                   -rule(e, rubbed_share(c)))}};
  return figure;
}

PaperFigure figure_k10() {
  PaperFigure figure = asymmetric_figure("K10", "Energy that sphere i loses while it slides",
                                         {"ΔE", "cm²/s²", 1e-4, &AsymmetricSlide::energy_change});
  const double A = steel_sphere().inverse_shape_factor(), e = 0.9, c = kPrintedShare;
  const auto struck = at_ten(1);  // i at rest, v^0 = 10 cm/s
  const auto square = [](double value) { return value * value; };
  const double before = square(kSpeed), in_cgs = 1e-4;
  const double printed_62 =
      (0.5 * (1 + e) - c) / square(1 + A) * ((1 + e) * (0.5 + A) - c) * before;
  const double printed_63 =
      -(0.5 * (1 + e) - c) / square(1 + A) * ((1 - e) * (1 + A) + 0.5 * (1 + e) - c) * before;
  const double printed_64 = (0.5 * (1 + e) - c) / square(1 + A) * ((1 + e) * A - (1 - e) * (1 + A));
  const double asymmetric = pair_loss(1, 1, 0), symmetric = pair_loss(0, 1, 0);
  const double with_rubbing = pair_loss(1, e, kSteel.rubbing_ratio), without = pair_loss(1, e, 0);
  const double allowed = c * c * before / in_cgs;
  figure.statements = {
      strong("ΔE", &AsymmetricSlide::energy_change),
      {"ΔE of the sphere that hits one at rest, v^0 = 10 cm/s [cm²/s²]", "negative", -kUnbounded, 0,
       struck[1].energy_change / in_cgs},
      {"ΔE of the one at rest [cm²/s²]", "positive", 0, kUnbounded,
       struck[0].energy_change / in_cgs},
      stated_number("the same by (62) as printed [cm²/s²]",
                    fmt::format("{:.1f}", printed_62 / in_cgs), printed_62 / in_cgs, allowed,
                    struck[0].energy_change / in_cgs, 0,
                    "a misprint, ½(1+e_n)+C is right: the target is spun backwards and slips more; "
                    "allowed is C² (v^0)²"),
      stated_number("ΔE of the one that hits by (63) [cm²/s²]",
                    fmt::format("−{:.2f}", -printed_63 / in_cgs), printed_63 / in_cgs, allowed,
                    struck[1].energy_change / in_cgs, 0, "allowed is C² (v^0)²"),
      stated_number("ΔE of both, of (v^0)², by (64) as printed", fmt::format("{:.3f}", printed_64),
                    printed_64, c * c, with_rubbing, 0,
                    "the sum of (62) corrected and (63); allowed is C²"),
      stated_number(
          "loss of a symmetric over that of a completely asymmetric pair, elastic", "twice", 2, 0.5,
          symmetric / asymmetric, 0,
          fmt::format("(66) {:.4f}, (65) {:.4f} of the energy before", symmetric, asymmetric)),
      {"what the rubbing adds to a pair's loss, e_n = 0.9, target at rest, of (v^0)²",
       "even smaller for C ≠ 0", -kUnbounded, 0, with_rubbing - without, 0,
       "it follows from the misprint of (62): the struck sphere slips more, not less"}};
  figure.panels[0].curves.push_back(zero_line("ΔE_i = 0"));
  return figure;
}

PaperFigure figure_k11() {
  PaperFigure figure =
      asymmetric_figure("K11", "Momentum that sphere i loses while it slides",
                        {"Δp", "cm/s", kCentimetre, &AsymmetricSlide::momentum_change});
  const double order = left_out_by_k(kSpeed);
  const auto scaled_by_67 = [](double v_p_share) {
    const double A = steel_sphere().inverse_shape_factor();
    return at_ten(v_p_share, 1)[0].momentum_change * (1 + A) / kSpeed;
  };
  const std::string remark = "within g t_col/v_rel, (38)";
  figure.statements = {
      weak("Δp", &AsymmetricSlide::momentum_change),
      stated_number("Δp over −v_m/(1+A), elastic, i hits one at rest, (67)", "1", 1, order,
                    scaled_by_67(-1), 0, remark),
      stated_number("the same, symmetric", "1", 1, order, scaled_by_67(0), 0, remark),
      stated_number("the same, i at rest is hit", "1", 1, order, scaled_by_67(1), 0, remark)};
  return figure;
}

}  // namespace slipcheck
