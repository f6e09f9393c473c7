#include <fmt/format.h>

#include <cmath>

#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "figures/secant.h"
#include "figures/steel_pair.h"

namespace slipcheck {
namespace {

/// What each of two spheres that meet at v_rel [m/s] loses, integrated.
SymmetricLosses integrated_losses(double restitution, double v_rel) {
  const double v = v_rel / 2;
  const ReferenceResult seen = SteelPair{v, -v, restitution}.solve();
  const double after = std::abs(value_of(seen, "i.velocity_after_collision.x")) / v;
  return {1 - after * after, 1 - after, value_of(seen, "i.energy_change_sliding") / (v * v),
          value_of(seen, "i.momentum_change_sliding") / v};
}

constexpr double kSpeed = 0.1;  // v_rel [m/s]

}  // namespace

PaperFigure figure_k7() {
  PaperFigure figure;
  figure.name = "K7";
  figure.title = "Losses after symmetric collisions, by sliding and by the collision";
  const double A = steel_sphere().inverse_shape_factor();
  const std::vector<double> fine = equally_spaced(0.5, 1, 101), points = equally_spaced(0.5, 1, 11);

  // The four curves: ΔE_slip, Δp_slip and what the collision itself takes beside them.
  struct Quantity {
    const char *name, *label;
    double (*of)(const SymmetricLosses&);
    Look look;
  };
  const Quantity quantities[] = {{"dE_slip",
                                  "ΔE_{slip}, (46)",
                                  [](const SymmetricLosses& a) { return a.sliding_energy; },
                                  {Ink::blue, Line::solid}},
                                 {"dp_slip",
                                  "Δp_{slip}, (48)",
                                  [](const SymmetricLosses& a) { return a.sliding_momentum; },
                                  {Ink::vermilion, Line::dashed}},
                                 {"dE_col/dE_slip",
                                  "ΔE_{col}/ΔE_{slip}, (47)",
                                  [](const SymmetricLosses& a) { return a.energy_ratio(); },
                                  {Ink::blue, Line::solid}},
                                 {"dp_col/dp_slip",
                                  "Δp_{col}/Δp_{slip}, (49)",
                                  [](const SymmetricLosses& a) { return a.momentum_ratio(); },
                                  {Ink::vermilion, Line::dashed}}};
  std::vector<SymmetricLosses> seen;
  for (double e : points) seen.push_back(integrated_losses(e, kSpeed));
  const auto closed_at = [&](double e) { return HeadOnCollision{A, e, 0}.symmetric_losses(); };

  Table& table = figure.table;
  table.add("e_n [-]", fine);
  table.add("e_n of points [-]", points);
  Panel a{"(a) lost while sliding", {"e_n [-]", false, 0.5, 1.01}, {"share [-]", false, 0, 1}};
  Panel b{"(b) lost in the collision beside it",
          {"e_n [-]", false, 0.5, 1.01},
          {"ratio [-]", false, 0}};
  for (const Quantity& quantity : quantities) {
    std::vector<double> line, reference, residual;
    for (double e : fine) line.push_back(quantity.of(closed_at(e)));
    for (std::size_t k = 0; k < points.size(); ++k) {
      reference.push_back(quantity.of(seen[k]));
      residual.push_back(reference.back() - quantity.of(closed_at(points[k])));
    }
    table.add(fmt::format("{} closed form [-]", quantity.name), line);
    table.add(fmt::format("{} reference [-]", quantity.name), reference);
    table.add(fmt::format("{} residual [-]", quantity.name), residual);
    Panel& panel = &quantity < quantities + 2 ? a : b;
    panel.curves.push_back({quantity.label, quantity.look, fine, line});
    panel.curves.push_back(
        {&quantity == quantities ? kReferenceLabel : "", kReference, points, reference});
  }

  const double equal_energy = secant_zero(
      [](double e) { return integrated_losses(e, kSpeed).energy_ratio() - 1; }, 0.7, 0.75);
  const double equal_momentum = secant_zero(
      [](double e) { return integrated_losses(e, kSpeed).momentum_ratio() - 1; }, 0.55, 0.6);
  b.marks = {{53.0 / 73, "53/73"}, {5.0 / 9, "5/9"}};
  figure.panels = {a, b};
  figure.caption =
      "Shares of the translational energy (v^0)² and of the momentum v^0 that each of two solid "
      "spheres that meet at v^0 = v_{rel}/2 has before. (a) What sliding takes after the "
      "collision. (b) What the collision itself takes, 1 − e_n² and 1 − e_n, over that; marked "
      "is where (47) and (49) are 1. Points at v_{rel} = 10 cm/s. K Fig. 7. ";
  figure.caption += steel_caption();

  const SymmetricLosses& elastic = seen.back();
  const SymmetricLosses slow = integrated_losses(0.9, 0.01), fast = integrated_losses(0.9, 1);
  const double order = left_out_by_k(kSpeed);
  figure.statements = {
      stated_number("ΔE_slip for e_n → 1", "80 %", 0.8, 0.05, elastic.sliding_energy, 0,
                    "one digit is stated"),
      stated_number("Δp_slip for e_n → 1", "60 %", 0.6, 0.05, elastic.sliding_momentum, 0,
                    "one digit is stated"),
      {"ΔE_col/ΔE_slip for e_n → 1", "0", -order, order, elastic.energy_ratio(), 0,
       "within g t_col/v_rel, (38), which K leaves out"},
      {"Δp_col/Δp_slip for e_n → 1", "0", -order, order, elastic.momentum_ratio(), 0,
       "within g t_col/v_rel, (38)"},
      {"ΔE_col/ΔE_slip at e_n = 0.9", "sliding is the main loss", 0, 1,
       integrated_losses(0.9, kSpeed).energy_ratio()},
      stated_number("e_n at which collision and slide take the same energy, (47)", "53/73",
                    53.0 / 73, 0.005, equal_energy, 0, "to two digits, as a plot is read"),
      stated_number("e_n at which they take the same momentum, (49)", "5/9", 5.0 / 9, 0.005,
                    equal_momentum, 0, "to two digits, as a plot is read"),
      {"change of ΔE_slip from 1 to 100 cm/s, of itself", "independent of the velocity",
       -left_out_by_k(0.01), left_out_by_k(0.01), fast.sliding_energy / slow.sliding_energy - 1, 0,
       "within g t_col/v_rel, (38), of 1 cm/s"}};
  figure.notes = fmt::format(
      "Integrated, both energies are equal at e_n = {:.4f} (53/73 = {:.4f}), both momenta at "
      "{:.4f} (5/9 = {:.4f}).",
      equal_energy, 53.0 / 73, equal_momentum, 5.0 / 9);
  return figure;
}

}  // namespace slipcheck
