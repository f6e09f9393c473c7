#include <gtest/gtest.h>

#include <cstring>

#include "../scenes.h"
#include "../support/refusal.h"
#include "engine/lacks.h"
#include "peer_run.h"
#include "simbody_bare.h"
#include "worker_run.h"

namespace slipcheck {
namespace {

std::string executable() { return test::peer_executable("simbody"); }

const Settings kPrecise = {
    {"accuracy", 1e-7}, {"transition_velocity", 1e-4}, {"modulus", 2e10}, {"interpolate", false}};

void expect_same_bits(const Scene& scene, const std::vector<test::BareBall>& balls) {
  RemoteEngine engine(executable(), test::kPatient);
  const Applied applied = engine.configure(scene, {}, 1.0 / 240);
  const auto typed = [&](const std::string& of) {
    return test::BareContact{1e9, number(applied, of + "_dissipation"),
                             number(applied, of + "_static_friction"),
                             number(applied, of + "_dynamic_friction")};
  };
  const test::BareContact pair = balls.size() > 1 ? typed("pair") : test::BareContact{};
  const auto frames = test::peer_run(engine, scene, {}, 1.0 / 240, 240);
  const auto expected = test::simbody_bare(balls, typed("substrate"), pair, 240, 240);
  ASSERT_EQ(frames.size(), expected.size());
  for (std::size_t n = 0; n < frames.size(); ++n)
    ASSERT_EQ(std::memcmp(frames[n].bodies.data(), expected[n].data(), 72 * balls.size()), 0)
        << "frame " << n;
}

TEST(Simbody, NumbersAreThoseOfABareProgram) {
  const Scene slide = test::slide_to_roll(), bounce = test::bouncing_ball();
  expect_same_bits(slide, {{0.005, slide.bodies[0].mass, 0, 0.005, 0.5, 0}});
  expect_same_bits(bounce, {{0.01, bounce.bodies[0].mass, 0, 0.06, 0, 0}});
  const Scene pair = test::head_on(0.15, -0.15, 0.9, 0.0095);
  const double mass = pair.bodies[0].mass, turn = pair.initial[0].angular_velocity.y();
  expect_same_bits(pair, {{0.002, mass, -0.0095, 0.002, 0.15, turn},
                          {0.002, mass, 0.0095, 0.002, -0.15, -turn}});
}

TEST(Simbody, ABallSlidesIntoRolling) {
  const Scene scene = test::slide_to_roll();
  RemoteEngine engine(executable(), test::kPatient);
  const auto frames = test::peer_run(engine, scene, kPrecise, 1e-3, 120);
  // The contact's depth and what it takes to settle is what is left.
  EXPECT_NEAR(test::sliding_end(frames, 0.005, 1e-3), 2 * 0.5 / (7 * 0.2 * 9.81), 2e-4);
  EXPECT_NEAR(frames.back().bodies[0].velocity.x(), 5.0 / 7 * 0.5, 1e-5);
}

TEST(Simbody, ABallReboundsWithItsRestitution) {
  const Scene scene = test::bouncing_ball();
  RemoteEngine engine(executable(), test::kPatient);
  // The dissipation is set for just this impact; gravity over the collision is left.
  const auto frames = test::peer_run(engine, scene, kPrecise, 1e-3, 150);
  EXPECT_NEAR(test::rebound(frames, scene), 0.8, 5e-4);
  const auto shipped = test::peer_run(engine, scene, {}, 1e-3, 150);
  EXPECT_NEAR(test::rebound(shipped, scene), 0.8, 5e-3);
}

TEST(Simbody, ASoftHertzContactHasItsDurationAndKeepsTheEnergy) {
  EngineScene scene(test::free_pair(0.15, -0.15));
  const double mass = scene.bodies[0].mass / 2, rho = 1e9;
  scene.soft = SoftContacts{
      {SoftContact{HertzForce{rho}, ContactEnd::zero_overlap, NoTangentialForce{}, false}}, {}};
  // Hertz 1882: 2.9433 ξ_max/v, ξ_max = ((5/4) m v²/ρ)^(2/5); L. Landau and E. Lifshitz, Theory of
  // elasticity, §9.
  const double depth = std::pow(1.25 * mass * 0.09 / rho, 0.4), time = 2.94326 * depth / 0.3;
  RemoteEngine engine(executable(), test::kPatient);
  const auto frames =
      test::peer_run(engine, scene, {{"accuracy", 1e-10}, {"interpolate", false}}, time / 50, 100);
  const BodyState &a = frames.back().bodies[0], &b = frames.back().bodies[1];
  const double rate = b.velocity.x() - a.velocity.x();
  EXPECT_NEAR(rate / 0.3, 1, 1e-6);
  const double since = (b.position.x() - a.position.x() - 0.004) / rate;
  EXPECT_NEAR((2 * time - since) / time, 1, 1e-5);
}

TEST(Simbody, HasNoRollingFrictionAndSaysSo) {
  const Scene scene = test::roll_to_rest();
  RemoteEngine engine(executable(), test::kPatient);
  const auto texts = texts_of(engine.configure(scene, {}, 1e-3).not_represented);
  EXPECT_EQ(texts,
            (std::vector<std::string>{"rolling friction",
                                      "contacts without duration (the substrate is Hertz's)"}));
  const auto frames = test::peer_run(engine, scene, kPrecise, 1e-3, 500);
  EXPECT_NEAR(frames.back().bodies[0].velocity.norm(), 0.5, 1e-4);
}

TEST(Simbody, EveryStartIsTheSame) {
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  RemoteEngine engine(executable(), test::kPatient);
  const auto first = test::peer_run(engine, scene, {}, 1.0 / 240, 30);
  std::vector<Frame> second;
  engine.start(scene.initial);
  engine.advance(30, [&](const Frame& frame) { second.push_back(frame); });
  for (std::size_t n = 0; n < first.size(); ++n)
    ASSERT_EQ(std::memcmp(first[n].bodies.data(), second[n].bodies.data(), 2 * 72), 0);
}

/// Below the transition velocity friction grows with the slip, up to the coefficient: here 0.3 for
/// 2/7 a_S, so that the slip is less than that velocity.
TEST(Simbody, AShakenSubstrateCarriesABallThatRolls) {
  constexpr double kBegin = 0.03, kRate = 240;
  const Scene scene = test::ball_on_shaker(kBegin);
  ASSERT_LT(2.0 / 7 * scene.motion.largest_acceleration(), 0.3 * kGravity);
  const Settings settings = test::peer_profile("simbody", "physical");
  RemoteEngine engine(executable(), test::kPatient);
  engine.configure(scene, settings, 1 / kRate);
  const double slip = std::get<double>(settings.at("transition_velocity"));
  ASSERT_LT(slip, 1e-2 * scene.motion.largest_speed());
  EXPECT_LT(test::shaker_error(engine, scene, kBegin, kRate), 2.0 / 7 * slip);
}

TEST(Simbody, RefusesWithTheReason) {
  RemoteEngine engine(executable(), test::kPatient);
  const auto refusal = [&](const EngineScene& scene) {
    return test::refusal_of<Refused>([&] { engine.configure(scene, {}, 1e-3); });
  };
  Scene scene = test::slide_to_roll();
  scene.motion = SubstrateMotion::table({{0, {0, 0}}, {1, {0.1, 0}}});
  EXPECT_EQ(refusal(scene), "simbody: a substrate that moves by a table, whose velocity jumps");
  scene = test::slide_to_roll();
  scene.periodic = {1, 1};
  EXPECT_TRUE(refusal(scene).starts_with("simbody: the substrate repeats itself"));
  EngineScene soft(test::head_on(0.15, -0.15, 0.9));
  soft.soft = SoftContacts{
      {SoftContact{LinearForce{1e5, 0}, ContactEnd::zero_overlap, NoTangentialForce{}, false}}, {}};
  EXPECT_TRUE(refusal(soft).starts_with("simbody: of forces that last it has Hertz's alone"));
}

}  // namespace
}  // namespace slipcheck
