#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "../support/extremes.h"
#include "../support/runge_kutta.h"
#include "physics/contact/pair_insight.h"

namespace slipcheck::test {

/// Two spheres on a line that collide with the linear law and rub, on a level, still substrate: all
/// forces of K, integrated by Runge-Kutta with equal steps. Independent of core/physics. Changes of
/// mode (stick and slip, lift-off, end of contact) fall on steps, which is the error.
struct SoftPair {
  std::array<double, 2> m{2.6e-4, 2.6e-4}, A{2.5, 2.5}, mu_s{0, 0}, mu_k{0, 0};
  Vector2 v = Vector2::Zero();                           ///< sphere 0 behind; both begin rolling
  double k = 0, c = 0;                                   ///< stiffness, damping γ_N m̄
  double rubbing = 0;                                    ///< γ_S m̄
  double cap = std::numeric_limits<double>::infinity();  ///< ν_s
  double g = 9.81;
  bool confined = true;
  bool ends_at_zero_force = false;

  struct State {
    double overlap = 0;
    Vector2 v = Vector2::Zero(), w = Vector2::Zero();  ///< centres, surfaces RΩ
    double rise = 0;                                   ///< velocity of the lifted sphere
    double rubbed = 0;                                 ///< impulse of F_R

    State operator+(const State& d) const {
      return {overlap + d.overlap, v + d.v, w + d.w, rise + d.rise, rubbed + d.rubbed};
    }
    friend State operator*(double h, const State& d) {
      return {h * d.overlap, h * d.v, h * d.w, h * d.rise, h * d.rubbed};
    }
  };
  struct Result {
    State end;
    double time = 0, deepest = 0;
    double slides_from = std::numeric_limits<double>::infinity();
    double lifts_from = std::numeric_limits<double>::infinity();
    double largest_rubbing = 0;
  };

  double force(const State& y) const { return k * y.overlap + c * (y.v[0] - y.v[1]); }

  Result collide(int steps_per_radian = 20000) const {
    State y;
    y.v = y.w = v;
    Result out;
    const double reduced = m[0] * m[1] / (m[0] + m[1]);
    const double h = 1 / (std::sqrt(k / reduced) * steps_per_radian);
    const std::size_t up = v[0] + v[1] >= 0 ? 0 : 1;  // the sphere that rubbing lifts
    std::array<bool, 2> sliding{};
    bool lifted = false;
    const auto rubbing_of = [&](const State& s) {
      // Downward speed of the lifted sphere's surface past the other's.
      const double slip = std::copysign(1, v[0] + v[1]) * (s.w[0] + s.w[1]) - s.rise;
      return std::copysign(std::min(rubbing * std::abs(slip), cap * std::abs(force(s))), slip);
    };
    /// Substrate's friction that would keep the sphere rolling, along the line.
    const auto holding = [&](const State& s, std::size_t i) {
      const double push = i == 0 ? -force(s) : force(s);
      const double turn = std::copysign(1, v[0] + v[1]) * rubbing_of(s);
      return -(push + A[i] * turn) / (1 + A[i]);
    };
    const auto normal = [&](const State& s, std::size_t i) {
      return std::max(0.0, m[i] * g + (i == up ? -1 : 1) * rubbing_of(s));
    };
    const auto slope = [&](double, const State& s) {
      State d;
      d.overlap = s.v[0] - s.v[1];
      const double turn = std::copysign(1, v[0] + v[1]) * rubbing_of(s);
      for (std::size_t i : {0u, 1u}) {
        double f = holding(s, i);
        if (sliding[i]) {
          const double u = s.v[i] - s.w[i];
          f = u == 0 ? 0 : -std::copysign(mu_k[i] * normal(s, i), u);
        }
        if (i == up && lifted) f = 0;
        const double push = i == 0 ? -force(s) : force(s);
        d.v[i] = (push + f) / m[i];
        d.w[i] = -A[i] * (f + turn) / m[i];
      }
      if (lifted) d.rise = rubbing_of(s) / m[up] - g;
      d.rubbed = rubbing_of(s);
      return d;
    };
    double before = 0;
    for (long n = 0;; ++n) {
      out.time = static_cast<double>(n) * h;
      const double left = ends_at_zero_force ? force(y) : y.overlap;  // falls through zero
      if (n > 1 && left < 0) {
        out.time += h * left / (before - left);
        break;
      }
      before = left;
      for (std::size_t i : {0u, 1u})
        if (!sliding[i] && std::abs(holding(y, i)) > mu_s[i] * normal(y, i)) {
          sliding[i] = true;
          out.slides_from = std::min(out.slides_from, out.time);
        }
      if (!confined && !lifted && rubbing_of(y) > m[up] * g) {
        lifted = true;
        out.lifts_from = out.time;
      }
      y = runge_kutta_step(slope, out.time, y, h);
      out.deepest = test::largest_of(out.deepest, y.overlap);
      out.largest_rubbing = test::largest_of(out.largest_rubbing, rubbing_of(y));
    }
    out.end = y;
    return out;
  }

  /// From the end of the collision until sphere i rolls: time, displacement, velocity. The friction
  /// is constant, so the slip falls in a straight line and the last step ends on it exactly.
  struct Slid {
    double time, displacement, velocity;
  };
  Slid slide(const State& from, std::size_t i, double h = 1e-5) const {
    double v_i = from.v[i], w_i = from.w[i], x = 0, t = 0;
    const double u0 = v_i - w_i, f = -std::copysign(mu_k[i] * m[i] * g, u0);
    for (bool over = false; !over;) {
      const double u = v_i - w_i, rate = f / m[i] * (1 + A[i]);
      const double dt = (u + h * rate) * u0 > 0 ? h : -u / rate;
      over = dt != h;
      x += dt * v_i + 0.5 * dt * dt * f / m[i];
      v_i += dt * f / m[i];
      w_i -= dt * A[i] * f / m[i];
      t += dt;
    }
    return {t, x, v_i};
  }
};

enum class SubstrateFriction { off, on };

/// A pair for the integration. Without the substrate's friction in the collision, as K's
/// closed forms for v^f and Ω^f have it, both spheres are free to turn.
inline SoftPair integrated(const LinearContact& contact, const RollingPair& pair,
                           SubstrateFriction friction) {
  SoftPair soft;
  for (std::size_t i : {0u, 1u}) {
    const RollingSphere& s = pair.spheres[i];
    soft.m[i] = s.sphere.mass;
    soft.A[i] = s.sphere.inverse_shape_factor();
    soft.v[i] = s.speed;
    if (friction == SubstrateFriction::on) {
      soft.mu_s[i] = s.static_friction;
      soft.mu_k[i] = s.kinetic_friction;
    }
  }
  soft.k = contact.stiffness();
  soft.c = contact.damping_rate() * contact.reduced_mass();
  soft.rubbing = pair.rubbing_rate * contact.reduced_mass();
  soft.cap = pair.rubbing_friction;
  soft.g = pair.gravity;
  soft.confined = pair.confined;
  return soft;
}

}  // namespace slipcheck::test
