#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "../support/extremes.h"
#include "../support/refusal.h"
#include "soft_box_scenes.h"

namespace slipcheck {
namespace {

using namespace test;

constexpr double kRadius = BeadBox::kRadius;

TEST(SoftBox, BounceOnAnElasticFloorUnderGravityIsExact) {
  BeadBox box;
  box.restitution = 1;
  box.collision_time = 1e-4;
  const double height = 1e-3, g = box.gravity;
  const double v = std::sqrt(2 * g * height), fall = v / g;
  // ξ̈ = g − ω² ξ: back at ξ = 0 with −v after 2 (π − atan(ω v/g))/ω.
  const double omega = M_PI / box.collision_time;
  const double contact = 2 * (M_PI - std::atan(omega * v / g)) / omega;
  const double t = 1.5 * fall + contact;
  const double exact = kRadius + v * 0.5 * fall - 0.5 * g * 0.25 * fall * fall;
  const ContactScene scene = box.scene({bead(0.01, kRadius + height, 0, 0)});
  // 100 steps take ½ 100 (π/100)⁶/144 = 3e-10 of the speed, over 7 ms or 70 contacts.
  EXPECT_NEAR(after(scene, t, 100)[0].position.z(), exact, 2e-7 * v * contact);
}

TEST(SoftBox, BouncesComeNearTheHardOnesInFirstOrder) {
  BeadBox box;
  box.end = ContactEnd::zero_overlap;
  const double height = 2e-3, g = box.gravity;
  const double v = std::sqrt(2 * g * height), fall = v / g;
  // At the top of the third arc, after two bounces: v/g (1 + 2e + e²).
  const auto state = [&](double e, double collision_time) {
    box.restitution = e;
    box.collision_time = collision_time;
    return after(box.scene({bead(0.01, kRadius + height, 0, 0)}), fall * (1 + 2 * e + e * e),
                 100)[0];
  };
  // Elastic contacts delay by t_col (1 + 2g/(πωv)) and do nothing else: 2 g t_col is left.
  EXPECT_NEAR(state(1, 1e-5).velocity.z() / (2 * g * 1e-5), 1, 1e-3);
  // With e < 1 gravity also changes the rebound, in sum by 2e-7 m for 10 µs; and ½ g (2 t_col)² is
  // a hundredth of that.
  const auto error = [&](double collision_time) {
    return state(0.8, collision_time).position.z() - (kRadius + height * std::pow(0.8, 4));
  };
  EXPECT_NEAR(error(2e-5) / error(1e-5), 2, 0.03);
  EXPECT_NEAR(error(1e-5) / error(5e-6), 2, 0.015);
  EXPECT_LT(std::abs(error(1e-5)), 1e-3 * height);
}

TEST(SoftBox, BeadComesToRestInTheFloor) {
  BeadBox box;
  box.restitution = 0.3;
  box.collision_time = 1e-4;
  for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force}) {
    box.end = end;
    const ContactScene scene = box.scene({bead(0.01, kRadius + 1e-4, 0, 0)});
    const auto& law = std::get<LinearForce>(scene.soft_box.on_floor[0]->normal);
    const BodyState s = after(scene, 0.05)[0];
    const double overlap = BeadBox::mass() * box.gravity / law.stiffness;
    EXPECT_NEAR(kRadius - s.position.z(), overlap, 1e-6 * overlap);
  }
}

TEST(SoftBox, MovingFloorGivesItsEnergy) {
  BeadBox box;
  box.restitution = 0.9;
  box.box.floor = {0.5e-3, 100};
  // Meets the floor at t = 1 ms, where it rises.
  const double t = 1e-3, v = 0.2, g = box.gravity;
  const double low = kRadius + box.box.floor.height(t);
  const std::vector<BodyState> initial = {bead(0.01, low + v * t - 0.5 * g * t * t, 0, -v + g * t)};
  const double floor = box.box.floor.velocity(t);
  const double hard = floor + 0.9 * (v + floor);
  const auto error = [&](double collision_time) {
    box.collision_time = collision_time;
    const BodyState s = after(box.scene(initial), 2e-3)[0];
    return s.velocity.z() - (hard - g * 1e-3);
  };
  // Of first order with the floor's acceleration: ω t_col = 0.006, and next 0.003.
  EXPECT_NEAR(error(1e-5) / error(5e-6), 2, 0.03);
  EXPECT_NEAR(error(5e-6) / error(2.5e-6), 2, 0.015);
  EXPECT_LT(std::abs(error(2.5e-6)), 2e-3);

  box.restitution = 1;
  const ContactScene scene = box.scene(initial);
  SoftBoxSolver solver(scene, initial);
  const SolvedRun run = solver.run(until_time(2e-3), nullptr);
  EXPECT_GT(run.balance->work, 0.5 * BeadBox::mass() * v * v);
  EXPECT_NEAR(run.balance->dissipated, 0, 1e-12 * run.balance->work);
  EXPECT_LT(std::abs(run.balance->error()), 1e-6);
}

std::vector<BodyState> crowd(int count) {
  std::vector<BodyState> states;
  for (int i = 0; i < count; ++i)
    states.push_back(bead(0.002 + 0.0013 * (i % 12), 0.001 + 0.0015 * (i / 12),
                          0.3 * std::sin(1 + 5 * i), 0.3 * std::cos(3 * i), 100 * std::sin(i)));
  return states;
}

TEST(SoftBox, EnergyBalance) {
  BeadBox box;
  box.restitution = 1;
  const auto error = [&](double steps) {
    const ContactScene scene = box.scene(crowd(24));
    SoftBoxSolver solver(scene, scene.hard.initial, {steps});
    const SolvedRun run = solver.run(until_time(0.02), nullptr);
    EXPECT_GT(run.collisions, 30U);
    EXPECT_EQ(run.balance->work, 0);
    EXPECT_NEAR(run.balance->dissipated, 0, 1e-20);
    return std::abs(run.balance->error());
  };
  // A contact of n steps loses 2n (π/n)⁶/144, or 1.4e-6 for 25, of what it stores, and of that the
  // total is the sum over some hundred contacts between 24 bodies.
  EXPECT_LT(error(25), 2e-5);
  EXPECT_LT(error(100), 2e-8);

  box.restitution = 0.9;
  box.friction = 0.3;
  box.box.floor = {0.5e-3, 100};
  box.box.moving_walls = true;
  for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force}) {
    box.end = end;
    const ContactScene scene = box.scene(crowd(24));
    SoftBoxSolver solver(scene, scene.hard.initial, {50});
    const SolvedRun run = solver.run(until_time(0.02), nullptr);
    EXPECT_GT(run.balance->work, 0);
    EXPECT_GT(run.balance->dissipated, 0);
    EXPECT_LT(std::abs(run.balance->error()), 2e-6);
  }
}

double distance(const std::vector<BodyState>& a, const std::vector<BodyState>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += (a[i].velocity - b[i].velocity).squaredNorm() +
           kRadius * kRadius * (a[i].angular_velocity - b[i].angular_velocity).squaredNorm();
  return std::sqrt(sum);
}

TEST(SoftBox, DiluteBoxConvergesToTheHardOneInFirstOrder) {
  for (const double friction : {0.0, 0.03}) {
    BeadBox box;
    box.friction = friction;
    box.box.width = 0.008;
    box.box.floor = {0.5e-3, 100};
    const std::vector<BodyState> initial = {
        bead(0.0021, 0.0052, 0.32, 0.1, 2600), bead(0.0043, 0.0057, -0.27, 0.05, 2900),
        bead(0.0061, 0.0043, 0.22, -0.2, 3100), bead(0.0034, 0.0031, 0.3, -0.15, 2800)};
    const double time = 0.0115;
    PlainHardBox hard(box, initial);
    const std::vector<BodyState> exact = hard.run(time);
    EXPECT_GE(hard.pairs, 3U);
    EXPECT_GE(hard.bounces, 2U);
    EXPECT_GT(hard.least_slip, 0.1);  // with friction all of them slide
    std::vector<double> errors;
    for (const double collision_time : {4e-6, 2e-6, 1e-6}) {
      box.collision_time = collision_time;
      const ContactScene scene = box.scene(initial);
      SoftBoxSolver solver(scene, initial, {50});
      const SolvedRun run = solver.run(until_time(time), nullptr);
      EXPECT_EQ(run.collisions, hard.pairs);
      EXPECT_EQ(run.contacts, hard.bounces);
      errors.push_back(distance(solver.states(), exact));
    }
    // The next term is that of t_col beside the time between events, 1e-3, times what they amplify.
    EXPECT_NEAR(errors[0] / errors[1], 2, 0.01);
    EXPECT_NEAR(errors[1] / errors[2], 2, 0.005);
    EXPECT_LT(errors[2], 1e-3);  // of speeds of 0.3 m/s and R w of 1.5 m/s
  }
}

struct Recorder : FrameSink {
  std::vector<double> times;
  std::vector<Frame> frames;
  void take(double time, const Frame& frame) override {
    times.push_back(time);
    frames.push_back(frame);
  }
};

TEST(SoftBox, SamplesAreExactAndChangeNothing) {
  BeadBox box;
  box.box.floor = {0.5e-3, 100};
  box.collision_time = 1e-3;  // long enough for samples within contacts
  const ContactScene scene = box.scene(crowd(12));
  SoftBoxSolver silent(scene, scene.hard.initial), shown(scene, scene.hard.initial);
  silent.run(until_time(0.0105), nullptr);
  Recorder recorder;
  shown.run(until_time(0.0105, 1e-3), &recorder);
  EXPECT_EQ(distance(silent.states(), shown.states()), 0);
  ASSERT_EQ(recorder.times.size(), 12U);
  for (int k = 0; k <= 10; ++k) EXPECT_EQ(recorder.times[k], k * 1e-3);
  EXPECT_EQ(recorder.times.back(), 0.0105);
  for (int k = 1; k <= 10; ++k) {
    SoftBoxSolver there(scene, scene.hard.initial);
    there.run(until_time(k * 1e-3), nullptr);
    // Two steps in place of one: their errors differ by 1e-6 of the speeds at most.
    EXPECT_LT(distance(there.states(), recorder.frames[k].bodies), 1e-6);
  }
}

TEST(SoftBox, NobodyPassesThroughAnything) {
  BeadBox box;
  box.friction = 0.2;
  box.slowing = 3;
  box.box.floor = {0.5e-3, 100};
  ContactScene scene = box.scene(crowd(60));
  for (std::size_t i = 0; i < 60; ++i)  // of several sizes
    scene.hard.bodies[i].radius *= 1 - 0.2 * static_cast<double>(i % 4);
  SoftBoxSolver solver(scene, scene.hard.initial);
  Recorder recorder;
  const SolvedRun run = solver.run(until_time(0.03, 1e-4), &recorder);
  EXPECT_GT(run.collisions, 150U);
  EXPECT_GT(run.contacts, 40U);
  double deepest = 0;
  for (std::size_t k = 0; k < recorder.frames.size(); ++k) {
    const auto& bodies = recorder.frames[k].bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Vector3& p = bodies[i].position;
      const double radius = scene.hard.bodies[i].radius;
      deepest = test::largest_of(deepest, radius - p.x(), radius + p.x() - box.box.width,
                                 radius + box.box.floor.height(recorder.times[k]) - p.z());
      for (std::size_t j = 0; j < i; ++j)
        deepest = test::largest_of(
            deepest, radius + scene.hard.bodies[j].radius - (p - bodies[j].position).norm());
    }
  }
  // Nobody meets faster than 2 m/s: v t_col/π, twice that where a third pushes.
  EXPECT_LT(deepest, 2 * 2 * box.collision_time / M_PI);
}

TEST(SoftBox, RefusesWhatIsHard) {
  const BeadBox box;
  const ContactScene good = box.scene(meeting(0.3));
  const auto message = [&](const auto& spoil) {
    ContactScene scene = good;
    spoil(scene);
    return test::refusal_of<Unsupported>([&] { SoftBoxSolver(scene, scene.hard.initial); });
  };
  EXPECT_EQ(message([](ContactScene&) {}), "");
  EXPECT_NE(message([](ContactScene& s) { s.soft[0].reset(); }).find("bodies 0 and 1 is hard"),
            std::string::npos);
  EXPECT_NE(message([](ContactScene& s) {
              s.soft_box.on_floor[0].reset();
            }).find("the floor with body 0 is hard"),
            std::string::npos);
  EXPECT_NE(message([](ContactScene& s) {
              s.soft_box.on_wall[0].reset();
            }).find("the walls with body 0 is hard"),
            std::string::npos);
  EXPECT_EQ(message([](ContactScene& s) { s.soft_box.on_lid[0].reset(); }), "");
  EXPECT_NE(message([](ContactScene& s) {
              s.soft_box.on_lid.clear();
              s.hard.box->lid = 0.02;
            }).find("the lid with body 0 is hard"),
            std::string::npos);
  EXPECT_NE(message([](ContactScene& s) { s.hard.box.reset(); }).find("no box"), std::string::npos);
  SoftBoxSolver solver(good, good.hard.initial);
  EXPECT_THROW(solver.run({Run::Until::rest, 0, 1}, nullptr), Unsupported);
}

}  // namespace
}  // namespace slipcheck
