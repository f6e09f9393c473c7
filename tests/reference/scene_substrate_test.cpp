#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "bundled_scenes.h"
#include "physics/closed_forms.h"

// What the bundled scenes of slopes, belts, shakers and single balls were made for. g = 9.81 m/s²
// and A = 5/2; the tolerance of what is integrated is 1e-9 of the scene's speed unless another
// error is named.

namespace slipcheck {
namespace {

using test::bundled;
using test::play;
using test::Played;
using test::until;

constexpr double kG = 9.81, kA = 2.5;
double degrees(double angle) { return angle * M_PI / 180; }

// --- shaken substrates and belts -----------------------------------------------------------------

TEST(Scene, ShakerK15TwoSeventhsOfTheSubstratesVelocity) {
  const double peak = 0.0169 * 2 * M_PI * 5;  // of v_S = −peak sin ωt, phase 90°
  for (double t : {0.03, 0.11, 0.27, 1.0}) {
    const Played scene = play(until(bundled("shaker-sticks"), t));
    EXPECT_NEAR(scene["ball.final_velocity.x"], -2.0 / 7 * peak * std::sin(10 * M_PI * t),
                1e-9 * peak);
    EXPECT_EQ(scene["ball.sliding_time"], 0);
  }
}

/// A ball on x_S = a sin ωt, μ_s = 0.5 and μ_k = 0.1, that starts at rest without slip: stretches
/// of sticking (v + A-fold spin follow v_S) and of sliding (v̇ = ∓μ_k g) joined by bisection.
class ShakenBall {
 public:
  double velocity(double t) {
    while (begin_ + stretch() < t) next();
    return here(t).v;
  }

 private:
  static constexpr double kOmega = 10 * M_PI, kPeak = 0.02 * kOmega, kMuK = 0.1;
  static constexpr double kLimit = (1 + kA) * 0.5 * kG;
  struct State {
    double v, s;  // centre, surface R k̂×Ω
  };
  static double ground(double t) { return kPeak * std::cos(kOmega * t); }
  static double push(double t) { return -kOmega * kPeak * std::sin(kOmega * t); }

  State here(double t) const {
    if (side_ == 0) {
      const double gained = (ground(t) - ground(begin_)) / (1 + kA);
      return {at_.v + gained, at_.s + kA * gained};
    }
    const double gained = -side_ * kMuK * kG * (t - begin_);
    return {at_.v + gained, at_.s + kA * gained};
  }
  /// Falls through zero where the stretch ends.
  double left(double t) const {
    if (side_ == 0) return kLimit - std::abs(push(t));
    return side_ * (here(t).v + here(t).s - ground(t));
  }
  double stretch() const {
    double step = 1e-4;
    while (left(begin_ + step) > 0 && step < 10) step += 1e-4;
    double low = step - 1e-4, high = step;
    for (int n = 0; n < 60; ++n) {
      const double middle = 0.5 * (low + high);
      (left(begin_ + middle) > 0 ? low : high) = middle;
    }
    return high;
  }
  void next() {
    const double t = begin_ + stretch();
    at_ = here(t);
    begin_ = t;
    // What the substrate accelerates away from slips backwards.
    side_ = side_ == 0 || std::abs(push(t)) > kLimit ? (push(t) > 0 ? -1 : 1) : 0;
  }

  double begin_ = 0;
  State at_{0, kPeak};
  double side_ = 0;  // sign of the slip, 0 where it sticks
};

TEST(Scene, ShakerAcrossTheStickLimitK17) {
  ShakenBall ball;
  for (double t : {0.02, 0.05, 0.09, 0.2, 0.4, 0.7, 1.0}) {
    const double v = play(until(bundled("shaker-slips"), t))["ball.final_velocity.x"];
    EXPECT_NEAR(v, ball.velocity(t), 2e-9) << t;
  }
  // In every half period one slide: ten in one second, of which the last has ended.
  EXPECT_GE(play("shaker-slips").run.events, 10u);
}

TEST(Scene, ShakerLeavesASmoothBallWhereItIs) {
  // v_S is at its peak and a_S at zero when it starts: nothing may hold the ball without friction.
  Scenario scenario = until(bundled("shaker-slips"), 0.3);
  scenario.substrate_contacts[0].friction = {0, 0};
  EXPECT_EQ(play(scenario)["ball.final_velocity"], 0);
}

TEST(Scene, BeltStartsAndStops) {
  // Each jump of the belt by V changes v by V/(1+A) and takes |V|/((1+A) μ_k g). In between and
  // while it slides the mean velocity makes up the way V/(1+A) · 1 s.
  const Played scene = play("belt-starts");
  EXPECT_NEAR(scene["ball.final_velocity"], 0, 1e-10);
  EXPECT_NEAR(scene["ball.final_position.x"], 0.2 / 3.5, 1e-10);
  EXPECT_NEAR(scene["ball.sliding_time"], 2 * 0.2 / (3.5 * 0.1 * kG), 1e-10);
}

TEST(Scene, BeltCarriesABallToItsSpeedK16) {
  // V/(1+A) after the slide, the rest at μ_r g.
  const Played scene = play("belt-carries");
  const double slide = 0.2 / (3.5 * 0.1 * kG);
  EXPECT_NEAR(scene["ball.rolling_velocity.x"], 0.2 / 3.5, 1e-10);
  EXPECT_NEAR(scene["ball.stopping_time"], slide + 0.2 * 2.5 / 3.5 / (0.02 * kG), 1e-9);
  EXPECT_NEAR(scene["ball.final_velocity.x"], 0.2, 1e-10);
}

TEST(Scene, BouncesOnABeltEndAtTwoSeventhsToo) {
  const Played scene = play("bounce-on-belt");
  EXPECT_NEAR(scene["ball.final_velocity.x"], 0.5 / 3.5, 1e-9);
  EXPECT_NEAR(scene["ball-substrate.restitution"], 0.6, 1e-9);
}

TEST(Scene, AThrownBallRollsWithFiveSeventhsWhateverItsBounces) {
  // Every impulse acts at the point of contact: v + (2/5) R Ω_y stays, and v = R Ω_y in the end.
  for (const double restitution : {0.0, 0.5, 0.9})
    for (const double friction : {0.05, 0.2, 0.8}) {
      Scenario scenario = bundled("bounce-slide-roll");
      scenario.substrate_contacts[0].restitution = restitution;
      scenario.substrate_contacts[0].friction = {friction, friction};
      scenario.run.limit = 60;
      const Played scene = play(scenario);
      EXPECT_NEAR(scene["ball.final_velocity.x"], 10.0 / 7, 1e-9) << restitution << " " << friction;
      EXPECT_NEAR(scene["ball.final_angular_velocity.y"], 10.0 / 7 / 0.05, 1e-8);
    }
}

TEST(Scene, BallsFromAllHeightsReboundWithTheirRestitution) {
  // They land at √(2 g h) after 14 ms and rise for the 16 ms that are left.
  const double g = 9.80665, rise = 0.03 - 0.014;
  const Played scene = play("restitution-over-height");
  for (const auto& [ball, h] :
       {std::pair{"mm", 1e-3}, {"cm", 1e-2}, {"dm", 0.1}, {"m", 1.0}, {"dam", 10.0}}) {
    const double v = std::sqrt(2 * g * h);
    EXPECT_NEAR(scene[ball + std::string("-substrate.restitution")], 0.8, 1e-12) << ball;
    EXPECT_NEAR(scene[ball + std::string(".final_velocity.z")], 0.8 * v - g * rise, 1e-12 * 14);
    EXPECT_NEAR(scene[ball + std::string(".final_position.z")],
                0.01 + 0.8 * v * rise - g * rise * rise / 2, 1e-12);
  }
}

TEST(Scene, AllHeadingsRollEquallyFarK16) {
  const double deceleration = 0.02 * 9.80665, way = 0.25 / (2 * deceleration);
  const Played scene = play("heading-ring");
  for (int k = 0; k < 8; ++k) {
    const std::string ball = "h" + std::to_string(45 * k);
    EXPECT_NEAR(scene[ball + ".stopping_time"], 0.5 / deceleration, 1e-12) << ball;
    EXPECT_NEAR(scene[ball + ".stopping_distance"], way, 1e-12) << ball;
    EXPECT_NEAR(scene[ball + ".final_position.x"], (0.5 + way) * std::cos(k * M_PI / 4), 1e-12);
    EXPECT_NEAR(scene[ball + ".final_position.y"], (0.5 + way) * std::sin(k * M_PI / 4), 1e-12);
  }
}

// --- slopes --------------------------------------------------------------------------------------

TEST(Scene, SlopeK24FiveSevenths) {
  const Played scene = play("slope-rolls");
  EXPECT_NEAR(scene["ball.final_velocity.y"], -5.0 / 7 * kG * std::sin(degrees(5)), 1e-10);
  EXPECT_EQ(scene["ball.sliding_time"], 0);
}

TEST(Scene, SlopeK25LimitIsOfTheNormalForceOfTheSlope) {
  const double sin = std::sin(degrees(45));
  EXPECT_NEAR(play("slope-slips")["ball.final_velocity.y"], -kG * sin * (1 - 0.1) * 0.5, 1e-9);
  // It holds up to tan θ = (1+A) μ_s = 0.7, 34.99°: with m g for the normal force it would be up to
  // sin θ = 0.7, 44.4°.
  Scenario slope = bundled("slope-slips");
  for (const auto& [angle, slides] : {std::pair{34.9, false}, {35.1, true}}) {
    std::get<Substrate>(slope.surroundings).tilt = degrees(angle);
    slope.gravity = {0, -kG * std::sin(degrees(angle)), -kG * std::cos(degrees(angle))};
    const double factor = slides ? 1 - 0.1 / std::tan(degrees(angle)) : 5.0 / 7;
    EXPECT_NEAR(play(slope)["ball.final_velocity.y"], -kG * std::sin(degrees(angle)) * factor * 0.5,
                1e-9);
  }
}

TEST(Scene, SlopeAcrossKeepsWhatFrictionCannotChange) {
  // A v − R k̂×Ω gains A a_G t whatever the friction: once it rolls, (1+A) v = A v_0 + A a_G t.
  const Played scene = play("slope-slides-across");
  const double down = -kG * std::sin(degrees(10));
  EXPECT_NEAR(scene["ball.final_velocity.x"], kA * 0.3 / (1 + kA), 1e-9);
  EXPECT_NEAR(scene["ball.final_velocity.y"], kA * down * 0.5 / (1 + kA), 1e-9);
  EXPECT_NEAR(scene["ball.rolling_velocity.y"], kA * down * scene["ball.sliding_time"] / (1 + kA),
              1e-9);
}

TEST(Scene, SlopeUpAndBackK16) {
  const double gravity = 5.0 / 7 * kG * std::sin(degrees(5));
  const double friction = 0.03 * kG * std::cos(degrees(5));
  const double up = 0.3 / (gravity + friction);
  EXPECT_NEAR(play("slope-up-and-back")["ball.final_velocity.y"],
              -(gravity - friction) * (1.5 - up), 1e-9);
}

TEST(Scene, SlopeHoldsK16) {
  const double a = 5.0 / 7 * kG * std::sin(degrees(3)) + 0.1 * kG * std::cos(degrees(3));
  const Played scene = play("slope-holds");
  EXPECT_NEAR(scene["ball.stopping_distance"], 0.01 / (2 * a), 1e-10);
  EXPECT_NEAR(scene["ball.stopping_time"], 0.1 / a, 1e-10);
}

TEST(Scene, ShakenSlopeK24) {
  // v_S = −peak sin ωt along x; gravity along y.
  const double t = 0.37, peak = 0.001 * 10 * M_PI;
  const Played scene = play(until(bundled("slope-shaken"), t));
  EXPECT_NEAR(scene["ball.final_velocity.x"], -2.0 / 7 * peak * std::sin(10 * M_PI * t), 1e-10);
  EXPECT_NEAR(scene["ball.final_velocity.y"], -5.0 / 7 * kG * std::sin(degrees(5)) * t, 1e-10);
}

TEST(Scene, CollisionsOnSlopesAndShakersPartAsOnALevelPlane) {
  // Both bodies are accelerated alike. With A v − R k̂×Ω of each, which the substrate changes alike,
  // (1+A) (v_i − v_j) = −(A e_n − 1) v_rel; μ_s g t_col/v_rel is left out.
  const double left = 0.5 * kG * 2.55e-5 / 0.3;
  for (const char* name : {"collision-on-slope", "collision-on-shaker"}) {
    const Played scene = play(name);
    const double apart = scene["j.final_velocity.x"] - scene["i.final_velocity.x"];
    EXPECT_NEAR(apart / 0.3, (2.5 * 0.9 - 1) / 3.5, left) << name;
    const double sum = scene["i.final_velocity.y"] + scene["j.final_velocity.y"];
    const double slope = name == std::string("collision-on-slope") ? degrees(5) : 0;
    EXPECT_NEAR(sum, -2 * 5.0 / 7 * kG * std::sin(slope) * 0.5, 1e-8) << name;
  }
}

// --- rolling and drilling friction ---------------------------------------------------------------

/// Time in which v̇ = −μ_r(v) g, μ_r = c + s v, takes v to zero: ln(1 + s v/c)/(s g).
double stops_in(double v, double c, double s) { return std::log1p(s * v / c) / (s * kG); }

TEST(Scene, TwoKindsOfSpheresStopByTheirOwnTables) {
  // Both roll slower than the second point of their tables, 10 and 5 cm/s, once they roll.
  const Played scene = play("rolling-two-kinds");
  const double v = scene["s.rolling_velocity"], w = scene["r.rolling_velocity"];
  ASSERT_LT(v, 0.1);
  ASSERT_LT(w, 0.05);
  EXPECT_NEAR(scene["s.stopping_time"] - scene["s.sliding_time"], stops_in(v, 0.002, 0.02), 1e-8);
  EXPECT_NEAR(scene["r.stopping_time"] - scene["r.sliding_time"], stops_in(w, 0.03, -0.2), 1e-8);
}

TEST(Scene, RollingFrictionWhileSliding) {
  // The couple (1+q) μ_r N R takes (1+q) A μ_r = (1+A) μ_r from (1+A) μ_k.
  const double time = 0.3 / (3.5 * (0.1 - 0.02) * kG), v = 0.3 - 0.1 * kG * time;
  const Played scene = play("rolling-while-sliding");
  EXPECT_NEAR(scene["ball.sliding_time"], time, 1e-9);
  EXPECT_NEAR(scene["ball.rolling_velocity"], v, 1e-9);
  EXPECT_NEAR(scene["ball.stopping_time"], time + v / (0.02 * kG), 1e-8);
}

TEST(Scene, RubberSlidesLongerWhileItSpins) {
  const Played scene = play("rubber-slides-spinning");
  EXPECT_GT(scene["ball.sliding_time"], 1.1 * 0.3 / (3.5 * 0.8 * kG));
  EXPECT_NEAR(scene["ball.rolling_velocity"], 5.0 / 7 * 0.3, 2e-6 * 0.3);  // what counts as slip
}

}  // namespace
}  // namespace slipcheck
