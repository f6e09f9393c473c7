// What an engine is not given unless it says that it takes it.

#include <gtest/gtest.h>

#include "engine/lacks.h"
#include "engine/remote_engine.h"
#include "engine/scene_needs.h"
#include "some_scene.h"

namespace slipcheck {
namespace {

TEST(Takes, AnEngineOfSpheresAloneIsRefusedABlock) {
  RemoteEngine engine(faulty_engine());
  ASSERT_TRUE(engine.info().takes.empty());
  Scene scene = some_scene(1);
  scene.bodies[0].shape = Shape::block;
  scene.extents = {Extent{{1, 1, 1}, Vector2::UnitX()}};
  try {
    engine.configure(scene, {}, 1e-3);
    FAIL() << "not refused";
  } catch (const Refused& refused) {
    EXPECT_STREQ(refused.what(), "faulty: it takes spheres alone here, and the scene has a block");
  }
  EXPECT_TRUE(engine.alive());
}

TEST(Takes, InPlaceOfALawOfFrictionItIsGivenANumberAndThatIsTold) {
  RemoteEngine engine(faulty_engine());
  Scene scene = some_scene();
  const std::vector<std::string> before =
      texts_of(engine.configure(scene, {}, 1e-3).not_represented);
  scene.pairs[1].friction = scene.pairs[2].friction = ExponentialFriction{0.01, 0.1, 1};
  scene.pairs[1].tangential_restitution = scene.pairs[2].tangential_restitution = 0;
  std::vector<std::string> expected = before;
  expected.emplace_back(lack::kFrictionLaw);
  EXPECT_EQ(texts_of(engine.configure(scene, {}, 1e-3).not_represented), expected);
}

TEST(Takes, InPlaceOfContactsThatRememberItIsGivenHardOnesAndThatIsTold) {
  RemoteEngine engine(faulty_engine());
  EngineScene scene = some_scene();
  SoftContact contact{LinearForce{1e5, 0.3}, ContactEnd::zero_force, NoTangentialForce{}, false};
  scene.soft = SoftContacts{std::vector<std::optional<SoftContact>>(4, contact), {}, {}};
  const auto lacks = [&] { return engine.configure(scene, {}, 1e-3).not_represented; };
  const std::vector<Lack> before = lacks();
  contact.memory.emplace();
  scene.soft->pairs[1] = scene.soft->pairs[2] = contact;
  const std::vector<Lack> now = lacks();
  ASSERT_EQ(now.size(), before.size() + 1);
  EXPECT_EQ(now.back().kind, lack::kMemory);
}

}  // namespace
}  // namespace slipcheck
