#include "studies/stability/scene_variation.h"

#include <cassert>
#include <utility>
#include <variant>

namespace slipcheck {
namespace {

void drop_expectations(Scenario& scenario) {
  for (EngineRequest& request : scenario.compare.engines) request.expect.reset();
}

}  // namespace

Scenario with_mass_ratio(Scenario scenario, double q) {
  assert(q > 0 && scenario.bodies.size() >= 2);
  drop_expectations(scenario);
  scenario.bodies[1].sphere.mass *= q;
  return scenario;
}

Scenario with_speed(Scenario scenario, double speed) {
  assert(speed > 0 && scenario.bodies.size() >= 2);
  drop_expectations(scenario);
  Body &one = scenario.bodies[0], &other = scenario.bodies[1];
  const Vector3 apart = other.initial.position - one.initial.position;
  const Vector3 n = apart.normalized();
  const double closing = (one.initial.velocity - other.initial.velocity).dot(n);
  assert(closing > 0);
  const double factor = speed / closing;
  const double gap = apart.norm() - one.sphere.radius - other.sphere.radius;
  const Vector3 way = 0.5 * (factor - 1) * gap * n;
  one.initial.position -= way;
  other.initial.position += way;
  for (Body& body : scenario.bodies) {
    body.initial.velocity *= factor;
    body.initial.angular_velocity *= factor;
  }
  return scenario;
}

Scenario with_restitution(Scenario scenario, double restitution) {
  assert(restitution >= 0 && restitution <= 1);
  drop_expectations(scenario);
  for (BodyContact& contact : scenario.contacts) {
    if (auto* hard = std::get_if<HardNormal>(&contact.normal)) {
      if (auto* number = std::get_if<double>(&hard->restitution)) *number = restitution;
    } else if (auto* linear = std::get_if<LinearNormal>(&contact.normal)) {
      assert(restitution > 0);
      linear->restitution = restitution;
      linear->damping_rate.reset();
    }
  }
  return scenario;
}

Scenario with_stiffness(Scenario scenario, double stiffness) {
  assert(stiffness > 0);
  drop_expectations(scenario);
  for (BodyContact& contact : scenario.contacts)
    if (auto* linear = std::get_if<LinearNormal>(&contact.normal)) {
      linear->stiffness = stiffness;
      linear->collision_time.reset();
    }
  return scenario;
}

}  // namespace slipcheck
