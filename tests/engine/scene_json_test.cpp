#include "engine/scene_json.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "../support/refusal.h"
#include "engine/protocol.h"
#include "some_scene.h"

namespace slipcheck::protocol {
namespace {

using nlohmann::json;

Request decode(const Request& request) {
  return decode_request(std::span<const std::uint8_t>(encode(request)).subspan(kPrefix));
}

EngineScene through(const EngineScene& scene) {
  return std::get<Configure>(decode(Configure{scene, {{"erp", 0.2}}, 1e-3})).scene;
}

void expect_rubbish(const EngineScene& scene, const std::function<void(json&)>& spoil,
                    const char* reason) {
  json object = scene_to_json(scene);
  spoil(object);
  const std::string place = "scene";
  EXPECT_EQ(test::refusal_of<Rubbish>([&] { scene_from_json(JsonNode(object, place)); }),
            "scene: " + std::string(reason));
}

TEST(SceneJson, TheSceneComesThroughWhole) {
  const Scene scene = some_scene(3);
  const auto request = std::get<Configure>(decode(Configure{scene, {{"erp", 0.2}}, 1e-3}));
  EXPECT_EQ(request.settings, (Settings{{"erp", 0.2}}));
  EXPECT_EQ(request.time_step, 1e-3);
  // The encoding is a function of every field, so equal encodings are equal scenes.
  EXPECT_EQ(scene_to_json(request.scene), scene_to_json(scene));
  EXPECT_EQ(request.scene.on_substrate(0).rolling(0.25), 0.0015);
  EXPECT_EQ(restitution_at(request.scene.between(0, 1).restitution, 0.01), 0.32);
  EXPECT_EQ(std::get<double>(request.scene.between(0, 2).restitution), 0.9);
  EXPECT_EQ(restitution_at(request.scene.between(1, 1).restitution, 0.2),
            restitution_at(scene.between(1, 1).restitution, 0.2));
  EXPECT_EQ(request.scene.on_substrate(1).coupled_radius, 1e-4);
  EXPECT_TRUE(request.scene.on_substrate(1).hertzian_pressure);
  EXPECT_TRUE(request.scene.on_substrate(1).rolling_while_sliding);
  EXPECT_FALSE(request.scene.on_substrate(0).rolling_while_sliding);
  EXPECT_EQ(request.scene.downhill, Vector2(0, -0.8));
}

TEST(SceneJson, BodiesInOnePieceAreTheSame) {
  EngineScene scene = some_scene(5);
  scene.bodies[3] = {1.0 / 3, 0.7, 2.0 / 3};
  const json one_by_one = scene_to_json(scene);
  scene.packed = true;
  const json object = scene_to_json(scene);
  EXPECT_FALSE(object.contains("bodies"));
  EXPECT_EQ(object["packed_bodies"].get_binary().size(), 5u * 28);
  EXPECT_EQ(scene_to_json(through(scene)), one_by_one);

  expect_rubbish(
      scene, [](json& o) { o["packed_bodies"].get_binary().pop_back(); },
      "packed_bodies: has 139 bytes, must be a multiple of 28");
  expect_rubbish(
      scene, [](json& o) { o["packed_bodies"].get_binary()[28 + 7] |= 0x80; },
      "packed_bodies: has -0.002 in body 1, must be finite and > 0");
  expect_rubbish(  // denormal, as "bodies" may not have it
      scene,
      [](json& o) {
        auto& bytes = o["packed_bodies"].get_binary();
        std::fill_n(bytes.begin() + 28, 8, 0);
        bytes[28] = 1;
      },
      "packed_bodies: has 5e-324 in body 1, must be finite and > 0");
  expect_rubbish(
      scene, [](json& o) { o["packed_bodies"].get_binary()[2 * 28 + 24] = 7; },
      "packed_bodies: has the material 7 in body 2, must be below 2");
}

TEST(SceneJson, BlocksCylindersAndLawsOfFrictionComeThrough) {
  Scene scene = some_scene(2);
  scene.bodies[0] = {0.05, 2, 0.3, Shape::block};
  scene.bodies[1] = {0.02, 1, 0.5, Shape::cylinder};
  scene.extents = {Extent{{0.3, 0.2, 0.1}, {0.6, 0.8}}, Extent{{0.07, 0.04, 0.04}, {0, 1}}};
  scene.pairs[0].friction = ExponentialFriction{0.01, 0.1, 1.0 / 3};
  scene.pairs[3].friction = TabulatedFriction({{0, 0.2}, {1, 0.1}});
  const EngineScene got = through(scene);
  EXPECT_EQ(got.bodies[0].shape, Shape::block);
  EXPECT_EQ(got.bodies[1].shape, Shape::cylinder);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(got.extents[i]->size, scene.extents[i]->size);
    EXPECT_EQ(got.extents[i]->axis, scene.extents[i]->axis);
  }
  for (const double v : {0.0, 0.3, 2.0})
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_EQ(friction_at(got.pairs[k].friction, v), friction_at(scene.pairs[k].friction, v));
  EXPECT_EQ(scene_to_json(got), scene_to_json(scene));
}

TEST(SceneJson, OfSpheresNoShapeIsSaid) {
  EXPECT_FALSE(scene_to_json(some_scene())["bodies"][0].contains("shape"));
}

TEST(SceneJson, EveryKindOfMotionComesThroughBitForBit) {
  const std::vector<SubstrateMotion> motions = {
      {},
      SubstrateMotion::constant({0.1, -1.0 / 3}),
      SubstrateMotion::oscillation({0.1, 0.02}, 1.0 / 7, 0.3),
      SubstrateMotion::table({{0, {0, 1}}, {1, {0.1, 1}}, {3, {0.2, -1}}})};
  for (const SubstrateMotion& motion : motions) {
    Scene scene = some_scene();
    scene.motion = motion;
    const auto received = through(scene);
    EXPECT_EQ(received.motion.kind(), motion.kind());
    EXPECT_EQ(received.motion.next_kink(0), motion.next_kink(0));
    for (double t : {0.0, 0.7, 1.9, 4.0}) {
      EXPECT_EQ(received.motion.position(t), motion.position(t));
      EXPECT_EQ(received.motion.velocity(t), motion.velocity(t));
    }
  }
}

TEST(SceneJson, ABoxComesThroughWhole) {
  const Scene scene = some_box(3);
  const auto received = through(scene);
  ASSERT_TRUE(received.box);
  const Box& box = *received.box;
  EXPECT_EQ(box.width, 0.1);
  EXPECT_EQ(box.floor.amplitude, 1e-3);
  EXPECT_EQ(box.floor.frequency, 1.0 / 7);
  EXPECT_TRUE(box.moving_walls);
  EXPECT_EQ(box.lid, 0.3);
  ASSERT_EQ(box.on_floor.size(), 2u);
  EXPECT_EQ(box.on_floor[1].friction, 0.4);
  EXPECT_EQ(restitution_at(box.on_floor[1].restitution, 0.01), 0.32);
  EXPECT_EQ(box.on_wall[0].tangential_restitution, -0.5);
  EXPECT_EQ(restitution_at(box.on_wall[1].restitution, 0.2),
            restitution_at(scene.box->on_wall[1].restitution, 0.2));
  EXPECT_EQ(std::get<double>(box.on_lid[1].restitution), 0.6);

  Scene open = some_box();
  open.box->lid.reset();
  open.box->moving_walls = false;
  const auto received_open = through(open);
  ASSERT_TRUE(received_open.box);
  EXPECT_FALSE(received_open.box->lid);
  EXPECT_FALSE(received_open.box->moving_walls);
  EXPECT_EQ(scene_to_json(received_open), scene_to_json(open));
}

TEST(SceneJson, APeriodicPlaneComesThroughAndTheReferencesRuleDoesNot) {
  Scene scene = some_scene();
  scene.periodic = {0.1, 1.0 / 3};
  scene.collapse = {CollapseRule::Model::contact_time, 1e-5};
  const auto received = through(scene);
  EXPECT_FALSE(received.box);
  EXPECT_EQ(received.periodic, scene.periodic);
  EXPECT_EQ(received.collapse.model, CollapseRule{}.model);
  EXPECT_EQ(received.collapse.contact_time, 0);
}

TEST(SceneJson, ABadSceneIsNamed) {
  const auto expect = [](auto spoil, const char* reason) {
    expect_rubbish(some_scene(), spoil, reason);
  };
  expect([](json& s) { s["bodies"][1]["material"] = 2; },
         "bodies[1].material: must be below 2, got 2");
  expect([](json& s) { s["bodies"] = json::array(); }, "bodies: must have an entry, got a list");
  expect([](json& s) { s["pairs"].erase(0); },
         "pairs: must have an entry for each of 4 pairs of materials, has 3");
  expect([](json& s) { s["initial"] = json::binary(Bytes(72)); },
         "initial: must have an entry for each of 2 bodies, has 1");
  expect([](json& s) { s["initial"] = json::binary(Bytes(71)); },
         "initial: has 71 bytes, must be a multiple of 72");
  expect(
      [](json& s) {
        s["substrate"][0]["rolling"] = {{1, 0.1}, {1, 0.2}};
      },
      "substrate[0].rolling[1][0]: must be above the one before, got 1");
  expect([](json& s) { s["substrate"][0]["rolling"] = json::array(); },
         "substrate[0].rolling: must have a point, got a list");
  expect([](json& s) { s["confined"] = 0; }, "confined: must be true or false, got 0");
  expect([](json& s) { s["pairs"][0]["restitution"] = 1.5; },
         "pairs[0].restitution: must be from 0 to 1, got 1.5");
  expect([](json& s) { s["pairs"][3]["restitution"]["slope"].erase(0); },
         "pairs[3].restitution.slope: must have an entry for each of 3 points, has 2");
  expect([](json& s) { s["pairs"][3]["restitution"]["log_odds"] = json::array(); },
         "pairs[3].restitution.log_odds: must have a point, got a list");
  expect([](json& s) { s["pairs"][3]["restitution"]["slope"][1] = "x"; },
         "pairs[3].restitution.slope[1]: must be a number, got \"x\"");
  expect([](json& s) { s["substrate"][1].erase("coupled_radius"); },
         "substrate[1].coupled_radius: must be there");
  expect([](json& s) { s["downhill"] = {1, 2, 3}; }, "downhill: must be a list of 2, got a list");
  expect([](json& s) { s["motion"]["kind"] = "wobble"; },
         "motion.kind: must be one of still, constant, oscillation, table, got \"wobble\"");
  expect(
      [](json& s) {
        s["motion"] = {{"kind", "table"}, {"points", json::array()}};
      },
      "motion.points: must have a point, got a list");
  expect(
      [](json& s) {
        s["motion"] = {{"kind", "table"}, {"points", {{0, 0, 0}, {0, 1, 0}}}};
      },
      "motion.points[1][0]: must be above the one before, got 0");
  expect(
      [](json& s) {
        s["motion"] = {{"kind", "table"}, {"points", {{0, 0}, {0, 1}}}};
      },
      "motion.points[0]: must be a list of 3 numbers, got a list");
}

/// One soft contact of each law, and one pair whose contact stays hard.
EngineScene soft_scene() {
  EngineScene scene(some_box(3));
  const SoftContact linear{LinearForce{1e5, 0.3}, ContactEnd::zero_force,
                           ViscousForce{1.0 / 3, 0.5, ViscousForce::Caps::apart}, false};
  const SoftContact hertz{HertzForce{1e9}, ContactEnd::zero_overlap,
                          AsperityForce{0.2, 1e-7, AsperityForce::Form::passive}, true};
  const SoftContact power{PowerForce{1e8, 20, 1.4, 0.6}, ContactEnd::zero_overlap,
                          NoTangentialForce{}, false};
  const SoftContact spheres{ViscoelasticForce{1e9, 1e-6}, ContactEnd::zero_overlap,
                            ImpactAngleForce{0.3, -0.5, 2.0 / 7, PowerLawRestitution{}}, false};
  const SoftContact compact{CompactViscoelasticForce{2e9, 1.0 / 7}, ContactEnd::zero_overlap,
                            NoTangentialForce{}, false};
  scene.soft = SoftContacts{{linear, std::nullopt, std::nullopt, hertz},
                            {{power, spheres}, {std::nullopt, compact}, {linear, std::nullopt}}};
  return scene;
}

TEST(SceneJson, SoftContactsComeThroughWhole) {
  const EngineScene scene = soft_scene();
  const EngineScene received = through(scene);
  EXPECT_EQ(scene_to_json(received), scene_to_json(scene));
  ASSERT_TRUE(received.soft);
  EXPECT_EQ(received.soft_between(0, 1), nullptr);
  const SoftContact& linear = *received.soft_between(0, 2);
  EXPECT_EQ(std::get<LinearForce>(linear.normal).damping, 0.3);
  EXPECT_EQ(linear.end, ContactEnd::zero_force);
  EXPECT_EQ(std::get<ViscousForce>(linear.tangential).damping, 1.0 / 3);
  EXPECT_EQ(std::get<ViscousForce>(linear.tangential).caps, ViscousForce::Caps::apart);
  const SoftContact& hertz = *received.soft_between(1, 1);
  EXPECT_EQ(std::get<AsperityForce>(hertz.tangential).form, AsperityForce::Form::passive);
  EXPECT_TRUE(hertz.after_impact);
  const SoftBox& box = received.soft->box;
  EXPECT_EQ(std::get<PowerForce>(box.on_floor[0]->normal).gamma, 0.6);
  EXPECT_EQ(std::get<ImpactAngleForce>(box.on_floor[1]->tangential).tangential_restitution, -0.5);
  EXPECT_EQ(std::get<CompactViscoelasticForce>(box.on_wall[1]->normal).dissipation_time, 1.0 / 7);
  EXPECT_FALSE(box.on_wall[0]);
}

/// Contacts that remember, of two spheres and of one material on two surfaces.
EngineScene remembering_scene() {
  EngineScene scene(some_surfaces());
  SoftContact contact{LinearForce{1e5, 0.3}, ContactEnd::zero_force, NoTangentialForce{}, false};
  contact.memory.emplace();
  contact.memory->sliding = {
      SpringFriction::Form::mindlin_displacement, 1.0 / 3, 0.1, 0.2, 0.5, 0.4};
  contact.memory->rolling = {1.0 / 7, 0.3, 1e-4};
  contact.memory->drilling = {1.0 / 9, 0.5, 2e-4};
  const std::optional<SoftContact> none;
  scene.soft = SoftContacts{{contact, none, none, none}, {}, {}};
  scene.soft->surfaces.resize(8);
  scene.soft->surfaces[1] = scene.soft->surfaces[6] = contact;
  return scene;
}

TEST(SceneJson, ContactsThatRememberComeThroughWhole) {
  const EngineScene scene = remembering_scene();
  const EngineScene received = through(scene);
  EXPECT_EQ(scene_to_json(received), scene_to_json(scene));
  EXPECT_EQ(received.soft_on_surface(0, 0), nullptr);
  for (const SoftContact* contact : {received.soft_between(0, 0), received.soft_on_surface(0, 1),
                                     received.soft_on_surface(1, 2)}) {
    ASSERT_TRUE(contact && contact->memory);
    const auto& [sliding, rolling, drilling] = *contact->memory;
    EXPECT_EQ(sliding.form, SpringFriction::Form::mindlin_displacement);
    EXPECT_EQ(sliding.stiffness, 1.0 / 3);
    EXPECT_EQ(sliding.damping, 0.1);
    EXPECT_EQ(sliding.damping_ratio, 0.2);
    EXPECT_EQ(sliding.static_friction, 0.5);
    EXPECT_EQ(sliding.kinetic_friction, 0.4);
    EXPECT_EQ(rolling.stiffness, 1.0 / 7);
    EXPECT_EQ(rolling.length, 1e-4);
    EXPECT_EQ(drilling.damping, 0.5);
  }
}

TEST(SceneJson, WhatForgetsHasHardContactsInTheirPlace) {
  EngineScene scene = remembering_scene();
  EXPECT_TRUE(scene.has_memory());
  scene.forget_memory();
  EXPECT_FALSE(scene.has_memory());
  EXPECT_EQ(scene.soft_between(0, 0), nullptr);
  EXPECT_EQ(scene.soft_on_surface(0, 1), nullptr);
  EXPECT_FALSE(scene_to_json(scene)["soft"].contains("on_surfaces"));
}

TEST(SceneJson, ABadContactThatRemembersIsNamed) {
  const auto expect = [](auto spoil, const char* reason) {
    expect_rubbish(remembering_scene(), spoil, reason);
  };
  expect([](json& s) { s["soft"]["on_surfaces"].erase(0); },
         "soft.on_surfaces: must have an entry for each of 8 materials on surfaces, has 7");
  expect([](json& s) { s["soft"]["pairs"][0]["memory"]["sliding"]["form"] = "round"; },
         "soft.pairs[0].memory.sliding.form: must be one of constant, mindlin, "
         "mindlin_displacement, got \"round\"");
  expect([](json& s) { s["soft"]["on_surfaces"][6]["memory"]["rolling"]["length"] = -1; },
         "soft.on_surfaces[6].memory.rolling.length: must be >= 0, got -1");
}

TEST(SceneJson, WhereAllIsHardNothingIsSaidOfSoftContacts) {
  EXPECT_FALSE(scene_to_json(some_scene()).contains("soft"));
  EXPECT_FALSE(EngineScene(with_hard_contacts(some_scene())).soft);
  EXPECT_FALSE(through(some_scene()).soft);
}

TEST(SceneJson, ABadSoftContactIsNamed) {
  const auto expect = [](auto spoil, const char* reason) {
    expect_rubbish(soft_scene(), spoil, reason);
  };
  expect([](json& s) { s["soft"]["pairs"].erase(0); },
         "soft.pairs: must have an entry for each of 4 pairs of materials, has 3");
  expect([](json& s) { s["soft"]["on_wall"].erase(0); },
         "soft.on_wall: must have an entry for each of 2 materials in a box, has 1");
  expect([](json& s) { s["soft"]["pairs"][0]["normal"]["model"] = "stiff"; },
         "soft.pairs[0].normal.model: must be one of linear, hertz, power, viscoelastic, "
         "compact_viscoelastic, got \"stiff\"");
  expect([](json& s) { s["soft"]["pairs"][0]["normal"]["stiffness"] = 0; },
         "soft.pairs[0].normal.stiffness: must be > 0, got 0");
  expect([](json& s) { s["soft"]["pairs"][0]["tangential"]["caps"] = "none"; },
         "soft.pairs[0].tangential.caps: must be one of together, apart, got \"none\"");
  expect([](json& s) { s["soft"]["pairs"][3].erase("ends_at"); },
         "soft.pairs[3].ends_at: must be there");
}

TEST(SceneJson, ABadBoxIsNamed) {
  const auto expect = [](auto spoil, const char* reason) {
    expect_rubbish(some_box(), spoil, reason);
  };
  expect([](json& s) { s["box"] = nullptr; }, "box: must be an object, got null");
  expect([](json& s) { s["box"]["width"] = 0; }, "box.width: must be > 0, got 0");
  expect([](json& s) { s["box"]["floor"]["amplitude"] = -1; },
         "box.floor.amplitude: must be >= 0, got -1");
  expect([](json& s) { s["box"]["floor"].erase("frequency"); },
         "box.floor.frequency: must be there");
  expect([](json& s) { s["box"]["moving_walls"] = "yes"; },
         "box.moving_walls: must be true or false, got \"yes\"");
  expect([](json& s) { s["box"]["lid"] = "open"; }, "box.lid: must be a number, got \"open\"");
  expect([](json& s) { s["box"]["on_wall"].erase(0); },
         "box.on_wall: must have an entry for each of 2 materials, has 1");
  expect([](json& s) { s["box"]["on_lid"][1]["restitution"] = 1.5; },
         "box.on_lid[1].restitution: must be from 0 to 1, got 1.5");
  expect([](json& s) { s["periodic"] = {-1, 0}; }, "periodic: must hold lengths >= 0, got a list");
  expect([](json& s) { s.erase("periodic"); }, "periodic: must be there");
}

TEST(SceneJson, SurfacesComeThroughWhole) {
  const Scene scene = some_surfaces();
  const Scene received = through(scene);
  EXPECT_EQ(scene_to_json(received), scene_to_json(scene));
  EXPECT_FALSE(received.has_substrate);
  ASSERT_EQ(received.surfaces.size(), 4u);
  const Vector3 at(0.3, 0.2, 0.1);
  for (std::size_t k = 0; k < 4; ++k)
    for (const double t : {0.0, 0.7}) {
      const Surface &sent = scene.surfaces[k], &got = received.surfaces[k];
      EXPECT_EQ(got.nearest(t, at).point, sent.nearest(t, at).point) << k;
      EXPECT_EQ(got.motion.velocity(t, at), sent.motion.velocity(t, at)) << k;
      EXPECT_EQ(got.motion.is_belt(), sent.motion.is_belt()) << k;
    }
  EXPECT_EQ(std::get<double>(received.on_surface(1, 3).impact.restitution), 0.1 * 7);
  EXPECT_EQ(received.on_surface(1, 3).lasting.coupled_radius, 1e-4);
}

TEST(SceneJson, WhereThereAreNoSurfacesNothingIsSaidOfThem) {
  const json object = scene_to_json(some_scene());
  for (const char* key : {"has_substrate", "surfaces", "on_surfaces"})
    EXPECT_FALSE(object.contains(key)) << key;
  EXPECT_TRUE(through(some_scene()).has_substrate);
}

TEST(SceneJson, ABadSurfaceIsNamed) {
  const auto expect = [](auto spoil, const char* reason) {
    expect_rubbish(some_surfaces(), spoil, reason);
  };
  expect([](json& s) { s["surfaces"][0]["shape"]["kind"] = "cone"; },
         "surfaces[0].shape.kind: must be one of plane, rectangle, rod, ball, got \"cone\"");
  expect(
      [](json& s) {
        s["surfaces"][0]["shape"]["normal"] = {0, 0, 2};
      },
      "surfaces[0].shape.normal: must have the length 1, got a list");
  expect(
      [](json& s) {
        s["surfaces"][1]["shape"]["half_width"] = {1, 1, 0};
      },
      "surfaces[1].shape.half_width: must be at right angles to the one before, got a list");
  expect(
      [](json& s) {
        s["surfaces"][1]["shape"]["half_length"] = {0, 0, 0};
      },
      "surfaces[1].shape.half_length: must have a length > 0, got a list");
  expect(
      [](json& s) {
        s["surfaces"][2]["shape"]["end"] = {0, 0, 0};
      },
      "surfaces[2].shape.end: must be apart from begin, got a list");
  expect(
      [](json& s) {
        s["surfaces"][2]["motion"]["rate"] = {0, 0, 0};
      },
      "surfaces[2].motion.rate: must not be zero, got a list");
  expect([](json& s) { s["surfaces"][3]["shape"]["radius"] = 0; },
         "surfaces[3].shape.radius: must be > 0, got 0");
  expect([](json& s) { s["surfaces"][3]["motion"]["kind"] = "hop"; },
         "surfaces[3].motion.kind: must be one of still, belt, moving, turning, got \"hop\"");
  expect([](json& s) { s["on_surfaces"].erase(0); },
         "on_surfaces: must have an entry for each of 8 materials on surfaces, has 7");
  Scene both = some_box();
  both.has_substrate = false;
  expect_rubbish(
      both, [](json&) {}, "box: must stand alone, without surfaces");
}

}  // namespace
}  // namespace slipcheck::protocol
