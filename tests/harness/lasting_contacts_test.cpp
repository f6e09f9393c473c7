#include "reference/lasting_contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "../scenes.h"
#include "hard_run.h"

namespace slipcheck {
namespace {

const UncertainValue& of(const ReferenceResult& result, const std::string& name) {
  return result.observables.at(name);
}

/// One ball on three that touch each other, all at rest.
Scene pyramid(double friction) {
  Scene scene = test::steel_scene(4);
  const double R = scene.bodies[0].radius;
  scene.substrate[0].static_friction = scene.substrate[0].kinetic_friction = 0.6;
  scene.pairs[0] = {0.5, friction, 0.0};
  scene.initial[1].position.x() = 2 * R;
  scene.initial[2].position = {R, std::sqrt(3.0) * R, R};
  scene.initial[3].position = {R, R / std::sqrt(3.0), R + 2 * R * std::sqrt(2.0 / 3)};
  return scene;
}

TEST(LastingContacts, AreThoseOfPairsThatDoNotRebound) {
  Scene pair = test::head_on(0.1, -0.1, 0);
  EXPECT_TRUE(has_lasting_contacts(pair));
  pair.substrate[0].kinetic_friction = 0;  // nothing presses them together
  EXPECT_FALSE(has_lasting_contacts(pair));
  EXPECT_FALSE(has_lasting_contacts(test::head_on(0.1, -0.1, 0.5)));
}

TEST(LastingContacts, BodiesRestOnBodiesWhereNothingMovesAndAnUpperOneTouchesALowerOne) {
  EXPECT_TRUE(rests_on_bodies(pyramid(0.5)));
  Scene apart = pyramid(0.5);
  apart.initial[3].position.z() += 1e-3;
  EXPECT_FALSE(rests_on_bodies(apart));
  Scene on_plane = pyramid(0.5);
  on_plane.initial[3] = test::rolling_at(1, 1, 0, 0);
  EXPECT_FALSE(rests_on_bodies(on_plane));
  on_plane.initial[3].velocity.setZero();
  on_plane.initial[3].angular_velocity.setZero();
  EXPECT_FALSE(rests_on_bodies(on_plane));
}

/// Two materials that share a row of contacts, on two surfaces: each body becomes one of its own.
TEST(LastingContacts, BodiesKeepTheirContactsWithSurfaces) {
  Scene scene = test::steel_scene(3);
  scene.material = {0, 1, 1};
  scene.substrate.resize(2, scene.substrate[0]);
  scene.rows = {{0, 0}, 1};
  scene.pairs = {PairContact{0.5, 0.0, 0.0}};
  scene.surfaces.resize(2);
  scene.on_surfaces.resize(4);
  for (std::size_t k = 0; k < 4; ++k)
    scene.on_surfaces[k].impact.restitution = 0.1 * static_cast<double>(k + 1);
  const std::optional<ContactScene> made = with_lasting_contacts(scene, 1e-6);
  ASSERT_TRUE(made);
  const auto restitution = [](const PairContact& pair) {
    return std::get<double>(pair.restitution);
  };
  ASSERT_EQ(made->hard.on_surfaces.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t s = 0; s < 2; ++s)
      EXPECT_EQ(restitution(made->hard.on_surface(i, s).impact),
                0.1 * static_cast<double>(2 * scene.material[i] + s + 1));
  ASSERT_EQ(made->hard.pairs.size(), 9u);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(restitution(made->hard.between(i, j)), 0.5);
}

TEST(LastingContacts, APyramidStandsAndFallsAsStaticsSays) {
  // At the angle θ of the line of centres to the vertical, sin θ = 1/√3, a lower ball is held by
  // the friction N tan(θ/2) = 0.318 N at both its contacts.
  const double tan_half = std::tan(0.5 * std::asin(1 / std::sqrt(3.0)));
  ASSERT_LT(tan_half, 0.5);
  const Scene scene = pyramid(0.5);
#ifdef SLIPCHECK_SANITIZE
  const double standing = 0.005;  // the same code
#else
  const double standing = 0.05;
#endif
  const ReferenceResult stands =
      test::run_hard(scene, until_time(standing), {"a", "b", "c", "top"});
  EXPECT_EQ(stands.solver, "contact");
  ASSERT_TRUE(stands.run.reached) << stands.run.reason;
  const double R = scene.bodies[0].radius;
  const UncertainValue& z = of(stands, "top.final_position.z");
  const double height = scene.initial[3].position.z();
  EXPECT_LE(std::abs(z.value - height), z.uncertainty);
  EXPECT_LT(z.uncertainty, 1e-4 * R);
  ASSERT_GT(tan_half, 0.1);
  const ReferenceResult falls =
      test::run_hard(pyramid(0.1), until_time(0.06), {"a", "b", "c", "top"});
  ASSERT_TRUE(falls.run.reached) << falls.run.reason;
  EXPECT_LT(of(falls, "top.final_position.z").value, height - R);
}

TEST(LastingContacts, PairThatDoesNotReboundIsPressedTogetherUntilItsSpinsAreSpent) {
  // v = 0 from the meeting on; the slip R Ω falls with A μ_k g alone, as the other ball takes the
  // push: Ω(t) = v/R − A μ_k g t/R.
  const double v = 0.15, push = 2.5 * 0.1 * 9.81, R = 0.002;
  const double meeting = (0.01 - 0.004) / (2 * v), spent = v / push;
  const Scene scene = test::head_on(v, -v, 0);
  const double half = 0.5 * spent;
  const ReferenceResult pressed = test::run_hard(scene, until_time(meeting + half), {"i", "j"});
  EXPECT_EQ(pressed.solver, "contact");
  EXPECT_EQ(pressed.run.collisions, 1u);
  // Integrated to 1e-13, with the digits of places of 1e-2 m in the time of the meeting.
  constexpr double kShare = 1e-9;
  EXPECT_NEAR(of(pressed, "i.final_angular_velocity.y").value, 0.5 * v / R, kShare * v / R);
  EXPECT_NEAR(of(pressed, "i.final_velocity.x").value, 0, kShare * v);
  EXPECT_NEAR(of(pressed, "i.final_position.x").value, -R, kShare * R);
  const ReferenceResult ended = test::run_hard(scene, {Run::Until::rolling, 0, 10}, {"i", "j"});
  ASSERT_TRUE(ended.run.reached) << ended.run.reason;
  EXPECT_NEAR(of(ended, "i.sliding_time").value, spent, kShare * spent);
  EXPECT_NEAR(of(ended, "i.rolling_velocity.x").value, 0, kShare * v);
  EXPECT_NEAR(of(ended, "i.final_position.x").value, -R, kShare * R);
  // What held the push springs back, by less than it says.
  const UncertainValue& left = of(ended, "i.final_velocity.x");
  EXPECT_LE(std::abs(left.value), left.uncertainty);
  EXPECT_LT(left.uncertainty, 1e-4 * v);
}

TEST(LastingContacts, ALineThatDoesNotReboundGoesOnWithTheMomentumOfOne) {
  // Four balls: all go on with v/4, but for what the substrate takes, at most μ_k g t of each.
  const double v = 1, friction = 1e-4, end = 0.06;
  Scene scene = test::steel_scene(4);
  scene.substrate[0].kinetic_friction = friction;
  scene.pairs[0].restitution = 0.0;
  for (std::size_t k = 0; k < 4; ++k)
    scene.initial[k].position.x() = 0.0044 * static_cast<double>(k);
  scene.initial[0].velocity.x() = v;
  const ReferenceResult result = test::run_hard(scene, until_time(end), {"a", "b", "c", "d"});
  ASSERT_TRUE(result.run.reached) << result.run.reason;
  for (const char* name : {"a", "b", "c", "d"})
    EXPECT_NEAR(of(result, std::string(name) + ".final_velocity.x").value, v / 4,
                friction * 9.81 * end)
        << name;
}

TEST(LastingContacts, AStateThatIsNoNumberFailsTheRunByName) {
  Scene scene = test::head_on(0.1, -0.1, 0.9);
  scene.initial[1].angular_velocity.z() = std::numeric_limits<double>::quiet_NaN();
  const ReferenceResult result = test::run_hard(scene, until_time(0.01), {"i", "j"});
  EXPECT_TRUE(result.run.failed);
  EXPECT_FALSE(result.run.reached);
  EXPECT_NE(result.run.reason.find("the state of body 1 is not finite"), std::string::npos)
      << result.run.reason;
}

}  // namespace
}  // namespace slipcheck
