#include "physics/contact/collision.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "physics/motion/substrate_phase.h"

namespace slipcheck {
namespace {

/// Contribution of one body to the mobility matrix C [1/kg].
Matrix3 mobility(const Sphere& sphere, const Vector3& n, bool held) {
  const double spin = 1 / (sphere.shape_factor * sphere.mass);  // R²/I
  Matrix3 c = spin * (Matrix3::Identity() - n * n.transpose());
  c.diagonal().array() += 1 / sphere.mass;
  if (held) c(2, 2) -= 1 / sphere.mass;
  return c;
}

/// P with Δu_n = C P · n and the Coulomb cap; `change` is Δu of a sticking contact.
Vector3 impulse_for(const Matrix3& mobility, const Vector3& n, const Vector3& change,
                    double friction) {
  const double normal_change = n.dot(change);
  if (friction == 0) return normal_change / n.dot(mobility * n) * n;
  Vector3 sticking = mobility.inverse() * change;
  const double normal = n.dot(sticking);
  const Vector3 tangential = sticking - normal * n;
  const double size = tangential.norm();
  if (size <= friction * normal) return sticking;
  const Vector3 direction = n + (friction / size) * tangential;
  return normal_change / n.dot(mobility * direction) * direction;
}

void push(CollidingBody& body, const Vector3& impulse, bool held) {
  Vector3 dv = impulse / body.sphere.mass;
  if (held) dv.z() = 0;
  body.state.velocity += dv;
}

void turn(CollidingBody& body, const Vector3& n_cross_impulse) {
  body.state.angular_velocity -=
      (body.sphere.radius / body.sphere.moment_of_inertia()) * n_cross_impulse;
}

}  // namespace

CollisionResult collide(const PairContact& contact, const CollisionRule& rule, CollidingBody first,
                        CollidingBody second) {
  const Vector3 n = (first.state.position - second.state.position).normalized();
  const Vector3 u = first.state.velocity - second.state.velocity -
                    (first.sphere.radius * first.state.angular_velocity +
                     second.sphere.radius * second.state.angular_velocity)
                        .cross(n);
  const double un = n.dot(u);
  const double impact = std::max(0.0, -un);
  const double by_law = impact > 0 ? restitution_at(contact.restitution, impact) * impact : 0;
  const double rebound = std::max(by_law, rule.slowest_rebound);
  const Vector3 ut = u - un * n;
  const double friction = friction_at(contact.friction, ut.norm());
  const Vector3 change = (rebound - un) * n - (1 + contact.tangential_restitution) * ut;

  // Who is held follows from the sign of the vertical impulse, which follows from who is held: the
  // sign hardly ever changes, so two or three rounds settle it.
  bool hold_first = first.supported && rule.confined;
  bool hold_second = second.supported && rule.confined;
  Vector3 impulse;
  for (int round = 0; round < 4; ++round) {
    impulse =
        impulse_for(mobility(first.sphere, n, hold_first) + mobility(second.sphere, n, hold_second),
                    n, change, friction);
    if (rule.confined) break;
    // A vertical impulse within round-off lifts nobody.
    const double round_off = 64 * std::numeric_limits<double>::epsilon() * impulse.norm();
    const bool first_down = first.supported && impulse.z() <= round_off;
    const bool second_down = second.supported && impulse.z() >= -round_off;
    if (first_down == hold_first && second_down == hold_second) break;
    hold_first = first_down;
    hold_second = second_down;
  }

  push(first, impulse, hold_first);
  push(second, -impulse, hold_second);
  if (friction > 0) {
    // Both spins turn the same way: n×P is the same for P on the one side and −P on the other.
    turn(first, n.cross(impulse));
    turn(second, n.cross(impulse));
  }

  if (hold_first && impulse.z() < 0)
    apply_substrate_impulse(first.sphere, first.substrate, -impulse.z(), first.state);
  if (hold_second && impulse.z() > 0)
    apply_substrate_impulse(second.sphere, second.substrate, impulse.z(), second.state);
  return {impact, impulse, rebound > by_law};
}

}  // namespace slipcheck
