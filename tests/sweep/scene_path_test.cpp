#include "studies/sweep/scene_path.h"

#include <gtest/gtest.h>

#include "../support/refusal.h"

namespace slipcheck {
namespace {

using test::refusal_of;

YamlPointer tree() {
  return parse_yaml(
      "bodies:\n"
      "  - {name: i, velocity: [1, 2]}\n"
      "  - {name: j, velocity: [3, 4]}\n"
      "compare: {tolerance: {i.sliding_time: 1 %}}\n",
      "a.yaml");
}

YamlPointer scalar(const std::string& text) {
  auto node = std::make_shared<YamlNode>();
  node->kind = YamlNode::Kind::scalar;
  node->text = text;
  return node;
}

TEST(ScenePath, ItemsAreFoundByNumberAndByName) {
  EXPECT_EQ(scene_path(*tree(), "bodies[1].velocity[0]").text(), "bodies[1].velocity[0]");
  EXPECT_EQ(scene_path(*tree(), "bodies.j.velocity.0").text(), "bodies[1].velocity[0]");
  EXPECT_EQ(scene_path(*tree(), "bodies[j].velocity").text(), "bodies[1].velocity");
}

TEST(ScenePath, AKeyMayHoldDots) {
  EXPECT_EQ(scene_path(*tree(), "compare.tolerance.i.sliding_time").steps.size(), 3u);
}

TEST(ScenePath, OnlyTheLastKeyMayBeNew) {
  EXPECT_EQ(scene_path(*tree(), "bodies.i.spin").text(), "bodies[0].spin");
  EXPECT_EQ(refusal_of<BadPath>([] { scene_path(*tree(), "bodies.i.sphere.radius"); }),
            "must be a path of the scene, and bodies[0] has no sphere");
  EXPECT_EQ(refusal_of<BadPath>([] { scene_path(*tree(), "bodie.i.spin"); }),
            "must be a path of the scene, and the scene has no bodie (did you mean bodies?)");
  EXPECT_EQ(refusal_of<BadPath>([] { scene_path(*tree(), "bodies.k.spin"); }),
            "must be a path of the scene, and bodies has no item k");
  EXPECT_EQ(refusal_of<BadPath>([] { scene_path(*tree(), "bodies.2.spin"); }),
            "must be a path of the scene, and bodies has no item 2");
  EXPECT_EQ(refusal_of<BadPath>([] { scene_path(*tree(), "bodies.i.name.x"); }),
            "must be a path of the scene, and bodies[0].name has no keys");
  EXPECT_EQ(refusal_of<BadPath>([] { scene_path(*tree(), "bodies..spin"); }),
            "must be keys of the scene, joined by dots");
}

TEST(ScenePath, AValueIsPutThereAndTheTreeStaysAsItWas) {
  const YamlPointer before = tree();
  const YamlPointer after =
      with_value(before, scene_path(*before, "bodies.j.velocity.0"), scalar("9"), {});
  EXPECT_EQ(before->find("bodies")->items[1]->find("velocity")->items[0]->text, "3");
  EXPECT_EQ(after->find("bodies")->items[1]->find("velocity")->items[0]->text, "9");
  EXPECT_EQ(after->find("bodies")->items[1]->find("velocity")->items[1]->text, "4");
  const YamlPointer more =
      with_value(before, scene_path(*before, "bodies.i.spin"), scalar("rolling"), {});
  EXPECT_EQ(more->find("bodies")->items[0]->find("spin")->text, "rolling");
  EXPECT_EQ(without_key(before, "compare")->find("compare"), nullptr);
}

}  // namespace
}  // namespace slipcheck
