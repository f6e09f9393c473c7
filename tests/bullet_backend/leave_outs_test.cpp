// What is left out of a step changes no result: without it the same frames bit for bit, and the
// same to rounding where one direction of friction does for two.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bullet_box.h"
#include "bullet_run.h"
#include "same_bits.h"

namespace slipcheck {
namespace {

constexpr double kGrainRadius = 0.005;  // [m]

const Settings kGeneral = {{"leaves_out", false}};

SubstrateContact rough_ground() {
  SubstrateContact ground = ground_with_friction(0.1);
  ground.rolling = RollingFriction(0.002);
  ground.drilling_length = 1e-4;
  return ground;
}

PairContact pair_of(double restitution, double friction = 0) {
  PairContact pair;
  pair.restitution = restitution;
  pair.friction = friction;
  pair.tangential_restitution = friction > 0 ? 0 : -1;
  return pair;
}

/// Rolls to rest and falls asleep.
Scene one_ball() {
  return scene_of(steel_ball(kGrainRadius), {rolling_towards(kGrainRadius, 0.2, 22.5)},
                  rough_ground());
}

Scene bouncing() {
  SubstrateContact ground = ground_with_friction(0.3);
  ground.restitution = 0.8;
  BodyState state = rolling_along_x(kGrainRadius, 0, 0.1);
  state.position.z() = 0.02;
  state.angular_velocity.z() = 1;  // not in a vertical plane, where one direction of friction does
  return scene_of(steel_ball(kGrainRadius), {state}, ground);
}

/// Rolling, oblique to each other.
Scene two_balls() {
  return scene_of(
      steel_ball(kGrainRadius),
      {rolling_towards(kGrainRadius, 0.3, 10), rolling_along_x(kGrainRadius, 0.03, -0.1)},
      rough_ground(), pair_of(0.8, 0.1));
}

/// On a substrate that swings.
Scene shaken() {
  Scene scene = two_balls();
  scene.motion = SubstrateMotion::oscillation(Vector2(0.01, 0.002), 5, 0.3);
  return scene;
}

Scene crowd() {
  Scene scene = two_balls();
  for (int k = 0; k < 4; ++k) {
    scene.bodies.push_back(steel_ball(k % 2 == 0 ? kGrainRadius : 0.8 * kGrainRadius));
    scene.material.push_back(0);
    scene.initial.push_back(
        rolling_towards(scene.bodies.back().radius, 0.2 - 0.1 * k, 30.0 * k, 0.02 * (k + 3)));
  }
  return scene;
}

struct Kind {
  const char* name;
  Settings settings;
};

class BulletLeaveOuts : public ::testing::TestWithParam<const char*> {
 protected:
  void expect_nothing_changes(const Scene& scene, const Settings& settings, double rate) {
    const auto steps = static_cast<std::size_t>(std::min(2000.0, 3 * rate));
    const auto short_of = run(engine_, scene, settings, rate, steps);
    expect_same_bits(short_of, run(engine_, scene, with(settings, kGeneral), rate, steps));
  }
  /// A second at 240 Hz; nothing where the engine refuses the settings.
  std::optional<std::vector<Frame>> taken(const Scene& scene, const Settings& settings) {
    try {
      return run(engine_, scene, settings, 240, 240);
    } catch (const Refused&) {
      return std::nullopt;
    }
  }
  RemoteEngine engine_{bullet_executable(GetParam())};
};

TEST_P(BulletLeaveOuts, NoBitChanges) {
  const Kind kinds[] = {
      {"default", kDefault},
      {"naive", kNaive},
      {"physical", shipped("physical")},
      {"never asleep", {{"sleeping", false}}},
      {"damped", {{"linear_damping", 0.1}, {"angular_damping", 0.2}}},
      {"swept", {{"ccd_motion_threshold", 1e-4}, {"ccd_swept_radius", 0.5}}},
      {"multibody", {{"body", "multibody"}, {"two_friction_directions", true}}},
      {"awake boxes only", {{"update_all_aabbs", false}}},
      {"two directions", {{"two_friction_directions", true}}},
  };
  for (const Scene& scene : {one_ball(), bouncing(), two_balls(), shaken(), crowd()})
    for (const Kind& kind : kinds)
      for (const double rate : {60.0, 240.0, 4000.0}) {
        SCOPED_TRACE(std::string(kind.name) + ", " + std::to_string(scene.bodies.size()) +
                     " balls, " + std::to_string(rate) + " Hz");
        expect_nothing_changes(scene, kind.settings, rate);
      }
}

TEST_P(BulletLeaveOuts, NoBitChangesWithAnySettingAtAnotherValue) {
  // What is left out does what the settings say: one that acts where Bullet is skipped would act
  // nowhere. A second, as rigid bodies and as multibodies.
  std::size_t tried = 0;
  for (const SettingInfo& info : engine_.info().settings) {
    if (info.name == "leaves_out" || info.name == "body") continue;
    for (const char* body : {"rigid", "multibody"}) {
      const Settings settings = {{"body", body}, {info.name, another(info)}};
      SCOPED_TRACE(info.name + ", " + body);
      for (const Scene& scene : {bouncing(), two_balls()}) {
        const std::optional<std::vector<Frame>> short_of = taken(scene, settings);
        if (!short_of) continue;
        const std::optional<std::vector<Frame>> in_full = taken(scene, with(settings, kGeneral));
        ASSERT_TRUE(in_full) << "refused where nothing is left out";
        expect_same_bits(*short_of, *in_full);
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 150u);
}

TEST_P(BulletLeaveOuts, NoBitChangesFarAway) {
  // Beyond 1e12 Bullet takes a bounding box for an error and halts the ball.
  Scene scene = one_ball();
  for (const double speed : {1e5, 1e9, 1e300}) {
    scene.initial[0].velocity.x() = speed;
    expect_nothing_changes(scene, kDefault, 240);
    expect_nothing_changes(scene, {{"body", "multibody"}}, 240);
  }
}

INSTANTIATE_TEST_SUITE_P(Precisions, BulletLeaveOuts, ::testing::Values("double", "single"),
                         [](const auto& param) { return std::string(param.param); });

// --- one direction of friction -------------------------------------------------------------------

/// Two that roll towards each other, `degrees` from x.
Scene on_a_line(double degrees) {
  return scene_of(steel_ball(kGrainRadius),
                  {rolling_towards(kGrainRadius, 0.3, degrees),
                   rolling_towards(kGrainRadius, -0.1, degrees, 0.02171234)},
                  ground_with_friction(0.1), pair_of(0.8));
}

std::vector<Frame> ends_of_steps(std::vector<Frame> frames) {
  std::erase_if(frames, [](const Frame& frame) { return frame.part != 1; });
  return frames;
}

class BulletLine : public ::testing::Test {
 protected:
  bool leaves_out(const Scene& scene, const char* what, const Settings& settings) {
    const auto left_out = engine_.configure(scene, settings, 1e-3).left_out;
    return std::ranges::any_of(left_out,
                               [&](const std::string& text) { return text.starts_with(what); });
  }
  bool has_one_direction(const Scene& scene) {
    return leaves_out(scene, "second friction direction", physical_);
  }
  const Settings physical_ = shipped("physical");
  RemoteEngine engine_{bullet_executable("double")};
};

TEST_F(BulletLine, OneDirectionDoesForTwoToRounding) {
  for (const double degrees : {0.0, 90.0, 22.5, 200.0})
    for (const char* profile : {"physical", "tuned"})
      for (const double rate : {60.0, 240.0, 4000.0}) {
        Scene scene = on_a_line(degrees);
        scene.downhill = 0.3 * direction(degrees).head<2>();
        scene.motion = SubstrateMotion::oscillation(0.01 * direction(degrees).head<2>(), 3, 1);
        ASSERT_TRUE(has_one_direction(scene)) << degrees;
        const auto steps = static_cast<std::size_t>(rate / 2);
        const auto one = run(engine_, scene, shipped(profile), rate, steps);
        const auto two = run(engine_, scene, with(shipped(profile), kGeneral), rate, steps);
        // Up to 8000 substeps each off by the rounding of 60 rad/s, 1e-14, which a collision may
        // raise tenfold. Where in a step the contacts fall is rounded too.
        const auto a = ends_of_steps(one), b = ends_of_steps(two);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t n = 0; n < a.size(); ++n)
          for (std::size_t i = 0; i < 2; ++i) {
            const BodyState &x = a[n].bodies[i], &y = b[n].bodies[i];
            ASSERT_LT((x.velocity - y.velocity).norm(), 1e-11) << profile << rate << ' ' << n;
            ASSERT_LT((x.position - y.position).norm(), 1e-11) << profile << rate << ' ' << n;
            ASSERT_LT((x.angular_velocity - y.angular_velocity).norm(), 1e-8) << profile << n;
          }
        EXPECT_TRUE(std::ranges::any_of(one, touch_each_other));
      }
}

TEST_F(BulletLine, OnlyWhereNothingLeavesThePlane) {
  EXPECT_TRUE(has_one_direction(on_a_line(0)));
  EXPECT_TRUE(has_one_direction(on_a_line(33)));
  const auto changed = [this](auto change) {
    Scene scene = on_a_line(33);
    change(scene);
    return has_one_direction(scene);
  };
  EXPECT_FALSE(changed([](Scene& s) { s.initial[0].velocity += 1e-9 * direction(123); }));
  EXPECT_FALSE(changed([](Scene& s) { s.initial[1].position += 1e-9 * direction(123); }));
  EXPECT_FALSE(changed([](Scene& s) { s.initial[1].angular_velocity += direction(33); }));
  EXPECT_FALSE(changed([](Scene& s) { s.initial[1].angular_velocity.z() = 1; }));
  EXPECT_FALSE(changed([](Scene& s) { s.downhill = {0.1, 0}; }));
  EXPECT_FALSE(changed([](Scene& s) { s.motion = SubstrateMotion::constant({0, 0.1}); }));
  EXPECT_FALSE(changed([](Scene& s) {
    s.motion = SubstrateMotion::table({{0, {0, 0}}, {1, {0.1, 0.1}}});
  }));
  // Bullet's one row lies across between two balls, and without the cone nothing rolls to rest.
  EXPECT_FALSE(changed([](Scene& s) { s.pairs = {pair_of(0.8, 0.1)}; }));
  EXPECT_FALSE(changed([](Scene& s) { s.substrate = {rough_ground()}; }));
  EXPECT_TRUE(changed([](Scene& s) { s.initial[0].velocity.z() = 1; }));
  EXPECT_FALSE(leaves_out(on_a_line(33), "second", kDefault));
  EXPECT_FALSE(leaves_out(on_a_line(33), "second", with(physical_, {{"friction_cone", false}})));
}

TEST_F(BulletLine, AStartOffTheLineHasBothDirections) {
  const Scene scene = on_a_line(0);
  std::vector<BodyState> off = scene.initial;
  off[0].velocity.y() = 0.1;
  const auto frames = [&](const Settings& settings) {
    engine_.configure(scene, settings, 1e-3);
    engine_.start(off);
    std::vector<Frame> made;
    engine_.advance(200, [&](const Frame& frame) { made.push_back(frame); });
    return made;
  };
  expect_same_bits(frames(physical_), frames(with(physical_, kGeneral)));
}

// --- what is told --------------------------------------------------------------------------------

TEST_F(BulletLine, EachIsToldWithItsReason) {
  const Scene bare = on_a_line(0);
  Scene rolling = bare, drilling = bare;
  rolling.substrate[0].rolling = RollingFriction(0.001);
  drilling.substrate[0].drilling_length = 1e-4;
  const Settings multibody = {{"body", "multibody"}};
  for (const Settings& settings : {kDefault, multibody}) {
    EXPECT_TRUE(leaves_out(bare, "rolling rows (no rolling friction)", settings));
    EXPECT_TRUE(leaves_out(bare, "spinning rows (no drilling friction)", settings));
    EXPECT_FALSE(leaves_out(rolling, "rolling rows", settings));
    EXPECT_FALSE(leaves_out(drilling, "spinning rows", settings));
  }
  // Of a rigid body Bullet makes all three or none.
  EXPECT_FALSE(leaves_out(rolling, "spinning rows", kDefault));
  EXPECT_FALSE(leaves_out(drilling, "rolling rows", kDefault));
  EXPECT_TRUE(leaves_out(rolling, "spinning rows", multibody));
  EXPECT_TRUE(leaves_out(drilling, "rolling rows", multibody));
  EXPECT_TRUE(leaves_out(bare, "sweep for CCD", kDefault));
  EXPECT_FALSE(leaves_out(bare, "sweep for CCD", {{"ccd_motion_threshold", 0.1}}));
  EXPECT_TRUE(leaves_out(one_ball(), "broadphase (one body", kDefault));
  EXPECT_FALSE(leaves_out(bare, "broadphase", kDefault));
  EXPECT_TRUE(leaves_out(bare, "memory for more contacts (there are 3 pairs)", kDefault));
  EXPECT_FALSE(leaves_out(bare, "memory", kGeneral));
  EXPECT_FALSE(leaves_out(bare, "sweep", kGeneral));
  EXPECT_FALSE(leaves_out(bare, "second", with(physical_, kGeneral)));
}

}  // namespace
}  // namespace slipcheck
