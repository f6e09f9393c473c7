#include "reference/steps/grain_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "reference/steps/grain_drive.h"
#include "scene/scene.h"

namespace slipcheck {
namespace {

constexpr double kStep = 1e-4, kGravity = 9.81, kRadius = 0.5, kStatic = 0.6, kKinetic = 0.5;

/// A solid sphere of mass 1.
GrainKind sphere(double kinetic_friction) {
  GrainKind kind;
  kind.inverse_mass = 1;
  kind.inverse_inertia = 1 / (0.4 * kRadius * kRadius);
  kind.weight = kGravity;
  kind.share = 2.0 / 7;
  kind.turn = 2.5 / kRadius;
  kind.static_friction = kStatic;
  kind.kinetic_friction = kinetic_friction;
  kind.radius = kRadius;
  return kind;
}

/// One grain, as StepBody moves it on a plane that accelerates: d is the last change.
struct Grain {
  Vector2 position, v, spin, d_v, d_spin;  // spin: R Ω turned into the slip, u = v + spin − V
  bool sticks;
  double kinetic = kKinetic;

  void step(const Vector2& push, const Vector2& before, const Vector2& after) {
    const double share = 2.0 / 7, load = kGravity * kStep;
    const Vector2 left = v + kStep * push + spin - after;
    const Vector2 expected = v + spin + 0.5 * (d_v + d_spin) - 0.5 * (before + after);
    const double cap = (sticks ? kStatic : kinetic) * load;
    sticks = share * left.norm() <= cap;
    const bool follows = expected.dot(left) > 0 && share * expected.norm() > kinetic * load;
    const Vector2 along = follows ? expected : left;
    const Vector2 lost =
        sticks ? Vector2(share * left) : Vector2(kinetic * load / along.norm() * along);
    d_v = kStep * push - lost;
    d_spin = -2.5 * lost;
    if (sticks) d_spin = after - (v + d_v) - spin;
    v += d_v;
    spin += d_spin;
    position += kStep * v;
  }
};

/// Sliding, some turned by an impact in the step before, nearly at rest, soon so, and rolling.
std::vector<Grain> grains(const Vector2& plane) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> sized(-1, 1);
  const auto vector = [&](double size) {
    return Vector2(size * sized(random), size * sized(random));
  };
  std::vector<Grain> all;
  for (int n = 0; n < 500; ++n) {
    Grain grain{vector(10), vector(1), vector(1), vector(1e-3), vector(1e-3), n % 5 == 0};
    if (n % 7 == 0) grain.d_v = -3 * (grain.v + grain.spin - plane);
    if (n % 7 == 1) grain.d_v = 0.4 * (grain.v + grain.spin - plane);
    if (n % 5 == 0) grain.spin = plane - grain.v;
    if (n % 5 == 1) grain.spin = plane - grain.v + vector(0.03);
    // What friction takes in 110 to 130 steps: the fourth of these blocks leaves some twenty.
    const Vector2 direction = vector(1).normalized();
    if (n % 5 == 2) grain.spin = plane - grain.v + (0.205 + 0.015 * sized(random)) * direction;
    all.push_back(grain);
  }
  return all;
}

/// Of so many kinds, by turns.
void put(const std::vector<Grain>& from, std::size_t kinds, GrainArrays& to) {
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Grain& grain = from[i];
    to.x[i] = grain.position.x(), to.y[i] = grain.position.y();
    to.vx[i] = grain.v.x(), to.vy[i] = grain.v.y();
    to.wx[i] = grain.spin.y() / kRadius, to.wy[i] = -grain.spin.x() / kRadius;
    to.dvx[i] = grain.d_v.x(), to.dvy[i] = grain.d_v.y();
    to.dwx[i] = grain.d_spin.y() / kRadius, to.dwy[i] = -grain.d_spin.x() / kRadius;
    to.sticks[i] = grain.sticks ? 1 : 0;
    to.kind[i] = static_cast<std::uint32_t>(i % kinds);
  }
}

/// A plane, tilted too, and its kinetic friction for each kind of grains on it.
struct Carrying {
  std::string name;
  SubstrateMotion motion;
  std::vector<double> friction = {kKinetic};
};

void PrintTo(const Carrying& plane, std::ostream* out) { *out << plane.name; }

class GrainsAloneOn : public ::testing::TestWithParam<Carrying> {};

/// Each is alone: what is done in one go, in each step without a look at what cannot be, and in
/// each step as it comes.
TEST_P(GrainsAloneOn, ADrivenPlaneGlideStepByStep) {
  Scene scene;
  scene.bodies = {Sphere{kRadius, 1, 0.4}};
  scene.downhill = {0.7, -0.2};
  scene.motion = GetParam().motion;
  GrainFeatures features;
  features.rubs = features.on_plane = features.driven = true;
  std::vector<GrainKind> kinds;
  for (const double friction : GetParam().friction) kinds.push_back(sphere(friction));
  const GrainKernels kernels(features, {}, kinds, {});
  const GrainDrive drive(scene, {}, kStep);
  std::vector<Grain> expected = grains(drive.velocity_of(0));
  for (std::size_t i = 0; i < expected.size(); ++i)
    expected[i].kinetic = kinds[i % kinds.size()].kinetic_friction;
  GrainArrays arrays;
  put(expected, kinds.size(), arrays);
  GrainDriving driving;
  std::size_t n = 0;
  for (const std::size_t count : {25, 1, 2, 64, 64}) {
    drive.find(n, count, kinds, driving);
    kernels.glide(arrays, 0, expected.size(), {kStep, kStep, count, true, true, &driving});
    n += count;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      SCOPED_TRACE(i);
      Grain& grain = expected[i];
      for (const GrainPush& push : driving.steps)
        grain.step({push.slope_x, push.slope_y}, {push.before_x, push.before_y},
                   {push.plane_x, push.plane_y});
      // Rounding of some hundred steps.
      ASSERT_NEAR(arrays.x[i], grain.position.x(), 1e-13);
      ASSERT_NEAR(arrays.y[i], grain.position.y(), 1e-13);
      ASSERT_NEAR(arrays.vx[i], grain.v.x(), 1e-13);
      ASSERT_NEAR(arrays.vy[i], grain.v.y(), 1e-13);
      ASSERT_NEAR(arrays.wy[i] * kRadius, -grain.spin.x(), 1e-13);
      ASSERT_NEAR(arrays.wx[i] * kRadius, grain.spin.y(), 1e-13);
      ASSERT_NEAR(arrays.dvx[i], grain.d_v.x(), 1e-13);
      ASSERT_NEAR(arrays.dwx[i] * kRadius, grain.d_spin.y(), 1e-13);
      ASSERT_EQ(arrays.sticks[i] > 0, grain.sticks);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, GrainsAloneOn,
    ::testing::Values(Carrying{"slope", {}},
                      Carrying{"shaken", SubstrateMotion::oscillation({0.01, 0.02}, 8, 0.3)},
                      // Its velocity jumps within a block, by more than friction takes in a step.
                      Carrying{"jerked", SubstrateMotion::table({{0, {0, 0}},
                                                                 {0.0042, {2e-5, 0}},
                                                                 {0.0123, {1e-5, 3e-5}}})},
                      Carrying{"slope_of_unlike_friction", {}, {kKinetic, 0.3, 0.05}},
                      Carrying{"slope_without_kinetic_friction", {}, {0}},
                      Carrying{"shaken_without_some",
                               SubstrateMotion::oscillation({0.01, 0.02}, 8, 0.3),
                               {0, kKinetic}}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace slipcheck
