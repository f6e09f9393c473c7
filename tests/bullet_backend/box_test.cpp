// Single balls in a box. Without gravity Bullet's contact row says exactly what comes out, see
// collision_test.cpp: a ball that had a fraction φ of a step to go comes back with
//     e_n = e + 0.2 (1 - φ)
// of its speed relative to the surface, if that is above 0.2 m/s. Where it is nearer than the
// contact breaking threshold, φ v dt < 0.02 sqrt(3) R, Bullet takes it for a contact at once whose
// gap is left to be closed in the step:
//     e_n = e - φ.
// The rows of contact and friction are solved one after the other, exactly after two of ten
// iterations for a ball that touches one surface: tolerances without a word are round-off.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bullet_box.h"

namespace slipcheck {
namespace {

constexpr double kBoxRadius = 0.01;                            // [m]
constexpr double kRate = 1000;                                 // [Hz]
constexpr double kRoundOff = 1e-9;                             // relative to 1 m/s
const double kThreshold = 0.02 * std::sqrt(3.0) * kBoxRadius;  // [m]

/// e_n - e of a ball that flies at a still surface with 1 m/s.
double lottery(double phase) { return phase / kRate < kThreshold ? -phase : 0.2 * (1 - phase); }

/// A surface, and the ball that flies at it with 1 m/s along its normal.
struct Target {
  const char* name;
  std::vector<PairContact> Box::*contacts;
  Vector3 normal;   ///< into the box
  double distance;  ///< of the surface from the origin along the normal [m]
};

const Target kTargets[] = {{"floor", &Box::on_floor, {0, 0, 1}, 0},
                           {"left wall", &Box::on_wall, {1, 0, 0}, 0},
                           {"right wall", &Box::on_wall, {-1, 0, 0}, -0.2},
                           {"lid", &Box::on_lid, {0, 0, -1}, -0.3}};

/// t = (n_z, -n_x) of the plane's normal n.
Vector3 tangent(const Vector3& normal) { return {normal.z(), 0, -normal.x()}; }

/// Three and `phase` steps away from the target, in the middle of it.
BodyState towards(const Target& target, double phase) {
  BodyState state = in_plane(0.1, 0.15, 0, 0);
  const double gap = (3 + phase) / kRate;
  const Vector3 n = target.normal;
  state.position += (target.distance + kBoxRadius + gap - state.position.dot(n)) * n;
  state.velocity = -n;
  return state;
}

Scene scene_towards(const Target& target, const BodyState& state, const PairContact& contact) {
  Scene scene = box_of(steel_ball(kBoxRadius), {state});
  scene.box->lid = 0.3;
  (scene.box.value().*target.contacts)[0] = contact;
  return scene;
}

class BulletBox : public ::testing::TestWithParam<const char*> {
 protected:
  RemoteEngine engine_{bullet_executable("double")};
  BodyState after(const Scene& scene, double rate = kRate, std::size_t steps = 8) {
    return run(engine_, scene, shipped(GetParam()), rate, steps).back().bodies[0];
  }
  bool is_default() const { return GetParam() == std::string("default"); }
  double applied(double coefficient) const {  // Bullet's product of two equal bodies' coefficients
    return is_default() ? coefficient : coefficient * coefficient;
  }
};

TEST_P(BulletBox, EverySurfaceHasItsRestitution) {
  for (const Target& target : kTargets) {
    for (const double e : {1.0, 0.8, 0.6}) {
      for (const double phase : {0.01, 0.3, 0.4, 0.99}) {
        Scene scene = scene_towards(target, towards(target, phase), {e, 0, -1});
        // Alone in a box the naive ball has the coefficients of its contact with the floor.
        if (!is_default()) scene.box->on_floor[0].restitution = e;
        const BodyState out = after(scene);
        EXPECT_NEAR(out.velocity.dot(target.normal), applied(e) + lottery(phase), kRoundOff)
            << target.name << ", e = " << e << ", phase " << phase;
        EXPECT_EQ(out.angular_velocity, Vector3(0, 0, 0));
      }
    }
  }
}

TEST_P(BulletBox, EverySurfaceHasItsFriction) {
  const double e = 0.8, phase = 0.4, mu = 0.3;
  for (const Target& target : kTargets) {
    BodyState in = towards(target, phase);
    const Vector3 t = tangent(target.normal);
    in.velocity += 4 * t;  // slides to the end: (7/2) μ (1 + e_n) v < 4 m/s
    Scene scene = scene_towards(target, in, {e, mu, 0});
    if (!is_default()) scene.box->on_floor[0] = {e, mu, 0};
    const double normal = applied(e) + lottery(phase);
    const double change = -applied(mu) * (1 + normal);  // of v_t [m/s]
    const BodyState out = after(scene);
    EXPECT_NEAR(out.velocity.dot(target.normal), normal, kRoundOff) << target.name;
    EXPECT_NEAR(out.velocity.dot(t), 4 + change, kRoundOff) << target.name;
    // R I dw = -R² P_t: with I = (2/5) m R².
    EXPECT_NEAR(out.angular_velocity.y() * kBoxRadius, -2.5 * change, kRoundOff) << target.name;
    EXPECT_EQ(out.position.y(), 0);
    EXPECT_EQ(out.velocity.y(), 0);
  }
}

TEST_P(BulletBox, StickingStopsTheSlipWhateverTheShape) {
  for (const double q : {0.4, 0.5, 2.0 / 3, 1.0}) {
    const Target& floor = kTargets[0];
    BodyState in = towards(floor, 0.4);
    in.velocity.x() = 0.5;
    Scene scene = scene_towards(floor, in, {0.8, 2.0, 0});
    scene.bodies[0].shape_factor = q;
    const BodyState out = after(scene);
    // u_t' = 0, m dv = P and q m R dw = -P give v_t' = v_t/(1 + q).
    EXPECT_NEAR(out.velocity.x(), 0.5 / (1 + q), kRoundOff) << q;
    EXPECT_NEAR(out.velocity.x(), kBoxRadius * out.angular_velocity.y(), kRoundOff) << q;
  }
}

/// The floor's place before the step that begins at t, and the velocity that Bullet makes of it.
double floor_velocity(const ShakenFloor& floor, double t, double rate) {
  return (floor.height(t) - floor.height(t - 1 / rate)) * rate;
}

TEST_P(BulletBox, AMovingFloorPassesItsVelocityOn) {
  const double e = 0.9, start = 0.037;
  for (const double height : {0.011, 0.0125, 0.014, 0.0155}) {
    Scene scene = box_of(steel_ball(kBoxRadius), {in_plane(0.1, height, 0, -0.5)});
    scene.box->floor = {0.002, 25};  // V = 0.31 m/s
    scene.box->on_floor[0].restitution = e;
    engine_.configure(scene, shipped(GetParam()), 1 / kRate);
    engine_.start(scene.initial, start);
    double t = start;
    BodyState before = scene.initial[0];
    bool touched = false;
    engine_.advance(20, [&](const Frame& frame) {
      if (!touched && !frame.touches.empty()) {
        touched = true;
        EXPECT_EQ(frame.touches[0].second, kSubstrate);
        const ShakenFloor& floor = scene.box->floor;
        const double v_f = floor_velocity(floor, t, kRate);
        const double overlap = floor.height(t) + kBoxRadius - before.position.z();
        const double v = before.velocity.z();
        const double out = frame.bodies[0].velocity.z();
        // A gap is left to be closed in the step; an overlap is pushed apart by a fifth.
        const double extra = (overlap > 0 ? 0.2 : 1.0) * overlap * kRate;
        EXPECT_NEAR(out, v_f + applied(e) * (v_f - v) + extra, kRoundOff) << height;
        // Seen from the real floor: half a step of its acceleration, ω V dt/2 = 0.025 m/s, and the
        // lottery. A gap is at most the contact breaking threshold, 0.02 sqrt(3) R.
        const double real = floor.velocity(t);
        const double least = applied(e) - kThreshold * kRate / (real - v);
        EXPECT_GT((out - real) / (real - v), least - 0.1) << height;
        EXPECT_LT((out - real) / (real - v), applied(e) + 0.2 + 0.1) << height;
      }
      before = frame.bodies[0];
      t += 1 / kRate;
    });
    EXPECT_TRUE(touched) << height;
  }
}

TEST_P(BulletBox, WallsRubUpAndDownOnlyWhereTheyMove) {
  const Target& wall = kTargets[1];
  for (const bool moving : {false, true}) {
    Scene scene = scene_towards(wall, towards(wall, 0.4), {0.8, 2.0, 0});
    if (!is_default()) scene.box->on_floor[0] = {0.8, 2.0, 0};
    scene.box->floor = {0.002, 25};
    scene.box->moving_walls = moving;
    // The touch is in the fifth step, which begins at 4 dt. Slip stops: 2/7 of the wall's velocity.
    const double v_f = moving ? floor_velocity(scene.box->floor, 4 / kRate, kRate) : 0;
    const BodyState out = after(scene);
    EXPECT_NEAR(out.velocity.z(), 2.0 / 7 * v_f, kRoundOff) << moving;
    EXPECT_NEAR(out.velocity.x(), applied(0.8) + lottery(0.4), kRoundOff) << moving;
  }
}

TEST_P(BulletBox, AMovingLidStrikesDown) {
  Scene scene = box_of(steel_ball(kBoxRadius), {in_plane(0.1, 0.28, 0, 0)});
  scene.box->lid = 0.295;
  scene.box->floor = {0.01, 5};  // V = 0.31 m/s; the lid comes down to 0.285
  scene.box->moving_walls = true;
  const BodyState out = after(scene, kRate, 150);
  EXPECT_LT(out.velocity.z(), -0.2);
  scene.box->moving_walls = false;
  EXPECT_EQ(after(scene, kRate, 150).velocity, Vector3(0, 0, 0));
}

TEST_P(BulletBox, BallsMeetAsTheyDoOnASubstrate) {
  // Two spheres make a contact only once they overlap, so that the rule of collision_test.cpp holds
  // in every phase; the narrower margins of the broadphase (margins.h) hide nothing.
  const double radius = 0.0005, e = 0.9;
  for (const double rate : {1000.0, 10000.0}) {
    for (const double phase : {0.01, 0.17, 0.5, 0.99}) {
      const double x = radius + (3 + phase) / rate / 2;
      Scene scene = box_of(steel_ball(radius),
                           {in_plane(0.1 - x, 0.1, 0.5, 0), in_plane(0.1 + x, 0.1, -0.5, 0)});
      scene.pairs[0].restitution = e;
      const Frame last = run(engine_, scene, shipped(GetParam()), rate, 8).back();
      const double out = last.bodies[1].velocity.x() - last.bodies[0].velocity.x();
      EXPECT_NEAR(out, applied(e) + 0.2 * (1 - phase), kRoundOff) << rate << " Hz, " << phase;
    }
  }
}

TEST_P(BulletBox, ABallBouncesUnderGravity) {
  // The first bounce in 1.2 s on a still floor from 0.1 m, over phases of the step. Falls to v =
  // 1.4 m/s; in one step it falls g dt = 0.04 m/s faster, 3 % of v, which the rule does not know
  // of: it takes v before the step's gravity, and the frame has the velocity after it.
  for (const double e : {1.0, 0.8}) {
    for (int k = 0; k < 8; ++k) {
      const double height = 0.1 + 0.0007 * k, rate = 240;
      Scene scene = box_of(steel_ball(kBoxRadius), {in_plane(0.1, kBoxRadius + height, 0, 0)});
      scene.gravity = kGravity;
      scene.box->on_floor[0].restitution = e;
      const auto frames = run(engine_, scene, shipped(GetParam()), rate, 60);
      const auto hit =
          std::ranges::find_if(frames, [](const Frame& frame) { return !frame.touches.empty(); });
      ASSERT_NE(hit, frames.end());
      const double ratio = hit->bodies[0].velocity.z() / std::sqrt(2 * kGravity * height);
      const double gap = kThreshold * rate / 1.4;
      EXPECT_GT(ratio, applied(e) - gap - 0.03) << "e = " << e << ", height " << height;
      EXPECT_LT(ratio, applied(e) + 0.2 + 0.03) << "e = " << e << ", height " << height;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, BulletBox, ::testing::Values("default", "naive"),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace slipcheck
