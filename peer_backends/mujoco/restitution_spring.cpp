#include "peer_backends/mujoco/restitution_spring.h"

#include <cmath>

namespace slipcheck::mujoco {
namespace {

/// Duration of the contact times ω0: 2 acos(ζ)/√(1 − ζ²), which is 2 at ζ = 1.
double scaled_duration(double zeta) {
  const double root = std::sqrt(std::abs(1 - zeta * zeta));
  if (root < 1e-8) return 2;
  return 2 * (zeta < 1 ? std::acos(zeta) : std::acosh(zeta)) / root;
}

}  // namespace

double rebound_of(double damping_ratio) {
  return std::exp(-damping_ratio * scaled_duration(damping_ratio));
}

Spring spring_of(double restitution, double duration) {
  // e falls with ζ, from 1 at 0 and about as 1/(4 ζ²) in the end.
  double low = 0, high = 1;
  while (rebound_of(high) > restitution) high *= 2;
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2;
    (rebound_of(middle) > restitution ? low : high) = middle;
  }
  const double omega = scaled_duration(low) / duration;
  return {omega * omega, 2 * low * omega};
}

}  // namespace slipcheck::mujoco
