#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "physics/contact/elastic_pair.h"
#include "reference/pair/pair_batch.h"

namespace slipcheck {
namespace {

constexpr double kYoungModulus = 1e10, kPoissonRatio = 0.3, kDensity = 1000;
constexpr double kRadius = 0.01;                 // [m]
constexpr double kDissipationTime = 1e-6;        // A [s]
constexpr std::array kSizes = {2e-4, 2e-5};      // ζ0/R_eff of the two rough cases
constexpr double kSlowest = 1e-3, kFastest = 1;  // [m/s]
constexpr std::size_t kGrid = 73;
constexpr int kSteps = 6400;  // in a collision

using Form = AsperityForce::Form;

struct RoughIce {
  RoughIce(double relative_size, Form form)
      : sphere{kRadius, kDensity * 4 * M_PI / 3 * std::pow(kRadius, 3), 2.0 / 5} {
    const double radius = effective_radius(sphere, sphere);
    size = relative_size * radius;
    friction = std::sqrt(size / 1e-2);  // μ = α √ζ0, α = 1 cm^-1/2
    const ElasticMaterial ice{kYoungModulus, kPoissonRatio, kDissipationTime};
    contact = {ViscoelasticForce{hertz_modulus(ice, ice, radius), kDissipationTime},
               ContactEnd::zero_overlap, AsperityForce{friction, size, form}};
  }
  /// All g_N and in each all g_T of `speeds`; raises `doubt` to the largest of ε^T.
  std::vector<PairCollision> collide(const std::vector<double>& speeds, double& doubt) const {
    std::vector<double> normal, tangential;
    for (double g_n : speeds)
      for (double g_t : speeds) normal.push_back(g_n), tangential.push_back(g_t);
    std::vector<PairCollision> found(normal.size());
    std::vector<PairDoubt> doubts(normal.size());
    collide_batch(contact, sphere, sphere, normal, tangential, kSteps, found, doubts);
    for (const PairDoubt& d : doubts) doubt = std::max(doubt, d.tangential_restitution);
    return found;
  }

  Sphere sphere;
  double size = 0, friction = 0;
  SoftContact contact;
};

std::string size_text(const RoughIce& ice) { return fmt::format("ζ_0 = {:g} µm", ice.size / 1e-6); }

}  // namespace

PaperFigure figure_b2() {
  const std::vector<double> speeds = logarithmically_spaced(kSlowest, kFastest, kGrid);
  const std::size_t cut = kGrid - 1;  // the fastest g_N
  PaperFigure figure;
  figure.name = "B2";
  figure.title = "Tangential restitution of rough ice";
  Table& table = figure.table;
  std::vector<double> normal, tangential, in_cm_s;
  for (double speed : speeds) in_cm_s.push_back(speed / 1e-2);
  for (double g_n : in_cm_s)
    for (double g_t : in_cm_s) normal.push_back(g_n), tangential.push_back(g_t);
  table.add("g_N [cm/s]", normal);
  table.add("g_T [cm/s]", tangential);

  // Where the printed law throws back most.
  struct {
    double restitution = 1, g_n = 0, g_t = 0, size = 0;
  } lowest;
  double doubt = 0;
  std::vector<Panel> cuts;
  std::string cases;
  for (std::size_t c = 0; c < kSizes.size(); ++c) {
    const char letter = static_cast<char>('a' + c);
    const RoughIce printed(kSizes[c], Form::printed), passive(kSizes[c], Form::passive);
    cases += fmt::format("{}ζ_0 = {:g} R_{{eff}} = {:g} µm with μ = {:.4f}", c == 0 ? "" : ", ",
                         kSizes[c], printed.size / 1e-6, printed.friction);
    const double kappa = tangential_mass_ratio(printed.sphere, printed.sphere);
    Panel chart{fmt::format("({}) g^N = {:g} cm/s, {}", static_cast<char>('e' + c), in_cm_s[cut],
                            size_text(printed)),
                {"g^T [cm/s]", true, 0.1, 100},
                {"ε^T", false, -1.05, 1.05}};
    const auto row = [&](const std::vector<double>& values) {
      const auto begin = values.begin() + static_cast<std::ptrdiff_t>(cut * kGrid);
      return std::vector<double>(begin, begin + kGrid);
    };
    std::vector<double> sliding;
    for (const bool is_printed : {true, false}) {
      std::vector<double> map;
      const std::vector<PairCollision> seen =
          (is_printed ? printed : passive).collide(speeds, doubt);
      for (std::size_t k = 0; k < seen.size(); ++k) {
        const double g_n = speeds[k / kGrid], g_t = speeds[k % kGrid];
        map.push_back(seen[k].tangential_restitution);
        if (is_printed && seen[k].tangential_restitution < lowest.restitution)
          lowest = {seen[k].tangential_restitution, g_n, g_t, kSizes[c]};
        // Many asperities break: on average half of μ F_N acts.
        if (is_printed)
          sliding.push_back(1 - 0.5 * printed.friction * (1 + seen[k].normal_restitution) * g_n /
                                    (kappa * g_t));
      }
      const std::string form = is_printed ? "printed" : "passive";
      table.add(fmt::format("eps^T {} {:g} R_eff [-]", form, kSizes[c]), map);
      Panel all{fmt::format("({}) {}, {}", static_cast<char>(letter + (is_printed ? 0 : 2)), form,
                            size_text(printed)),
                {"g^T [cm/s]", true},
                {"g^N [cm/s]", true}};
      all.colours = ColourMap{in_cm_s, in_cm_s, map, "ε^T"};
      figure.panels.push_back(std::move(all));
      chart.curves.push_back(
          {form + " form",
           is_printed ? Look{Ink::blue, Line::solid} : Look{Ink::vermilion, Line::dashed}, in_cm_s,
           row(map)});
      if (is_printed) {
        std::vector<double> residual = map;
        for (std::size_t k = 0; k < map.size(); ++k) residual[k] -= sliding[k];
        table.add(fmt::format("eps^T sliding limit {:g} R_eff [-]", kSizes[c]), sliding);
        table.add(fmt::format("residual printed - sliding limit {:g} R_eff [-]", kSizes[c]),
                  residual);
      }
    }
    chart.curves.push_back(
        {"sliding limit, closed form", {Ink::black, Line::dotted}, in_cm_s, row(sliding)});
    cuts.push_back(chart);
  }
  // Rows: both sizes printed, both passive, both cuts.
  std::swap(figure.panels[1], figure.panels[2]);
  for (Panel& panel : cuts) figure.panels.push_back(std::move(panel));

  figure.caption = fmt::format(
      "ε^T = g_T'/g_T of two free spheres of ice (R = {:g} cm, Y = {:g} Pa, ν = {:g}, ρ = {:g} "
      "kg/m³, A = {:g} s) whose asperities bend and break, (35), with μ = √ζ_0 (ζ_0 in cm), for "
      "two roughnesses: {}. The values are the project's; the paper's own are not at hand. ",
      kRadius / kCentimetre, kYoungModulus, kPoissonRatio, kDensity, kDissipationTime, cases);
  figure.caption +=
      "(a), (b) the law as printed, (c), (d) the passive form, (e), (f) their uppermost rows. "
      "Blue, ε^T near 1: the spheres slide at small g^N, where many asperities break; on average "
      "half of μ F_N acts, the closed form 1 − μ(1+ε^N) g^N/(2κ g^T). Brown, ε^T near −1: an "
      "asperity that does not break throws a small g^T back. ";
  if (lowest.restitution < -1)
    figure.caption += fmt::format(
        "The law as printed is not passive everywhere: ε^T falls to −{:.3f} at ζ_0 = {:g} "
        "R_{{eff}}, g^N = {:.3g} cm/s, g^T = {:.3g} cm/s (the darkest colour is −1 and below). ",
        -lowest.restitution, lowest.size, lowest.g_n / kCentimetre, lowest.g_t / kCentimetre);
  figure.caption += fmt::format(
      "{} steps in a collision; with half as many ε^T changes by at most {:.0e}. B Fig. 2.", kSteps,
      doubt);
  return figure;
}

}  // namespace slipcheck
