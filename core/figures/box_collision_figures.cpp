#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "physics/contact/planar_collision.h"

namespace slipcheck {
namespace {

// L Sec. IV: one sphere against a wall and two against each other, solid, without spin before.

constexpr double kBeadRadius = 0.5e-3;  // d = 1 mm
constexpr double kBeadMass = 1;         // the velocities do not depend on it
constexpr double kSolid = 0.4;          // q
constexpr double kKappa = 1 / (1 + 1 / kSolid);

/// One collision, with everything per −u_n where it is a Ψ.
struct BeadCollision {
  double psi_1 = 0, psi_2 = 0;
  double spin = 0;        ///< ω after it, of each sphere [rad/s]
  double separation = 0;  ///< speed along the normal after it [m/s]
};

PlanarImpulse bead_impulse(const PairContact& contact, double mass, double u_n, double u_t) {
  return planar_impulse(contact, restitution_at(contact.restitution, -u_n), mass, kKappa, u_n, u_t);
}

/// As planar_impulse() has it: against a wall with the velocity (−v_n, v_t).
BeadCollision meet_wall(const PairContact& contact, double v_n, double v_t) {
  PlanarVelocity v{-v_n, v_t, 0};
  apply(bead_impulse(contact, kBeadMass, -v_n, v_t), 1, 0, kBeadRadius, kBeadMass, kSolid, v);
  return {v_t / v_n, (v.y - kBeadRadius * v.spin) / v_n, std::abs(v.spin), v.x};
}

/// Two that approach each other along x with ±`speed` and pass at the distance `offset` d.
BeadCollision meet_pair(const PairContact& contact, double speed, double offset) {
  PlanarVelocity left{speed, 0, 0}, right{-speed, 0, 0};
  const double cosine = std::sqrt(1 - offset * offset);  // the right one is that much higher
  const auto along = [&](double x, double y) { return x * cosine + y * offset; };
  const auto across = [&](double x, double y) { return -x * offset + y * cosine; };
  const double u_n = along(right.x - left.x, right.y - left.y);
  const double u_t = across(right.x - left.x, right.y - left.y);
  const PlanarImpulse impulse = bead_impulse(contact, kBeadMass / 2, u_n, u_t);
  apply(impulse, cosine, offset, kBeadRadius, kBeadMass, kSolid, right);
  apply(impulse, -cosine, -offset, kBeadRadius, kBeadMass, kSolid, left);
  const double x = right.x - left.x, y = right.y - left.y;
  const double slip = across(x, y) - kBeadRadius * (left.spin + right.spin);
  return {-u_t / u_n, -slip / u_n, std::abs(right.spin), along(x, y)};
}

/// Ψ1 up to which they stick: where planar_impulse() reaches Coulomb's cap.
double sticking_limit(const PairContact& contact) {
  double low = 0, high = 100;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    const PlanarImpulse impulse = bead_impulse(contact, kBeadMass, -1, middle);
    (std::abs(impulse.tangential) < std::get<double>(contact.friction) * impulse.normal ? low
                                                                                        : high) =
        middle;
  }
  return 0.5 * (low + high);
}

/// Curves of one set of coefficients.
struct BeadSet {
  PairContact contact;
  std::string label, name;  ///< in the legend and in the table
};

constexpr Look kBeadLooks[] = {{Ink::blue, Line::none, Marker::circle},
                               {Ink::vermilion, Line::none, Marker::triangle},
                               {Ink::green, Line::none, Marker::square}};

/// By set and by point.
using BeadCollisions = std::vector<std::vector<BeadCollision>>;

std::vector<double> column_of(const std::vector<BeadCollision>& all, double BeadCollision::*what,
                              double unit = 1) {
  std::vector<double> values;
  for (const BeadCollision& each : all) values.push_back(each.*what / unit);
  return values;
}

/// Closed forms of L: what the tangential impulse leaves, (11) and (12), and the spin that it
/// gives, |Ψ1 − Ψ2| (−u_n) over R(1 + q) against a wall; a pair shares it, half to each.
double closed_psi_2(const PairContact& contact, double psi_1) {
  const double lost = (1 + 1 / kSolid) * (1 + std::get<double>(contact.restitution));
  return std::max(-contact.tangential_restitution * psi_1,
                  psi_1 - lost * std::get<double>(contact.friction));
}
double closed_spin(const PairContact& contact, double psi_1, double approach, bool pair) {
  const double slowed = (psi_1 - closed_psi_2(contact, psi_1)) * approach;
  return slowed / (kBeadRadius * (1 + kSolid)) / (pair ? 2 : 1);
}

/// What L3 to L6 share: ω over what is varied, Ψ2 over Ψ1, and for pairs the speed of separation.
struct BeadFigure {
  const char* name;
  const char* title;
  std::vector<BeadSet> sets;
  bool pair;
};

PaperFigure bead_figure(const BeadFigure& of, BeadCollisions& seen) {
  constexpr double kWallApproach = 0.5, kPairSpeed = 0.5;  // [m/s]
  PaperFigure figure;
  figure.name = of.name;
  figure.title = of.title;
  const std::vector<double> varied =
      of.pair ? equally_spaced(0, 0.9, 10) : equally_spaced(0, 1.75, 8);
  const std::vector<double> fine =
      of.pair ? equally_spaced(0, 0.999, 200) : equally_spaced(0, 1.8, 181);
  const AxisSpec axis =
      of.pair ? AxisSpec{"b_0/d [-]", false, 0, 1} : AxisSpec{"v_t [m/s]", false, 0, 1.8};
  const double last = of.pair ? 2.2 : 3.6;
  Panel a{"(a) spin after the collision", axis, {"ω [10^3 rad/s]"}};
  Panel b{"(b) tangential velocities", {"Ψ_1 [-]", false, 0, last}, {"Ψ_2 [-]"}};
  Panel c{"(c) speed of separation", axis, {"−e u_n [m/s]"}};
  const auto psi_of = [&](double x) {
    return of.pair ? x / std::sqrt(1 - x * x) : x / kWallApproach;
  };
  const auto approach_at = [&](double x) {
    return of.pair ? 2 * kPairSpeed * std::sqrt(1 - x * x) : kWallApproach;
  };
  figure.table.add(of.pair ? "b_0/d [-]" : "v_t [m/s]", varied);
  for (std::size_t n = 0; n < of.sets.size(); ++n) {
    const PairContact& contact = of.sets[n].contact;
    std::vector<BeadCollision>& all = seen.emplace_back();
    for (double x : varied)
      all.push_back(of.pair ? meet_pair(contact, kPairSpeed, x)
                            : meet_wall(contact, kWallApproach, x));
    std::vector<double> spin, psi, slip, separation;
    for (double x : fine) {
      spin.push_back(closed_spin(contact, psi_of(x), approach_at(x), of.pair) / 1e3);
      psi.push_back(psi_of(x));
      slip.push_back(closed_psi_2(contact, psi.back()));
      separation.push_back(std::get<double>(contact.restitution) * approach_at(x));
    }
    std::vector<double> spin_here, slip_here;
    for (double x : varied) {
      spin_here.push_back(closed_spin(contact, psi_of(x), approach_at(x), of.pair));
      slip_here.push_back(closed_psi_2(contact, psi_of(x)));
    }
    const Look look = kBeadLooks[n], line{look.ink, Line::solid};
    const std::vector<double> psi_1 = column_of(all, &BeadCollision::psi_1);
    const std::vector<double> psi_2 = column_of(all, &BeadCollision::psi_2);
    a.curves.push_back({"", line, fine, spin});
    a.curves.push_back({of.sets[n].label, look, varied, column_of(all, &BeadCollision::spin, 1e3)});
    b.curves.push_back({"", line, psi, slip});
    b.curves.push_back({"", look, psi_1, psi_2});
    c.curves.push_back({"", line, fine, separation});
    c.curves.push_back({"", look, varied, column_of(all, &BeadCollision::separation)});
    if (n == 0) figure.table.add("Psi_1 [-]", psi_1);
    const std::string& name = of.sets[n].name;
    figure.table.add("Psi_2 " + name + " [-]", psi_2);
    figure.table.add("Psi_2 closed form " + name + " [-]", slip_here);
    figure.table.add("omega " + name + " [rad/s]", column_of(all, &BeadCollision::spin));
    figure.table.add("omega closed form " + name + " [rad/s]", spin_here);
    if (of.pair)
      figure.table.add("speed of separation " + name + " [m/s]",
                       column_of(all, &BeadCollision::separation));
  }
  figure.panels = {a, b};
  if (of.pair) figure.panels.push_back(c);
  return figure;
}

/// ω of the point `at` over that of the set before it, the least.
double least_growth(const BeadCollisions& seen, std::size_t at) {
  double least = INFINITY;
  for (std::size_t n = 1; n < seen.size(); ++n)
    least = std::min(least, seen[n][at].spin / seen[n - 1][at].spin);
  return least;
}

constexpr const char* kWallSetting =
    "A solid sphere, d = 1 mm, hits a wall with v_n = 0.5 m/s and v_t = 0, 0.25, …, 1.75 m/s, "
    "without spin before. Points: the project's collision, planar_impulse(). Lines: L (11), (12), "
    "and the spin that such an impulse gives, ω = (Ψ_1 − Ψ_2) v_n/(R (1 + q)).";
constexpr const char* kPairSetting =
    "Two solid spheres, d = 1 mm, meet with ±0.5 m/s along x, one b_0 = 0, 0.1 d, …, 0.9 d above "
    "the other, without spin before. Points: the project's collision, planar_impulse(). Lines: L "
    "(11), (12), and ω = (Ψ_1 − Ψ_2) |u_n|/(2R (1 + q)).";

}  // namespace

PaperFigure figure_l3() {
  BeadCollisions seen;
  PaperFigure figure = bead_figure({"L3",
                                    "A sphere hits a wall: friction",
                                    {{{0.9, 0.2, 0.5}, "μ = 0.2", "mu = 0.2"},
                                     {{0.9, 0.5, 0.5}, "μ = 0.5", "mu = 0.5"},
                                     {{0.9, 1e4, 0.5}, "μ = 10^4", "mu = 10000"}},
                                    false},
                                   seen);
  const auto largest = [&](std::size_t set) { return seen[set].back().spin; };
  figure.statements = {
      stated_number("Ψ1 of the fastest", "3.5", 3.5, 0.05, seen[0].back().psi_1),
      {"ω at v_t = 1.75 over that at 1.5 m/s, μ = 0.2", "reaches a maximum", 1, 1,
       largest(0) / seen[0][6].spin, 1e-12, "1 at a maximum; the error is rounding."},
      {"largest ω with μ = 0.5 over that with μ = 0.2", "larger", 1, INFINITY,
       largest(1) / largest(0)},
      {"ω at v_t = 1.75 over 7 times that at 0.25 m/s, μ = 10⁴", "no maximum", 1, 1,
       largest(2) / (7 * seen[2][1].spin), 1e-12, "1 without one; the error is rounding."}};
  figure.caption = fmt::format(
      "{} e = 0.9, β_0 = 0.5, three μ. Coulomb's law limits the spin to {:.0f} rad/s with μ = 0.2 "
      "and {:.0f} with 0.5; with 10^4 it does not. The paper shows snapshots 6 ms apart, their "
      "grey white above 720 rad/s. L Fig. 3.",
      kWallSetting, largest(0), largest(1));
  return figure;
}

PaperFigure figure_l4() {
  BeadCollisions seen;
  const std::vector<BeadSet> sets = {{{0.9, 0.5, -0.5}, "β_0 = −0.5", "beta0 = -0.5"},
                                     {{0.9, 0.5, 0}, "β_0 = 0", "beta0 = 0"},
                                     {{0.9, 0.5, 0.5}, "β_0 = 0.5", "beta0 = 0.5"}};
  PaperFigure figure =
      bead_figure({"L4", "A sphere hits a wall: tangential restitution", sets, false}, seen);
  const double papers[] = {6.65, 3.33, 2.22};
  int sliding = 0;
  for (std::size_t n = 0; n < sets.size(); ++n) {
    const double limit = sticking_limit(sets[n].contact);
    figure.statements.push_back(
        stated_number(fmt::format("−tan γ0 with β0 = {:g}", sets[n].contact.tangential_restitution),
                      fmt::format("{:.2f}", papers[n]), papers[n], 0.005, limit, 1e-12));
    for (const BeadCollision& each : seen[n]) sliding += each.psi_1 > limit ? 1 : 0;
  }
  figure.statements.push_back({"how many of the 24 slide", "3, the fastest with β0 = 0.5", 3, 3,
                               static_cast<double>(sliding), 0,
                               "The fastest with β0 = 0 slides too: Ψ1 = 3.5 is more than the "
                               "paper's own 3.33."});
  figure.statements.push_back({"ω at v_t = 1 m/s over that with the next smaller β0, the least",
                               "larger", 1, INFINITY, least_growth(seen, 4)});
  figure.caption = fmt::format(
      "{} e = 0.9, μ = 0.5, three β_0; at v_t = 1 m/s ω = {:.0f}, {:.0f} and {:.0f} rad/s. Of 24 "
      "collisions {} slide; the paper counts three and leaves out the fastest with β_0 = 0. L Fig. "
      "4.",
      kWallSetting, seen[0][4].spin, seen[1][4].spin, seen[2][4].spin, sliding);
  return figure;
}

PaperFigure figure_l5() {
  BeadCollisions seen;
  const std::vector<BeadSet> sets = {{{0.9, 0, 0.5}, "μ = 0", "mu = 0"},
                                     {{0.9, 0.2, 0.5}, "μ = 0.2", "mu = 0.2"},
                                     {{0.9, 0.5, 0.5}, "μ = 0.5", "mu = 0.5"}};
  PaperFigure figure = bead_figure({"L5", "Two spheres meet: friction", sets, true}, seen);
  const std::pair<std::size_t, const char*> offsets[] = {
      {1, "0.1005"}, {2, "0.204"}, {3, "0.314"}, {8, "1.333"}, {9, "2.065"}};
  for (const auto& [at, text] : offsets) {
    const std::string digits(text);
    const double half = 0.5 * std::pow(10, -static_cast<double>(digits.size() - 2));
    figure.statements.push_back(stated_number(fmt::format("Ψ1 at b0 = 0.{} d", at), digits,
                                              std::stod(digits), half, seen[0][at].psi_1));
  }
  const double papers[] = {0, 0.89, 1.33};
  const char* remarks[] = {"", "", "1.33 belongs to μ = 0.3; the text on Fig. 4 has 2.22 for 0.5."};
  for (std::size_t n = 0; n < sets.size(); ++n)
    figure.statements.push_back(stated_number(
        fmt::format("−tan γ0 with μ = {:g}", std::get<double>(sets[n].contact.friction)),
        fmt::format("{:g}", papers[n]), papers[n], 0.005, sticking_limit(sets[n].contact), 1e-12,
        remarks[n]));
  figure.caption = fmt::format(
      "{} e = 0.9, β_0 = 0.5, three μ. The spin grows with b_0 while they stick and falls where "
      "they slide, Ψ_1 > {:.2f} for μ = 0.2 and {:.2f} for 0.5; the paper prints 1.33 for the "
      "last, which is that of μ = 0.3. It shows snapshots 4 ms apart. L Fig. 5.",
      kPairSetting, sticking_limit(sets[1].contact), sticking_limit(sets[2].contact));
  return figure;
}

PaperFigure figure_l6() {
  BeadCollisions seen;
  PaperFigure figure = bead_figure({"L6",
                                    "Two spheres meet: restitution",
                                    {{{0.2, 0.2, 0.5}, "e = 0.2", "e = 0.2"},
                                     {{0.6, 0.2, 0.5}, "e = 0.6", "e = 0.6"},
                                     {{0.99, 0.2, 0.5}, "e = 0.99", "e = 0.99"}},
                                    true},
                                   seen);
  const auto spread = [&](std::size_t at) {
    return seen[2][at].separation - seen[0][at].separation;
  };
  figure.statements = {
      {"speed of separation with e = 0.99 less that with 0.2, at b0 = 0.9 d over at 0",
       "depends much less on e", 0, 1, spread(9) / spread(0), 0, "Less is read as below 1."},
      {"ω at b0 = 0.7 d over that with the next smaller e, the least", "larger", 1, INFINITY,
       least_growth(seen, 7)}};
  figure.caption = fmt::format(
      "{} μ = 0.2, β_0 = 0.5, three e. Head on the speeds of separation are {:.2f} m/s apart, at "
      "b_0 = 0.9 d {:.2f} m/s; in between a larger e makes a larger spin, because Coulomb's cap "
      "grows with it. L Fig. 6.",
      kPairSetting, spread(0), spread(9));
  return figure;
}

}  // namespace slipcheck
