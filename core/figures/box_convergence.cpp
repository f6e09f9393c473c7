#include "figures/box_convergence.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "physics/contact/linear_contact.h"
#include "reference/events/planar_solver.h"
#include "reference/forces/soft_box_solver.h"

namespace slipcheck {
namespace {

constexpr std::size_t kDiscard = 200;  // periods

/// [s]
double after_periods(std::size_t count) {
  return static_cast<double>(kDiscard + count) / dilute_box().frequency;
}

BoxSampling after_discard() {
  BoxSampling sampling;
  sampling.discard = kDiscard;
  return sampling;
}

SolvedRun reached(const SolvedRun& run) {
  if (!run.reached) throw std::runtime_error("box convergence: " + run.reason);
  return run;
}

/// The same box with contacts that last and tend to its hard ones: where Coulomb's cap is not
/// reached the viscous force leaves exp(−slowing) of the slip, so that β0 = 0.
ContactScene softened(const Scene& hard, double collision_time, double slowing) {
  const Sphere& sphere = hard.bodies.front();
  const auto contact = [&](double reduced_mass) {
    const auto law = LinearContact::with_collision_time(reduced_mass, kConvergenceRestitution,
                                                        collision_time, ContactEnd::zero_force);
    SoftContact made;
    made.normal = LinearForce{law.stiffness(), law.damping_rate() * reduced_mass};
    made.end = ContactEnd::zero_force;
    const double mobility = (1 + 1 / sphere.shape_factor) / reduced_mass;  // 1/(κ m_eff)
    if (const double mu = std::get<double>(hard.pairs.front().friction); mu > 0)
      made.tangential = ViscousForce{slowing / (mobility * collision_time), mu};
    return made;
  };
  ContactScene scene;
  scene.hard = hard;
  scene.soft = {contact(0.5 * sphere.mass)};
  scene.soft_box.on_floor = scene.soft_box.on_wall = scene.soft_box.on_lid = {contact(sphere.mass)};
  return scene;
}

Scene few_spheres(double friction) {
  VibratedBox box;
  box.count = 6;
  box.spread = 0;
  box.width = 8;
  box.speed = 0.3;
  box.set_contacts(kConvergenceRestitution, friction, 0);
  Scene scene = box.scene();
  for (std::size_t i = 0; i < box.count; ++i) {
    const double k = static_cast<double>(i);
    const std::size_t row = i / 3;
    BodyState& state = scene.initial[i];
    state.position.x() = (1.1 + 2.4 * static_cast<double>(i % 3)) * box.diameter;
    state.position.z() = (1.5 + 2.0 * static_cast<double>(row)) * box.diameter;
    state.velocity = 0.35 * Vector3(std::sin(1 + 5 * k), 0, std::cos(3 * k));
    state.angular_velocity.y() = 500 * std::sin(2 + k);
  }
  return scene;
}

}  // namespace

TrajectoriesApart trajectories_apart(double friction, const std::vector<double>& collision_times) {
  constexpr double kSlowing = 100, kSteps = 100;
  const Scene hard = few_spheres(friction);
  const RunEnd end = until_time(kTrajectoryTime);
  PlanarSolver event(hard, hard.initial);
  reached(event.run(end, nullptr));
  const std::vector<BodyState> exact = event.states();
  TrajectoriesApart apart;
  for (double collision_time : collision_times) {
    const ContactScene scene = softened(hard, collision_time, kSlowing);
    SoftBoxSolver contact(scene, hard.initial, {kSteps});
    reached(contact.run(end, nullptr));
    const std::vector<BodyState> soft = contact.states();
    double x = 0, v = 0, w = 0;
    for (std::size_t i = 0; i < soft.size(); ++i) {
      x = std::max(x, (soft[i].position - exact[i].position).norm());
      v = std::max(v, (soft[i].velocity - exact[i].velocity).norm());
      w = std::max(w, (soft[i].angular_velocity - exact[i].angular_velocity).norm());
    }
    apart.position.push_back(x);
    apart.velocity.push_back(v);
    apart.surface.push_back(w * hard.bodies.front().radius);
  }
  return apart;
}

VibratedBox dilute_box() {
  VibratedBox box;
  box.count = 20;
  box.spread = 0;
  box.set_contacts(kConvergenceRestitution, kConvergenceFriction, 0);
  return box;
}

EventMeans dilute_box_by_events() {
  const VibratedBox box = dilute_box();
  const Scene scene = box.scene();
  PlanarSolver solver(scene, scene.initial);
  BoxObserver observer(scene, after_discard());
  const SolvedRun run =
      reached(solver.run(until_time(after_periods(40'000), 1 / box.frequency), &observer));
  const double taken_part = static_cast<double>(2 * run.collisions + run.contacts);
  return {observer.finish(), static_cast<double>(box.count) * run.end_time / taken_part};
}

BoxObservables dilute_box_by_contacts(double collision_time) {
  constexpr double kSlowing = 15, kSteps = 10;  // which makes 25 steps a contact
  const VibratedBox box = dilute_box();
  const ContactScene scene = softened(box.scene(), collision_time, kSlowing);
  SoftBoxSolver solver(scene, scene.hard.initial, {kSteps});
  BoxObserver observer(scene.hard, after_discard());
  reached(solver.run(until_time(after_periods(2000), 1 / box.frequency), &observer));
  return observer.finish();
}

}  // namespace slipcheck
