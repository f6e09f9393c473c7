#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "../scenes.h"
#include "harness/observe/blocking.h"
#include "lammps_bare.h"
#include "physics/contact/linear_contact.h"
#include "reference/piles/pile_solver.h"

// Spheres that fall into a container and come to rest, beside LAMMPS's gran/hooke/history between
// them and on five walls. Where each of them lies is chance, and a last bit changes it; how high
// they lie on average is not.

namespace slipcheck {
namespace {

constexpr double kBedTime = 1e-3;  // t_col of two [s]
constexpr double kBedStep = kBedTime / 50;
constexpr int kBedSteps = 25000;     // 0.5 s: a fall from 60 mm takes 0.11 s
constexpr double kBedRadius = 2e-3;  // [m]
constexpr double kBedSide = 10 * kBedRadius;
constexpr std::size_t kBedBodies = 75;

/// On a lattice that lets none touch, with velocities by chance.
Scene falling_bed(unsigned seed) {
  Scene scene = test::steel_scene(kBedBodies);
  scene.has_substrate = false;
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> speed(-0.3, 0.3);
  const int across = 4;
  const double apart = kBedSide / across;
  for (std::size_t i = 0; i < kBedBodies; ++i) {
    const auto k = static_cast<int>(i);
    const Vector3 cell(k % across, k / across % across, k / (across * across));
    scene.initial[i].position = apart * (cell + Vector3(0.5, 0.5, 0.5));
    for (int axis = 0; axis < 3; ++axis) scene.initial[i].velocity[axis] = speed(generator);
    scene.initial[i].angular_velocity = Vector3::Zero();
  }
  const double x = kBedSide;
  scene.surfaces = {Surface{PlaneShape{}, {}},
                    Surface{PlaneShape{Vector3::Zero(), Vector3::UnitX()}, {}},
                    Surface{PlaneShape{{x, 0, 0}, -Vector3::UnitX()}, {}},
                    Surface{PlaneShape{Vector3::Zero(), Vector3::UnitY()}, {}},
                    Surface{PlaneShape{{0, x, 0}, -Vector3::UnitY()}, {}}};
  scene.on_surfaces.resize(scene.surfaces.size());
  return scene;
}

/// e = 0.4 between two; a wall's spring has the same coefficients, as one line of LAMMPS's says.
test::HistoryLaw bed_law(double mass) {
  const LinearContact law =
      LinearContact::with_collision_time(mass / 2, 0.4, kBedTime, ContactEnd::zero_force);
  const double k = law.stiffness(), rate = law.damping_rate();
  return {false, k, 2.0 / 7 * k, rate, 0.5 * rate, 0.4};
}

struct Bed {
  double height = 0;  // of the centres, on average [m]
  double speed = 0;   // the largest [m/s]
};

Bed bed_of(const std::vector<BodyState>& states) {
  Bed bed;
  for (const BodyState& state : states) {
    bed.height += state.position.z() / static_cast<double>(states.size());
    bed.speed = std::max(bed.speed, state.velocity.norm());
  }
  return bed;
}

Bed bed_here(const Scene& scene) {
  ContactScene soft = with_hard_contacts(scene);
  const double mass = scene.bodies[0].mass;
  const test::HistoryLaw law = bed_law(mass);
  soft.soft.assign(soft.soft.size(), law.contact(mass / 2, kBedRadius / 2));
  soft.soft_surfaces.assign(scene.surfaces.size(), law.contact(mass, kBedRadius));
  PileSolver solver(soft, scene.initial, {.step = kBedStep});
  EXPECT_TRUE(solver.run(until_time(kBedSteps * kBedStep), nullptr).reached);
  return bed_of(solver.states());
}

Bed bed_by_lammps(const Scene& scene) {
  const test::HistoryLaw law = bed_law(scene.bodies[0].mass);
  const double margin = kBedRadius, top = 40 * kBedRadius;
  std::string in = test::bare_atoms(
      scene, {{-margin, -margin, -margin}, {kBedSide + margin, kBedSide + margin, top}});
  in += fmt::format("pair_style gran/{} {}\npair_coeff * *\n", law.style(), law.words());
  in += "neighbor 0.0005 bin\nneigh_modify delay 0 every 1 check yes\nfix motion all nve/sphere\n";
  in += fmt::format("fix weight all gravity {:.17g} vector 0 0 -1\n", scene.gravity);
  for (const std::string wall : {"zplane 0 NULL", "xplane 0 {0:.17g}", "yplane 0 {0:.17g}"})
    in += fmt::format("fix {} all wall/gran {} {} {}\n", wall.substr(0, 1), law.style(),
                      law.words(), fmt::format(fmt::runtime(wall), kBedSide));
  return bed_of(test::bare_lammps(in, kBedStep, kBedSteps, kBedSteps, scene.bodies.size()).back());
}

TEST(LammpsHistory, ABedSettlesToTheSameHeight) {
  const std::size_t count = 8;
  std::vector<double> here, there;
  for (unsigned seed = 1; seed <= count; ++seed) {
    const Scene scene = falling_bed(seed);
    const Bed own = bed_here(scene), other = bed_by_lammps(scene);
    // It lies: what still moves has fallen by less than a thousandth of a radius.
    EXPECT_LT(own.speed, std::sqrt(2 * scene.gravity * 1e-3 * kBedRadius));
    EXPECT_LT(other.speed, std::sqrt(2 * scene.gravity * 1e-3 * kBedRadius));
    here.push_back(own.height / kBedRadius);
    there.push_back(other.height / kBedRadius);
  }
  const auto mean = [](const std::vector<double>& all) {
    double sum = 0;
    for (const double each : all) sum += each;
    return sum / static_cast<double>(all.size());
  };
  const auto squares = [&](const std::vector<double>& all) {
    double sum = 0;
    for (const double each : all) sum += (each - mean(all)) * (each - mean(all));
    return sum;
  };
  const double n = static_cast<double>(count);
  const double error = std::sqrt((squares(here) + squares(there)) / (n * (n - 1)));
  const double difference = mean(here) - mean(there);
  fmt::print("height {:.4f} R here, {:.4f} R by LAMMPS, 95 % of the difference {:.4f} R\n",
             mean(here), mean(there), student_factor95(2 * count - 2) * error);
  RecordProperty("difference", fmt::format("{:.4f}", difference));
  EXPECT_LT(error, 0.02 * mean(there)) << "the means tell too little";
  // 99.8 % of Student's t with 14 degrees of freedom is 3.79: one run in 500 fails by chance.
  EXPECT_LT(std::abs(difference), 3.79 * error);
}

}  // namespace
}  // namespace slipcheck
