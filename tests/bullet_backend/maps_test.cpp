// The exact maps, each alone, against its closed form: in every heading, whatever units Bullet
// counts in, at any rate.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bullet_run.h"

namespace slipcheck {
namespace {

constexpr double kHeadings[] = {0, 22.5, 45};
constexpr double kRates[] = {60, 240, 1000, 16000};  // [Hz]
constexpr double kTime = 0.05;                       // [s], of a run: 3 steps at 60 Hz

// Nothing is fitted in `physical`, and what is left is rounding, 1e-16 of 1 m/s in each of 800
// steps against a loss of 5e-3 m/s; in single precision 6e-8. What is tuned may trade within half a
// percent.
constexpr double kRoundOff = 1e-10, kRoundOffSingle = 4e-3, kTuned = 5e-3;

struct Case {
  const char* name;
  const char* precision;
  const char* profile;
  double tolerance;              // relative, of what friction takes in a run
  double length, mass, gravity;  // a radius, a ball and g in Bullet; 0: SI
};

/// The lengths of these profiles are in radii, and stay so in other units.
Settings settings_of(const Case& c) {
  Settings settings = shipped(c.profile);
  EXPECT_EQ(settings.at("scale_radius_to"), Setting(1.0));
  const double radius = c.length > 0 ? c.length : kRadius;
  for (const char* name : {"contact_processing_threshold", "linear_slop"})
    if (settings.contains(name)) settings[name] = radius * std::get<double>(settings.at(name));
  return with(
      settings,
      {{"scale_radius_to", c.length}, {"scale_mass_to", c.mass}, {"scale_gravity_to", c.gravity}});
}

Sphere ball_with(double shape_factor) {
  Sphere ball = steel_ball(kRadius);
  ball.shape_factor = shape_factor;
  return ball;
}

class BulletMaps : public ::testing::TestWithParam<Case> {
 protected:
  BodyState after(const Scene& scene, double rate, double time = kTime) {
    const auto steps = static_cast<std::size_t>(std::lround(time * rate));
    return run(engine_, scene, settings_of(GetParam()), rate, steps).back().bodies[0];
  }
  double tolerance() const { return GetParam().tolerance; }
  /// Of a restitution, where nothing adds up: rounding, or what tuning may trade.
  double bounce_tolerance() const {
    if (tolerance() == kTuned) return 1e-3;
    return GetParam().precision == std::string("single") ? 1e-5 : 1e-9;
  }
  RemoteEngine engine_{bullet_executable(GetParam().precision)};
};

TEST_P(BulletMaps, SlidingFrictionBrakesWithMuG) {
  const double mu = 0.3, lost = mu * kGravity * kTime;  // of v [m/s]; it slides for 0.097 s
  for (const double q : {2.0 / 5, 2.0 / 3}) {
    for (const double heading : kHeadings) {
      BodyState start = rolling_towards(kRadius, 1, heading);
      start.angular_velocity.setZero();
      const Scene scene = scene_of(ball_with(q), {start}, ground_with_friction(mu));
      for (const double rate : kRates) {
        const BodyState end = after(scene, rate);
        const Vector3 t = direction(heading);
        const Vector3 exact = (1 - lost) * t;
        EXPECT_LT((end.velocity - exact).norm(), tolerance() * lost) << heading << "°, " << rate;
        // q m R dω/dt = μ m g: spins up about k̂×t.
        const Vector3 spin = lost / (q * kRadius) * Vector3(-t.y(), t.x(), 0);
        EXPECT_LT((end.angular_velocity - spin).norm(), tolerance() * spin.norm()) << rate;
      }
    }
  }
}

TEST_P(BulletMaps, RollingFrictionBrakesWithMuRG) {
  const double mu_r = 0.01, lost = mu_r * kGravity * kTime;
  SubstrateContact ground = ground_with_friction(0.3);
  ground.rolling = RollingFriction(mu_r);
  for (const double q : {2.0 / 5, 2.0 / 3}) {
    for (const double heading : kHeadings) {
      const Scene scene = scene_of(ball_with(q), {rolling_towards(kRadius, 0.3, heading)}, ground);
      for (const double rate : kRates) {
        const BodyState end = after(scene, rate);
        const Vector3 exact = (0.3 - lost) * direction(heading);
        EXPECT_LT((end.velocity - exact).norm(), tolerance() * lost)
            << "q = " << q << ", " << heading << "°, " << rate << " Hz";
        EXPECT_LT(slip_velocity(end, kRadius).norm(), tolerance() * lost);
      }
    }
  }
}

TEST_P(BulletMaps, SpinningFrictionBrakesTheSpinAlone) {
  // I dω_z/dt = −L m g, also of a ball that rolls, which goes on as if it did not spin.
  SubstrateContact ground = ground_with_friction(0.3);
  ground.rolling = RollingFriction(0.01);
  ground.drilling_length = 0.01 * kRadius;
  for (const double q : {2.0 / 5, 2.0 / 3}) {
    const double lost = 0.01 * kGravity * kTime / (q * kRadius);  // of ω_z [rad/s]
    for (const double heading : kHeadings) {
      for (const double speed : {0.0, 0.3}) {
        BodyState start = rolling_towards(kRadius, speed, heading);
        start.angular_velocity.z() = 100;
        const Scene scene = scene_of(ball_with(q), {start}, ground);
        for (const double rate : kRates) {
          const BodyState end = after(scene, rate);
          EXPECT_NEAR(end.angular_velocity.z(), 100 - lost, tolerance() * lost)
              << "q = " << q << ", " << heading << "°, " << rate << " Hz";
          const double left = speed > 0 ? speed - 0.01 * kGravity * kTime : 0;
          EXPECT_NEAR(end.velocity.norm(), left, tolerance() * 0.01 * kGravity * kTime) << rate;
        }
      }
    }
  }
}

TEST_P(BulletMaps, TwoBallsPartWithTheirRestitution) {
  // Head-on in the air: a step looks at the approach alone, and with erp2 = 0 at no overlap.
  for (const double e : {0.0, 0.5, 0.9, 1.0}) {
    PairContact pair;
    pair.restitution = e;
    for (const double heading : kHeadings) {
      const Vector3 n = direction(heading);
      for (const double rate : kRates) {
        for (const double phase : {0.1, 0.6}) {
          const double speed = 0.05 * kRadius * rate;  // together [m/s]
          BodyState left, right;
          right.position = (kRadius + (2 + phase) * 0.5 * speed / rate) * n;
          left.position = -right.position;
          left.velocity = 0.5 * speed * n;
          right.velocity = -left.velocity;
          left.position.z() = right.position.z() = 1;
          const Scene scene = scene_of(ball_with(0.4), {left, right}, {}, pair);
          const auto frames = run(engine_, scene, settings_of(GetParam()), rate, 8);
          const auto& end = frames.back().bodies;
          const Vector3 parting = end[1].velocity - end[0].velocity;
          EXPECT_LT((parting - e * speed * n).norm(), bounce_tolerance() * speed)
              << "e = " << e << ", " << heading << "°, " << rate << " Hz, phase " << phase;
        }
      }
    }
  }
}

TEST_P(BulletMaps, ABallComesBackFromTheGroundWithItsRestitution) {
  // Of the velocity before the step's gravity, both kinds of body.
  SubstrateContact ground;
  for (const char* body : {"rigid", "multibody"}) {
    const Settings settings = with(settings_of(GetParam()), {{"body", body}});
    for (const double e : {0.3, 0.8, 1.0}) {
      ground.restitution = e;
      for (const double rate : kRates) {
        BodyState start;
        start.position.z() = kRadius * 1.3;
        start.velocity.z() = -0.1 * kRadius * rate;
        const Scene scene = scene_of(ball_with(0.4), {start}, ground);
        const auto frames = run(engine_, scene, settings, rate, 8);
        const auto hit =
            std::ranges::find_if(frames, [](const Frame& frame) { return !frame.touches.empty(); });
        ASSERT_NE(hit, frames.end());
        ASSERT_NE(hit, frames.begin());
        const double down = -(hit - 1)->bodies[0].velocity.z();
        EXPECT_NEAR(hit->bodies[0].velocity.z() / down, e, bounce_tolerance())
            << body << ", " << rate << " Hz, e = " << e;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    ProfilesAndUnits, BulletMaps,
    // CGS numbers of a steel ball of 2 mm: 0.2 cm, 0.263 g, 981 cm/s².
    ::testing::Values(Case{"TunedSi", "double", "tuned", kTuned, 0, 0, 0},
                      Case{"TunedCgs", "double", "tuned", kTuned, 0.2, 0.263, 981},
                      Case{"TunedScaled", "double", "tuned", kTuned, 1, 1, 1},
                      Case{"SingleCgs", "single", "physical", kRoundOffSingle, 0.2, 0.263, 981},
                      Case{"SingleScaled", "single", "physical", kRoundOffSingle, 1, 1, 1},
                      Case{"PhysicalSi", "double", "physical", kRoundOff, 0, 0, 0},
                      Case{"PhysicalCgs", "double", "physical", kRoundOff, 0.2, 0.263, 981},
                      Case{"PhysicalScaled", "double", "physical", kRoundOff, 1, 1, 1}),
    [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace slipcheck
