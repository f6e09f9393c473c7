#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "physics/contact/elastic_pair.h"
#include "physics/contact/linear_contact.h"
#include "reference/free_collision.h"
#include "reference/pair/pair_batch.h"

namespace slipcheck {
namespace {

constexpr int kSteps = 200;  // in a collision

/// Collisions of one pair of materials at many speeds.
struct Sweep {
  SoftContact contact;
  Sphere ball;
  std::vector<double> normal_speed, tangential_speed;
  std::vector<PairCollision> out;

  void add_speeds(std::size_t across, double slowest, double fastest) {
    const auto speed = [&](std::size_t k) {
      return slowest *
             std::pow(fastest / slowest, static_cast<double>(k) / static_cast<double>(across - 1));
    };
    for (std::size_t i = 0; i < across; ++i)
      for (std::size_t j = 0; j < across; ++j)
        normal_speed.push_back(speed(i)), tangential_speed.push_back(speed(j));
    out.resize(normal_speed.size());
  }
  void collide() {
    collide_batch(contact, ball, ball, normal_speed, tangential_speed, kSteps, out);
  }
};

/// K's steel spheres with rubbing below and at Coulomb's cap.
Sweep kondic() {
  Sweep sweep;
  sweep.ball = {0.002, 2.6e-4, 0.4};
  const double mass = effective_mass(sweep.ball, sweep.ball);
  const LinearContact law =
      LinearContact::with_collision_time(mass, 0.9, 2.55e-5, ContactEnd::zero_overlap);
  const double damping = law.damping_rate() * mass;
  sweep.contact = {LinearForce{law.stiffness(), damping}, ContactEnd::zero_overlap,
                   ViscousForce{0.5 * damping, 0.5}};
  sweep.add_speeds(64, 1e-2, 1);
  return sweep;
}

/// B's ice with asperities that bend and break.
Sweep rough_ice(AsperityForce::Form form) {
  Sweep sweep;
  sweep.ball = {0.01, 4.18879e-3, 0.4};
  const ElasticMaterial ice{1e10, 0.3, 1e-6};
  const double radius = effective_radius(sweep.ball, sweep.ball);
  sweep.contact = {ViscoelasticForce{hertz_modulus(ice, ice, radius), 1e-6},
                   ContactEnd::zero_overlap, AsperityForce{0.01, 2e-4 * radius, form}};
  sweep.add_speeds(64, 1e-3, 1);
  return sweep;
}

/// How many steps the collisions of this law's sweep take.
double steps_of(const Sweep& sweep) {
  const double mass = effective_mass(sweep.ball, sweep.ball);
  double steps = 0;
  for (std::size_t k = 0; k < sweep.out.size(); ++k) {
    double undamped = 0;
    if (const auto* linear = std::get_if<LinearForce>(&sweep.contact.normal))
      undamped = M_PI * std::sqrt(mass / linear->stiffness);
    else
      undamped = hertz_duration(mass, std::get<ViscoelasticForce>(sweep.contact.normal).modulus,
                                sweep.normal_speed[k]);
    steps += std::ceil(kSteps * sweep.out[k].duration / undamped);
  }
  return steps;
}

void count(benchmark::State& state, double collisions, double steps) {
  const auto runs = static_cast<double>(state.iterations());
  state.counters["collisions/s"] =
      benchmark::Counter(runs * collisions, benchmark::Counter::kIsRate);
  state.counters["per_pair_step"] =
      benchmark::Counter(runs * steps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// One instruction set; those that the machine lacks are not run.
void run_batch(benchmark::State& state, Sweep sweep, int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  for (auto _ : state) {
    sweep.collide();
    benchmark::DoNotOptimize(sweep.out.data());
    benchmark::ClobberMemory();
  }
  count(state, static_cast<double>(sweep.out.size()), steps_of(sweep));
  state.SetLabel(batch_target());
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// What a loop over one collision at a time makes of K's forces, in plain C++: the same steps.
struct OneByOne {
  double stiffness, damping, rubbing, friction, mass, tangential_mass;

  PairCollision operator()(double g_n, double g_t, double h) const {
    double x = 0, v = g_n, u = g_t, t = 0;
    const double k = stiffness / mass, c = damping / mass, brake = 1 / (1 + 0.5 * h * c);
    const double left = std::exp(-h * rubbing / tangential_mass);
    const double cap = friction * mass / tangential_mass;
    while (true) {
      const double middle = v + c * x - 0.5 * h * k * x;
      const double next = x + h * (middle - c * x) * brake;
      const double after = middle - (0.5 * h * k + c) * next;
      const double taken = std::min(std::abs(u) * (1 - left), cap * std::abs(v - after));
      if (next <= 0) {
        const double part = x / (x - next);
        const double end = v + part * (after - v);
        return pair_collision(mass, tangential_mass, g_n, g_t, -end / g_n,
                              (u - part * std::copysign(taken, u)) / g_t, t + part * h);
      }
      u -= std::copysign(taken, u);
      x = next;
      v = after;
      t += h;
    }
  }
};

void BM_CollisionsOneByOne(benchmark::State& state) {
  Sweep sweep = kondic();
  const auto& linear = std::get<LinearForce>(sweep.contact.normal);
  const auto& viscous = std::get<ViscousForce>(sweep.contact.tangential);
  const double mass = effective_mass(sweep.ball, sweep.ball);
  const OneByOne collide{
      linear.stiffness, linear.damping, viscous.damping,
      viscous.friction, mass,           tangential_mass_ratio(sweep.ball, sweep.ball) * mass};
  const double step = M_PI * std::sqrt(mass / linear.stiffness) / kSteps;
  for (auto _ : state) {
    for (std::size_t k = 0; k < sweep.out.size(); ++k)
      sweep.out[k] = collide(sweep.normal_speed[k], sweep.tangential_speed[k], step);
    benchmark::DoNotOptimize(sweep.out.data());
    benchmark::ClobberMemory();
  }
  count(state, static_cast<double>(sweep.out.size()), steps_of(sweep));
}
BENCHMARK(BM_CollisionsOneByOne)->Unit(benchmark::kMillisecond);

/// By CVODE, what the batch is compared with in tests.
void BM_CollisionsByCvode(benchmark::State& state) {
  Sweep sweep = kondic();
  for (auto _ : state) {
    for (std::size_t k = 0; k < sweep.out.size(); k += 64)
      benchmark::DoNotOptimize(sweep.out[k] = test::collide_freely(
                                   sweep.contact, sweep.ball, sweep.ball, sweep.normal_speed[k],
                                   sweep.tangential_speed[k], 1e-8));
  }
  state.counters["collisions/s"] = benchmark::Counter(
      static_cast<double>(state.iterations() * sweep.out.size() / 64), benchmark::Counter::kIsRate);
}
BENCHMARK(BM_CollisionsByCvode)->Unit(benchmark::kMillisecond);

/// Batches on each instruction set that this machine and this program have.
const bool kRegistered = [] {
  for (const int64_t target : {HWY_SCALAR, HWY_SSE4, HWY_NEON, HWY_AVX2, HWY_AVX3}) {
    if ((hwy::SupportedTargets() & target) == 0) continue;
    const auto add = [&](const char* name, const Sweep& sweep) {
      benchmark::RegisterBenchmark(
          (std::string(name) + "/" + hwy::TargetName(target)).c_str(),
          [sweep, target](benchmark::State& state) { run_batch(state, sweep, target); })
          ->Unit(benchmark::kMillisecond);
    };
    add("BM_BatchKondic", kondic());
    add("BM_BatchIcePrinted", rough_ice(AsperityForce::Form::printed));
    add("BM_BatchIcePassive", rough_ice(AsperityForce::Form::passive));
  }
  return true;
}();

}  // namespace
}  // namespace slipcheck
