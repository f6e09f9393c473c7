#include <fmt/format.h>

#include <cmath>

#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "figures/steel_pair.h"

namespace slipcheck {

PaperFigure figure_k7() {
  const std::vector<double> speeds = logarithmically_spaced(0.3e-2, 1, 26);  // v_rel
  PaperFigure figure;
  figure.name = "K7";
  figure.title = "Sliding time and distance after symmetric collisions";

  const HeadOnCollision rule{steel_sphere().inverse_shape_factor(), SteelPair{}.restitution, 0};
  std::vector<double> v_rel, time, time_closed, time_error, way, way_closed, way_error, bound;
  std::vector<double> effective, effective_closed, effective_error;
  for (double v : speeds) {
    const SteelPair pair{v / 2, -v / 2};
    const ReferenceResult seen = pair.solve();
    const AfterCollision after = pair.insight().after[0];
    v_rel.push_back(v / 1e-2);
    time.push_back(value_of(seen, "i.sliding_time") / 1e-3);
    time_closed.push_back(after.sliding_time / 1e-3);
    time_error.push_back(time.back() / time_closed.back() - 1);
    way.push_back(value_of(seen, "i.sliding_distance") / 1e-2);
    // K (44) by itself, not by way of v^f and u^f.
    way_closed.push_back(
        rule.symmetric_sliding_distance(v, kSteel.kinetic_friction, kSteel.gravity) / 1e-2);
    way_error.push_back(way.back() / way_closed.back() - 1);
    effective.push_back(value_of(seen, "i-j.effective_restitution"));
    effective_closed.push_back(rule.effective_restitution());
    effective_error.push_back(effective.back() - effective_closed.back());
    bound.push_back(kSteel.collision_time / after.sliding_time);
  }
  Table& table = figure.table;
  table.add("v_rel [cm/s]", v_rel);
  table.add("t^s reference [ms]", time);
  table.add("t^s closed form [ms]", time_closed);
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
  const AxisSpec speed{"v_{rel} [cm/s]", true, 0.25, 120};
  Panel a{"(a) sliding time", speed, {"t^s [ms]", true}};
  a.curves = {{kClosedFormLabel, kClosedForm, v_rel, time_closed},
              {kReferenceLabel, kReference, v_rel, time}};
  Panel b{"(b) sliding distance", speed, {"s [cm]", true}};
  b.curves = {{"", kClosedForm, v_rel, way_closed}, {"", kReference, v_rel, way}};
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
  figure.caption = fmt::format(
      "Each of two spheres that meet at v_{{rel}}/2. (a) t^s = (1+e_n) v_{{rel}}/(2(1+A) μ_k g). "
      "(b) s, (44) corrected: {:.4f} cm at 10 cm/s. (c) e_{{eff}} = (A e_n − 1)/(1+A). (d) The "
      "closed forms take the collision as an instant; what they miss, relative for t^s and s, is "
      "of the order t_{{col}}/t^s. K on sliding after a symmetric collision. ",
      rule.symmetric_sliding_distance(0.1, kSteel.kinetic_friction, kSteel.gravity) / 1e-2);
  figure.caption += steel_caption();
  return figure;
}

}  // namespace slipcheck
