#include <fmt/format.h>

#include <cmath>

#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "figures/steel_pair.h"

namespace slipcheck {

PaperFigure figure_k6() {
  PaperFigure figure;
  figure.name = "K6";
  figure.title = "Sliding time and distance after symmetric collisions";

  const HeadOnCollision rule{steel_sphere().inverse_shape_factor(), SteelPair{}.restitution, 0};
  std::vector<double> v_rel, time, time_closed, time_error, way, way_closed, way_error, bound;
  std::vector<double> effective, effective_closed, effective_error;
  for (double speed : kSpeedPoints) {
    const double v = speed * kCentimetre;
    const SteelPair pair{v / 2, -v / 2};
    const ReferenceResult seen = pair.solve();
    const AfterCollision after = pair.insight().after[0];
    v_rel.push_back(speed);
    time.push_back(value_of(seen, "i.sliding_time"));
    time_closed.push_back(after.sliding_time);
    time_error.push_back(time.back() / time_closed.back() - 1);
    way.push_back(value_of(seen, "i.sliding_distance") / kCentimetre);
    // K (44) by itself, not by way of v^f and u^f.
    way_closed.push_back(
        rule.symmetric_sliding_distance(v, kSteel.kinetic_friction, kSteel.gravity) / kCentimetre);
    way_error.push_back(way.back() / way_closed.back() - 1);
    effective.push_back(value_of(seen, "i-j.effective_restitution"));
    effective_closed.push_back(rule.effective_restitution());
    effective_error.push_back(effective.back() - effective_closed.back());
    bound.push_back(steel_collision_time(v) / after.sliding_time);
  }
  Table& table = figure.table;
  table.add("v_rel [cm/s]", v_rel);
  table.add("t^s reference [s]", time);
  table.add("t^s closed form [s]", time_closed);
  table.add("t^s relative residual [-]", time_error);
  table.add("s reference [cm]", way);
  table.add("s closed form [cm]", way_closed);
  table.add("s relative residual [-]", way_error);
  table.add("e_eff reference [-]", effective);
  table.add("e_eff closed form [-]", effective_closed);
  table.add("e_eff residual [-]", effective_error);
  table.add("t_col/t^s [-]", bound);

  const auto size = [](std::vector<double> values) {
    for (double& value : values) value = std::abs(value);
    return values;
  };
  const std::vector<double> fine = equally_spaced(0, 100, 101);
  std::vector<double> line, parabola;  // (42), (44)
  for (double v : fine) {
    line.push_back((1 + rule.restitution) * v * kCentimetre /
                   (2 * (1 + rule.A) * kSteel.kinetic_friction * kSteel.gravity));
    parabola.push_back(
        rule.symmetric_sliding_distance(v * kCentimetre, kSteel.kinetic_friction, kSteel.gravity) /
        kCentimetre);
  }
  const AxisSpec linear{"v_{rel} [cm/s]", false, 0, 102};
  const AxisSpec speed{"v_{rel} [cm/s]", true, 0.9, 110};
  Panel a{"(a) sliding time", linear, {"t^s [s]", false, 0}};
  a.curves = {{kClosedFormLabel, kClosedForm, fine, line},
              {kReferenceLabel, kReference, v_rel, time}};
  Panel b{"(b) sliding distance", linear, {"s [cm]", false, 0}};
  b.curves = {{"", kClosedForm, fine, parabola}, {"", kReference, v_rel, way}};
  Panel c{"(c) effective restitution", speed, {"e_{eff}", false, 0.33, 0.38}};
  c.curves = {{"", kClosedForm, v_rel, effective_closed}, {"", kReference, v_rel, effective}};
  Panel d{"(d) reference against closed form", speed, {"|residual|", true}};
  d.curves = {
      {"t_{col}/t^s", {Ink::grey, Line::dotted}, v_rel, bound},
      {"residual of t^s", {Ink::blue, Line::none, Marker::circle}, v_rel, size(time_error)},
      {"residual of s", {Ink::vermilion, Line::none, Marker::triangle}, v_rel, size(way_error)},
      {"residual of e_{eff}",
       {Ink::green, Line::none, Marker::square},
       v_rel,
       size(effective_error)}};
  figure.panels = {a, b, c, d};
  figure.caption =
      "Each of two spheres that meet at v_{rel}/2. (a) t^s = (1+e_n) v_{rel}/(2(1+A) μ_k g), (42). "
      "(b) s of (44), read with 1+e_n in the numerator. Beyond the paper's: (c) e_{eff} = (A e_n − "
      "1)/(1+A), (68). (d) The closed forms take the collision as an instant; what they miss, "
      "relative for t^s and s, is of the order t_{col}/t^s. K Fig. 6. ";
  figure.caption += steel_caption();

  const std::size_t ten = kTenCentimetres;
  // e_eff is linear in e_n: v^s is zero between these.
  const auto rolls_on = [](double e) {
    return value_of(SteelPair{0.05, -0.05, e}.solve(), "i-j.effective_restitution");
  };
  const double low = 0.35, high = 0.45, at_low = rolls_on(low), at_high = rolls_on(high);
  figure.statements = {
      stated_number("t^s at v_rel = 10 cm/s [s]", "0.03", 0.03, 0.005, time[ten]),
      stated_number("s at v_rel = 10 cm/s [cm]", "0.1", 0.1, 0.05, way[ten], 0,
                    "with 1+e_n in the denominator of (44) it would be 0.024"),
      stated_number("|v^s|/v^0, (43)", "0.36", 0.36, 0.005, effective[ten]),
      stated_number("e_n below which they roll backwards when the slide ends", "I/mR^2 = 2/5", 0.4,
                    0.005, low - at_low * (high - low) / (at_high - at_low), 0,
                    "where the integrated v^s is zero")};
  return figure;
}

}  // namespace slipcheck
