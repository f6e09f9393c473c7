#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "../scenes.h"
#include "physics/contact/linear_contact.h"
#include "reference/reference_solver.h"
#include "worker_run.h"

// `contact` against LAMMPS: two free spheres that touch at time zero, with no gravity. LAMMPS takes
// a step of velocity Verlet: positions at its end and velocities at its middle go into the forces.
// The damping force jumps at the first touch, of which a step knows only whether the spheres
// overlap at its end: LAMMPS's error goes with the step, and without damping with its square.

namespace slipcheck {
namespace {

constexpr double kTime = 2.55e-5;  // t_col [s]
constexpr double kRadius = 0.002;

/// What the pair has come to, from its free flight afterwards.
struct Outcome {
  double restitution = 0;  // along the line of centres when they part
  double duration = 0;     // of the overlap [s]
  Vector3 spin[2];         // [rad/s]
};

struct LastFrame final : FrameSink {
  void take(double, const Frame& frame) override { last = frame; }
  Frame last;
};

/// Two spheres whose line of centres is turned by `angle` from the x axis, along which they
/// approach with 30 cm/s.
Scene free_collision(double angle, double mass_ratio = 1) {
  Scene scene = test::free_pair(0.15, -0.15);
  const Vector3 apart(-kRadius * std::cos(angle), kRadius * std::sin(angle), 0);
  scene.initial[0].position = apart + Vector3::UnitZ();
  scene.initial[1].position = -apart + Vector3::UnitZ();
  if (angle != 0) scene.initial[0].angular_velocity = {3, -5, 20};
  if (mass_ratio != 1) {
    scene.bodies[1].mass *= mass_ratio;
    scene.material = {0, 1};
    scene.substrate.resize(2, scene.substrate[0]);
    scene.pairs.resize(4, scene.pairs[0]);
  }
  return scene;
}

Outcome outcome(const Scene& scene, const std::vector<BodyState>& end, double time) {
  const auto approach = [](const BodyState& a, const BodyState& b) {
    const Vector3 apart = a.position - b.position;
    return -apart.dot(a.velocity - b.velocity) / apart.norm();
  };
  const Vector3 apart = end[0].position - end[1].position;
  const Vector3 rate = end[0].velocity - end[1].velocity;
  // Back to |apart + s rate| = 2 R.
  const double product = apart.dot(rate), square = rate.squaredNorm();
  const double left = apart.squaredNorm() - 4 * kRadius * kRadius;
  const double s = (-product + std::sqrt(product * product - square * left)) / square;
  const Vector3 normal = (apart + s * rate).normalized();
  return {normal.dot(rate) / approach(scene.initial[0], scene.initial[1]),
          time + s,
          {end[0].angular_velocity, end[1].angular_velocity}};
}

Outcome by_reference(const ContactScene& scene) {
  LastFrame sink;
  const double time = 1.5 * kTime;
  const SolvedRun run =
      ReferenceSolver(scene, Compare::Reference::contact).run(until_time(time), &sink);
  EXPECT_TRUE(run.reached) << run.reason;
  return outcome(scene.hard, sink.last.bodies, time);
}

Outcome by_lammps(const ContactScene& scene, std::size_t steps_per_collision) {
  RemoteEngine engine(test::peer_executable("lammps"), test::kPatient);
  const double step = kTime / static_cast<double>(steps_per_collision);
  const std::size_t steps = 3 * steps_per_collision / 2;
  const auto frames = test::peer_run(engine, EngineScene(scene), {{"substeps", 1.0}}, step, steps);
  return outcome(scene.hard, frames.back().bodies, static_cast<double>(steps) * step);
}

/// All that is compared, in a row: e, duration over t_col, changes of spin over that of the
/// reference's sum.
std::vector<double> numbers(const Scene& scene, const Outcome& outcome) {
  std::vector<double> all = {outcome.restitution, outcome.duration / kTime};
  for (int body = 0; body < 2; ++body) {
    const Vector3 change =
        outcome.spin[body] - scene.initial[static_cast<std::size_t>(body)].angular_velocity;
    for (int k = 0; k < 3; ++k) all.push_back(change[k] * kRadius / 0.15);
  }
  return all;
}

struct Case {
  const char* name;
  ContactScene scene;
  /// Of the error over the step; none where errors of either sign, from the jump of the damping and
  /// from where Coulomb's cap lets go, are alike in size.
  std::optional<double> order;
  double at_thousand;   // largest difference at t_col/1000
  double extrapolated;  // and of what two steps extrapolate to; a kink inside a step remains
};

ContactScene with_contact(Scene hard, const SoftContact& contact) {
  ContactScene scene = with_hard_contacts(std::move(hard));
  scene.soft.assign(scene.soft.size(), contact);
  return scene;
}

SoftContact linear(const Scene& scene, double restitution, ContactEnd end,
                   const TangentialForce& tangential = NoTangentialForce{}) {
  const double m1 = scene.bodies[0].mass, m2 = scene.bodies[1].mass, mass = m1 * m2 / (m1 + m2);
  const LinearContact law = LinearContact::with_collision_time(mass, restitution, kTime, end);
  return {LinearForce{law.stiffness(), law.damping_rate() * mass}, end, tangential, false};
}

/// γ_S = ω0/2 with Coulomb's cap, which the slip of the oblique pair reaches at first.
ViscousForce rubbing(const Scene& scene) {
  return {0.5 * M_PI / kTime * scene.bodies[0].mass / 2, 0.2, ViscousForce::Caps::together};
}

/// ρ for which an elastic collision at 30 cm/s takes about t_col.
double hertz_modulus(const Scene& scene) {
  const double mass = scene.bodies[0].mass / 2;
  return 1.25 * mass * std::pow(kTime / 2.9433 * std::pow(0.3, 0.2), -2.5);
}

std::vector<Case> cases() {
  using enum ContactEnd;
  const Scene central = free_collision(0), oblique = free_collision(M_PI / 6);
  const Scene unlike = free_collision(M_PI / 6, 3);
  const double rho = hertz_modulus(central);
  // |ln e| sets how much of the force jumps: at e = 0.5 it is 6.6 times that at e = 0.9.
  return {
      {"elastic", with_contact(central, linear(central, 1, zero_overlap)), 2, 1e-6, 1e-6},
      {"central", with_contact(central, linear(central, 0.9, zero_overlap)), 1, 3e-4, 1e-6},
      {"clamped", with_contact(central, linear(central, 0.9, zero_force)), 1, 3e-4, 2e-5},
      {"damped", with_contact(central, linear(central, 0.5, zero_overlap)), 1, 6e-4, 2e-5},
      {"oblique", with_contact(oblique, linear(oblique, 0.9, zero_overlap, rubbing(oblique))), 1,
       3e-4, 1e-4},
      {"unlike masses", with_contact(unlike, linear(unlike, 0.9, zero_overlap, rubbing(unlike))), 1,
       3e-4, 1e-4},
      {"hertz", with_contact(central, {HertzForce{rho}, zero_overlap, NoTangentialForce{}, false}),
       2, 1e-6, 1e-6},
      {"hertz, oblique",
       with_contact(oblique, {HertzForce{rho}, zero_overlap, rubbing(oblique), false}),
       std::nullopt, 1e-4, 1e-4},
      {"viscoelastic",
       with_contact(central,
                    {ViscoelasticForce{rho, 1e-6}, zero_overlap, NoTangentialForce{}, false}),
       1, 3e-4, 2e-5},
  };
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

TEST(LammpsContact, TheReferenceIsWhatItConvergesTo) {
  for (const Case& each : cases()) {
    SCOPED_TRACE(each.name);
    const Scene& scene = each.scene.hard;
    const auto of = [&](std::size_t steps) { return numbers(scene, by_lammps(each.scene, steps)); };
    const std::vector<double> truth = numbers(scene, by_reference(each.scene));
    const auto coarse = of(500), middle = of(1000), fine = of(2000);
    const double at_500 = largest_difference(coarse, truth);
    const double at_1000 = largest_difference(middle, truth);
    const double at_2000 = largest_difference(fine, truth);
    EXPECT_LT(at_1000, each.at_thousand);
    if (each.order) {
      EXPECT_NEAR(std::log2(at_500 / at_1000), *each.order, 0.35);
      EXPECT_NEAR(std::log2(at_1000 / at_2000), *each.order, 0.35);
    }
    std::vector<double> extrapolated;
    for (std::size_t k = 0; k < truth.size(); ++k) extrapolated.push_back(2 * fine[k] - middle[k]);
    EXPECT_LT(largest_difference(extrapolated, truth), each.extrapolated);
  }
}

TEST(LammpsContact, TheCentralCollisionIsTheClosedForm) {
  const Scene scene = free_collision(0);
  const auto at = [&](std::size_t steps) {
    return by_lammps(with_contact(scene, linear(scene, 0.9, ContactEnd::zero_overlap)), steps);
  };
  const Outcome coarse = at(1000), fine = at(2000);
  EXPECT_NEAR(2 * fine.restitution - coarse.restitution, 0.9, 1e-6);
  EXPECT_NEAR((2 * fine.duration - coarse.duration) / kTime, 1, 1e-6);
}

}  // namespace
}  // namespace slipcheck
