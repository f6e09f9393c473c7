#include "harness/observe/gas_restitution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../scenes.h"
#include "physics/closed_forms.h"
#include "reference/events/event_solver.h"

namespace slipcheck {
namespace {

/// Two rolling balls that meet head-on, and nothing else: e_eff = (A e_n − 1)/(1+A), K (44) for s.
TEST(GasRestitution, OfOnePairIsKondics) {
  const double v = 0.15, e = 0.9;
  const Scene scene = test::head_on(v, -v, e);
  // A second pair far away, so that there are two collisions to average.
  Scene two = scene;
  for (std::size_t i = 0; i < 2; ++i) {
    two.bodies.push_back(scene.bodies[i]);
    two.material.push_back(scene.material[i]);
    two.initial.push_back(scene.initial[i]);
    two.initial.back().position.y() += 1;
  }
  GasRestitution seen(two, 2, 1e-12);
  EventSolver(two, two.initial).run({Run::Until::rolling, 0, 10}, &seen);
  ASSERT_EQ(seen.windows().size(), 1u);
  const GasWindow window = seen.windows()[0];
  const HeadOnCollision rule{scene.bodies[0].inverse_shape_factor(), e, 0};
  // Rounding.
  EXPECT_NEAR(window.restitution, e, 1e-13);
  EXPECT_NEAR(window.effective, rule.effective_restitution(), 1e-12);
  EXPECT_NEAR(window.isolated, rule.effective_restitution(), 1e-12);
  EXPECT_NEAR(window.effective_error, 0, 1e-12);
  EXPECT_EQ(window.uninterrupted, 1);
  const double mu = scene.substrate[0].kinetic_friction;
  EXPECT_NEAR(window.sliding_distance / rule.symmetric_sliding_distance(2 * v, mu, scene.gravity),
              1, 1e-12);
  // Both rolled from their places to where they touch.
  const double gap =
      (scene.initial[0].position - scene.initial[1].position).norm() - 2 * scene.bodies[0].radius;
  EXPECT_NEAR(window.free_path, gap / 2, 1e-12);
}

/// A ball that waits right behind the struck one takes its velocity before it has slid: the first
/// collision comes to e_n, the isolated one would have come to (A e_n − 1)/(1+A), and the average
/// lies between.
TEST(GasRestitution, AnInterruptedSlideEndsWithTheNextCollision) {
  const double e = 0.9, gap = 1e-9;
  Scene scene = test::head_on(0.3, 0, e);
  scene.bodies.push_back(scene.bodies[1]);
  scene.material.push_back(scene.material[1]);
  scene.initial.push_back(scene.initial[1]);
  scene.initial[2].position.x() += 2 * scene.bodies[1].radius + gap;
  GasRestitution seen(scene, 2, 1e-12);
  EventSolver(scene, scene.initial).run({Run::Until::rolling, 0, 10}, &seen);
  ASSERT_GE(seen.windows().size(), 1u);
  const GasWindow window = seen.windows()[0];
  EXPECT_NEAR(window.restitution, e, 1e-6);  // the slide through the gap
  EXPECT_LT(window.uninterrupted, 1);
  EXPECT_GT(window.effective, window.isolated + 0.1);
  EXPECT_LT(window.effective, e);
}

}  // namespace
}  // namespace slipcheck
