#include "figures/steel_pair.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "reference/forces/contact_solver.h"

namespace slipcheck {

std::string steel_caption() {
  return fmt::format(
      "Steel, R = {:g} mm, ρ = {:g} g/cm³, e_n = {:g} unless said otherwise, linear contact until "
      "the overlap is zero "
      "with t_{{col}} = {:g} µs (v_{{rel}}/10 cm/s)^{{−1/5}}, γ_S = {:g} γ_N, ν_s = {:g}, μ_s = "
      "{:g}, μ_k = "
      "{:g}, g = {:g} cm/s².",
      1e3 * kSteel.radius, 1e-3 * kSteel.density, SteelPair{}.restitution,
      1e6 * kSteel.collision_time, kSteel.rubbing_ratio, kSteel.rubbing_friction,
      kSteel.static_friction, kSteel.kinetic_friction, 100 * kSteel.gravity);
}

double steel_collision_time(double v_rel) {
  return kSteel.collision_time * std::pow(v_rel / 0.1, -0.2);
}

double left_out_by_k(double v_rel) { return kSteel.gravity * steel_collision_time(v_rel) / v_rel; }

Sphere steel_sphere() {
  return {kSteel.radius, kSteel.density * 4 * M_PI / 3 * std::pow(kSteel.radius, 3), 2.0 / 5};
}

LinearContact SteelPair::contact() const {
  return LinearContact::with_collision_time(steel_sphere().mass / 2, restitution,
                                            steel_collision_time(v_i - v_j),
                                            ContactEnd::zero_overlap);
}

RollingPair SteelPair::rolling() const {
  RollingPair pair;
  for (const std::size_t k : {0u, 1u})
    pair.spheres[k] = {steel_sphere(), k == 0 ? v_i : v_j, kSteel.static_friction,
                       kSteel.kinetic_friction};
  pair.gravity = kSteel.gravity;
  pair.rubbing_rate = rubbing_ratio * contact().damping_rate();
  pair.rubbing_friction = kSteel.rubbing_friction;
  pair.confined = confined;
  return pair;
}

ContactScene SteelPair::scene(double lead) const {
  Scene hard;
  hard.gravity = kSteel.gravity;
  SubstrateContact substrate;
  substrate.static_friction = kSteel.static_friction;
  substrate.kinetic_friction = kSteel.kinetic_friction;
  hard.substrate = {substrate};
  hard.pairs = {{restitution, 0.0, -1.0}};
  hard.bodies.assign(2, steel_sphere());
  hard.material = {0, 0};
  hard.confined = confined;
  hard.initial.resize(2);
  for (const std::size_t k : {0u, 1u}) {
    BodyState& state = hard.initial[k];
    const double v = k == 0 ? v_i : v_j;
    state.velocity = {v, 0, 0};
    state.position = {(k == 0 ? -kSteel.radius : kSteel.radius) - lead * v, 0, kSteel.radius};
    state.angular_velocity = rolling_angular_velocity(state.velocity, kSteel.radius);
  }
  ContactScene made = with_hard_contacts(std::move(hard));
  const LinearContact law = contact();
  const double mass = law.reduced_mass();
  made.soft[0] =
      SoftContact{LinearForce{law.stiffness(), law.damping_rate() * mass}, ContactEnd::zero_overlap,
                  ViscousForce{rubbing_ratio * law.damping_rate() * mass, kSteel.rubbing_friction}};
  return made;
}

ReferenceResult SteelPair::solve() const {
  const ContactScene made = scene();
  const ReferenceSolver solver(made, Compare::Reference::contact);
  ReferenceResult result = run_reference(solver, {Run::Until::rolling, 0, 10}, {"i", "j"});
  if (!result.run.reached)
    throw std::runtime_error("a figure's collision was not solved: " + result.run.reason);
  return result;
}

std::vector<BodyState> states_at(const ContactScene& scene, double time) {
  ContactSolver solver(scene, scene.hard.initial);
  const SolvedRun run = solver.run(until_time(time), nullptr);
  if (!run.reached) throw std::runtime_error("a figure's scene was not solved: " + run.reason);
  return solver.states();
}

double surface_velocity(const BodyState& state, double radius) {
  return radius * state.angular_velocity.y();
}

double value_of(const ReferenceResult& result, const std::string& name) {
  const auto found = result.observables.find(name);
  return found == result.observables.end() ? kNotObserved : found->second.value;
}

}  // namespace slipcheck
