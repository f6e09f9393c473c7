#include "reference/piles/pile_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../scenes.h"
#include "physics/contact/linear_contact.h"
#include "reference/reference_solver.h"
#include "sphere_piles.h"

namespace slipcheck {
namespace {

struct Frames final : FrameSink {
  void take(double time, const Frame& frame) override {
    times.push_back(time);
    for (const Touch& touch : frame.touches) impulse += touch.normal_impulse;
    last = frame;
  }
  std::vector<double> times;
  double impulse = 0;
  Frame last;
};

TEST(PileSolver, ShowsTouchesWithTheirImpulses) {
  // Four spheres at rest press the ground with their weight, whatever is skipped.
  const Scene scene = test::pile(2, 0.5, 0.5);
  const ContactScene hard = with_hard_contacts(scene);
  PileSolver solver(hard, scene.initial, {.collision_time = 4e-5, .steps_per_frame = 16});
  Frames frames;
  const double time = 1;
  ASSERT_TRUE(solver.run(until_time(time), &frames).reached);
  EXPECT_TRUE(std::ranges::is_sorted(frames.times));
  EXPECT_EQ(frames.times.front(), 0);
  EXPECT_NEAR(frames.times.back(), time, solver.step());
  const double weight = 4 * scene.bodies[0].mass * scene.gravity;
  const double upper = scene.bodies[0].mass * scene.gravity / 3;
  // By the closed form each upper contact has a third of a weight, N itself.
  EXPECT_NEAR(frames.impulse, (weight + 3 * upper) * frames.times.back(), 1e-3 * weight * time);
}

TEST(PileSolver, TheGeneralLoopGivesTheSame) {
  Scene scene = test::pile(2, 0.2, 0.5);
  const ContactScene hard = with_hard_contacts(scene);
  const auto end = [&](bool general) {
    PileSolver solver(hard, scene.initial, {.collision_time = 4e-4, .general = general});
    EXPECT_TRUE(solver.run(until_time(0.02), nullptr).reached);
    return solver.states();
  };
  const auto a = end(false), b = end(true);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].position, b[i].position) << i;
}

TEST(PileSolver, SaysWhatItHasNot) {
  const auto refuses = [](const ContactScene& scene, const char* why) {
    try {
      PileSolver(scene, scene.hard.initial);
      ADD_FAILURE() << why;
    } catch (const Unsupported& refusal) {
      EXPECT_NE(std::string(refusal.what()).find(why), std::string::npos) << refusal.what();
    }
  };
  const ContactScene good = with_hard_contacts(test::pile(2, 0.5, 0.5));
  ContactScene scene = good;
  scene.hard.confined = true;
  refuses(scene, "confined");
  scene = good;
  scene.hard.substrate[0].coupled_radius = 1e-4;
  refuses(scene, "coupled drilling");
  scene = good;
  scene.hard.pairs[0].restitution = PowerLawRestitution{};
  refuses(scene, "one restitution for all speeds");
  scene = good;
  scene.soft[0] = SoftContact{LinearForce{1e6, 0}, ContactEnd::zero_overlap, AsperityForce{}};
  refuses(scene, "asperities");
}

TEST(PileSolver, FailsWhereBodiesAreTooDeepInEachOther) {
  // Thrown at the ground at a speed for which its contact was never made.
  Scene scene = test::steel_scene(1);
  scene.initial[0].position.z() = 0.003;
  scene.initial[0].velocity.z() = -100;
  const ContactScene hard = with_hard_contacts(scene);
  PileSolver solver(hard, scene.initial, {.collision_time = 1e-3});
  const SolvedRun run = solver.run(until_time(0.01), nullptr);
  EXPECT_TRUE(run.failed);
  EXPECT_NE(run.reason.find("deep in the substrate"), std::string::npos) << run.reason;
}

TEST(PileSolver, EventsTakeNoMemory) {
  ContactScene scene = with_hard_contacts(test::head_on(0.1, -0.1, 0.9));
  SoftContact contact{LinearForce{1e6, 0}, ContactEnd::zero_overlap, NoTangentialForce{}};
  contact.memory = ContactMemory{};
  scene.soft[0] = contact;
  EXPECT_TRUE(ReferenceSolver(scene, Compare::Reference::automatic).is_piled());
  EXPECT_THROW(ReferenceSolver(scene, Compare::Reference::event), Unsupported);
}

}  // namespace
}  // namespace slipcheck
