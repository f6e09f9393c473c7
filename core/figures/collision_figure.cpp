#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "figures/steel_pair.h"

namespace slipcheck {
namespace {

constexpr double kSpeed = 0.05;  // of each sphere [m/s]: v_rel = 10 cm/s
constexpr std::size_t kOnsetPoints = 31;

/// ẍ + γ_N ẋ + ω0² x = 0 from x = 0, ẋ = v: K (2) of two spheres with nothing else acting.
struct FreeContact {
  explicit FreeContact(const LinearContact& contact)
      : half_damping(contact.damping_rate() / 2),
        omega(std::sqrt(std::pow(contact.contact_frequency(), 2) - std::pow(half_damping, 2))),
        duration(contact.collision_time()) {}
  double overlap(double v, double t) const {
    return t < duration ? v / omega * std::exp(-half_damping * t) * std::sin(omega * t) : 0;
  }
  double rate(double v, double t) const {
    t = std::min(t, duration);
    return v * std::exp(-half_damping * t) *
           (std::cos(omega * t) - half_damping / omega * std::sin(omega * t));
  }

  double half_damping, omega, duration;
};

/// Velocities of sphere i [cm/s] and the overlap [µm] over time, integrated.
struct Course {
  std::vector<double> overlap, v, surface, slip;

  Course(const ContactScene& scene, const std::vector<double>& times) {
    for (double t : times) {
      const auto states = states_at(scene, t);
      const double gap = states[1].position.x() - states[0].position.x();
      overlap.push_back(std::max(0.0, 2 * kSteel.radius - gap) / 1e-6);
      v.push_back(states[0].velocity.x() / kCentimetre);
      surface.push_back(surface_velocity(states[0], kSteel.radius) / kCentimetre);
      slip.push_back(slip_velocity(states[0], kSteel.radius).x() / kCentimetre);
    }
  }
};

}  // namespace

PaperFigure figure_collision_course() {
  const SteelPair pair{kSpeed, -kSpeed}, elastic{kSpeed, -kSpeed, 1};
  const double t_col = kSteel.collision_time;
  const PairInsight insight = pair.insight(), without_damping = elastic.insight();

  // Fine at the onset of sliding, for its panel.
  std::vector<double> times = equally_spaced(0, 60e-9, kOnsetPoints);
  for (double t : equally_spaced(0, 1.1 * t_col, 89))
    if (t > times.back()) times.push_back(t);
  const Course seen(pair.scene(), times), seen_elastic(elastic.scene(), times);

  const FreeContact free(pair.contact()), free_elastic(elastic.contact());
  const double A = steel_sphere().inverse_shape_factor();
  const double a = kSteel.kinetic_friction * kSteel.gravity;
  const double onset = without_damping.onset.exact_time;
  std::vector<double> overlap, v, slip, slip_elastic, slip_onset, turning, braking;
  for (double t : times) {
    const double v_rel = 2 * kSpeed, during = std::min(t, t_col);
    overlap.push_back(free.overlap(v_rel, t) / 1e-6);
    v.push_back(0.5 * free.rate(v_rel, t) / kCentimetre);
    slip.push_back(v.back() - kSpeed / kCentimetre);
    slip_elastic.push_back((0.5 * free_elastic.rate(v_rel, t) - kSpeed) / kCentimetre);
    // It slides from the first touch on: friction turns it with −A μ_k g, and accelerates it with
    // μ_k g, which to first order the spring turns into (μ_k g/ω0) sin ω0 t.
    turning.push_back(-A * a * t / 1e-6);
    const double omega0 = insight.contact_frequency;
    // From the onset on u̇ = −F_N/m + (1+A) μ_k g with F_N/m = ½ ω0² v_rel t at first.
    const double rise = std::pow(without_damping.contact_frequency, 2) * v_rel / 4;
    slip_onset.push_back(t < onset ? 0
                                   : (-rise * (t * t - onset * onset) + (1 + A) * a * (t - onset)) /
                                         kCentimetre);
    braking.push_back((a / omega0 * std::sin(omega0 * during) + a * (t - during)) / 1e-6);
  }

  PaperFigure figure;
  figure.name = "collision-course";
  figure.title = "One symmetric collision";
  figure.caption = fmt::format(
      "Two spheres that roll into each other at ±{:g} cm/s (v_{{rel}} = {:g} cm/s), sphere i; "
      "lines: closed forms, points: the reference. (a) Overlap, {:.3f} µm at most. (b) Velocity v "
      "of the centre, R Ω of the surface, slip u = v − R Ω. ",
      kSpeed / kCentimetre, 2 * kSpeed / kCentimetre, insight.largest_overlap / 1e-6);
  figure.caption += fmt::format(
      "(c) The onset of sliding without damping (e_n = 1): it rolls until t_{{min}} = 2(1+A) μ_s "
      "g/(v_{{rel}} ω_0²) = {:.2f} ns, twice what (33)–(36) give as printed. Damped as in (a), "
      "(b), it slides from the first touch on, as v_{{rel}} is above v^c = {:.2f} cm/s. ",
      without_damping.onset.time / 1e-9, insight.onset.v_c / kCentimetre);
  figure.caption +=
      "(d) What the substrate's friction adds to v and R Ω: the reference less spheres without "
      "substrate, beside the first order. K on one collision and the onset of sliding. ";
  figure.caption += steel_caption();

  std::vector<double> in_t_col = scaled(times, 1 / t_col), in_ns = scaled(times, 1e9);
  const std::vector<double> rolling(times.size(), kSpeed / kCentimetre);
  const auto added_v = scaled(difference(seen.v, v), 1e4);
  const auto added_surface = scaled(difference(seen.surface, rolling), 1e4);
  Table& table = figure.table;
  table.add("t/t_col [-]", in_t_col);
  table.add("t [ns]", in_ns);
  table.add("overlap reference [µm]", seen.overlap);
  table.add("overlap closed form [µm]", overlap);
  table.add("overlap residual [µm]", difference(seen.overlap, overlap));
  table.add("v_i reference [cm/s]", seen.v);
  table.add("v_i closed form [cm/s]", v);
  table.add("v_i residual [µm/s]", added_v);
  table.add("v_i residual first order [µm/s]", braking);
  table.add("RΩ_i reference [cm/s]", seen.surface);
  table.add("RΩ_i closed form [cm/s]", rolling);
  table.add("RΩ_i residual [µm/s]", added_surface);
  table.add("RΩ_i residual first order [µm/s]", turning);
  table.add("u_i reference [cm/s]", seen.slip);
  table.add("u_i closed form [cm/s]", slip);
  table.add("u_i residual [cm/s]", difference(seen.slip, slip));
  table.add("u_i reference e_n = 1 [cm/s]", seen_elastic.slip);
  table.add("u_i free spheres e_n = 1 [cm/s]", slip_elastic);
  // The expansion at small times says nothing later.
  for (std::size_t k = 0; k < times.size(); ++k)
    if (times[k] > 61e-9) slip_onset[k] = kNotObserved;
  table.add("u_i closed form e_n = 1 [cm/s]", slip_onset);
  table.add("u_i residual e_n = 1 [cm/s]", difference(seen_elastic.slip, slip_onset));

  const std::size_t skip = 4, first = kOnsetPoints;  // none of the onset's points but in its panel
  const auto points = [&](Ink ink, Marker marker, const std::vector<double>& y) {
    return Curve{"", {ink, Line::none, marker}, in_t_col, y, skip, first};
  };
  const AxisSpec time{"t/t_{col}", false, 0, 1.1};
  Panel overlap_chart{"(a) overlap", time, {"ξ [µm]", false, 0}};
  overlap_chart.curves = {{kClosedFormLabel, kClosedForm, in_t_col, overlap},
                          {kReferenceLabel, kReference, in_t_col, seen.overlap, skip, first}};
  Panel velocities{"(b) velocities of sphere i", time, {"velocity [cm/s]"}};
  velocities.curves = {{"", {Ink::blue, Line::solid}, in_t_col, v},
                       {"", {Ink::green, Line::dashed}, in_t_col, rolling},
                       {"", {Ink::vermilion, Line::dash_dot}, in_t_col, slip},
                       points(Ink::blue, Marker::circle, seen.v),
                       points(Ink::green, Marker::square, seen.surface),
                       points(Ink::vermilion, Marker::triangle, seen.slip)};
  for (const Curve& entry : velocity_legend()) velocities.curves.push_back(entry);
  Panel onset_chart{"(c) onset of sliding, e_n = 1", {"t [ns]", false, 0, 60}, {"u_i [µm/s]"}};
  onset_chart.curves = {{"", {Ink::blue, Line::solid}, in_ns, scaled(slip_onset, 1e4)},
                        {"(c): spheres without substrate",
                         {Ink::grey, Line::dotted},
                         in_ns,
                         scaled(slip_elastic, 1e4)},
                        {"", kReference, in_ns, scaled(seen_elastic.slip, 1e4)}};
  onset_chart.marks = {{without_damping.onset.time / 1e-9, "t_{min}", true},
                       {0.5 * without_damping.onset.time / 1e-9, "printed", true}};
  Panel added{"(d) added by the substrate's friction", time, {"residual [µm/s]"}};
  added.curves = {{"", {Ink::blue, Line::solid}, in_t_col, braking},
                  {"", {Ink::green, Line::dashed}, in_t_col, turning},
                  points(Ink::blue, Marker::circle, added_v),
                  points(Ink::green, Marker::square, added_surface)};
  figure.panels = {overlap_chart, velocities, onset_chart, added};

  // Elastic: the slip that the collision leaves beside v0, and what the substrate took of v_rel.
  const double v_rel = 2 * kSpeed;
  const double left = -value_of(elastic.solve(), "i.slip_after_collision.x");
  figure.statements = {
      stated_number("u^f/v^0 after a symmetric elastic collision", "twice", 2, 0.5, left / kSpeed),
      stated_order(
          "v_rel − u^f by the substrate's friction, second term of (37) [cm/s]", "0.01", 0.01,
          (v_rel - left) / kCentimetre, 0,
          "the part of (37) with t_min is printed four times too small, which does not show"),
      stated_order("v^a, above which the substrate changes the collision little, App. D [cm/s]",
                   "10^-3", 1e-3, a / insight.contact_frequency / kCentimetre)};
  return figure;
}

}  // namespace slipcheck
