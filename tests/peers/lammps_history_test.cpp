#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "../scenes.h"
#include "lammps_bare.h"
#include "physics/contact/linear_contact.h"
#include "reference/piles/pile_solver.h"

// Contacts that remember beside LAMMPS's gran/hooke/history and gran/hertz/history, of two spheres
// and of one on a wall, as bare input files. LAMMPS takes velocities at the middle of the step into
// its dashpots and cuts a contact off at the end of the step in which it ends: with dashpots, or a
// spring that is bent when the contact ends, its error goes with the step.

namespace slipcheck {
namespace {

constexpr double kHistoryTime = 2.55e-5;  // t_col [s]
constexpr double kHistoryRadius = 0.002;

/// What one case is: two spheres, or one on a wall.
struct HistoryCase {
  const char* name;
  bool wall = false;
  double angle = 0;  // of the line of centres to the way they come
  test::HistoryLaw law;
};

Scene history_scene(const HistoryCase& each) {
  Scene scene = test::free_pair(0.15, -0.15);
  scene.has_substrate = false;
  const Vector3 apart(-kHistoryRadius * std::cos(each.angle), kHistoryRadius * std::sin(each.angle),
                      0);
  scene.initial[0].position = apart;
  scene.initial[1].position = -apart;
  if (each.angle != 0) scene.initial[0].angular_velocity = {3, -5, 20};
  if (!each.wall) return scene;
  // LAMMPS does not turn a spring with the spin about the normal, as here: 20 rad/s make 4e-5.
  scene.initial[0].angular_velocity.z() = 0;
  scene.bodies.resize(1);
  scene.material.resize(1);
  scene.initial.resize(1);
  scene.initial[0].position = {0, 0, kHistoryRadius};
  scene.initial[0].velocity = {-0.3 * std::sin(each.angle), 0, -0.3 * std::cos(each.angle)};
  scene.surfaces = {Surface{PlaneShape{}, {}}};
  scene.on_surfaces.resize(1);
  return scene;
}

std::vector<BodyState> by_lammps(const Scene& scene, const HistoryCase& each, int per_contact) {
  std::string in = test::bare_atoms(scene, {{-1, -1, -1}, {1, 1, 1}});
  in += fmt::format("pair_style gran/{} {}\npair_coeff * *\n", each.law.style(), each.law.words());
  in += "neighbor 0.0005 nsq\nneigh_modify delay 0 every 1 check yes\nfix 1 all nve/sphere\n";
  if (each.wall)
    in += fmt::format("fix 2 all wall/gran {} {} zplane 0 NULL\n", each.law.style(),
                      each.law.words());
  const int steps = 3 * per_contact / 2;
  return test::bare_lammps(in, kHistoryTime / per_contact, steps, steps, scene.bodies.size())
      .back();
}

std::vector<BodyState> by_piles(const Scene& scene, const HistoryCase& each, int per_contact) {
  ContactScene soft = with_hard_contacts(scene);
  const double mass = scene.bodies[0].mass / (each.wall ? 1 : 2);
  const SoftContact contact = each.law.contact(mass, kHistoryRadius / (each.wall ? 1 : 2));
  soft.soft.assign(soft.soft.size(), contact);
  if (each.wall) soft.soft_surfaces = {contact};
  PileSolver solver(soft, scene.initial, {.step = kHistoryTime / per_contact});
  EXPECT_TRUE(solver.run(until_time(1.5 * kHistoryTime), nullptr).reached);
  return solver.states();
}

/// The largest difference of velocities and of R Ω, over the speed of approach.
double difference(const std::vector<BodyState>& a, const std::vector<BodyState>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most =
        std::max({most, (a[i].velocity - b[i].velocity).norm() / 0.3,
                  kHistoryRadius * (a[i].angular_velocity - b[i].angular_velocity).norm() / 0.3});
  return most;
}

std::vector<HistoryCase> history_cases() {
  const double pair_mass = test::free_pair(0, 0).bodies[0].mass / 2;
  const auto hooke = [&](double mass, double e, double friction) {
    const LinearContact law =
        LinearContact::with_collision_time(mass, e, kHistoryTime, ContactEnd::zero_force);
    return test::HistoryLaw{false,
                            law.stiffness(),
                            2.0 / 7 * law.stiffness(),
                            law.damping_rate(),
                            0.5 * law.damping_rate(),
                            friction};
  };
  const auto hertz = [&](double mass, double radius, double damping, double friction) {
    const double rho = 1.25 * mass * std::pow(kHistoryTime / 2.9433 * std::pow(0.3, 0.2), -2.5);
    const double k = rho / std::sqrt(radius);
    return test::HistoryLaw{true, k, 0.8 * k, damping, 0.5 * damping, friction};
  };
  const double R = kHistoryRadius, rate = 2e9;
  return {
      {"hooke, pair, central", false, 0, hooke(pair_mass, 0.9, 0.3)},
      {"hooke, pair, oblique", false, M_PI / 6, hooke(pair_mass, 0.9, 0.3)},
      {"hooke, pair, sliding", false, M_PI / 3, hooke(pair_mass, 0.9, 0.05)},
      {"hooke, wall, central", true, 0, hooke(2 * pair_mass, 0.9, 0.3)},
      {"hooke, wall, oblique", true, M_PI / 6, hooke(2 * pair_mass, 0.9, 0.3)},
      {"hertz, pair, central", false, 0, hertz(pair_mass, R / 2, rate, 0.3)},
      {"hertz, pair, oblique", false, M_PI / 6, hertz(pair_mass, R / 2, rate, 0.3)},
      {"hertz, pair, elastic", false, M_PI / 6, hertz(pair_mass, R / 2, 0, 0.3)},
      {"hertz, wall, oblique", true, M_PI / 6, hertz(2 * pair_mass, R, rate, 0.3)},
  };
}

TEST(LammpsHistory, ComesToTheSameAsItsStepFalls) {
  for (const HistoryCase& each : history_cases()) {
    SCOPED_TRACE(each.name);
    const Scene scene = history_scene(each);
    // Its own error is far below LAMMPS's: to second order at four times the steps.
    const std::vector<BodyState> exact = by_piles(scene, each, 8000);
    const double own = difference(by_piles(scene, each, 4000), exact);
    const double at_500 = difference(by_lammps(scene, each, 500), exact);
    const double at_1000 = difference(by_lammps(scene, each, 1000), exact);
    const double at_4000 = difference(by_lammps(scene, each, 4000), exact);
    RecordProperty(each.name,
                   fmt::format("{:.2e} {:.2e} {:.2e} {:.2e}", own, at_500, at_1000, at_4000));
    fmt::print("{:24} own {:.1e}; LAMMPS at t_col/500 {:.1e}, /1000 {:.1e}, /4000 {:.1e}\n",
               each.name, own, at_500, at_1000, at_4000);
    // Hertz's oblique contact on the wall is not yet as near as the others: 4.4e-5, 1.2e-4.
    const bool is_far = std::string_view(each.name) == "hertz, wall, oblique";
    EXPECT_LT(own, is_far ? 1e-4 : 2e-6);
    EXPECT_LT(at_1000, is_far ? 2e-4 : 1e-4);
    EXPECT_LT(at_4000, std::max(0.6 * at_1000, 1e-5));
  }
}

}  // namespace
}  // namespace slipcheck
