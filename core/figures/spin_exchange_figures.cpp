#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>

#include "figures/asymmetric_collision.h"
#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

constexpr std::array kBodies = {"i", "j"};
constexpr Look kFreeReference{Ink::purple, Line::none, Marker::triangle};

/// A quantity of one sphere after the collision.
struct SphereQuantity {
  std::string name;  ///< as plot_text.h, "u^f"
  std::string unit;  ///< "cm/s"
  double unit_in_si = 1;
  std::string observable;  ///< without the body's name
  std::function<double(const AfterCollision&)> closed;
  /// By which the observable becomes the closed form's quantity, by sphere.
  std::array<double, 2> factor = {1, 1};
  /// What is drawn of either [SI], where it is not the quantity itself; sphere and point.
  std::function<double(double, std::size_t, std::size_t)> drawn = nullptr;
};

/// One sphere's quantity over v_j/v_i by all ways to reckon it; `table` gets what is drawn.
Panel chart_of(const SphereQuantity& quantity, std::size_t k, char letter, Table& table) {
  const AsymmetricCollisions& all = asymmetric_collisions();
  const std::string unit = quantity.unit.empty() ? "" : " [" + quantity.unit + "]";
  Panel chart;
  chart.title = fmt::format("({}) {} of sphere {}", letter, quantity.name, kBodies[k]);
  chart.x = {"v_j/v_i", false, -1.05, 1};
  chart.y = {fmt::format("{}_{}{}", quantity.name, kBodies[k], unit)};
  const auto drawn = [&](double value, std::size_t n) {
    return (quantity.drawn ? quantity.drawn(value, k, n) : value) / quantity.unit_in_si;
  };
  const auto closed = [&](const AsymmetricCollisions::Course& course) {
    std::vector<double> values;
    for (std::size_t n = 0; n < course[k].size(); ++n)
      values.push_back(drawn(quantity.closed(course[k][n]), n));
    return values;
  };
  const auto seen = [&](const std::vector<ReferenceResult>& results) {
    std::vector<double> values;
    const std::string name = observable_key(quantity.observable).of(kBodies[k]).text();
    for (std::size_t n = 0; n < results.size(); ++n)
      values.push_back(drawn(quantity.factor[k] * value_of(results[n], name), n));
    return values;
  };
  const auto add_column = [&](const char* column, const std::vector<double>& values) {
    table.add(fmt::format("{}_{} {} [{}]", quantity.name, kBodies[k], column,
                          quantity.unit.empty() ? "-" : quantity.unit),
              values);
  };
  const auto add = [&](const std::string& label, const char* column, const Look& look,
                       const std::vector<double>& values) {
    add_column(column, values);
    chart.curves.push_back({label, look, all.ratio, values});
  };
  const auto capped = closed(all.capped), capped_free = closed(all.capped_free);
  const auto held = seen(all.held), free = seen(all.free);
  add("C = 0", "C = 0", {Ink::grey, Line::dotted}, closed(all.without_rubbing));
  add(fmt::format("first order, C = {:.3f}", all.constant), "first order",
      {Ink::vermilion, Line::dashed}, closed(all.first_order));
  add(fmt::format("exponential, ½(1−e^{{−2C}}) = {:.3f}", all.share), "exponential",
      {Ink::blue, Line::solid}, closed(all.exponential));
  add("with Coulomb's cap", "with cap", {Ink::green, Line::dash_dot}, capped);
  add("reference, held on the plane", "reference held", kReference, held);
  add("reference, free to jump", "reference free", kFreeReference, free);
  // Both sets of points by turns, so that neither hides the other.
  for (const std::size_t set : {0u, 1u}) {
    Curve& points = chart.curves[chart.curves.size() - 2 + set];
    points.marker_every = 2;
    points.marker_first = set;
  }
  add_column("with cap free", capped_free);
  add_column("residual held", difference(held, capped));
  add_column("residual free", difference(free, capped_free));
  return chart;
}

PaperFigure started(const char* name, const char* title, const std::string& what) {
  const AsymmetricCollisions& all = asymmetric_collisions();
  PaperFigure figure;
  figure.name = name;
  figure.title = title;
  figure.caption = what;
  figure.caption += fmt::format(
      " Sphere i rolls with v_i = {:g} cm/s towards j or after it; v_j/v_i = −1 is symmetric, 0 a "
      "target at rest. Signs are along v_i. ",
      AsymmetricCollisions::kFirstSpeed / kCentimetre);
  figure.caption += fmt::format(
      "Lines: closed forms by the spin exchange: none; to first order ΔΩ = −C(Ω_i + Ω_j), C = "
      "πAγ_S/(2ω_0) = {:.4f}, as in the paper's figures; exactly without Coulomb's cap, {:.4f}; "
      "with the cap, which wins where F_N is weak, towards v_j/v_i = 1. Points: the integrated "
      "law, held on the plane as in K Sec. II–IV, and free to jump (App. F). ",
      all.constant, all.share);
  figure.caption +=
      "The points less the closed form with the cap are what the substrate's friction does in the "
      "collision, to sphere j, which the rubbing presses down, and, if held, to i. K on "
      "asymmetric collisions. ";
  figure.caption += steel_caption();
  figure.table.add("v_j/v_i [-]", all.ratio);
  return figure;
}

/// v_i and v_j [m/s] of a point.
std::array<double, 2> speeds_at(std::size_t n) {
  const double v_i = AsymmetricCollisions::kFirstSpeed;
  return {v_i, asymmetric_collisions().ratio[n] * v_i};
}

}  // namespace

PaperFigure figure_k8() {
  PaperFigure figure =
      started("K8", "Slip after asymmetric collisions",
              "(a), (b) Slip velocity u^f of both spheres at the end of the collision, (62) "
              "corrected. (c), (d) The exchanged share of the spins, c in R ΔΩ = −c(v_i + v_j).");
  const SphereQuantity slip{"u^f", "cm/s", kCentimetre, "slip_after_collision.x",
                            [](const AfterCollision& a) { return a.slip; }};
  SphereQuantity share{"c", "", 1, "angular_velocity_after_collision.y",
                       [](const AfterCollision& a) { return a.surface_velocity; }};
  share.factor = {kSteel.radius, kSteel.radius};
  share.drawn = [](double surface, std::size_t k, std::size_t n) {
    const auto before = speeds_at(n);
    const double sum = before[0] + before[1];
    return sum > 0 ? (before[k] - surface) / sum : kNotObserved;
  };
  Panel c_i = chart_of(share, 0, 'c', figure.table);
  Panel c_j = chart_of(share, 1, 'd', figure.table);
  c_i.y.low = c_j.y.low = -0.005;
  c_i.y.high = c_j.y.high = 0.15;
  figure.panels = {chart_of(slip, 0, 'a', figure.table), chart_of(slip, 1, 'b', figure.table), c_i,
                   c_j};
  return figure;
}

PaperFigure figure_k9() {
  const AsymmetricCollisions& all = asymmetric_collisions();
  const HeadOnCollision rule{steel_sphere().inverse_shape_factor(), SteelPair{}.restitution,
                             all.share};
  const double returning = 1 / rule.zero_sliding_distance_ratio();
  PaperFigure figure = started(
      "K9", "Sliding times and distances after asymmetric collisions",
      fmt::format("Time t^s for which each sphere slides and the length s of its displacement "
                  "meanwhile. (61), corrected, puts s_i = 0 with the exponential exchange at "
                  "v_j/v_i = −{:.3f}.",
                  -returning));
  const SphereQuantity time{"t^s", "ms", 1e-3, "sliding_time",
                            [](const AfterCollision& a) { return a.sliding_time; }};
  const SphereQuantity way{"s", "mm", 1e-3, "sliding_distance",
                           [](const AfterCollision& a) { return std::abs(a.sliding_distance); }};
  Panel s_i = chart_of(way, 0, 'c', figure.table);
  s_i.marks.push_back({returning, "(61)"});
  figure.panels = {chart_of(time, 0, 'a', figure.table), chart_of(time, 1, 'b', figure.table), s_i,
                   chart_of(way, 1, 'd', figure.table)};
  return figure;
}

PaperFigure figure_k10() {
  PaperFigure figure = started(
      "K10", "Rolling velocities and effective restitution after asymmetric collisions",
      "(a), (b) Velocity v^s with which each sphere rolls on. (c) e_{eff} = (v^s_j − v^s_i)/(v_i "
      "− v_j), which the spin exchange leaves at (A e_n − 1)/(1+A); to first order the friction "
      "on the sphere that the rubbing presses down adds Aμ_k ∫F_R dt/((1+A) m v_{rel}). (d) e_n "
      "of the collision itself.");
  const SphereQuantity rolling{"v^s", "cm/s", kCentimetre, "rolling_velocity.x",
                               [](const AfterCollision& a) { return a.rolling_velocity; }};
  figure.panels = {chart_of(rolling, 0, 'a', figure.table),
                   chart_of(rolling, 1, 'b', figure.table)};

  const AsymmetricCollisions& all = asymmetric_collisions();
  const HeadOnCollision rule{steel_sphere().inverse_shape_factor(), SteelPair{}.restitution, 0};
  const std::vector<double> closed(all.ratio.size(), rule.effective_restitution());
  std::vector<double> pressed;
  for (std::size_t n = 0; n < all.ratio.size(); ++n) {
    const auto [v_i, v_j] = speeds_at(n);
    SteelPair pair{v_i, v_j};
    pair.confined = false;
    pressed.push_back(closed[n] + rule.A * kSteel.kinetic_friction *
                                      pair.insight().rubbing.impulse /
                                      ((1 + rule.A) * steel_sphere().mass * (v_i - v_j)));
  }
  const auto add = [&](char letter, const std::string& name, const std::string& symbol,
                       const std::string& observable, const std::vector<double>& expected,
                       AxisSpec axis) {
    std::vector<double> held, free;
    for (const ReferenceResult& result : all.held) held.push_back(value_of(result, observable));
    for (const ReferenceResult& result : all.free) free.push_back(value_of(result, observable));
    figure.table.add(symbol + " closed form [-]", expected);
    figure.table.add(symbol + " reference held [-]", held);
    figure.table.add(symbol + " reference free [-]", free);
    figure.table.add(symbol + " residual held [-]", difference(held, expected));
    figure.table.add(symbol + " residual free [-]", difference(free, expected));
    Panel chart;
    chart.title = fmt::format("({}) {}", letter, name);
    chart.x = {"v_j/v_i", false, -1.05, 1};
    chart.y = std::move(axis);
    chart.curves = {{"(c), (d): closed form", {Ink::black, Line::solid}, all.ratio, expected},
                    {"", kReference, all.ratio, held, 2},
                    {"", kFreeReference, all.ratio, free, 2, 1}};
    return chart;
  };
  Panel effective =
      add('c', "effective restitution", "e_eff", "i-j.effective_restitution", closed, {"e_{eff}"});
  figure.table.add("e_eff with friction on the pressed sphere [-]", pressed);
  effective.curves.push_back(
      {"(c): with friction on the pressed sphere", {Ink::black, Line::dashed}, all.ratio, pressed});
  figure.panels.push_back(effective);
  figure.panels.push_back(add('d', "restitution of the collision", "e_n", "i-j.restitution",
                              std::vector<double>(all.ratio.size(), rule.restitution),
                              {"e_n", false, 0.895, 0.905}));
  return figure;
}

PaperFigure figure_k11() {
  PaperFigure figure = started(
      "K11", "Energy and momentum lost while sliding after asymmetric collisions",
      "ΔE = |v^f|² − |v^s|² and Δp = v^f − v^s (per unit mass, ΔE times two) of each sphere.");
  const SphereQuantity energy{"ΔE", "cm²/s²", 1e-4, "energy_change_sliding",
                              [](const AfterCollision& a) { return a.energy_change; }};
  SphereQuantity momentum{"Δp", "cm/s", kCentimetre, "momentum_change_sliding",
                          [](const AfterCollision& a) { return a.momentum_change; }};
  momentum.factor = {-1, 1};  // observed along the line away from the other sphere
  figure.panels = {chart_of(energy, 0, 'a', figure.table), chart_of(energy, 1, 'b', figure.table),
                   chart_of(momentum, 0, 'c', figure.table),
                   chart_of(momentum, 1, 'd', figure.table)};
  return figure;
}

}  // namespace slipcheck
