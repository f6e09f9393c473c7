#include "engine/scene_needs.h"

#include <gtest/gtest.h>

#include "engine/lacks.h"
#include "some_scene.h"

namespace slipcheck {
namespace {

/// Balls of 1 cm, one for each material given, on substrates and with pairs that need nothing.
Scene balls_of(const std::vector<std::uint32_t>& materials, std::size_t kinds) {
  Scene scene;
  scene.bodies.assign(materials.size(), Sphere{0.01, 0.1, 0.4});
  scene.initial.resize(materials.size());
  scene.material = materials;
  scene.substrate.resize(kinds);
  scene.pairs.assign(kinds * kinds, PairContact{0.0, 0, -1});
  return scene;
}

TEST(SceneNeeds, AMaterialThatNoBodyIsOfNeedsNothing) {
  Scene scene = balls_of({0}, 2);
  scene.substrate[1].static_friction = scene.substrate[1].kinetic_friction = 0.3;
  scene.pairs[3].restitution = 0.9;
  EXPECT_FALSE(needs_of(scene, 1e-3).friction);
  EXPECT_FALSE(needs_of(scene, 1e-3).bounce);
  scene.material[0] = 1;
  EXPECT_TRUE(needs_of(scene, 1e-3).friction);
  EXPECT_FALSE(needs_of(scene, 1e-3).static_friction);
  EXPECT_FALSE(needs_of(scene, 1e-3).bounce) << "a single ball has no pair";
}

TEST(SceneNeeds, RollingFrictionThatActsOnSlidingBodiesTooIsToldApart) {
  Scene scene = balls_of({0}, 1);
  scene.substrate[0].rolling = RollingFriction(0.01);
  EXPECT_TRUE(needs_of(scene, 1e-3).rolling && needs_of(scene, 1e-3).rolling_only);
  scene.substrate[0].rolling_while_sliding = true;
  EXPECT_TRUE(needs_of(scene, 1e-3).rolling);
  EXPECT_FALSE(needs_of(scene, 1e-3).rolling_only);
  EXPECT_FALSE(needs_of(scene, 1e-3).rolling_table);
}

TEST(SceneNeeds, SlipThatIsKeptOrJustStoppedIsNotReversed) {
  Scene scene = balls_of({0, 0}, 1);
  scene.pairs[0].friction = 0.2;
  for (const double beta0 : {-1.0, 0.0, -0.5, 1.0}) {
    scene.pairs[0].tangential_restitution = beta0;
    EXPECT_EQ(needs_of(scene, 1e-3).reversed_slip, beta0 != -1 && beta0 != 0) << beta0;
  }
}

TEST(SceneNeeds, ABallThatFallsItsRadiusInAStepMayPassAnother) {
  Scene scene = balls_of({0}, 1);
  scene.gravity = 10;
  scene.box.emplace();
  scene.box->width = 1;
  scene.box->on_floor = scene.box->on_wall = {PairContact{0.5, 0, -1}};
  scene.initial[0].position = Vector3(0.5, 0, 0.2);  // 2 m/s on the floor, 1 cm in 5 ms
  EXPECT_FALSE(needs_of(scene, 4.9e-3).far_in_a_step);
  EXPECT_TRUE(needs_of(scene, 5.1e-3).far_in_a_step);
  EXPECT_TRUE(needs_of(scene, 1e-3).bounce);
}

TEST(SceneNeeds, ALawOfFrictionIsToldWherePairsRub) {
  Scene scene = some_scene();
  EXPECT_FALSE(needs_of(scene, 1e-3).friction_law);
  for (PairContact& pair : scene.pairs) pair = {0.9, ExponentialFriction{0.01, 0.1, 1}, 0};
  EXPECT_TRUE(needs_of(scene, 1e-3).friction_law);
  for (PairContact& pair : scene.pairs) pair.tangential_restitution = -1;  // the slip is kept
  EXPECT_FALSE(needs_of(scene, 1e-3).friction_law);
}

TEST(SceneNeeds, TheNumberInPlaceOfALawIsThatOfTheFirstImpact) {
  // Two equal balls that meet where the line of centres lies at 30° to the velocity v of the first,
  // which rolls: along the surface v sin 30°, upwards its spin's v cos 30°.
  Scene scene = some_scene();
  const double R = scene.bodies[0].radius, v = 0.8;
  scene.initial[0] = {{-0.1, R, R}, {v, 0, 0}, rolling_angular_velocity({v, 0, 0}, R)};
  scene.initial[1] = {{0, 0, R}, Vector3::Zero(), Vector3::Zero()};
  const double slip = std::hypot(v / 2, v * std::sqrt(0.75));
  EXPECT_NEAR(slip_at_meeting(scene, 0, 1), slip, 1e-12);
  const FrictionLaw law = ExponentialFriction{0.01, 0.1, 1};
  for (PairContact& pair : scene.pairs) pair.friction = law;
  const Scene given = with_friction_numbers(scene);
  EXPECT_NEAR(std::get<double>(given.between(0, 1).friction), friction_at(law, slip), 1e-13);
  EXPECT_NEAR(std::get<double>(given.between(1, 0).friction), friction_at(law, slip), 1e-13);
  EXPECT_FALSE(needs_of(given, 1e-3).friction_law);
}

TEST(SceneNeeds, ShapesAreNamed) {
  Scene scene = some_scene();
  EXPECT_TRUE(shapes_of(scene).empty());
  scene.bodies[1].shape = Shape::cylinder;
  EXPECT_EQ(shapes_of(scene), std::vector<std::string>{scene_part::kCylinder});
}

TEST(LackList, KindsAreWithoutReasonsAndNumbers) {
  LackList list;
  list.note(false, lack::kDrilling);
  list.note(true, lack::kStaticFriction, "one coefficient");
  list.note_threshold(true, 0);
  list.note_threshold(true, 0.2);
  const std::vector<Lack> lacks = list.take();
  EXPECT_EQ(texts_of(lacks), (std::vector<std::string>{"static friction (one coefficient)",
                                                       "restitution below 0.2 m/s of approach"}));
  EXPECT_EQ(lacks[0].kind, "static friction");
  EXPECT_EQ(lacks[1].kind, "restitution below … m/s of approach");
}

TEST(SceneNeeds, SurfacesCountInPlaceOfASubstrateThatIsNotThere) {
  Scene scene = balls_of({0}, 1);
  scene.has_substrate = false;
  scene.substrate[0].rolling = RollingFriction(0.01);
  scene.surfaces = {{RectangleShape{}, {}}};
  scene.on_surfaces = {{{}, {0.0, 0, -1}}};
  EXPECT_FALSE(needs_of(scene, 1e-3).rolling);
  scene.on_surfaces[0].lasting.drilling_length = 1e-3;
  scene.on_surfaces[0].impact = {PowerLawRestitution{}, 0.2, 0.5};
  const SceneNeeds needs = needs_of(scene, 1e-3);
  EXPECT_TRUE(needs.drilling && needs.bounce_law && needs.reversed_slip && needs.friction);
  EXPECT_FALSE(needs.swinging_surface || needs.through_in_a_step);
  scene.initial[0].velocity = {0, 0, -11};  // radius 1 cm, 11 mm in a step
  EXPECT_TRUE(needs_of(scene, 1e-3).through_in_a_step);
  scene.surfaces[0].motion =
      SurfaceMotion::moving(SubstrateMotion::oscillation({1, 0}, 1, 0), kUp, Vector3::UnitX());
  EXPECT_TRUE(needs_of(scene, 1e-3).swinging_surface);
}

}  // namespace
}  // namespace slipcheck
