#include "physics/contact/step_limits.h"

#include <cmath>

namespace slipcheck {

double symplectic_euler_limit(double omega0, double gamma) {
  // (√(γ² + 4ω0²) − γ)/ω0² without the difference of like numbers.
  return 4 / (std::hypot(gamma, 2 * omega0) + gamma);
}

double velocity_verlet_limit(double omega0) { return 2 / omega0; }

double explicit_euler_limit(double omega0, double gamma) {
  const double half = 0.5 * gamma;
  if (half < omega0) return gamma / (omega0 * omega0);
  return 2 / (half + std::sqrt((half - omega0) * (half + omega0)));
}

double runge_kutta_limit(double omega0) { return 2 * std::sqrt(2.0) / omega0; }

}  // namespace slipcheck
