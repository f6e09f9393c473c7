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
#include "worker_run.h"

// Contacts that remember beside LAMMPS's gran/hooke/history and gran/hertz/history, of two spheres
// and of one on a wall, as bare input files and through the worker. LAMMPS takes velocities at the
// middle of the step into its dashpots and cuts a contact off at the end of the step in which it
// ends: with dashpots, or a spring that is bent when the contact ends, its error goes with the
// step.

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

ContactScene with_contacts(const Scene& scene, const SoftContact& contact) {
  ContactScene soft = with_hard_contacts(scene);
  soft.soft.assign(soft.soft.size(), contact);
  soft.soft_surfaces.assign(scene.surfaces.size(), contact);
  return soft;
}

ContactScene with_law(const Scene& scene, const HistoryCase& each) {
  const int bodies = each.wall ? 1 : 2;
  return with_contacts(scene,
                       each.law.contact(scene.bodies[0].mass / bodies, kHistoryRadius / bodies));
}

std::vector<BodyState> by_piles(const ContactScene& scene, int per_contact) {
  PileSolver solver(scene, scene.hard.initial, {.step = kHistoryTime / per_contact});
  EXPECT_TRUE(solver.run(until_time(1.5 * kHistoryTime), nullptr).reached);
  return solver.states();
}

std::vector<BodyState> by_worker(const ContactScene& scene, int per_contact) {
  RemoteEngine engine(test::peer_executable("lammps"), test::kPatient);
  const Settings steps = {{"substeps", 1.5 * per_contact}};
  return test::peer_run(engine, EngineScene(scene), steps, 1.5 * kHistoryTime, 1).back().bodies;
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
    const ContactScene here = with_law(scene, each);
    const std::vector<BodyState> exact = by_piles(here, 8000);
    const double own = difference(by_piles(here, 4000), exact);
    const double at_500 = difference(by_lammps(scene, each, 500), exact);
    const std::vector<BodyState> bare = by_lammps(scene, each, 1000);
    const double at_1000 = difference(bare, exact);
    // The same commands; or those of `granular`, which acts in the middle of the overlap, ξ/2 from
    // the surfaces, and on a region, which may be touched one step later.
    const std::vector<BodyState> worker = by_worker(here, 1000);
    EXPECT_LT(difference(worker, exact), 2e-4);
    if (!each.wall && !each.law.hertz) {
      EXPECT_LT(difference(worker, bare), 1e-10);
    }
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

/// What only pair style `granular` and fix wall/gran have, of e = 0.9, as their step falls.
TEST(LammpsHistory, TheWorkerHasTheSpringsOfTheScene) {
  const HistoryCase pair{"pair", false, M_PI / 6, {}}, wall{"wall", true, M_PI / 6, {}};
  const double R = kHistoryRadius;
  for (const HistoryCase* each : {&pair, &wall}) {
    Scene scene = history_scene(*each);
    const int bodies = each->wall ? 1 : 2;
    const double mass = scene.bodies[0].mass / bodies;
    const LinearContact law =
        LinearContact::with_collision_time(mass, 0.9, kHistoryTime, ContactEnd::zero_force);
    const double k = law.stiffness(), c = law.damping_rate() * mass;
    const double rho = 1.25 * mass * std::pow(kHistoryTime / 2.9433 * std::pow(0.3, 0.2), -2.5);
    using Form = SpringFriction::Form;
    const auto friction = [&](Form form, double coefficient) {
      SpringFriction made{form, (form == Form::constant ? 2.0 / 7 * k : 0.8 * rho), 0, 0.5};
      made.static_friction = made.kinetic_friction = coefficient;
      return made;
    };
    const auto contact = [&](const NormalForce& normal, const ContactMemory& memory) {
      SoftContact made{normal, ContactEnd::zero_force, NoTangentialForce{}, false};
      made.memory = memory;
      return made;
    };
    const SpringTorque turning{0.1 * k * R * R, 0.1 * c * R * R, 0.2 * R}, none;
    const ViscoelasticForce hertz{rho, 1e-6};
    const std::pair<const char*, SoftContact> all[] = {
        {"rolling", contact(LinearForce{k, c}, {friction(Form::constant, 0.3), turning, none})},
        {"drilling", contact(LinearForce{k, c}, {friction(Form::constant, 0.3), none, turning})},
        {"gives way", contact(LinearForce{k, c}, {friction(Form::constant, 0.05), turning, none})},
        {"mindlin", contact(hertz, {friction(Form::mindlin, 0.3), none, none})},
        {"mindlin, gives way", contact(hertz, {friction(Form::mindlin, 0.05), none, none})},
        {"mindlin, displacement",
         contact(hertz, {friction(Form::mindlin_displacement, 0.3), none, none})},
        {"mindlin, undamped",
         contact(HertzForce{rho}, {friction(Form::mindlin, 0.3), none, turning})},
    };
    for (const auto& [name, soft] : all) {
      SCOPED_TRACE(fmt::format("{}, {}", each->name, name));
      // LAMMPS turns no spring with the spin about the normal: that is for drilling alone.
      const Vector3 normal =
          each->wall ? Vector3(0, 0, 1) : Vector3(scene.initial[0].position.normalized());
      const bool drills = soft.memory->drilling.length > 0;
      scene.initial[0].angular_velocity =
          drills ? Vector3(60 * normal) : Vector3(60 * normal.cross(Vector3::UnitY()));
      const ContactScene here = with_contacts(scene, soft);
      const std::vector<BodyState> exact = by_piles(here, 8000);
      const double own = difference(by_piles(here, 4000), exact);
      const double at_1000 = difference(by_worker(here, 1000), exact);
      const double at_4000 = difference(by_worker(here, 4000), exact);
      fmt::print("{:5} {:22} own {:.1e}; LAMMPS at t_col/1000 {:.1e}, /4000 {:.1e}\n", each->name,
                 name, own, at_1000, at_4000);
      EXPECT_LT(at_1000, 2e-4);
      // It acts in the middle of the overlap, where the lever is shorter by ξ/2 < 1e-3 R.
      EXPECT_LT(at_4000, drills ? 1e-4 : std::max(0.6 * at_1000, 3e-5));
      SoftContact less = soft;  // what is looked at makes a difference
      (drills ? less.memory->drilling : less.memory->rolling) = none;
      if (soft.memory->rolling.length == 0 && !drills) less.memory->sliding = {};
      EXPECT_GT(difference(by_piles(with_contacts(scene, less), 1000), exact), 1e-3);
    }
  }
}

/// The slip of the first sphere's surface on the second's across the line of centres [m/s].
Vector3 slip_of(const std::vector<BodyState>& states, const Vector3& normal) {
  const Vector3 rate =
      states[0].velocity - states[1].velocity +
      kHistoryRadius * (states[0].angular_velocity + states[1].angular_velocity).cross(normal);
  return rate - rate.dot(normal) * normal;
}

/// What stands for a hard contact leaves −β0 of a slip that sticks where it holds by a spring; by
/// damping nothing of it is left.
TEST(LammpsHistory, AHardContactThatHoldsLeavesItsTangentialRestitution) {
  const HistoryCase oblique{"oblique", false, M_PI / 6, {}};
  Scene scene = history_scene(oblique);
  scene.initial[0].angular_velocity.setZero();
  const Vector3 normal = scene.initial[1].position.normalized();  // towards the second
  const Vector3 before = slip_of(scene.initial, normal);
  ASSERT_NEAR(before.norm(), 0.3 * std::sin(M_PI / 6), 1e-12);
  RemoteEngine engine(test::peer_executable("lammps"), test::kPatient);
  for (const double beta : {0.0, 0.5, 0.9}) {
    SCOPED_TRACE(beta);
    scene.pairs.assign(scene.pairs.size(), {1.0, 1e3, beta});
    const auto left = [&](const char* sticking_by) {
      const Settings settings = {{"substeps", 3000.0},
                                 {"collision_time", kHistoryTime},
                                 {"sticking_by", std::string(sticking_by)}};
      const auto frames = test::peer_run(engine, scene, settings, 1.5 * kHistoryTime, 1);
      return slip_of(frames.back().bodies, normal).dot(before) / before.squaredNorm();
    };
    // The line of centres turns by v_t t_col/(2 R) = 1e-3 while they touch.
    EXPECT_NEAR(left("spring"), -beta, 3e-3);
    EXPECT_NEAR(left("damping"), 0, 3e-3);
    EXPECT_NEAR(left("scene"), 0, 3e-3);
  }
}

}  // namespace
}  // namespace slipcheck
