#include "physics/contact/pair_insight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/safe_root.h"

namespace slipcheck {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// ẍ + γ ẋ + ω0² x = 0 from x = 0, ẋ = 1: force per mass ω0² x + γ ẋ.
struct Oscillator {
  double omega0, gamma;

  double force(double t) const {
    const double half = 0.5 * gamma, square = (omega0 - half) * (omega0 + half);
    const double w = std::sqrt(std::abs(square));
    const double s = w == 0 ? t : (square > 0 ? std::sin(w * t) : std::sinh(w * t)) / w;
    const double c = square > 0 ? std::cos(w * t) : std::cosh(w * t);
    return std::exp(-half * t) * (omega0 * omega0 * s + gamma * (c - half * s));
  }
  /// When the force is largest. It is −ẍ, and each derivative turns the phase of x by π − φ with
  /// cos φ = γ/(2 ω0): the force's derivative is zero at ωt = 3φ − π, before the first touch from
  /// γ = ω0 on.
  double peak_time() const {
    if (gamma >= omega0) return 0;
    const double phase = std::acos(0.5 * gamma / omega0);
    return (3 * phase - M_PI) / std::sqrt((omega0 - 0.5 * gamma) * (omega0 + 0.5 * gamma));
  }
};

/// F_N at which a rolling sphere begins to slide [N].
double sliding_force(const RollingSphere& s, double gravity) {
  return (1 + s.sphere.inverse_shape_factor()) * s.static_friction * s.sphere.mass * gravity;
}

/// B = Σ A/m: the vertical force F_R takes B F_R from the surface speed in unit time.
double turning_mobility(const RollingPair& pair) {
  double sum = 0;
  for (const RollingSphere& s : pair.spheres)
    sum += s.sphere.inverse_shape_factor() / s.sphere.mass;
  return sum;
}

SlidingOnset sliding_onset(const LinearContact& contact, const RollingPair& pair) {
  const double force = std::min(sliding_force(pair.spheres[0], pair.gravity),
                                sliding_force(pair.spheres[1], pair.gravity));
  const double v = pair.closing_speed(), omega0 = contact.contact_frequency();
  const double damping = contact.damping_rate() * contact.reduced_mass();
  SlidingOnset onset;
  onset.overlap = force / contact.stiffness();
  onset.time = onset.overlap / v;
  onset.v_b = onset.overlap * omega0;
  onset.v_c = damping > 0 ? force / damping : kInfinity;

  // While both roll, a sphere's inertia is m (1 + A)/A.
  double inverse_mass = 0;
  for (const RollingSphere& s : pair.spheres) {
    const double A = s.sphere.inverse_shape_factor();
    inverse_mass += A / ((1 + A) * s.sphere.mass);
  }
  const Oscillator rolling{std::sqrt(contact.stiffness() * inverse_mass), damping * inverse_mass};
  const double threshold = force * inverse_mass, peak = rolling.peak_time();
  onset.sliding_speed = threshold / rolling.force(peak);
  if (v * rolling.force(0) >= threshold) {
    onset.exact_time = 0;
  } else if (v <= onset.sliding_speed) {
    onset.exact_time = kInfinity;
  } else {
    // F_N grows steadily up to its peak.
    onset.exact_time =
        first_true(0, peak, [&](double t) { return v * rolling.force(t) >= threshold; });
  }
  return onset;
}

AfterCollision after_collision(const RollingPair& pair, std::size_t k, double impulse,
                               double rubbing_impulse) {
  const RollingSphere& s = pair.spheres[k];
  const double A = s.sphere.inverse_shape_factor();
  const double turned = std::copysign(rubbing_impulse, pair.surface_speed()) * A / s.sphere.mass;
  AfterCollision after;
  after.velocity = s.speed + (k == 0 ? -impulse : impulse) / s.sphere.mass;
  after.surface_velocity = s.speed - turned;
  const SlideToRoll slide(s.sphere, s.kinetic_friction, pair.gravity, {after.velocity, 0, 0},
                          {0, after.surface_velocity / s.sphere.radius, 0});
  after.slip = slide.slip.x();
  after.sliding_time = slide.sliding_time;
  after.sliding_distance = slide.displacement.x();
  after.rolling_velocity = slide.rolling_velocity.x();
  after.energy_change = slide.energy_change;
  after.momentum_change = slide.momentum_change.x();
  return after;
}

Jump jump(const LinearContact& contact, const RollingPair& pair, const Rubbing& rubbing) {
  Jump result;
  result.sphere = pair.surface_speed() >= 0 ? 0 : 1;
  result.speed = rubbing.lift_off_speed;
  result.time = 2 * result.speed / pair.gravity;
  result.height = 0.5 * result.speed * result.speed / pair.gravity;

  const double weight =
      pair.spheres[static_cast<std::size_t>(result.sphere)].sphere.mass * pair.gravity;
  const Oscillator sliding{contact.contact_frequency(), contact.damping_rate()};
  const double largest_force =
      contact.reduced_mass() * pair.closing_speed() * sliding.force(sliding.peak_time());
  const bool can =
      pair.rubbing_rate > 0 && !pair.confined && pair.rubbing_friction * largest_force > weight;
  result.v_d = can ? weight / (pair.rubbing_rate * contact.reduced_mass()) : kInfinity;
  return result;
}

}  // namespace

PairInsight pair_insight(const LinearContact& contact, const RollingPair& pair) {
  const double v = pair.closing_speed(), m = contact.reduced_mass(), g = pair.gravity;
  const auto& [first, second] = pair.spheres;
  PairInsight out;
  out.collision_time = contact.collision_time();
  out.contact_frequency = contact.contact_frequency();
  out.damping_ratio = contact.damping_ratio();
  out.restitution = contact.restitution();
  out.largest_overlap = contact.largest_overlap(v);
  const double braking = (first.kinetic_friction + second.kinetic_friction) * g;
  out.v_a = 0.5 * braking / out.contact_frequency;
  out.collision_time_change = collision_time_change(braking, v, out.contact_frequency);
  out.largest_overlap_change = largest_overlap_change(braking, v, out.contact_frequency);

  const double mobility = turning_mobility(pair);
  out.rubbing_constant = rubbing_constant(m * mobility, pair.rubbing_rate, out.contact_frequency);
  out.exponential_share = rubbed_share(out.rubbing_constant);
  const RollingSphere& lifted = pair.surface_speed() >= 0 ? first : second;
  out.rubbing =
      rub(contact, {v, std::abs(pair.surface_speed()), pair.rubbing_rate, pair.rubbing_friction,
                    mobility, lifted.sphere.mass, g, pair.confined});

  out.onset = sliding_onset(contact, pair);
  out.slides = v > out.onset.sliding_speed;
  if (out.slides) {
    // The sphere that slides first, or either of two like ones.
    const RollingSphere& s = sliding_force(first, g) <= sliding_force(second, g) ? first : second;
    const double rolls = std::min(out.onset.time, out.collision_time);
    out.substrate_turning =
        s.sphere.inverse_shape_factor() * g *
        (0.5 * s.static_friction * rolls + s.kinetic_friction * (out.collision_time - rolls));
  }
  const double impulse = m * (1 + out.restitution) * v;
  for (const std::size_t k : {0u, 1u})
    out.after[k] = after_collision(pair, k, impulse, out.rubbing.impulse);
  out.effective_restitution = (out.after[1].rolling_velocity - out.after[0].rolling_velocity) / v;
  out.jump = jump(contact, pair, out.rubbing);
  return out;
}

// ξ̈ + ω0² ξ = a: ξ = (a/ω0²)(1 − cos ω0 t) + (v/ω0) sin ω0 t has its largest value
// a/ω0² + √((a/ω0²)² + (v/ω0)²) and is zero at ω0 t = π + 2 atan(a/(v ω0)).
double collision_time_change(double braking, double closing_speed, double contact_frequency) {
  return 2 * braking / (M_PI * closing_speed * contact_frequency);
}

double largest_overlap_change(double braking, double closing_speed, double contact_frequency) {
  return braking / (closing_speed * contact_frequency);
}

}  // namespace slipcheck
