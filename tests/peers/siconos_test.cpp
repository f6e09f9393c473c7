#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

#include "../scenes.h"
#include "../support/refusal.h"
#include "engine/lacks.h"
#include "peer_run.h"
#include "siconos_bare.h"
#include "worker_run.h"

namespace slipcheck {
namespace {

std::string executable() { return test::peer_executable("siconos"); }

const Settings kPrecise = {{"tolerance", 1e-12}, {"iterations", 1e5}, {"newton_tolerance", 1e-12}};

void expect_same_bits(const Scene& scene, const std::vector<test::BareSphere>& balls,
                      const test::BareLaw& ground, const test::BareLaw& pair) {
  RemoteEngine engine(executable(), test::kPatient);
  const auto frames = test::peer_run(engine, scene, {}, 1.0 / 240, 240);
  const auto expected = test::siconos_bare(balls, ground, pair, 240, 240);
  ASSERT_EQ(frames.size(), expected.size());
  for (std::size_t n = 0; n < frames.size(); ++n)
    ASSERT_EQ(std::memcmp(frames[n].bodies.data(), expected[n].data(), 72 * balls.size()), 0)
        << "frame " << n;
}

TEST(Siconos, NumbersAreThoseOfABareProgram) {
  const Scene slide = test::slide_to_roll(), bounce = test::bouncing_ball();
  expect_same_bits(slide, {{0.005, slide.bodies[0].mass, 0, 0.005, 0.5, 0}}, {0, 0.2}, {});
  expect_same_bits(bounce, {{0.01, bounce.bodies[0].mass, 0, 0.06, 0, 0}}, {0.8, 0.3}, {});
  const Scene pair = test::head_on(0.15, -0.15, 0.9, 0.0095);
  const double mass = pair.bodies[0].mass, turn = pair.initial[0].angular_velocity.y();
  expect_same_bits(
      pair, {{0.002, mass, -0.0095, 0.002, 0.15, turn}, {0.002, mass, 0.0095, 0.002, -0.15, -turn}},
      {0, 0.1}, {0.9, 0});
}

TEST(Siconos, ABallSlidesIntoRolling) {
  const Scene scene = test::slide_to_roll();
  RemoteEngine engine(executable(), test::kPatient);
  const auto frames = test::peer_run(engine, scene, kPrecise, 1e-3, 120);
  // Sliding is exact; it ends inside a step.
  EXPECT_NEAR(test::sliding_end(frames, 0.005, 1e-3), 2 * 0.5 / (7 * 0.2 * 9.81), 1e-9);
  EXPECT_NEAR(frames.back().bodies[0].velocity.x(), 5.0 / 7 * 0.5, 1e-9);
  ASSERT_EQ(frames.back().touches.size(), 1u);
  EXPECT_NEAR(frames.back().touches[0].normal_impulse, scene.bodies[0].mass * 9.81e-3, 1e-12);
}

TEST(Siconos, ABallReboundsWithItsRestitutionUpToAStepOfGravity) {
  const Scene scene = test::bouncing_ball();
  RemoteEngine engine(executable(), test::kPatient);
  const double landing = std::sqrt(2 * 9.81 * 0.05);
  for (const double step : {1.0 / 240, 1e-3, 1e-4}) {
    const auto steps = static_cast<std::size_t>(0.15 / step);
    const auto frames = test::peer_run(engine, scene, kPrecise, step, steps);
    // The rebound takes the velocity, and the place, of a step's begin: g dt, and v dt of a fall.
    EXPECT_NEAR(test::rebound(frames, scene), 0.8, 2 * 9.81 * step / landing) << step;
  }
}

TEST(Siconos, RollingFrictionSlowsByItsCoefficientInAllHeadings) {
  Scene scene = test::roll_to_rest();
  RemoteEngine engine(executable(), test::kPatient);
  for (const double degrees : {0.0, 22.5, 30.0, 45.0}) {
    const double angle = degrees * M_PI / 180;
    const Vector3 velocity = 0.5 * Vector3(std::cos(angle), std::sin(angle), 0);
    scene.initial[0].velocity = velocity;
    scene.initial[0].angular_velocity = rolling_angular_velocity(velocity, 0.01);
    const auto frames = test::peer_run(engine, scene, kPrecise, 1e-3, 1000);
    const Vector3 v = frames.back().bodies[0].velocity;
    EXPECT_NEAR((0.5 - v.norm()) / (0.02 * 9.81 * 1.0), 1, 1e-6) << degrees;
    EXPECT_NEAR(std::atan2(v.y(), v.x()), angle, 1e-6) << degrees;
  }
}

TEST(Siconos, TheSpinIsAlongTheAxesOfSpace) {
  // Rolls and spins about the vertical: the body's axes turn, and what rolls goes on straight.
  Scene scene = test::slide_to_roll();
  scene.initial[0].angular_velocity =
      rolling_angular_velocity(scene.initial[0].velocity, 0.005) + Vector3(0, 0, 80);
  RemoteEngine engine(executable(), test::kPatient);
  const auto frames = test::peer_run(engine, scene, kPrecise, 1e-4, 2000);
  const BodyState& last = frames.back().bodies[0];
  EXPECT_NEAR(last.velocity.x(), 0.5, 1e-3);
  EXPECT_NEAR(last.angular_velocity.z(), 80, 0.1);
  EXPECT_NEAR(last.angular_velocity.y(), 100, 0.1);
}

TEST(Siconos, EveryStartIsTheSame) {
  const Scene scene = test::head_on(0.15, -0.15, 0.9);
  RemoteEngine engine(executable(), test::kPatient);
  const auto first = test::peer_run(engine, scene, {}, 1.0 / 240, 30);
  std::vector<Frame> second;
  engine.start(scene.initial);
  engine.advance(30, [&](const Frame& frame) { second.push_back(frame); });
  for (std::size_t n = 0; n < first.size(); ++n)
    ASSERT_EQ(std::memcmp(first[n].bodies.data(), second[n].bodies.data(), 2 * 72), 0);
}

/// With θ = 1/2 the velocity of the plane is the sum of its accelerations by the trapezoidal rule,
/// and the place that of the velocities: each has an error of at most (ω h)²/12 of its swing.
TEST(Siconos, AShakenSubstrateCarriesABallThatRolls) {
  constexpr double kBegin = 0.03, kRate = 240;
  const Scene scene = test::ball_on_shaker(kBegin);
  RemoteEngine engine(executable(), test::kPatient);
  engine.configure(scene, {}, 1 / kRate);
  const double angle = 2 * std::numbers::pi * scene.motion.frequency() / kRate;
  const double swing = 2.0 / 7 * 2 * scene.motion.largest_speed();
  EXPECT_LT(test::shaker_error(engine, scene, kBegin, kRate), 2 * angle * angle / 12 * swing);
}

TEST(Siconos, SaysWhatIsNotRepresentedAndRefuses) {
  Scene scene = test::roll_to_rest();
  scene.substrate[0].static_friction = 0.5;
  scene.substrate[0].drilling_length = 1e-5;
  RemoteEngine engine(executable(), test::kPatient);
  EXPECT_EQ(texts_of(engine.configure(scene, {}, 1e-3).not_represented),
            (std::vector<std::string>{
                "static friction (one coefficient for sticking and sliding)", "drilling friction",
                "rolling friction only while rolling (it acts while sliding too)"}));
  scene.motion = SubstrateMotion::table({{0, {0, 0}}, {1, {0.1, 0}}});
  EXPECT_EQ(test::refusal_of<Refused>([&] { engine.configure(scene, {}, 1e-3); }),
            "siconos: a substrate that moves by a table, whose velocity jumps");
}

}  // namespace
}  // namespace slipcheck
