// What is said of a scene, by its rows: formulas of the papers written out anew.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../scenario/scenes.h"
#include "../support/bundled.h"
#include "explain/explain_engines.h"
#include "explain/explain_scene.h"
#include "harness/run/requested_runs.h"
#include "scenario/file_text.h"

namespace slipcheck {
namespace {

using test::bundled;
using testing::with;

constexpr double kGravity = 9.81;

/// An explanation in which rows are looked up.
struct Explained : Explanation {
  explicit Explained(const Scenario& scenario)
      : Explanation(explain_scene(scenario, make_contact_scene(scenario), false)) {}
  explicit Explained(const std::string& text) : Explained(parse_scenario(text, "s.yaml")) {}

  const ExplainSection* section(const std::string& title) const {
    const auto found = std::ranges::find_if(
        sections, [&](const ExplainSection& each) { return each.title.starts_with(title); });
    return found == sections.end() ? nullptr : &*found;
  }
  /// The first row with this label, or of what is said without one.
  const ExplainRow* find(const std::string& label) const {
    for (const ExplainSection& each : sections)
      for (const ExplainRow& row : each.rows)
        if (row.label == label || (row.label.empty() && row.remark == label)) return &row;
    return nullptr;
  }
  std::string value(const std::string& label) const {
    const ExplainRow* row = find(label);
    return row && !row->values.empty() ? row->values[0] : "no row";
  }
  double number(const std::string& label) const { return std::stod(value(label)); }
  bool has(const std::string& title, const std::string& label) const {
    const ExplainSection* there = section(title);
    return there && std::ranges::find(there->rows, label, &ExplainRow::label) != there->rows.end();
  }
};

std::string file_of(const std::string& scene) {
  return read_file(SLIPCHECK_SOURCE_DIR "/scenarios/" + scene + ".yaml");
}
/// Two steel balls of K that meet at 30 cm/s, with another normal and tangential law.
std::string steel(const std::string& normal, const std::string& tangential = "{model: none}") {
  return with(with(file_of("symmetric-30cms"), "{model: hard, restitution: 0.9}", normal),
              "{model: none}", tangential);
}
const std::string kLinear = "{model: linear, restitution: 0.9, collision_time: 2.55e-5}";

/// As it is told, with five digits.
void expect_told(const Explained& seen, const std::string& label, double value) {
  EXPECT_NEAR(seen.number(label) / value, 1, 5.1e-5) << label;
}

TEST(Explain, DerivesALinearContactsNumbers) {
  const Explained seen(with(steel(kLinear, "{model: viscous, damping_ratio: 0.5, friction: 0.5}"),
                            "[-15, 0]", "[0, 0]"));
  EXPECT_TRUE(seen.solver.starts_with("contact (")) << seen.solver;
  // γ_N = −2 ln e_n/t_col, ω0² = (π/t_col)² + γ_N²/4, C = π A γ_S/(2 ω0).
  const double gamma = -2 * std::log(0.9) / 2.55e-5;
  const double omega0 = std::hypot(M_PI / 2.55e-5, gamma / 2);
  expect_told(seen, "γ_N", gamma);
  expect_told(seen, "ω0", omega0);
  expect_told(seen, "ε", gamma / omega0);
  expect_told(seen, "γ_S", gamma / 2);
  expect_told(seen, "C", M_PI * 2.5 * gamma / 4 / omega0);
  EXPECT_EQ(seen.value("t_col"), "25.50 µs");
  EXPECT_EQ(seen.value("v_rel"), "150.0 mm/s");
  EXPECT_NEAR(seen.number("v^b"), 1e6 * 2 * 3.5 * 0.5 * kGravity / omega0, 0.06);  // in µm/s
  EXPECT_TRUE(seen.value("v^z").ends_with("mm/s"));
  // e_eff = (A e_n − 1)/(1 + A), and the same from hard contacts.
  EXPECT_EQ(seen.value("e_eff"), "0.35714");
  EXPECT_EQ(seen.find("i-j.effective_restitution")->remark, "0.3571428571");
  EXPECT_TRUE(
      seen.find("closed forms, with hard contacts of the same restitution and without rubbing"));
  const ExplainSection* after = seen.section("After the collision");
  ASSERT_TRUE(after);
  EXPECT_TRUE(after->is_part);
  EXPECT_EQ(after->columns.at(0).head, "i");
  EXPECT_EQ(after->columns.at(1).head, "j");
  for (const ExplainRow& row : after->rows) EXPECT_EQ(row.values.size(), 2u) << row.label;
}

TEST(Explain, SaysWhyClosedFormsDoNotApply) {
  const Explained seen(with(steel(kLinear), "[0.95, 0]", "[0.95, 0.1]"));
  EXPECT_TRUE(seen.find("closed forms of a rolling pair do not apply: the collision is oblique"));
  EXPECT_FALSE(seen.find("e_eff"));
}

TEST(Explain, ALawOfTheMaterials) {
  const Explained seen(with(steel("{model: viscoelastic, dissipation_time: 1e-6}"),
                            "{density: 7.85}",
                            "{density: 7.85, young_modulus: 2.06e12, poisson_ratio: 0.28}"));
  // ρ = 2 Y √R_eff/(3 (1 − ν²)), t_c = 2.9432 (m_eff/k_H)^(2/5) g^(−1/5), k_H = (4/5) ρ.
  const double rho = 2 * 2.06e11 * std::sqrt(1e-3) / (3 * (1 - 0.28 * 0.28));
  const double mass = 7850 * 4 * M_PI / 3 * 8e-9 / 2;
  const double duration = 2.9432 * std::pow(mass / (0.8 * rho), 0.4) * std::pow(0.3, -0.2);
  expect_told(seen, "ρ", rho);
  expect_told(seen, "A/t_c", 1e-6 / duration);
  expect_told(seen, "(g/c_t)²", 0.09 / (2.06e11 / (2 * 7850 * 1.28)));
  EXPECT_EQ(seen.value("A"), "1.000 µs");
  EXPECT_FALSE(seen.section("Warnings"));
}

TEST(Explain, ATiltedAndAShakenSubstrate) {
  const std::string level = file_of("symmetric-30cms");
  const Explained tilted(with(level, "substrate: {}", "substrate: {tilt: 5}"));
  EXPECT_TRUE(tilted.solver.starts_with("event (")) << tilted.solver;
  EXPECT_TRUE(tilted.solver.ends_with("integrated between collisions)")) << tilted.solver;
  expect_told(tilted, "a_roll", 5 / 7.0 * kGravity * std::sin(5 * M_PI / 180));
  const Explained shaken(
      with(level, "substrate: {}",
           "substrate: {motion: {kind: oscillate, amplitude: [0.1, 0], frequency: 5}}"));
  expect_told(shaken, "a_S", 1e-3 * std::pow(10 * M_PI, 2));
  expect_told(shaken, "a_roll", 2 / 7.0 * 1e-3 * std::pow(10 * M_PI, 2));
  EXPECT_TRUE(shaken.has("Needs", "moving substrate"));
  EXPECT_TRUE(shaken.has("Left out", "tilted substrate"));
}

TEST(Explain, EachFeatureIsNeededOrLeftOut) {
  const Explained seen(bundled("symmetric-30cms"));
  EXPECT_TRUE(seen.has("Needs", "collisions of two bodies"));
  EXPECT_TRUE(seen.has("Left out", "rolling friction"));
  EXPECT_EQ(seen.section("Needs")->rows.size() + seen.section("Left out")->rows.size(), 13u);
  const ExplainSection* bodies = seen.section("Bodies");
  ASSERT_EQ(bodies->rows.size(), 1u);  // both look alike
  EXPECT_EQ(bodies->columns.back().head, "slip");
  EXPECT_EQ(bodies->rows[0].label, "i … j");
  EXPECT_EQ(bodies->rows[0].values.at(0), "2.000 mm");
  EXPECT_EQ(bodies->rows[0].values.at(3), "2.5");
  EXPECT_EQ(bodies->rows[0].values.at(4), "150.0 mm/s");
}

TEST(Explain, TheLoopIsTheOneThatRuns) {
  const Scenario scenario = bundled("symmetric-30cms");
  const ContactScene scene = make_contact_scene(scenario);
  for (const bool general : {false, true}) {
    const Explanation told = explain_scene(scenario, scene, general);
    EXPECT_EQ(told.sections.at(0).title, "Loop");
    EXPECT_EQ(told.sections[0].rows.at(0).remark,
              general ? "phases on any plane" : "phases on a level, still plane");
  }
}

TEST(Explain, AVibratedBox) {
  const Explained seen(bundled("box-rough-moving-walls"));
  EXPECT_TRUE(seen.solver.starts_with("event (every contact is hard")) << seen.solver;
  for (const char* feature :
       {"collisions of two bodies", "rubbing at collisions", "rubbing at floor, walls and lid",
        "vibrating floor", "moving walls", "rule for inelastic collapse"})
    EXPECT_TRUE(seen.has("Needs", feature)) << feature;
  for (const char* feature :
       {"bodies of unlike size", "contacts that last", "restitution over the impact speed", "lid"})
    EXPECT_TRUE(seen.has("Left out", feature)) << feature;
  EXPECT_FALSE(seen.section("Substrate"));
  EXPECT_EQ(seen.value("V"), "1.000 m/s");
  expect_told(seen, "Γ", 1.5915e-3 * std::pow(200 * M_PI, 2) / kGravity);
  EXPECT_EQ(seen.value("N d/width"), "5");
  // (9 ((1 - √3/2) 5 + (√3/2) 25) + 5 (1 + 5 √3)) d0/100, L (14).
  EXPECT_EQ(seen.value("h_cm0"), "2.492 mm");
  // (2/q + 1/μ)/(1 + β0) with q = 2/5, μ = 1/2, β0 = 0, L (15).
  EXPECT_EQ(seen.value("K/R"), "7");
  EXPECT_EQ(seen.value("samples"), "800 looks");
  EXPECT_TRUE(seen.section("Contact glass on floor (g1): hard"));
  EXPECT_TRUE(seen.section("Contact glass on wall (g1): hard"));
  EXPECT_TRUE(seen.has("Bodies", "g1 … g50"));
}

TEST(Explain, BoxesOfOtherKinds) {
  const Explained one(bundled("box-one-ball"));
  EXPECT_FALSE(one.has("Needs", "vibrating floor"));
  EXPECT_EQ(one.find("rule for inelastic collapse")->remark, "elastic bodies cannot collapse");
  EXPECT_EQ(one.find("V")->remark, "the floor is at rest");
  EXPECT_TRUE(Explained(bundled("box-polydisperse")).has("Needs", "bodies of unlike size"));
  EXPECT_TRUE(
      Explained(bundled("box-viscoelastic")).has("Needs", "restitution over the impact speed"));
  EXPECT_EQ(Explained(bundled("box-collapse-tc")).find("rule for inelastic collapse")->remark,
            "TC model: no loss within 1e-06 s of a collision");
}

TEST(Explain, ABoxWhoseContactsLast) {
  std::string text = file_of("box-elastic-walls");
  for (const char* e : {"0.9", "1", "1"})
    text = with(text, std::string("{model: hard, restitution: ") + e + "}",
                std::string("{model: linear, restitution: ") + e + ", collision_time: 1e-5}");
  const Explained seen(text);
  EXPECT_TRUE(seen.solver.starts_with("contact (")) << seen.solver;
  EXPECT_TRUE(seen.has("Needs", "contacts that last"));
  EXPECT_EQ(seen.find("rule for inelastic collapse")->remark, "contacts that last cannot collapse");
  EXPECT_TRUE(seen.section("Contact glass on floor (g1): linear"));
  EXPECT_EQ(seen.value("t_col"), "10.00 µs");
}

TEST(Explain, AGasOnAPeriodicPlane) {
  const Explained seen(bundled("gas-rolling"));
  EXPECT_TRUE(seen.has("Needs", "periodic cell"));
  const double covered = 200 * M_PI * 4e-6 / (0.16 * 0.16);
  const double chi = (1 - 7 * covered / 16) / std::pow(1 - covered, 2);
  const double path = 0.16 * 0.16 / (2 * std::sqrt(2) * 200 * 4e-3 * chi);
  const double v_rel = std::sqrt(2) * 0.2, e = 0.9, mu = 0.1;
  const double slide = v_rel * v_rel * (1 + e) * (e - 1 + 5 * e) / (8 * mu * kGravity * 3.5 * 3.5);
  expect_told(seen, "φ", covered);
  EXPECT_NEAR(seen.number("l"), 1e3 * path, 5.1e-4);  // in mm, with four digits
  EXPECT_NEAR(seen.number("s"), 1e3 * slide, 5.1e-4);
  expect_told(seen, "l/s", path / slide);
  EXPECT_EQ(seen.value("L_x"), "160.0 mm");
}

TEST(Explain, ACueAndWhatPresetsBrought) {
  const Explained draw(bundled("draw-shot"));
  // J = (1 + e) V/(1/M + 1/m + (2/5 R)²/((2/5) m R²)).
  const double J = 1.73 * 2 / (1 / 0.54 + 1.4 / 0.17);
  EXPECT_NEAR(draw.number("J"), J, 1e-5 * J);
  EXPECT_EQ(draw.value("v"), fmt::format("[{:.5g}, 0, 0] m/s", J / 0.17));
  EXPECT_EQ(draw.value("Ω"), fmt::format("[0, {:.5g}, 0] rad/s", -J / 0.17 / 0.028575));
  const ExplainRow* rolling = draw.find("contacts[1].rolling");
  ASSERT_TRUE(rolling);
  EXPECT_TRUE(rolling->remark.starts_with("0.01 (pool-cloth: D. G. Alciatore")) << rolling->remark;
  EXPECT_TRUE(draw.has("From presets", "bodies[0].sphere.diameter"));
  EXPECT_FALSE(Explained(bundled("oblique")).section("From presets"));
}

TEST(Explain, FrictionOverTheSlipIsThatOfTheFirstMeeting) {
  const Explained draw(bundled("draw-shot"));
  const ExplainRow* mu = draw.find("μ");
  ASSERT_TRUE(mu);
  const double slip = std::stod(mu->remark.substr(std::string("friction at a slip of ").size()));
  EXPECT_NEAR(draw.number("μ"), 9.951e-3 + 0.108 * std::exp(-1.088 * slip), 1e-4);
  EXPECT_GT(slip, 0.5);
}

TEST(Explain, ABlockHoldsUpToStaticFriction) {
  const Explained block(bundled("block-on-ramp-holds"));
  // μ_s g cos θ, and no rolling.
  EXPECT_NEAR(block.number("|a_S − a_G|"), 0.5 * kGravity * std::cos(25 * M_PI / 180), 1e-4);
  EXPECT_EQ(block.value("a_roll"), "no row");
}

TEST(Explain, TellsOfTheTwoThatMeetAmongManySizes) {
  Scenario scenario = bundled("symmetric-30cms");
  LinearNormal linear;
  linear.restitution = 0.9;
  linear.collision_time = 2.55e-5;
  scenario.contacts[0].normal = linear;
  // Others far away, ever larger: of each two the spring is another.
  for (int k = 1; k <= 301; ++k) {
    Body& body = scenario.bodies.emplace_back(scenario.bodies[0]);
    body.name = "far" + std::to_string(k);
    body.sphere.radius *= 1 + 1e-3 * k;
    body.sphere.mass *= std::pow(1 + 1e-3 * k, 3);
    body.initial = {};
    body.initial.position = {0, 1.0 * k, body.sphere.radius};
  }
  const Explained seen(scenario);
  EXPECT_TRUE(seen.section("Contact steel on steel (i and j)"));
  expect_told(seen, "e_n", 0.9);
  const double omega0 = std::hypot(M_PI, std::log(0.9)) / 2.55e-5;
  expect_told(seen, "ω0", omega0);
  expect_told(seen, "k", scenario.bodies[0].sphere.mass / 2 * omega0 * omega0);
}

TEST(Explain, AsksTheEnginesWhatTheyWouldMakeOfIt) {
  test::use_test_engines();
  const Scenario scenario = bundled("symmetric-30cms");
  const Scene scene = make_contact_scene(scenario).hard;
  const auto runs = requested_runs({scenario});
  const ExplainSections engines = explain_engines(scenario, scene, runs.at(0), nullptr);
  ASSERT_EQ(engines.size(), scenario.compare.engines.size());
  EXPECT_EQ(engines[0].title,
            "Engine bullet double, profile default, 60, 240, 1000, 4000, 16000 Hz");
  const auto told = [&](const std::string& start) {
    return std::ranges::any_of(engines[0].rows, [&](const ExplainRow& row) {
      return row.label.empty() && row.remark.starts_with(start);
    });
  };
  EXPECT_TRUE(told("not represented: "));
  EXPECT_TRUE(told("left out: "));
  const auto erp = std::ranges::find(engines[0].rows, "erp", &ExplainRow::label);
  ASSERT_NE(erp, engines[0].rows.end());
  EXPECT_EQ(erp->remark, "0.2");
}

}  // namespace
}  // namespace slipcheck
