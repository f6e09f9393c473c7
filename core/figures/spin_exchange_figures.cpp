#include <fmt/format.h>

#include <algorithm>
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
  double factor = 1;  ///< by which the observable becomes the closed form's quantity
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
      values.push_back(drawn(quantity.factor * value_of(results[n], name), n));
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

/// Where j is at rest.
std::size_t at_rest() {
  const std::vector<double>& ratio = asymmetric_collisions().ratio;
  const auto nearest = std::min_element(
      ratio.begin(), ratio.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  return static_cast<std::size_t>(nearest - ratio.begin());
}

/// What K says of the spins and, in App. F, of the jump: of a target at rest, v^0 = 10 cm/s.
std::vector<Statement> spin_statements() {
  const AsymmetricCollisions& all = asymmetric_collisions();
  const std::size_t n = at_rest();
  const double v = AsymmetricCollisions::kFirstSpeed;
  const SteelPair pair{v, 0}, elastic{v, 0, 1};
  const ReferenceResult struck = elastic.solve();
  const double damping = pair.contact().damping_ratio();
  const auto share = [&](double surface) { return (v - surface) / v; };
  const double exchanged =
      share(kSteel.radius * value_of(all.free[n], "i.angular_velocity_after_collision.y"));
  const double slip = left_out_by_k(v);
  const double flight = value_of(all.free[n], "i.flight_time");
  const std::string falls =
      "K takes the force of the first touch for the whole contact; it falls "
      "as the spins become alike";
  return {
      stated_number("C for γ_S = γ_N/2, e_n = 0.9", "0.13", 0.13, 0.005, all.constant),
      stated_number("share of v_i + v_j exchanged, (56)", "C = 0.13", 0.13, 0.005, exchanged, 0,
                    fmt::format("first order; without Coulomb's cap ½(1 − e^−2C) = {:.4f}, with "
                                "it {:.4f}",
                                all.share, share(all.capped_free[0][n].surface_velocity))),
      {"what Coulomb's cap takes of that share, App. E", "O(ε²)", 0, damping * damping,
       all.share - share(all.capped[0][n].surface_velocity), 0,
       fmt::format("read as at most ε² = {:.4f}", damping * damping)},
      stated_number("u^f/v^0 of a sphere that hits one at rest, elastic", "−1", -1, slip,
                    value_of(struck, "i.slip_after_collision.x") / v),
      stated_number("u^f/v^0 of the one at rest", "1", 1, slip,
                    value_of(struck, "j.slip_after_collision.x") / v),
      stated_number(
          "v^d = 2g/γ_S, above which the faster sphere lifts off [cm/s]", "0.5", 0.5, 0.05,
          2 * kSteel.gravity / (pair.rubbing_ratio * pair.contact().damping_rate()) / kCentimetre),
      stated_number("v^z of the jump [cm/s]", "0.5", 0.5, 0.05,
                    value_of(all.free[n], "i.lift_off_speed") / kCentimetre, 0, falls),
      stated_number("h^z [cm]", "1.3e-4", 1.3e-4, 0.05e-4,
                    value_of(all.free[n], "i.jump_height") / kCentimetre, 0, falls),
      stated_order("t^z [s]", "10^-2", 1e-2, flight, 0,
                   "a misprint: 2v^z/g is 1.0e-3 s for the paper's own v^z"),
      {"t^z/t_col", "≫ 1", 10, kUnbounded, flight / value_of(all.free[n], "i-j.contact_time"), 0,
       "read as above 10"},
      {"t^s/t^z", "≫ 1", 10, kUnbounded, value_of(all.free[n], "i.sliding_time") / flight, 0,
       "read as above 10"}};
}

}  // namespace

PaperFigure figure_spin_exchange() {
  PaperFigure figure =
      started("spin-exchange", "Slip after asymmetric collisions",
              "(a), (b) Slip velocity u^f of both spheres at the end of the collision, (62) "
              "corrected. (c), (d) The exchanged share of the spins, c in R ΔΩ = −c(v_i + v_j).");
  const SphereQuantity slip{"u^f", "cm/s", kCentimetre, "slip_after_collision.x",
                            [](const AfterCollision& a) { return a.slip; }};
  SphereQuantity share{"c", "", 1, "angular_velocity_after_collision.y",
                       [](const AfterCollision& a) { return a.surface_velocity; }};
  share.factor = kSteel.radius;
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
  figure.statements = spin_statements();

  const AsymmetricCollisions& all = asymmetric_collisions();
  const std::size_t n = at_rest();
  const auto taken = [&](double surface) { return -surface / AsymmetricCollisions::kFirstSpeed; };
  const double capped = taken(all.capped[1][n].surface_velocity);
  const double seen =
      taken(kSteel.radius * value_of(all.held[n], "j.angular_velocity_after_collision.y"));
  figure.notes = fmt::format(
      "K takes the share to first order, C. Of a target at rest, which the rubbing presses down, "
      "the substrate's friction takes back {:.0f} % of the exchanged spin: c = {:.4f} with the cap "
      "and {:.4f} integrated.",
      100 * (1 - seen / capped), capped, seen);
  return figure;
}

PaperFigure figure_rolling_restitution() {
  PaperFigure figure = started(
      "rolling-restitution",
      "Rolling velocities and effective restitution after asymmetric collisions",
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

  // K's case, Sec. IV (vi): opposite directions, or one at rest.
  const std::size_t n = at_rest();
  const auto effective_at = [&](std::size_t k) {
    return value_of(all.held[k], "i-j.effective_restitution");
  };
  double low = effective_at(0), high = low, highest = low;
  for (std::size_t k = 0; k < all.held.size(); ++k) {
    highest = std::max(highest, effective_at(k));
    if (k > n) continue;
    low = std::min(low, effective_at(k));
    high = std::max(high, effective_at(k));
  }
  const std::string grows = "grows by what the substrate rubs the pressed sphere";
  figure.statements = {stated_number("e_eff after a symmetric collision, (68)", "0.36", 0.36, 0.005,
                                     effective_at(0)),
                       stated_number("e_eff with a target at rest, (68)", "0.36", 0.36, 0.005,
                                     effective_at(n), 0, grows),
                       {"range of e_eff over opposite directions", "none: e_n and A alone", 0, 0.01,
                        high - low, 0, "read as less than one in its second digit"}};
  figure.notes = fmt::format(
      "The substrate's friction on the sphere that the rubbing presses down lifts e_eff from "
      "{:.4f}, (68), to {:.4f} for a target at rest and {:.3f} for nearly equal speeds, which K "
      "leaves out.",
      closed[0], effective_at(n), highest);
  return figure;
}

}  // namespace slipcheck
