#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "figures/steel_pair.h"

namespace slipcheck {
namespace {

constexpr double kSpeed = 0.05;  // of each sphere [m/s]: v_rel = 10 cm/s

}  // namespace

PaperFigure figure_slide_course() {
  const SteelPair pair{kSpeed, -kSpeed};
  const double lead = 4e-3, last = 36e-3;
  const ContactScene scene = pair.scene(lead);
  const AfterCollision after = pair.insight().after[0];
  // t = 0 is the collision. No point falls into its 25 µs; two stand right before and after it, one
  // at the kink.
  std::vector<double> times = equally_spaced(-lead, last, 81);
  std::erase_if(times, [](double t) { return std::abs(t) < 1e-9; });
  for (double t : {-1e-6, 3e-5, after.sliding_time}) times.push_back(t);
  std::sort(times.begin(), times.end());
  std::vector<double> v_seen, surface_seen, slip_seen, x_seen;
  for (double t : times) {
    const BodyState i = states_at(scene, t + lead)[0];
    v_seen.push_back(i.velocity.x() / kCentimetre);
    surface_seen.push_back(surface_velocity(i, kSteel.radius) / kCentimetre);
    slip_seen.push_back(slip_velocity(i, kSteel.radius).x() / kCentimetre);
    x_seen.push_back((i.position.x() + kSteel.radius) / 1e-3);
  }

  const double A = steel_sphere().inverse_shape_factor();
  const double push = kSteel.kinetic_friction * kSteel.gravity;  // v̇ while it slides back
  const auto v_of = [&](double t) {
    if (t < 0) return kSpeed;
    return after.velocity + push * std::min(t, after.sliding_time);
  };
  const auto surface_of = [&](double t) {
    if (t < 0) return kSpeed;
    return after.surface_velocity - A * push * std::min(t, after.sliding_time);
  };
  const auto x_of = [&](double t) {
    if (t < 0) return kSpeed * t;
    const double sliding = std::min(t, after.sliding_time);
    return after.velocity * sliding + 0.5 * push * sliding * sliding +
           after.rolling_velocity * (t - sliding);
  };
  std::vector<double> v, surface, slip, x;
  for (double t : times) {
    v.push_back(v_of(t) / kCentimetre);
    surface.push_back(surface_of(t) / kCentimetre);
    slip.push_back(v.back() - surface.back());
    x.push_back(x_of(t) / 1e-3);
  }

  PaperFigure figure;
  figure.name = "slide-course";
  figure.title = "From a symmetric collision to rolling";
  figure.caption = fmt::format(
      "Sphere i of two that meet at ±{:g} cm/s at t = 0; lines: closed forms with the collision "
      "as an instant, points: the reference. (a) Velocity, R Ω and slip: it slides for t^s = "
      "|u^f|/((1+A) μ_k g) = {:.2f} ms from v^f = −{:.3f} cm/s to v^s = −{:.3f} cm/s, e_{{eff}} = "
      "{:.4f}. ",
      kSpeed / kCentimetre, after.sliding_time / 1e-3, -after.velocity / kCentimetre,
      -after.rolling_velocity / kCentimetre, pair.insight().effective_restitution);
  figure.caption += fmt::format(
      "(b) Its displacement since the collision; s = {:.4f} mm while it slides, (44) corrected. K "
      "on sliding after a symmetric collision. ",
      std::abs(after.sliding_distance) / 1e-3);
  figure.caption += steel_caption();

  const std::vector<double> in_ms = scaled(times, 1e3);
  Table& table = figure.table;
  table.add("t [ms]", in_ms);
  const auto add = [&](const std::string& name, const std::string& unit,
                       const std::vector<double>& seen, const std::vector<double>& expected) {
    table.add(name + " reference [" + unit + "]", seen);
    table.add(name + " closed form [" + unit + "]", expected);
    table.add(name + " residual [" + unit + "]", difference(seen, expected));
  };
  add("v_i", "cm/s", v_seen, v);
  add("RΩ_i", "cm/s", surface_seen, surface);
  add("u_i", "cm/s", slip_seen, slip);
  add("x_i", "mm", x_seen, x);

  const AxisSpec time{"t [ms]", false, -4, 36};
  const ChartMark end{after.sliding_time / 1e-3, "t^s"};
  Panel a{"(a) velocities of sphere i", time, {"velocity [cm/s]"}};
  const std::size_t skip = 3;
  a.curves = {{"", {Ink::blue, Line::solid}, in_ms, v},
              {"", {Ink::green, Line::dashed}, in_ms, surface},
              {"", {Ink::vermilion, Line::dash_dot}, in_ms, slip},
              {"", {Ink::blue, Line::none, Marker::circle}, in_ms, v_seen, skip},
              {"", {Ink::green, Line::none, Marker::square}, in_ms, surface_seen, skip},
              {"", {Ink::vermilion, Line::none, Marker::triangle}, in_ms, slip_seen, skip}};
  for (const Curve& entry : velocity_legend()) a.curves.push_back(entry);
  Panel b{"(b) displacement of sphere i", time, {"x − x(0) [mm]"}};
  b.curves = {{kClosedFormLabel, kClosedForm, in_ms, x},
              {kReferenceLabel, kReference, in_ms, x_seen, skip}};
  a.marks.push_back(end);
  b.marks.push_back(end);
  figure.panels = {a, b};
  return figure;
}

}  // namespace slipcheck
