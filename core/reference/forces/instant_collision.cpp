#include "reference/forces/instant_collision.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/contact/elastic_pair.h"
#include "reference/forces/contact_solver.h"
#include "scene/impact.h"
#include "scene/ode.h"

namespace slipcheck {
namespace {

/// Part of the time in which a body goes by its own radius.
constexpr double kShortest = 1e-9;
/// What the weight changes of the approach meanwhile: it only keeps on the plane what lies there.
constexpr double kWeight = 1e-9;
/// A contact that lasts so many of its own times stays.
constexpr double kLongest = 1e3;

struct Modulus {
  double factor;
  void operator()(LinearForce& law) const { law.stiffness *= factor; }
  template <class Law>
  void operator()(Law& law) const {
    law.modulus *= factor;
  }
};

/// The same impact in another time T [s] and length L, both `s` times what they are.
NormalForce shortened(NormalForce force, const ImpactScales& scales, double mass, double speed,
                      double s) {
  std::visit(Modulus{std::pow(s, -(1 + scales.law.alpha))}, force);
  return with_dissipation(force, mass, speed, scales.dissipation);
}

TangentialForce shortened(TangentialForce force, double s) {
  if (auto* viscous = std::get_if<ViscousForce>(&force)) viscous->damping /= s;
  if (auto* asperity = std::get_if<AsperityForce>(&force)) asperity->size *= s;
  return force;
}

double surface_speed(const CollidingBody& body) {
  return body.state.velocity.norm() + body.sphere.radius * body.state.angular_velocity.norm();
}

}  // namespace

CollisionResult InstantCollision::collide(const CollisionRule& rule, CollidingBody first,
                                          CollidingBody second) const {
  const Vector3 between = first.state.position - second.state.position;
  const Vector3 n = between.normalized();
  const auto closing = [&](const BodyState& a, const BodyState& b) {
    return -n.dot(a.velocity - b.velocity);
  };
  const double speed = closing(first.state, second.state);
  const auto as_hard = [&] { return slipcheck::collide(hard_, rule, first, second); };
  if (!(speed > rule.slowest_rebound)) return as_hard();

  const double mass = effective_mass(first.sphere, second.sphere);
  if (std::holds_alternative<NoTangentialForce>(soft_.tangential) && n.z() == 0) {
    // Nothing but the impulse along the plane, which the normal law has by itself.
    PairContact alone{hard_.restitution};
    if (!std::holds_alternative<double>(alone.restitution))
      alone.restitution = impact(soft_.normal, mass, speed, soft_.end).restitution;
    return slipcheck::collide(alone, rule, first, second);
  }
  const ImpactScales scales = impact_scales(soft_.normal, mass, speed);
  const double fastest = std::max(surface_speed(first), surface_speed(second));
  const double time =
      softness_ * kShortest * std::min(first.sphere.radius, second.sphere.radius) / fastest;
  const double s = time / scales.time;

  ContactScene scene;
  Scene& hard = scene.hard;
  hard.bodies = {first.sphere, second.sphere};
  hard.material = {0, 1};
  hard.substrate = {first.substrate, second.substrate};
  hard.pairs.assign(4, hard_);
  hard.gravity = softness_ * kWeight * speed / time;
  hard.confined = rule.confined;
  SoftContact soft = soft_;
  soft.normal = shortened(soft.normal, scales, mass, speed, s);
  soft.tangential = shortened(soft.tangential, s);
  scene.soft.assign(4, soft);

  // A little before they touch, seen from between them.
  const double before = 0.01 * time;
  const Vector3 origin(second.state.position.x(), second.state.position.y(), 0);
  for (const CollidingBody* body : {&first, &second}) {
    BodyState state = body->state;
    state.position -= origin + before * state.velocity;
    if (body->supported) {
      state.position.z() = body->sphere.radius;
      state.velocity.z() = 0;
    }
    hard.initial.push_back(state);
  }
  ContactSolver solver(scene, hard.initial);
  const double contact = first.sphere.radius + second.sphere.radius;
  for (double end = before + 3 * time;; end += 0.5 * time) {
    const SolvedRun run = solver.run(until_time(end), nullptr);
    if (run.failed) throw IntegrationFailure("the collision at an instant: " + run.reason);
    const std::vector<BodyState> states = solver.states();
    const bool is_apart = (states[0].position - states[1].position).norm() >= contact &&
                          closing(states[0], states[1]) < 0;
    if (!is_apart && end < kLongest * time) continue;
    if (-closing(states[0], states[1]) < rule.slowest_rebound) return as_hard();
    CollisionResult result{.impact_speed = speed};
    // The substrate has no part in what lifts a body, but where both are held.
    const bool second_rises = states[1].velocity.z() - second.state.velocity.z() >
                              states[0].velocity.z() - first.state.velocity.z();
    result.impulse =
        second_rises ? Vector3(second.sphere.mass * (second.state.velocity - states[1].velocity))
                     : Vector3(first.sphere.mass * (states[0].velocity - first.state.velocity));
    const auto take = [](CollidingBody& body, const BodyState& after) {
      body.state.velocity = after.velocity;
      body.state.angular_velocity = after.angular_velocity;
    };
    take(first, states[0]);
    take(second, states[1]);
    return result;
  }
}

std::vector<std::shared_ptr<const CollisionLaw>> instant_collisions(const ContactScene& scene,
                                                                    double softness) {
  std::vector<std::shared_ptr<const CollisionLaw>> laws(scene.soft.size());
  for (std::size_t k = 0; k < laws.size(); ++k)
    if (scene.soft[k])
      laws[k] = std::make_shared<InstantCollision>(*scene.soft[k], scene.hard.pairs[k], softness);
  return laws;
}

}  // namespace slipcheck
