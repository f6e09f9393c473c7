#include <gtest/gtest.h>

#include <string>

#include "planar_scenes.h"
#include "reference/events/event_solver.h"
#include "reference/steps/step_solver.h"
#include "step_scenes.h"

namespace slipcheck {
namespace {

using namespace test;

constexpr double kStep = kCollisionTime / 50;

/// Three balls, the last one smaller, of which the first two meet in a graze and the others later.
Scene three_balls() {
  Scene scene = steel_scene(3);
  scene.bodies[2].radius = 0.0015;
  scene.initial[2].position.z() = 0.0015;
  scene.initial[0].position.head<2>() = Vector2(-0.0021, 0);
  scene.initial[1].position.head<2>() = Vector2(0.0021, 0.001);
  scene.initial[2].position.head<2>() = Vector2(0.0045, -0.0021);
  scene.initial[0].velocity = {0.4, 0.05, 0};
  scene.initial[1].velocity = {-0.2, 0, 0};
  scene.initial[2].velocity = {-0.5, 0.3, 0};
  scene.initial[0].angular_velocity = {30, 40, 50};
  scene.initial[1].angular_velocity = {-10, 60, -20};
  return scene;
}

struct Case {
  std::string name;
  TangentialForce tangential;
  bool friction, confined, equal, moving = false;
};

class GeneralLoop : public testing::TestWithParam<Case> {};

/// A feature left out is one whose terms are zeros: it changes no bit of any state.
TEST_P(GeneralLoop, GivesTheSameBits) {
  Scene hard = three_balls();
  hard.confined = GetParam().confined;
  if (GetParam().equal) {
    hard.bodies[2] = hard.bodies[0];
    hard.initial[2].position.z() = hard.bodies[0].radius;
  }
  if (!GetParam().friction)
    hard.substrate[0].static_friction = hard.substrate[0].kinetic_friction = 0;
  if (GetParam().moving) {
    hard.motion = SubstrateMotion::oscillation({0.002, 0.001}, 40, 0);
    hard.downhill = {0.3, -0.5};
  }
  SoftContact contact =
      linear_contact(0.5 * hard.bodies[0].mass, 0.8, kCollisionTime, ContactEnd::zero_overlap);
  contact.tangential = GetParam().tangential;
  const ContactScene scene = with_contact(hard, contact);
  StepSolver special(scene, hard.initial, {kStep, 1e-10, false});
  StepSolver general(scene, hard.initial, {kStep, 1e-10, true});
  EXPECT_NE(special.features(), general.features());
  std::size_t collisions = 0;
  for (int k = 1; k <= 40; ++k) {
    const double t = k * 500 * kStep;
    collisions = special.run(until_time(t), nullptr).collisions;
    EXPECT_EQ(general.run(until_time(t), nullptr).collisions, collisions);
    const auto a = special.states(), b = general.states();
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].position, b[i].position) << k << " " << i;
      EXPECT_EQ(a[i].velocity, b[i].velocity) << k << " " << i;
      EXPECT_EQ(a[i].angular_velocity, b[i].angular_velocity) << k << " " << i;
    }
  }
  EXPECT_GE(collisions, 2u);
}

const double kReduced = 0.5 * 7850 * 4 * M_PI / 3 * 8e-9;
const TangentialForce kViscous = ViscousForce{kReduced * 0.2 / kCollisionTime, 0.3};
const TangentialForce kPassive = AsperityForce{0.2, 1e-7, AsperityForce::Form::passive};
const TangentialForce kPrinted = AsperityForce{0.2, 1e-7, AsperityForce::Form::printed};

INSTANTIATE_TEST_SUITE_P(
    All, GeneralLoop,
    testing::Values(Case{"smooth_bare", NoTangentialForce{}, false, false, true},
                    Case{"smooth_bare_confined", NoTangentialForce{}, false, true, false},
                    Case{"smooth", NoTangentialForce{}, true, true, false},
                    Case{"smooth_lifting", NoTangentialForce{}, true, false, false},
                    Case{"viscous_bare", kViscous, false, true, true},
                    Case{"viscous", kViscous, true, true, true},
                    Case{"viscous_lifting", kViscous, true, false, false},
                    Case{"passive", kPassive, true, false, true},
                    Case{"printed", kPrinted, true, true, true},
                    Case{"viscous_moving", kViscous, true, false, false, true},
                    Case{"smooth_moving_confined", NoTangentialForce{}, true, true, true, true}),
    [](const auto& each) { return each.param.name; });

/// Phases on any plane are series where those on a level, still one are closed forms: the same to
/// rounding, here some hundred units in the last place after a collision and two slides.
TEST(GeneralEvents, PhasesOnAnyPlaneGiveTheSame) {
  const Scene scene = head_on(0.2, -0.1, 0.9);
  EventSettings general;
  general.general = true;
  EventSolver special(scene, scene.initial), other(scene, scene.initial, general);
  EXPECT_NE(special.features(), other.features());
  const SolvedRun a = special.run(kRolling, nullptr), b = other.run(kRolling, nullptr);
  EXPECT_TRUE(a.reached && b.reached);
  EXPECT_EQ(a.collisions, b.collisions);
  EXPECT_NEAR(a.end_time / b.end_time, 1, 1e-13);
  const auto x = special.states(), y = other.states();
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT((x[i].position - y[i].position).norm(), 1e-13);
    EXPECT_LT((x[i].velocity - y[i].velocity).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace slipcheck
