#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "figures/columns.h"
#include "figures/ice.h"
#include "figures/paper_figure.h"
#include "reference/pair/pair_batch.h"

namespace slipcheck {
namespace {

constexpr std::size_t kGrid = 50;                // of the planes
constexpr double kSlowest = 0.2, kFastest = 10;  // their speeds, evenly [cm/s]
constexpr double kCut = 1;                       // g^T of the cuts [cm/s]
constexpr int kSteps = 6400;                     // in a collision

using Form = AsperityForce::Form;

/// Two spheres of ice with asperities of a size ζ0, and μ = α √ζ0 with α = 1 in some unit of
/// length.
struct RoughIce {
  double relative_size;  ///< ζ0/R_eff [-]
  double unit = 1e-6;    ///< [m]
  Form form = Form::printed;
  IceLaw law = kIceLaw;

  double size() const { return relative_size * kIce.radius / 2; }  ///< ζ0 [m]
  double friction() const { return std::sqrt(size() / unit); }     ///< μ [-]

  /// At these speeds [cm/s]; raises `doubt`, where given, to the largest of ε^T.
  std::vector<PairCollision> collide(const std::vector<double>& g_n, const std::vector<double>& g_t,
                                     double* doubt = nullptr) const {
    const SoftContact contact{law.force(ice_pair(), ice_pair_fit(law).dissipation_time), law.end,
                              AsperityForce{friction(), size(), form}};
    const Sphere sphere = ice_sphere();
    const auto normal = scaled(g_n, kCentimetre), tangential = scaled(g_t, kCentimetre);
    std::vector<PairCollision> found(normal.size());
    if (doubt == nullptr) {
      collide_batch(contact, sphere, sphere, normal, tangential, kSteps, found);
      return found;
    }
    std::vector<PairDoubt> doubts(normal.size());
    collide_batch(contact, sphere, sphere, normal, tangential, kSteps, found, doubts);
    for (const PairDoubt& d : doubts) *doubt = std::max(*doubt, d.tangential_restitution);
    return found;
  }

  /// ε^T of those.
  std::vector<double> turned(const std::vector<double>& g_n, const std::vector<double>& g_t,
                             double* doubt = nullptr) const {
    std::vector<double> values;
    for (const PairCollision& each : collide(g_n, g_t, doubt))
      values.push_back(each.tangential_restitution);
    return values;
  }

  /// g^T_cr at a g^N [cm/s]: below it no asperity breaks, and as the law is linear in the bend ε^T
  /// is the same for all g^T. To the 1.5 % between two of them.
  double critical(double g_n) const {
    const auto g_t = logarithmically_spaced(1e-3, 100, 800);
    const auto values = turned(std::vector<double>(g_t.size(), g_n), g_t);
    std::size_t first = 1;
    while (first < g_t.size() && std::abs(values[first] - values[0]) < 1e-6) ++first;
    return first < g_t.size() ? g_t[first] : NAN;
  }
};

/// Of B's three panels.
constexpr std::array<RoughIce, 3> kCases = {{{1e-7}, {2e-4}, {1e-3}}};
constexpr RoughIce kInCentimetres{1e-7, 1e-2};

std::string name_of(const RoughIce& ice) {
  return fmt::format("{:g} R_eff{}", ice.relative_size, ice.unit == 1e-2 ? " in cm" : "");
}

double least(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

double share_below_zero(const std::vector<double>& values) {
  return static_cast<double>(
             std::count_if(values.begin(), values.end(), [](double value) { return value < 0; })) /
         static_cast<double>(values.size());
}

}  // namespace

PaperFigure figure_b2() {
  PaperFigure figure;
  figure.name = "B2";
  figure.title = "Tangential restitution of rough ice";
  Table& table = figure.table;
  const auto speeds = equally_spaced(kSlowest, kFastest, kGrid);
  std::vector<double> g_n, g_t;
  for (double n : speeds)
    for (double t : speeds) g_n.push_back(n), g_t.push_back(t);
  table.add("g_N [cm/s]", g_n);
  table.add("g_T [cm/s]", g_t);
  double doubt = 0;
  const double kappa = tangential_mass_ratio(ice_sphere(), ice_sphere());

  // The planes: B's three, and the first with the other reading of μ.
  std::array<std::vector<double>, 4> planes;
  for (std::size_t c = 0; c < planes.size(); ++c) {
    const RoughIce& ice = c < kCases.size() ? kCases[c] : kInCentimetres;
    const std::vector<PairCollision> seen = ice.collide(g_n, g_t, &doubt);
    std::vector<double> sliding;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      planes[c].push_back(seen[k].tangential_restitution);
      // Many asperities break: on average half of μ F_N acts.
      sliding.push_back(1 - 0.5 * ice.friction() * (1 + seen[k].normal_restitution) * g_n[k] /
                                (kappa * g_t[k]));
    }
    table.add(fmt::format("eps^T {} [-]", name_of(ice)), planes[c]);
    table.add(fmt::format("eps^T sliding limit {} [-]", name_of(ice)), sliding);
    Panel plane{fmt::format("({}) ζ_0 = {:g} R_{{eff}}, μ = {:.2g}", "abcd"[c], ice.relative_size,
                            ice.friction()),
                {"g^T [cm/s]"},
                {"g^N [cm/s]"}};
    plane.colours = ColourMap{speeds, speeds, planes[c], "ε^T"};
    figure.panels.push_back(std::move(plane));
  }

  // Cuts over g^N.
  const auto cut = logarithmically_spaced(0.1, 100, 181);
  const std::vector<double> fixed(cut.size(), kCut);
  table.add("g_N of the cuts [cm/s]", cut);
  std::array<std::vector<double>, 3> cuts;
  for (const Form form : {Form::printed, Form::passive}) {
    const bool is_printed = form == Form::printed;
    Panel panel{fmt::format("({}) g^T = {:g} cm/s, {}", is_printed ? 'e' : 'f', kCut,
                            is_printed ? "as printed" : "passive form"),
                {"g^N [cm/s]", true, 0.1, 100},
                {"ε^T", false, -1.05, 1.05}};
    const std::array<Look, 3> looks = {
        {{Ink::blue, Line::solid}, {Ink::vermilion, Line::dashed}, {Ink::black, Line::dash_dot}}};
    for (std::size_t c = 0; c < kCases.size(); ++c) {
      RoughIce ice = kCases[c];
      ice.form = form;
      const auto values = ice.turned(cut, fixed);
      table.add(fmt::format("eps^T of the cut {} {} [-]", is_printed ? "printed" : "passive",
                            name_of(ice)),
                values);
      if (is_printed) cuts[c] = values;
      panel.curves.push_back(
          {is_printed ? fmt::format("ζ_0 = {:g} R_{{eff}}", ice.relative_size) : "", looks[c], cut,
           values});
    }
    figure.panels.push_back(std::move(panel));
  }

  // g^T_cr of (b) and (c).
  const std::vector<double> normal = {0.5, 1, 2, 5, 10};
  table.add("g_N of g_T_cr [cm/s]", normal);
  std::array<std::vector<double>, 2> critical;
  for (const std::size_t c : {0u, 1u}) {
    for (double n : normal) critical[c].push_back(kCases[c + 1].critical(n));
    table.add(fmt::format("g_T_cr {} [cm/s]", name_of(kCases[c + 1])), critical[c]);
  }
  const auto slowest_growth = [&](std::size_t c) {  // as a power of g^N
    double least = kUnbounded;
    for (std::size_t k = 1; k < normal.size(); ++k)
      least = std::min(least, std::log(critical[c][k] / critical[c][k - 1]) /
                                  std::log(normal[k] / normal[k - 1]));
    return least;
  };

  // The others with ζ_0 in cm.
  const double never_back = std::min(least(RoughIce{2e-4, 1e-2}.turned(g_n, g_t)),
                                     least(RoughIce{1e-3, 1e-2}.turned(g_n, g_t)));
  // (24) to zero overlap instead, whose tail attracts.
  double tail_low = 1, tail_high = -1, tail_doubt = 0;
  for (const std::size_t c : {1u, 2u}) {
    RoughIce ice = kCases[c];
    ice.law = kExpandedIceLaw;
    const auto values = ice.turned(g_n, g_t, &tail_doubt);
    tail_low = std::min(tail_low, least(values));
    tail_high = std::max(tail_high, *std::max_element(values.begin(), values.end()));
  }

  figure.caption = fmt::format(
      "ε^T = g_T'/g_T of two free spheres over both parts of their impact velocity, for the three "
      "sizes of asperities of the paper, ζ_0 = {:g} nm, {:g} µm and {:g} µm, which bend and break, "
      "(35); the normal law is (25) to zero force with A = {:.3g} s, that of Fig. 1 for two "
      "spheres. μ = √ζ_0 with ζ_0 in µm; (d) is (a) with ζ_0 in cm. Blue: they slide, and many "
      "asperities break; brown: an asperity that does not break throws them back. (e) Over g^N at "
      "g^T = {:g} cm/s, (f) the same with the project's passive form. {} steps in a collision; "
      "with half as many ε^T changes by at most {:.0e}. B Fig. 2. ",
      kCases[0].size() / 1e-9, kCases[1].size() / 1e-6, kCases[2].size() / 1e-6,
      ice_pair_fit().dissipation_time, kCut, kSteps, doubt);
  figure.caption += ice_caption();
  figure.notes = fmt::format(
      "The unit of ζ_0 in μ = α√ζ_0, α = 1, is not printed. With µm, μ = {:.3f}, {:.2f} and "
      "{:.2f}, (b) and (c) have the two phases, the transition and the minimum that the paper "
      "tells, on {:.0f} and {:.0f} % of the plane they throw back, and (a) does not stay above "
      "0.85; with cm, {:.1g}, {:.2g} and {:.2g}, (a) does, but the others stay above {:.2f}: no "
      "reading has both. Where many asperities break half of μF_N acts on average, "
      "ε^T = 1 − μ(1+ε^N) g^N/(2κ g^T).\n\nWith (24) to zero overlap, which attracts at the end, "
      "ε^T of (b) and (c) runs from {:.2f} to {:.2f} on the same plane (half as many steps change "
      "it by "
      "at most {:.0e}): the tail throws back more than came.",
      kCases[0].friction(), kCases[1].friction(), kCases[2].friction(),
      100 * share_below_zero(planes[1]), 100 * share_below_zero(planes[2]),
      kInCentimetres.friction(), RoughIce{2e-4, 1e-2}.friction(), RoughIce{1e-3, 1e-2}.friction(),
      never_back, tail_low, tail_high, tail_doubt);

  // Where ε^T of (c) is least over g^N, and what it is at high g^N.
  const std::size_t deepest =
      static_cast<std::size_t>(std::min_element(cuts[2].begin(), cuts[2].end()) - cuts[2].begin());
  double mean = 0, squares = 0, count = 0;
  for (std::size_t k = 0; k < cut.size(); ++k)
    if (cut[k] > 20) mean += cuts[2][k], squares += cuts[2][k] * cuts[2][k], count += 1;
  mean /= count;
  const double scatter = std::sqrt(squares / count - mean * mean);
  double gentle = 1;  // of all three where g^N is small and g^T large
  for (const RoughIce& ice : kCases) gentle = std::min(gentle, ice.turned({0.01}, {kFastest})[0]);
  figure.statements = {
      {"(a)-(c): ε^T at g^N = 0.01 cm/s, g^T = 10 cm/s", "→ 1 as g^N → 0", 0.99, 1, gentle, 0,
       "least of the three; read as above 0.99"},
      {"(a): least ε^T, μ by µm", "0.85 to 1", 0.85, 1, least(planes[0]), 0,
       "no reading of μ gives this and two phases in (b) and (c)"},
      {"(a): least ε^T, μ by cm", "0.85 to 1", 0.85, 1, least(planes[3]), 0,
       "but then (b) and (c) have one phase"},
      {"(b): share of the plane with ε^T < 0", "some, at small g^T and larger g^N", 1e-3, 1,
       share_below_zero(planes[1])},
      {"(c): share of the plane with ε^T < 0", "some, another than in (b)", 1e-3, 1,
       share_below_zero(planes[2])},
      {"(b): least power of g^N in g^T_cr, between 0.5, 1, 2, 5 and 10 cm/s", "grows", 0,
       kUnbounded, slowest_growth(0)},
      {"(c): least power of g^N in g^T_cr, between the same", "grows", 0, kUnbounded,
       slowest_growth(1), 0,
       "up to 5 cm/s; faster, the bend is deepest at the contact's end, where F_N holds it less"},
      {"(b), (c): least ε^T", "−1 is not reached", -1, 1,
       std::min(least(planes[1]), least(planes[2]))},
      {"(c): least ε^T over g^N at g^T = 1 cm/s", "a negative minimum", -1, 0, cuts[2][deepest]},
      {"(c): g^N/g^T of that minimum", "several", 2, 10, cut[deepest] / kCut, 0, "read as 2 to 10"},
      {"(c): mean ε^T from 20 to 100 cm/s over the depth of the minimum", "rises up to zero", -0.5,
       0.5, mean / std::abs(cuts[2][deepest]), 0,
       fmt::format("read as below a half; it swings about it by {:.2f}", scatter)},
      stated_number("ε^T of the smoothest, (a) by cm, at g^N = g^T = 1 cm/s", "−1", -1, 0.005,
                    kInCentimetres.turned({1}, {1})[0], 0,
                    "the limit of smooth spheres is +1; as printed both limits are −1")};
  return figure;
}

}  // namespace slipcheck
