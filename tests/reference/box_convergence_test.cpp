#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../support/extremes.h"
#include "harness/observe/box_observer.h"
#include "reference/events/planar_solver.h"
#include "soft_box_scenes.h"

namespace slipcheck {
namespace {

using namespace test;

/// Both forms of one box: contacts that last, and in `hard` what they tend to, with β0 = 0.
ContactScene both_forms(const BeadBox& box, const std::vector<BodyState>& initial) {
  ContactScene scene = box.scene(initial);
  const PairContact contact{box.restitution, box.friction, 0};
  scene.hard.pairs = {contact};
  scene.hard.box->on_floor = scene.hard.box->on_wall = {contact};
  return scene;
}

/// The largest difference of a velocity or of R w [m/s].
double apart(const std::vector<BodyState>& a, const std::vector<BodyState>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double spin = (a[i].angular_velocity - b[i].angular_velocity).norm();
    most = test::largest_of(most, (a[i].velocity - b[i].velocity).norm(), BeadBox::kRadius * spin);
  }
  return most;
}

std::vector<BodyState> six_beads() {
  std::vector<BodyState> initial;
  for (int i = 0; i < 6; ++i)
    initial.push_back(bead(0.0011 + 0.0024 * (i % 3), 0.0015 + 0.002 * (i / 3),
                           0.35 * std::sin(1 + 5 * i), 0.35 * std::cos(3 * i),
                           500 * std::sin(2 + i)));
  return initial;
}

TEST(BoxConvergence, TrajectoriesComeNearTheEventDrivenOnesInFirstOrder) {
  constexpr double kTime = 0.016;
  for (const double friction : {0.0, 0.2, 0.5}) {
    for (const bool moving_walls : {false, true}) {
      BeadBox box;
      box.friction = friction;
      box.box.width = 0.008;
      box.box.floor = {0.5e-3, 100};
      box.box.moving_walls = moving_walls;
      std::vector<double> errors;
      for (const double collision_time : {2e-6, 1e-6, 5e-7}) {
        box.collision_time = collision_time;
        const ContactScene scene = both_forms(box, six_beads());
        PlanarSolver event(scene.hard, scene.hard.initial);
        const SolvedRun hard = event.run(until_time(kTime), nullptr);
        SoftBoxSolver contact(scene, scene.hard.initial, {50});
        const SolvedRun soft = contact.run(until_time(kTime), nullptr);
        EXPECT_GE(hard.collisions, 2U);
        EXPECT_GE(hard.contacts, 5U);
        EXPECT_EQ(soft.collisions, hard.collisions);
        EXPECT_EQ(soft.contacts, hard.contacts);
        errors.push_back(apart(contact.states(), event.states()));
      }
      SCOPED_TRACE(testing::Message() << friction << (moving_walls ? ", moving walls" : ""));
      // The next term is the square of what 1 to 2 cm/s are beside speeds of 0.35 m/s and more.
      EXPECT_NEAR(errors[0] / errors[1], 2, 0.02);
      EXPECT_NEAR(errors[1] / errors[2], 2, 0.01);
      EXPECT_LT(errors[2], 0.01);

      // With friction, unlike where all slide for ever, some stick: that is compared too.
      box.collision_time = 1e-6;
      const ContactScene scene = both_forms(box, six_beads());
      PlanarSolver event(scene.hard, scene.hard.initial);
      event.run(until_time(kTime), nullptr);
      const double sticking = apart(event.states(), PlainHardBox(box, six_beads()).run(kTime));
      if (friction > 0)
        EXPECT_GT(sticking, 0.1);
      else
        EXPECT_LT(sticking, 1e-12);
    }
  }
}

struct Averages {
  BlockedMean height, translation, rotation;
};

Averages averages(const Scene& scene, Solver&& solver, std::size_t periods) {
  BoxSampling sampling;
  sampling.discard = 150;
  BoxObserver observer(scene, sampling);
  const double frequency = scene.box->floor.frequency;
  const double end = static_cast<double>(sampling.discard + periods) / frequency;
  EXPECT_TRUE(solver.run(until_time(end, 1 / frequency), &observer).reached);
  const BoxObservables seen = observer.finish();
  return {seen.height, seen.kinetic_energy, seen.rotational_energy};
}

TEST(BoxConvergence, AveragesAgreeWithinTheirErrors) {
  BeadBox box;
  box.friction = 0.2;
  box.slowing = 20;
  box.box.width = 0.01;
  box.box.floor = {0.8 / (2 * M_PI * 100), 100};
  std::vector<BodyState> initial;
  for (int i = 0; i < 20; ++i)
    initial.push_back(bead(0.001 + 0.0011 * (i % 8), 0.002 + 0.0012 * (i / 8),
                           0.2 * std::sin(1 + 5 * i), 0.2 * std::cos(3 * i)));
  const ContactScene hard = both_forms(box, initial);
  const Averages exact = averages(hard.hard, PlanarSolver(hard.hard, initial), 12'000);
  const auto off = [&](BlockedMean Averages::*what, const Averages& seen) {
    const BlockedMean &a = seen.*what, &b = exact.*what;
    return std::abs(a.mean - b.mean) / std::hypot(a.standard_error, b.standard_error);
  };
  const auto with_contacts = [&](double collision_time) {
    box.collision_time = collision_time;
    const ContactScene scene = both_forms(box, initial);
    return averages(scene.hard, SoftBoxSolver(scene, initial, {12}), 900);
  };
  // What is compared are means of chaotic runs: 4 of their standard errors, which another rounding
  // passes about once in 5000 times.
  const Averages short_contacts = with_contacts(1e-5);
  for (const auto what : {&Averages::height, &Averages::translation, &Averages::rotation})
    EXPECT_LT(off(what, short_contacts), 4);
  EXPECT_LT(short_contacts.height.standard_error, 0.07 * short_contacts.height.mean);
  EXPECT_LT(short_contacts.translation.standard_error, 0.05 * short_contacts.translation.mean);
  EXPECT_LT(short_contacts.rotation.standard_error, 0.05 * short_contacts.rotation.mean);
  // And the comparison can fail: contacts of 1.5 ms, a seventh of the time between them, are seen.
  // K/R has an error of 4 % at most and changes by half.
  const Averages long_contacts = with_contacts(1.5e-3);
  const auto ratio = [](const Averages& seen) {
    return seen.translation.mean / seen.rotation.mean;
  };
  EXPECT_GT(ratio(long_contacts), 1.25 * ratio(exact));
}

}  // namespace
}  // namespace slipcheck
