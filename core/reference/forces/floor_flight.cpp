#include "reference/forces/floor_flight.h"

#include <algorithm>
#include <cmath>

#include "physics/numbers.h"
#include "physics/safe_root.h"

namespace slipcheck {
namespace {

/// The first t in [from, horizon] at which gap(t) = y + v t + ½ a t² − A sin(ω (start + t)) is zero
/// and falls, in steps that never pass it.
double first_contact(double A, double omega, double start, double y, double v, double a,
                     double from, double horizon) {
  const double M = std::abs(a) + std::abs(A) * omega * omega;
  double t = from;
  while (t <= horizon) {
    const double phase = omega * (start + t);
    const double gap = y + (v + 0.5 * a * t) * t - A * std::sin(phase);
    const double closing = A * omega * std::cos(phase) - (v + a * t);
    // Below this a gap is rounding, of the heights and of the phase.
    const double touching = 4 * kEpsilon * (std::abs(y) + std::abs(A) * (1 + std::abs(phase)));
    if (gap <= touching && closing > 0) return t;
    const double open = std::max(gap, touching);
    const double step = step_to_bound(open, -closing, M);
    if (step == kNever) return kNever;
    const double next = t + step;
    if (next > t) {
      t = next;
    } else if (closing > 0) {
      return t;  // time itself cannot tell them apart
    } else {
      t = std::nextafter(t, kNever);
    }
  }
  return kNever;
}

/// When a parabola falls below a height h under its start [m], >= 0.
double time_to_fall(double h, double v, double g) {
  if (g == 0) return v < 0 ? h / -v : kNever;
  const double root = std::sqrt(v * v + 2 * g * h);
  if (v > 0) return (v + root) / g;
  return root > v ? 2 * h / (root - v) : 0;
}

}  // namespace

double floor_contact(const ShakenFloor& floor, double start, double y, double v, double g,
                     double horizon) {
  if (floor.is_still()) {
    const double t = time_to_fall(std::max(y, 0.0), v, g);
    return t <= horizon ? t : kNever;
  }
  // No floor is higher than A0.
  const double from = y > floor.amplitude ? time_to_fall(y - floor.amplitude, v, g) : 0;
  return first_contact(floor.amplitude, floor.angular_frequency(), start, y, v, -g, from, horizon);
}

double lid_contact(const ShakenFloor& lid, double start, double gap, double v, double g,
                   double horizon) {
  // The gap is l' − v t + ½ g t² + A0 sin(ω t).
  const double A = lid.is_still() ? 0 : lid.amplitude;
  return first_contact(-A, lid.angular_frequency(), start, gap, -v, g, 0, horizon);
}

}  // namespace slipcheck
