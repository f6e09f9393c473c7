#include "scenario/fill/fill_lattice.h"

#include <cmath>
#include <numbers>

#include "../support/cpu_time.h"
#include "../support/extremes.h"
#include "scenes.h"

// Dense fills of a box and of a periodic cell, at random and on a lattice.

namespace slipcheck {
namespace {

using namespace testing;

/// 10 mm wide.
Scenario box(const std::string& fill) {
  const std::string bodies = kContainer.substr(kContainer.find("bodies:"));
  std::string text = with(kContainer, bodies, "fill: {prefix: g, material: steel, " + fill + "}\n");
  return parse_scenario(text + "run: {until: 1}\n", "s.yaml");
}

/// The smallest gap of two bodies over the sum of their radii; across the ends of a cell too.
double smallest_gap(const Scenario& scene, const Vector2& periodic = Vector2::Zero()) {
  double least = 1e300;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Body &a = scene.bodies[i], &b = scene.bodies[j];
      Vector3 apart = a.initial.position - b.initial.position;
      for (int k = 0; k < 2; ++k)
        if (periodic[k] > 0) apart[k] -= periodic[k] * std::round(apart[k] / periodic[k]);
      least = test::least_of(least, apart.norm() / (a.sphere.radius + b.sphere.radius) - 1);
    }
  }
  return least;
}

TEST(Fill, HundredsOfBodiesCoverHalfABoxAtRandom) {
  // 600 of 0.2 mm in 10 mm times 15.1 mm: 0.4993 of it. Random places end at 0.547.
  const test::CpuTime took;
  for (const int seed : {1, 2, 3}) {
    const Scenario scene =
        box("count: 600, radius: 0.2 mm, area: [0, 0, 10 mm, 14.9 mm], speed: 1, seed: " +
            std::to_string(seed));
    ASSERT_EQ(scene.bodies.size(), 600u);
    EXPECT_GE(smallest_gap(scene), -1e-12);
    for (const Body& body : scene.bodies) EXPECT_LE(body.initial.position.z(), 0.0149);
  }
  EXPECT_LT(took(), 20 * test::kSlower);
}

TEST(Fill, LatticeStartsAtTheLowerLeftRowByRow) {
  // Centres between the walls, 9 mm, and in 0.5 mm to 5.5 mm. 4 in a row of 3 mm, 3 in the next: 7,
  // and with three rows 11 in 2 · (√3/2) 3 mm = 5.196 mm, too high. So a is 5 mm/√3 = 2.887 mm for
  // more than 7 bodies.
  const Scenario scene =
      box("count: 8, radius: 0.5 mm, area: [0, 0, 1, 5.5 mm], arrange: lattice, speed: 2");
  ASSERT_EQ(scene.bodies.size(), 8u);
  const double a = 0.005 / std::numbers::sqrt3;
  for (std::size_t i = 0; i < 8; ++i) {
    const bool second = i >= 4 && i < 7;
    const auto column = static_cast<double>(second ? i - 4 : i % 7) + (second ? 0.5 : 0);
    const double row = i < 4 ? 0 : second ? 1 : 2;
    const Vector3 site(0.0005 + column * a, 0, 0.0005 + row * 0.0025);
    // The rows fit to within the 1e-14 that round-off is given.
    EXPECT_LT((scene.bodies[i].initial.position - site).norm(), 1e-15) << i;
    EXPECT_NEAR(scene.bodies[i].initial.velocity.norm(), 2, 1e-15);
    EXPECT_EQ(scene.bodies[i].initial.velocity.y(), 0);
  }
  EXPECT_NE(scene.bodies[0].initial.velocity, scene.bodies[1].initial.velocity);
}

TEST(Fill, LatticeHoldsWhatTouches) {
  // Rows of 10 and 9 spheres of 0.5 mm between walls 10 mm apart; 5 rows are 1 + 4 √3/2 = 4.4641 mm
  // high: 48 bodies, 0.844 of the area.
  const std::string dense = "radius: 0.5 mm, arrange: lattice, area: [0, 0, 1, 3.9642 mm], count: ";
  const Scenario scene = box(dense + "48");
  EXPECT_EQ(scene.bodies.size(), 48u);
  EXPECT_GE(smallest_gap(scene), -1e-12);
  const auto faults = test::faults_of([&] { box(dense + "49"); });
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults[0].rule, "must have room for 49 bodies, but only 48 found a place");
  EXPECT_EQ(faults[0].key, "fill.area");
}

TEST(Fill, LatticeGoesAroundOtherBodies) {
  const std::string fill =
      "fill: {prefix: g, count: 40, material: steel, radius: {uniform: [0.3 mm, 0.4 mm]}, area: "
      "[0, 0, 1, 8 mm], arrange: lattice}\nrun:";
  const Scenario scene = parse_scenario(with(kContainer, "run:", fill), "s.yaml");
  ASSERT_EQ(scene.bodies.size(), 42u);
  EXPECT_GE(smallest_gap(scene), -1e-12);
  for (const Body& body : scene.bodies) {
    EXPECT_LE(body.initial.position.x(), 0.01 - body.sphere.radius);
    EXPECT_GE(body.initial.position.z(), body.sphere.radius);
  }
}

TEST(Fill, LatticeKeepsItsDistanceAcrossAPeriodicCell) {
  for (const int count : {1, 7, 30, 100, 101, 137}) {
    std::string text = with(kHard, "substrate: {}", "substrate: {periodic: [2.5, 2.2]}");
    const std::string bodies = text.substr(text.find("bodies:"));
    text = with(text, bodies,
                "fill: {prefix: g, material: steel, radius: 0.09, area: [0, 0, 2.5, 2.2], arrange: "
                "lattice, count: " +
                    std::to_string(count) + "}\nrun: {until: 1}\n");
    const Scenario scene = parse_scenario(text, "s.yaml");
    ASSERT_EQ(scene.bodies.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(scene.bodies[0].initial.position, Vector3(0, 0, 0.09));
    const auto lattice =
        FillLattice::widest(Vector2(2.5, 2.2), Vector2(2.5, 2.2), 0.18, count).value();
    EXPECT_GE(lattice.sites(), count);
    // Positions carry round-off of the cell's size.
    if (count == 1) continue;
    EXPECT_GE(0.18 * (1 + smallest_gap(scene, {2.5, 2.2})), lattice.spacing() * (1 - 1e-12))
        << count;
  }
}

TEST(Fill, LatticesOfManySites) {
  const auto lattice = FillLattice::widest(Vector2(1, 1), std::nullopt, 1e-9, 1'000'000);
  // A site has √3/2 a² of the area; the edges take a row or two of 1000.
  EXPECT_NEAR(lattice.value().spacing(), std::sqrt(2 / (std::numbers::sqrt3 * 1e6)), 2e-6);
  EXPECT_GE(lattice->sites(), 1e6);
  EXPECT_FALSE(FillLattice::widest(Vector2(1, 1), std::nullopt, 0.5, 9));
  EXPECT_TRUE(FillLattice::widest(Vector2(1, 1), std::nullopt, 0.5, 8));  // 3 + 2 + 3
  EXPECT_TRUE(FillLattice::widest(Vector2(0, 0), std::nullopt, 1, 1));
  EXPECT_FALSE(FillLattice::widest(Vector2(0, 0), std::nullopt, 1, 2));
}

TEST(Fill, ArrangeFault) {
  const std::string fill =
      "fill: {prefix: g, count: 1, material: steel, radius: 0.1, area: [3, 3, 3, 3], arrange: "
      "lattic}\nrun:";
  expect_fault(with(kHard, "run:", fill),
               "s.yaml:16:88: fill.arrange: must be random or lattice (did you mean lattice?), got "
               "lattic");
}

}  // namespace
}  // namespace slipcheck
