#include "harness/observe/gas_restitution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../scenes.h"
#include "physics/closed_forms.h"
#include "reference/events/event_solver.h"

namespace slipcheck {
namespace {

/// The same two bodies once more, so far away along y: two collisions to average.
Scene with_a_second_pair(Scene scene, double away) {
  for (std::size_t i = 0; i < 2; ++i) {
    scene.bodies.push_back(scene.bodies[i]);
    scene.material.push_back(scene.material[i]);
    scene.initial.push_back(scene.initial[i]);
    scene.initial.back().position.y() += away;
  }
  return scene;
}

/// Two rolling balls that meet head-on, and nothing else: e_eff = (A e_n − 1)/(1+A), K (44) for s.
TEST(GasRestitution, OfOnePairIsKondics) {
  const double v = 0.15, e = 0.9;
  const Scene scene = test::head_on(v, -v, e);
  const Scene two = with_a_second_pair(scene, 1);
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

/// The pair of the first test, but around the edge of a periodic cell: the same numbers.
TEST(GasRestitution, AcrossAPeriodicEdgeIsTheSame) {
  const double e = 0.9;
  Scene scene = test::head_on(0.15, -0.15, e);
  scene.periodic = {0.03, 0.02};
  for (std::size_t i = 0; i < 2; ++i) {  // now 1 cm apart around the edge, and they come nearer
    scene.initial[i].position.x() += i == 0 ? 0.015 : -0.015;
  }
  const Scene two = with_a_second_pair(scene, 0.01);
  GasRestitution both(two, 2, 1e-12);
  // They slide for 83 ms from 20 ms on, and are back where they began, around the cell, after 160.
  EventSolver(two, two.initial).run(until_time(0.15), &both);
  ASSERT_EQ(both.windows().size(), 1u);
  const HeadOnCollision rule{scene.bodies[0].inverse_shape_factor(), e, 0};
  EXPECT_NEAR(both.windows()[0].restitution, e, 1e-13);
  EXPECT_NEAR(both.windows()[0].isolated, rule.effective_restitution(), 1e-12);
}

/// Two pairs of different restitution and speed, u_k and c_k = e_k u_k: ⟨e⟩ = Σc/Σu, and its
/// standard error that of a ratio of two means, √Σ(c_k − ⟨e⟩ u_k)²/Σu.
TEST(GasRestitution, ItsErrorIsThatOfARatioOfTwoMeans) {
  Scene scene = test::head_on(0.15, -0.15, 0.9);
  scene.material = {0, 0, 1, 1};
  scene.substrate.push_back(scene.substrate[0]);
  scene.pairs.assign(4, scene.pairs[0]);
  scene.pairs[3].restitution = 0.6;
  for (std::size_t i = 0; i < 2; ++i) {
    scene.bodies.push_back(scene.bodies[i]);
    const double v = i == 0 ? 0.1 : -0.1;
    scene.initial.push_back(test::rolling_at(scene.initial[i].position.x(), 1, v, 0));
  }
  GasRestitution seen(scene, 2, 1e-12);
  EventSolver(scene, scene.initial).run({Run::Until::rolling, 0, 10}, &seen);
  ASSERT_EQ(seen.windows().size(), 1u);
  const double A = scene.bodies[0].inverse_shape_factor();
  const double u[] = {0.3, 0.2};
  const double c[] = {0.3 * HeadOnCollision{A, 0.9, 0}.effective_restitution(),
                      0.2 * HeadOnCollision{A, 0.6, 0}.effective_restitution()};
  const double mean = (c[0] + c[1]) / 0.5;
  const double error = std::hypot(c[0] - mean * u[0], c[1] - mean * u[1]) / 0.5;
  EXPECT_GT(error, 0.01);
  EXPECT_NEAR(seen.windows()[0].effective, mean, 1e-12);
  EXPECT_NEAR(seen.windows()[0].effective_error, error, 1e-12);
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
