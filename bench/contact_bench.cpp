#include <benchmark/benchmark.h>

#include "physics/contact/linear_contact.h"
#include "reference/forces/contact_solver.h"
#include "reference/steps/step_solver.h"
#include "scenes.h"

namespace slipcheck {
namespace {

constexpr double kCollisionTime = 2.55e-5;  // [s]
constexpr double kStepsPerCollision = 1000;

/// K's steel spheres in the moment they meet, rolling, with his forces.
ContactScene meeting(const TangentialForce& tangential, bool full_substrate) {
  ContactScene scene;
  scene.hard = test::head_on(0.1, -0.07, 0.9, 0.002);
  const double reduced = 0.5 * scene.hard.bodies[0].mass;
  const LinearContact law =
      LinearContact::with_collision_time(reduced, 0.9, kCollisionTime, ContactEnd::zero_overlap);
  SoftContact contact;
  contact.normal = LinearForce{law.stiffness(), law.damping_rate() * reduced};
  contact.tangential = tangential;
  scene.soft = {contact};
  if (full_substrate) {
    scene.hard.substrate[0].rolling = RollingFriction(0.001);
    scene.hard.substrate[0].drilling_length = 1e-6;
    scene.hard.downhill = {0, -0.1};
  }
  return scene;
}

TangentialForce viscous() {
  const double reduced = 0.5 * test::head_on(1, 0, 1).bodies[0].mass;
  return ViscousForce{0.5 * reduced * 2 * 0.1054 / kCollisionTime, 0.5};
}

/// Steps of a pair; `steps` of them in one collision, or all while the spheres slide apart.
void run_steps(benchmark::State& state, const ContactScene& scene, bool in_contact,
               bool general = false) {
  const double step = kCollisionTime / kStepsPerCollision;
  const double duration = in_contact ? 0.99 * kCollisionTime : 100 * kCollisionTime;
  std::vector<BodyState> start = scene.hard.initial;
  if (!in_contact)
    for (BodyState& body : start) {
      body.velocity *= -1;
      body.angular_velocity *= 3;
    }
  std::size_t steps = 0;
  for (auto _ : state) {
    StepSolver solver(scene, start, {.step = step, .general = general});
    steps += solver.run(until_time(duration), nullptr).steps;
    benchmark::DoNotOptimize(solver.now());
  }
  state.counters["per_step"] = benchmark::Counter(
      static_cast<double>(steps), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// K's forces while two bodies that slide on the substrate collide.
void BM_StepOfPairInContact(benchmark::State& state) {
  run_steps(state, meeting(viscous(), false), true);
}
BENCHMARK(BM_StepOfPairInContact);

/// The same without rubbing of the pair: what leaving it out gains.
void BM_StepOfSmoothPairInContact(benchmark::State& state) {
  run_steps(state, meeting(NoTangentialForce{}, false), true);
}
BENCHMARK(BM_StepOfSmoothPairInContact);

void BM_StepOfAsperityPairInContact(benchmark::State& state) {
  run_steps(state, meeting(AsperityForce{0.1, 1e-7, AsperityForce::Form::passive}, false), true);
}
BENCHMARK(BM_StepOfAsperityPairInContact);

/// With rolling and drilling friction on a slope.
void BM_StepOfPairInContactOnFullSubstrate(benchmark::State& state) {
  run_steps(state, meeting(viscous(), true), true);
}
BENCHMARK(BM_StepOfPairInContactOnFullSubstrate);

/// A smooth pair on a substrate without friction that it cannot leave: no rolling, spin, drilling
/// or lift-off. The loop made for it (0) and the one that has everything (1).
void BM_StepOfBarePair(benchmark::State& state) {
  ContactScene scene = meeting(NoTangentialForce{}, false);
  scene.hard.confined = true;
  scene.hard.substrate[0].static_friction = scene.hard.substrate[0].kinetic_friction = 0;
  run_steps(state, scene, true, state.range(0) == 1);
}
BENCHMARK(BM_StepOfBarePair)->Arg(0)->Arg(1);

/// K's pair, sliding, in the loop that has everything: against BM_StepOfPairInContact.
void BM_StepOfPairInContactInGeneralLoop(benchmark::State& state) {
  run_steps(state, meeting(viscous(), false), true, true);
}
BENCHMARK(BM_StepOfPairInContactInGeneralLoop);

/// The truth: K's pair from before the collision until both roll, at a tolerance of 1e-12.
void BM_TwoBodyTruth(benchmark::State& state) {
  ContactScene scene = meeting(viscous(), false);
  scene.hard.initial = test::head_on(0.1, -0.07, 0.9).initial;
  for (auto _ : state) {
    ContactSolver solver(scene, scene.hard.initial);
    benchmark::DoNotOptimize(solver.run({Run::Until::rolling, 0, 10}, nullptr));
  }
}
BENCHMARK(BM_TwoBodyTruth)->Unit(benchmark::kMillisecond);

/// Between collisions.
void BM_StepOfPairApart(benchmark::State& state) {
  run_steps(state, meeting(viscous(), false), false);
}
BENCHMARK(BM_StepOfPairApart);

}  // namespace
}  // namespace slipcheck
