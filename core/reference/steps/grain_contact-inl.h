// Two grains in contact; included once for each instruction set.
#if defined(SLIPCHECK_GRAIN_CONTACT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_GRAIN_CONTACT_INL_H
#undef SLIPCHECK_GRAIN_CONTACT_INL_H
#else
#define SLIPCHECK_GRAIN_CONTACT_INL_H
#endif

#include <algorithm>
#include <cmath>

#include "reference/steps/grain_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {

/// What a loop is made for, of GrainFeatures.
template <bool linear, bool rubs, bool on_plane, bool driven, bool uneven = false,
          bool lifts = false, bool rolls = false, bool walls = false>
struct GrainHas {
  static constexpr bool kLinear = linear, kRubs = rubs, kOnPlane = on_plane, kDriven = driven;
  static constexpr bool kUneven = uneven, kLifts = lifts, kRolls = rolls;
  static constexpr bool kWalls = walls;
};

/// StepLoop's contact of two bodies (K (1)-(6)), written out for grains whose centres stay in the
/// plane. With the direction n to the first and t = k̂×n, the slip has the parts u_t and, where
/// grains roll, u_z. Centres of unlike grains, and of those that leave the substrate, lie at unlike
/// heights: n is not level then, and all have three parts.
template <class Has>
class GrainContact {
  static constexpr bool kLinear = Has::kLinear, kRubs = Has::kRubs, kOnPlane = Has::kOnPlane;
  static constexpr bool kUneven = Has::kUneven, kLifts = Has::kLifts;

 public:
  GrainContact(GrainBatch& batch, const std::vector<GrainLaw>& laws, const GrainPlane& plane,
               double step)
      : s_(batch),
        g_(batch.grains),
        laws_(laws.data()),
        walls_(plane.walls.data()),
        radius_(plane.radius),
        h_(step) {}

  struct Direction {
    double x = 0, y = 0, z = 0;
  };
  /// Where the first centre lies from the second.
  struct Between {
    double x, y, z;
    double reach;  ///< two radii
    HWY_ATTR double distance2() const {
      if constexpr (kUneven) return x * x + y * y + z * z;
      return x * x + y * y;
    }
    HWY_ATTR Direction direction(double distance) const {
      if constexpr (kUneven) return {x / distance, y / distance, z / distance};
      return {x / distance, y / distance, 0};
    }
  };

  HWY_ATTR Between between(const GrainPair& pair) const {
    const std::size_t a = pair.a, b = pair.b;
    if constexpr (Has::kWalls) {
      if (pair.wall != GrainPair::kNoWall) {
        const GrainWall& wall = walls_[pair.wall];
        const double distance = wall.distance(g_.x[a], g_.y[a]);
        return {distance * wall.x, distance * wall.y, 0, s_.radius[a]};
      }
    }
    const double x = g_.x[a] - g_.x[b] - pair.shift_x, y = g_.y[a] - g_.y[b] - pair.shift_y;
    if constexpr (!kUneven) return {x, y, 0, 2 * radius_};
    const double A = s_.radius[a], B = s_.radius[b];
    if constexpr (kLifts) return {x, y, g_.z[a] - g_.z[b], A + B};
    return {x, y, A - B, A + B};
  }

  /// Two grains that overlap in a step of the block; whether their contact begins.
  HWY_ATTR bool meet(GrainPair& pair, const Between& between, double distance, std::size_t step,
                     bool begun) const {
    const GrainLaw& law = laws_[pair.law];
    const Direction n = between.direction(distance);
    const double overlap = between.reach - distance;
    const Motion now = motion(pair, n, 0.5);
    const double normal = normal_force_of(law, overlap, now.closing);
    if ((law.clamped && normal <= 0) || (overlap <= 0 && now.closing <= 0)) {
      if (pair.touching)
        end(pair, normal < 0 ? pair.normal_force / (pair.normal_force - normal) : 1, {}, n, step);
      return false;
    }
    const bool begins = !pair.touching;
    const Force force = force_of(law, normal, now, n);
    Force pushed = force;
    if (begins && begun) {
      // The contact has lasted for `part` of the step before now, and gets part h ½ (F_begin + F).
      const Motion before = motion(pair, n, 0);
      if (before.closing * h_ >= overlap && before.closing > 0) {
        const double part = overlap / (before.closing * h_);
        const double first = normal_force_of(law, 0, before.closing);
        const Force first_force = force_of(law, law.clamped ? std::max(0.0, first) : first, now, n);
        pushed = mix(0.5 * (1 + part), force, 0.5 * part, first_force);
      }
    }
    push(pair, pushed, n);
    pair.force = force;
    pair.normal_force = normal;
    pair.touching = true;
    return begins;
  }

  /// Two grains that touched a step ago and overlap no more.
  HWY_ATTR void part(GrainPair& pair, const Between& between, double distance,
                     std::size_t step) const {
    const GrainLaw& law = laws_[pair.law];
    const Direction n = between.direction(distance);
    const Motion before = motion(pair, n, 0);
    const double gone = before.closing < 0 ? (between.reach - distance) / (before.closing * h_) : 0;
    const double last = law.clamped ? 0 : normal_force_of(law, 0, before.closing);
    end(pair, std::max(0.0, 1 - gone), force_of(law, last, before, n), n, step);
  }

 private:
  struct Motion {
    double closing = 0;
    double u_t = 0, u_z = 0;  ///< slip [m/s]
    double u_x = 0, u_y = 0;  ///< in place of u_t where n is not level
  };
  using Force = GrainPair::Force;

  HWY_ATTR static double normal_force_of(const GrainLaw& law, double overlap, double rate) {
    if constexpr (kLinear)
      return (*std::get_if<LinearForce>(&law.normal))(overlap, rate);
    else
      return normal_force(law.normal, overlap, rate);
  }

  /// Relative to each other, with `ahead` of what the last step changed added.
  HWY_ATTR Motion motion(const GrainPair& pair, const Direction& n, double ahead) const {
    const std::size_t a = pair.a, b = pair.b;
    const double dvx = (g_.vx[a] - g_.vx[b]) + ahead * (g_.dvx[a] - g_.dvx[b]);
    const double dvy = (g_.vy[a] - g_.vy[b]) + ahead * (g_.dvy[a] - g_.dvy[b]);
    Motion m;
    double dvz = 0;
    if constexpr (kLifts) dvz = (g_.vz[a] - g_.vz[b]) + ahead * (g_.dvz[a] - g_.dvz[b]);
    m.closing = kLifts ? -(n.x * dvx + n.y * dvy + n.z * dvz) : -(n.x * dvx + n.y * dvy);
    if constexpr (kUneven) {
      const double A = s_.radius[a], B = s_.radius[b];
      const double x = (A * g_.wx[a] + B * g_.wx[b]) + ahead * (A * g_.dwx[a] + B * g_.dwx[b]);
      const double y = (A * g_.wy[a] + B * g_.wy[b]) + ahead * (A * g_.dwy[a] + B * g_.dwy[b]);
      const double z = (A * g_.wz[a] + B * g_.wz[b]) + ahead * (A * g_.dwz[a] + B * g_.dwz[b]);
      m.u_x = dvx + m.closing * n.x - (y * n.z - z * n.y);
      m.u_y = dvy + m.closing * n.y - (z * n.x - x * n.z);
      m.u_z = dvz + m.closing * n.z - (x * n.y - y * n.x);
    } else if constexpr (kRubs) {
      const double turning = (g_.wz[a] + g_.wz[b]) + ahead * (g_.dwz[a] + g_.dwz[b]);
      m.u_t = dvy * n.x - dvx * n.y - radius_ * turning;
      if constexpr (kOnPlane) {
        const double wx = (g_.wx[a] + g_.wx[b]) + ahead * (g_.dwx[a] + g_.dwx[b]);
        const double wy = (g_.wy[a] + g_.wy[b]) + ahead * (g_.dwy[a] + g_.dwy[b]);
        m.u_z = radius_ * (wy * n.x - wx * n.y);
      }
    }
    return m;
  }

  HWY_ATTR static Force force_of(const GrainLaw& law, double normal, const Motion& m,
                                 const Direction& n) {
    if constexpr (!kRubs) return {normal * n.x, normal * n.y, 0, 0, 0, 0};
    const double cap = law.friction * std::abs(normal);
    const double along2 = kUneven ? m.u_x * m.u_x + m.u_y * m.u_y : m.u_t * m.u_t;
    const double slip2 = along2 + m.u_z * m.u_z;
    const bool is_capped = law.damping * law.damping * slip2 > cap * cap;
    const double per_slip = is_capped ? -cap / std::sqrt(slip2) : -law.damping;
    const double tz = per_slip * m.u_z;
    if constexpr (kUneven) {
      const double tx = per_slip * m.u_x, ty = per_slip * m.u_y;
      return {normal * n.x + tx, normal * n.y + ty, normal * n.z + tz, tx, ty, tz};
    } else {
      const double ft = per_slip * m.u_t;
      const double tx = -ft * n.y, ty = ft * n.x;
      return {normal * n.x + tx, normal * n.y + ty, tz, tx, ty, tz};
    }
  }

  HWY_ATTR static Force mix(double p, const Force& f, double q, const Force& g) {
    return {p * f.x + q * g.x,
            p * f.y + q * g.y,
            p * f.z + q * g.z,
            p * f.across_x + q * g.across_x,
            p * f.across_y + q * g.across_y,
            kUneven ? p * f.across_z + q * g.across_z : 0};
  }

  HWY_ATTR HWY_INLINE void push(const GrainPair& pair, const Force& f, const Direction& n) const {
    const std::size_t a = pair.a, b = pair.b;
    s_.fx[a] += f.x;
    s_.fy[a] += f.y;
    s_.fx[b] -= f.x;
    s_.fy[b] -= f.y;
    if constexpr (kUneven) {  // R F×n
      const double x = f.across_y * n.z - f.across_z * n.y;
      const double y = f.across_z * n.x - f.across_x * n.z;
      const double z = f.across_x * n.y - f.across_y * n.x;
      s_.fz[a] += f.z;
      s_.fz[b] -= f.z;
      for (const std::size_t i : {a, b}) {
        s_.tx[i] += s_.radius[i] * x;
        s_.ty[i] += s_.radius[i] * y;
        s_.tz[i] += s_.radius[i] * z;
      }
    } else if constexpr (kRubs) {
      const double lever_z = radius_ * (f.across_x * n.y - f.across_y * n.x);
      s_.tz[a] += lever_z;
      s_.tz[b] += lever_z;
      if constexpr (kOnPlane) {
        const double lever_x = -radius_ * f.z * n.y, lever_y = radius_ * f.z * n.x;
        s_.fz[a] += f.z;
        s_.fz[b] -= f.z;
        s_.tx[a] += lever_x;
        s_.tx[b] += lever_x;
        s_.ty[a] += lever_y;
        s_.ty[b] += lever_y;
      }
    }
  }

  /// The contact lasted for `part` of the step before now and should have had part h ½ (F + F_end)
  /// there; it had h/2 F. What is taken back from a grain that the other pressed down was borne by
  /// the substrate and must not lift it.
  HWY_ATTR void end(GrainPair& pair, double part, const Force& last, const Direction& n,
                    std::size_t step) const {
    const Force pushed = mix(0.5 * (part - 1), pair.force, 0.5 * part, last);
    if constexpr (kOnPlane) {
      const double before_a = s_.fz[pair.a], before_b = s_.fz[pair.b];
      push(pair, pushed, n);
      keep_down(pair.a, before_a);
      keep_down(pair.b, before_b);
    } else {
      push(pair, pushed, n);
    }
    pair.touching = false;
    pair.parted_in = static_cast<std::uint16_t>(step + 1);
  }

  HWY_ATTR void keep_down(std::uint32_t i, double before) const {
    if constexpr (kLifts) {
      if (g_.flies[i] > 0) return;
    }
    s_.fz[i] = before + std::min(s_.fz[i] - before, s_.weight[i]);
  }

  GrainBatch& s_;
  const GrainView g_;
  const GrainLaw* laws_;
  const GrainWall* walls_;
  double radius_, h_;
};

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
