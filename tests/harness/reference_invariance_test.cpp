#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../scenes.h"
#include "hard_run.h"

// What may change a scene's numbers and what may not: a place, a stranger far away, a later limit.

namespace slipcheck {
namespace {

const std::vector<std::string> kPair{"i", "j"};

RunEnd rolling(double limit) { return {Run::Until::rolling, 0, limit}; }

double value(const ReferenceResult& result, const std::string& name) {
  return result.observables.at(name).value;
}

/// Both results hold the observables of motion of the bodies of the first, to within their
/// uncertainties and `extra` of itself. (What counts as a collision goes by the scene's speed.)
void expect_agreement(const ReferenceResult& one, const ReferenceResult& other, double extra) {
  std::size_t compared = 0;
  for (const auto& [name, of_one] : one.observables) {
    if (name.find(".final_velocity") == std::string::npos &&
        name.find(".final_angular_velocity") == std::string::npos)
      continue;
    const auto found = other.observables.find(name);
    ASSERT_NE(found, other.observables.end()) << name;
    const UncertainValue& of_other = found->second;
    EXPECT_LE(std::abs(of_one.value - of_other.value),
              of_one.uncertainty + of_other.uncertainty + extra * std::abs(of_one.value))
        << name;
    ++compared;
  }
  EXPECT_EQ(compared, 16u);  // of two bodies: two sizes and six components each
}

TEST(ReferenceInvariance, APlaceFarAwayCostsDigitsInProportion) {
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  const ReferenceResult here = test::run_hard(scene, rolling(10), kPair);
  for (const double far : {1.0, 1e3}) {
    Scene moved = scene;
    for (BodyState& state : moved.initial) state.position += Vector3(far, -far, 0);
    // A gap of 6 mm between places of the size L has lost ε L/6 mm of itself, in a few roundings.
    const double lost = 8 * std::numeric_limits<double>::epsilon() * far / 0.006;
    expect_agreement(here, test::run_hard(moved, rolling(10), kPair), lost);
  }
}

TEST(ReferenceInvariance, SmallBallsMeetWhereTheyTouchHoweverFarTheyCome) {
  // Radius r, from the distance d, straight on: after (d − 2r)/v, and e_eff is the closed form's.
  for (const double d : {1e-3, 1.0, 1e3}) {
    const double r = 1e-6, v = 1;
    Scene scene = test::head_on(v, 0, 0.9, d / 2);
    for (Sphere& sphere : scene.bodies) sphere.radius = r;
    scene.initial = {test::rolling_at(-d / 2, 0, v, 0, r), test::rolling_at(d / 2, 0, 0, 0, r)};
    const ReferenceResult result = test::run_hard(scene, rolling(2 * d + 10), kPair);
    ASSERT_TRUE(result.run.reached) << result.run.reason;
    EXPECT_EQ(result.run.collisions, 1u);
    EXPECT_NEAR(result.first_contact, (d - 2 * r) / v, 1e-15 * d);
    EXPECT_NEAR(value(result, "i-j.effective_restitution"), (2.5 * 0.9 - 1) / 3.5, 1e-12) << d;
  }
}

TEST(ReferenceInvariance, AFarObliqueMeetingHasItsLineOfCentres) {
  // Aside by b = r: n makes the angle asin(b/2r) = 30° with the way, so u_n' = −e u_n parts them
  // with e v cos 30°.
  const double r = 1e-6, d = 10, v = 1;
  Scene scene = test::steel_scene(2);
  for (Sphere& sphere : scene.bodies) sphere.radius = r;
  scene.initial = {test::rolling_at(-d, r, v, 0, r), test::rolling_at(0, 0, 0, 0, r)};
  const ReferenceResult result = test::run_hard(scene, rolling(100), kPair);
  ASSERT_EQ(result.run.collisions, 1u);
  // ε d/r of the angle, in a few roundings.
  const double lost = 8 * std::numeric_limits<double>::epsilon() * d / r;
  const double struck = 0.5 * 1.9 * v * std::cos(M_PI / 6);
  EXPECT_NEAR(value(result, "j.velocity_after_collision"), struck, lost);
}

TEST(ReferenceInvariance, AStrangerDoesNotChangeAPair) {
  // e_n = 0.5 rolls apart with (A e − 1)/(1 + A) of the approach; what is 1e-5 m/s here is below
  // 1e-6 of the stranger's speed.
  const double v = 1e-5, e_eff = (2.5 * 0.5 - 1) / 3.5;
  Scene scene = test::head_on(v, -v, 0.5);
  const ReferenceResult alone = test::run_hard(scene, rolling(1e4), kPair);
  scene.bodies.push_back(scene.bodies[0]);
  scene.material.push_back(0);
  scene.initial.push_back(test::rolling_at(0, 1, 0, 100));
  const ReferenceResult beside = test::run_hard(scene, rolling(1e4), {"i", "j", "k"});
  EXPECT_NEAR(value(alone, "i.final_velocity"), e_eff * v, 1e-12 * v);
  EXPECT_NEAR(value(beside, "i.final_velocity"), e_eff * v, 1e-12 * v);
  expect_agreement(alone, beside, 0);
}

TEST(ReferenceInvariance, BodiesMeetAcrossAnEdgeAsInsideIt) {
  // The other one is a cell away, or two: its image is where it was.
  Scene scene = test::head_on(0.15, -0.05, 0.9);
  scene.initial[1].position.y() += 0.001;  // oblique: the line of centres counts
  scene.periodic = {1, 0.5};
  const ReferenceResult inside = test::run_hard(scene, rolling(10), kPair);
  EXPECT_NEAR(value(inside, "i-j.restitution"), 0.9, 1e-12);
  for (const Vector3& cells : {Vector3(1, 0, 0), Vector3(0, -0.5, 0), Vector3(-2, 1, 0)}) {
    Scene across = scene;
    across.initial[1].position += cells;
    const ReferenceResult result = test::run_hard(across, rolling(10), kPair);
    // ε of 2 m over a gap of millimetres.
    expect_agreement(inside, result, 1e-11);
    for (const char* name : {"i-j.restitution", "i-j.effective_restitution",
                             "i.velocity_after_collision", "j.sliding_time"})
      EXPECT_NEAR(value(result, name), value(inside, name), 1e-11) << name;
  }
}

TEST(ReferenceInvariance, ALaterLimitCostsNothing) {
  Scene scene = test::steel_scene(1);
  scene.motion = SubstrateMotion::oscillation({0.01, 0}, 5, M_PI / 2);
  const RunEnd soon = until_time(1), late{Run::Until::time, 1, 1e9};
  const ReferenceResult one = test::run_hard(scene, soon, {"i"});
  const ReferenceResult other = test::run_hard(scene, late, {"i"});
  EXPECT_EQ(one.run.steps, other.run.steps);
  EXPECT_EQ(value(one, "i.final_position"), value(other, "i.final_position"));
  EXPECT_EQ(one.first_contact, other.first_contact);
}

}  // namespace
}  // namespace slipcheck
