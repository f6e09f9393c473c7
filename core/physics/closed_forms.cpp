#include "physics/closed_forms.h"

#include <cmath>

namespace slipcheck {

Vector3 rolling_acceleration(double A, const Vector3& downhill, const Vector3& substrate) {
  return (A * downhill + substrate) / (1 + A);
}

double rolling_limit(double A, double static_friction, double normal) {
  return (1 + A) * static_friction * normal;
}

SlideToRoll::SlideToRoll(const Sphere& sphere, double kinetic_friction, double gravity,
                         const Vector3& velocity, const Vector3& angular_velocity) {
  const double A = sphere.inverse_shape_factor();
  const BodyState state{Vector3::Zero(), velocity, angular_velocity};
  slip = slip_velocity(state, sphere.radius);
  sliding_time = slip.norm() / ((1 + A) * kinetic_friction * gravity);
  momentum_change = slip / (1 + A);
  rolling_velocity = velocity - momentum_change;
  displacement = (velocity + rolling_velocity) * (0.5 * sliding_time);
  sliding_distance = displacement.norm();
  energy_change = velocity.squaredNorm() - rolling_velocity.squaredNorm();
}

double HeadOnCollision::velocity_after(double v_i, double v_j) const {
  return 0.5 * ((1 - restitution) * v_i + (1 + restitution) * v_j);
}

double HeadOnCollision::surface_velocity_after(double v_i, double v_j) const {
  return v_i - spin_exchange * (v_i + v_j);
}

double HeadOnCollision::slip_after(double v_i, double v_j) const {
  return velocity_after(v_i, v_j) - surface_velocity_after(v_i, v_j);
}

double HeadOnCollision::rolling_velocity(double v_i, double v_j) const {
  return velocity_after(v_i, v_j) - slip_after(v_i, v_j) / (1 + A);
}

double HeadOnCollision::effective_restitution() const { return (A * restitution - 1) / (1 + A); }

double HeadOnCollision::zero_sliding_distance_ratio() const {
  const double e = restitution, c = spin_exchange;
  return -((1 + 2 * A) * (1 + e) - 2 * c) / (3 + 2 * A - 2 * c - e * (1 + 2 * A));
}

double HeadOnCollision::symmetric_sliding_distance(double v_rel, double kinetic_friction,
                                                   double gravity) const {
  const double e = restitution;
  return v_rel * v_rel * (1 + e) * (e - 1 + 2 * e * A) /
         (8 * kinetic_friction * gravity * (1 + A) * (1 + A));
}

SymmetricLosses HeadOnCollision::symmetric_losses() const {
  const double e = restitution;
  return {(1 - e) * (1 + e), 1 - e, (1 + e) * (e - 1 + 2 * A * e) / ((1 + A) * (1 + A)),
          (1 + e) / (1 + A)};
}

}  // namespace slipcheck
