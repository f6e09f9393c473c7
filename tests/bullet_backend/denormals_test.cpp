// A world that comes to rest fills with denormal numbers unless they are flushed to zero.

#include <gtest/gtest.h>

#include <cmath>

#include "../support/extremes.h"
#include "bullet_run.h"

namespace slipcheck {
namespace {

/// Of the velocities, in which everything dies away.
template <class Look>
void look_at_velocities(const std::vector<Frame>& frames, const Look& look) {
  for (const Frame& frame : frames)
    for (int axis = 0; axis < 3; ++axis) {
      look(frame.bodies[0].velocity[axis]);
      look(frame.bodies[0].angular_velocity[axis]);
    }
}

long denormals_in(const std::vector<Frame>& frames) {
  long count = 0;
  look_at_velocities(frames,
                     [&](double value) { count += std::fpclassify(value) == FP_SUBNORMAL; });
  return count;
}

TEST(BulletDenormals, AreFlushedUnlessToldOtherwiseAndNothingElseChanges) {
  constexpr double radius = 0.1, rate = 240;  // [m], [Hz]
  SubstrateContact ground = ground_with_friction(0.1);
  ground.rolling = RollingFriction(0.02);
  const Scene scene = scene_of(steel_ball(radius), {rolling_along_x(radius, 0, 0.1)}, ground);
  RemoteEngine engine(bullet_executable("double"));
  const auto flushed = run(engine, scene, shipped("physical"), rate, 2400);
  const auto kept =
      run(engine, scene, with(shipped("physical"), {{"flush_denormals", false}}), rate, 2400);
  EXPECT_EQ(denormals_in(flushed), 0);
  EXPECT_GT(denormals_in(kept), 1000);

  std::vector<double> values;
  look_at_velocities(flushed, [&](double value) { values.push_back(value); });
  std::size_t k = 0;
  double apart = 0;
  look_at_velocities(
      kept, [&](double value) { apart = test::largest_of(apart, std::abs(value - values[k++])); });
  // What is below 1.5e-154 has a square that is denormal.
  EXPECT_LT(apart, 1e-152);
}

}  // namespace
}  // namespace slipcheck
