// The loops of grain_kernels.cpp; included once for each instruction set.
#if defined(SLIPCHECK_GRAIN_LOOPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_GRAIN_LOOPS_INL_H
#undef SLIPCHECK_GRAIN_LOOPS_INL_H
#else
#define SLIPCHECK_GRAIN_LOOPS_INL_H
#endif

#include <hwy/highway.h>

/// Before a loop each turn of which reads and writes what no other does: compilers do not see it of
/// more than some arrays. Under sanitizers none is vectorised.
#undef SLIPCHECK_EACH_ALONE
#if defined(SLIPCHECK_SANITIZE)
#define SLIPCHECK_EACH_ALONE
#elif defined(__clang__)
#define SLIPCHECK_EACH_ALONE _Pragma("clang loop vectorize(assume_safety)")
#else
#define SLIPCHECK_EACH_ALONE _Pragma("GCC ivdep")
#endif

#include "reference/steps/grain_contact-inl.h"
#include "reference/steps/grain_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// --- which grains are near -----------------------------------------------------------------------

HWY_ATTR void FindNear(const GrainArrays& grains, const GrainPlane& plane,
                       std::span<const std::uint32_t> first, std::span<const std::uint32_t> second,
                       double margin, std::vector<std::uint32_t>& near) {
  const hn::ScalableTag<double> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<std::uint32_t, decltype(d)> du;
  const std::size_t lanes = hn::Lanes(d);
  const auto length_x = hn::Set(d, plane.length_x), length_y = hn::Set(d, plane.length_y);
  const auto per_x = hn::Set(d, plane.length_x > 0 ? 1 / plane.length_x : 0);
  const auto per_y = hn::Set(d, plane.length_y > 0 ? 1 / plane.length_y : 0);
  const double reach = 2 * plane.radius + margin;
  const auto reach2 = hn::Set(d, reach * reach);
  // Which are near is written down without a branch for some, then read.
  constexpr std::size_t kAtOnce = 64;
  std::size_t k = 0;
  for (; k + kAtOnce <= first.size(); k += kAtOnce) {
    std::uint64_t all = 0;
    for (std::size_t at = 0; at < kAtOnce; at += lanes) {
      const auto i = hn::BitCast(di, hn::PromoteTo(hn::RebindToUnsigned<decltype(di)>(),
                                                   hn::LoadU(du, first.data() + k + at)));
      const auto j = hn::BitCast(di, hn::PromoteTo(hn::RebindToUnsigned<decltype(di)>(),
                                                   hn::LoadU(du, second.data() + k + at)));
      auto dx =
          hn::Sub(hn::GatherIndex(d, grains.x.data(), i), hn::GatherIndex(d, grains.x.data(), j));
      auto dy =
          hn::Sub(hn::GatherIndex(d, grains.y.data(), i), hn::GatherIndex(d, grains.y.data(), j));
      dx = hn::Sub(dx, hn::Mul(length_x, hn::Round(hn::Mul(dx, per_x))));
      dy = hn::Sub(dy, hn::Mul(length_y, hn::Round(hn::Mul(dy, per_y))));
      const auto distance2 = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
      const auto is_near = hn::Le(distance2, reach2);
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, is_near, bytes);
      all |= std::uint64_t{bytes[0]} << at;
    }
    for (; all != 0; all &= all - 1)
      near.push_back(static_cast<std::uint32_t>(k) +
                     static_cast<std::uint32_t>(std::countr_zero(all)));
  }
  for (; k < first.size(); ++k) {
    const std::uint32_t i = first[k], j = second[k];
    double dx = grains.x[i] - grains.x[j], dy = grains.y[i] - grains.y[j];
    if (plane.length_x > 0) dx -= plane.length_x * std::nearbyint(dx * (1 / plane.length_x));
    if (plane.length_y > 0) dy -= plane.length_y * std::nearbyint(dy * (1 / plane.length_y));
    if (dx * dx + dy * dy <= reach * reach) near.push_back(static_cast<std::uint32_t>(k));
  }
}

// --- grains that may meet ------------------------------------------------------------------------

/// Velocities after a kick of dt, and positions after a drift of h; StepBody's kick without lift.
template <bool kRubs, bool kOnPlane, bool kDriven>
HWY_ATTR HWY_INLINE void KickAndDrift(GrainBatch& batch, const GrainGroup& group, double R,
                                      double dt, double h, const GrainPush& push) {
  const std::size_t n = group.last_grain - group.first_grain, o = group.first_grain;
  GrainArrays& g = batch.grains;
  const auto begin = [o](std::vector<double>& values) {
    return values.empty() ? nullptr : values.data() + o;
  };
  double* HWY_RESTRICT x = begin(g.x);
  double* HWY_RESTRICT y = begin(g.y);
  double* HWY_RESTRICT vx = begin(g.vx);
  double* HWY_RESTRICT vy = begin(g.vy);
  double* HWY_RESTRICT wx = begin(g.wx);
  double* HWY_RESTRICT wy = begin(g.wy);
  double* HWY_RESTRICT wz = begin(g.wz);
  double* HWY_RESTRICT dvx = begin(g.dvx);
  double* HWY_RESTRICT dvy = begin(g.dvy);
  double* HWY_RESTRICT dwx = begin(g.dwx);
  double* HWY_RESTRICT dwy = begin(g.dwy);
  double* HWY_RESTRICT dwz = begin(g.dwz);
  double* HWY_RESTRICT sticks = begin(g.sticks);
  double* HWY_RESTRICT fx = begin(batch.fx);
  double* HWY_RESTRICT fy = begin(batch.fy);
  double* HWY_RESTRICT fz = begin(batch.fz);
  double* HWY_RESTRICT tx = begin(batch.tx);
  double* HWY_RESTRICT ty = begin(batch.ty);
  double* HWY_RESTRICT tz = begin(batch.tz);
  double* HWY_RESTRICT load_of = begin(batch.load);
  double* HWY_RESTRICT fastest = begin(batch.fastest);
  const double* HWY_RESTRICT inverse_mass = begin(batch.inverse_mass);
  const double* HWY_RESTRICT inverse_inertia = begin(batch.inverse_inertia);
  const double* HWY_RESTRICT weight = begin(batch.weight);
  const double* HWY_RESTRICT share = begin(batch.share);
  const double* HWY_RESTRICT turn = begin(batch.turn);
  const double* HWY_RESTRICT mu_s = begin(batch.mu_s);
  const double* HWY_RESTRICT mu_k = begin(batch.mu_k);
  SLIPCHECK_EACH_ALONE
  for (std::size_t i = 0; i < n; ++i) {
    double ax = vx[i] + (dt * inverse_mass[i]) * fx[i];
    double ay = vy[i] + (dt * inverse_mass[i]) * fy[i];
    fx[i] = fy[i] = 0;
    if constexpr (kDriven) {
      ax += dt * push.slope_x;
      ay += dt * push.slope_y;
    }
    if constexpr (kRubs) {
      const double az = wz[i] + (dt * inverse_inertia[i]) * tz[i];
      dwz[i] = az - wz[i];
      wz[i] = az;
      tz[i] = 0;
    }
    if constexpr (kOnPlane) {
      double bx = wx[i] + (dt * inverse_inertia[i]) * tx[i];
      double by = wy[i] + (dt * inverse_inertia[i]) * ty[i];
      const double load = std::abs(weight[i] - fz[i]) * dt;
      tx[i] = ty[i] = fz[i] = 0;
      load_of[i] = load;
      double ux = ax - R * by, uy = ay + R * bx;
      if constexpr (kDriven) {
        ux -= push.plane_x;
        uy -= push.plane_y;
      }
      const double slip2 = ux * ux + uy * uy, share2 = share[i] * share[i];
      const double per_slip = load * inverse_mass[i];
      const double cap = (sticks[i] > 0 ? mu_s[i] : mu_k[i]) * per_slip;
      const bool held = slip2 * share2 <= cap * cap;
      // The slip expected in the middle of the step; see rub_alone() and follows() of StepBody.
      double px = vx[i] + 0.5 * dvx[i] - R * (wy[i] + 0.5 * dwy[i]);
      double py = vy[i] + 0.5 * dvy[i] + R * (wx[i] + 0.5 * dwx[i]);
      if constexpr (kDriven) {
        px -= 0.5 * (push.before_x + push.plane_x);
        py -= 0.5 * (push.before_y + push.plane_y);
      }
      const double friction = mu_k[i] * per_slip, expected2 = px * px + py * py;
      const bool follows = (px * ux + py * uy > 0) & (expected2 * share2 > friction * friction);
      const double sx = follows ? px : ux, sy = follows ? py : uy;
      const double size2 = follows ? expected2 : slip2;
      const double change = friction * (1 / std::sqrt(size2 > 0 ? size2 : 1));
      double rolling_x = ax - share[i] * ux, rolling_y = ay - share[i] * uy;
      const double turned_x = bx - change * turn[i] * sy, turned_y = by + change * turn[i] * sx;
      ax = held ? rolling_x : ax - change * sx;
      ay = held ? rolling_y : ay - change * sy;
      if constexpr (kDriven) {  // relative to the plane
        rolling_x -= push.plane_x;
        rolling_y -= push.plane_y;
      }
      bx = held ? -rolling_y / R : turned_x;
      by = held ? rolling_x / R : turned_y;
      sticks[i] = held ? 1 : 0;
      dwx[i] = bx - wx[i];
      dwy[i] = by - wy[i];
      wx[i] = bx;
      wy[i] = by;
    }
    dvx[i] = ax - vx[i];
    dvy[i] = ay - vy[i];
    vx[i] = ax;
    vy[i] = ay;
    x[i] += h * ax;
    y[i] += h * ay;
    if constexpr (kDriven) {
      ax -= push.drift_x;
      ay -= push.drift_y;
    }
    const double speed2 = ax * ax + ay * ay, before = fastest[i];
    fastest[i] = speed2 > before ? speed2 : before;
  }
}

/// What a plane that is not driven does in every step.
inline constexpr GrainPush kNoPush;

template <class Contact, bool kRubs, bool kOnPlane, bool kDriven>
HWY_ATTR std::size_t RunOf(GrainBatch& batch, const std::vector<GrainLaw>& laws, double R,
                           const GrainGroup& group, const GrainSteps& steps) {
  const Contact contact(batch, laws, R, steps.step);
  const double reach = 2 * R;
  const double* HWY_RESTRICT x = batch.grains.x.data();
  const double* HWY_RESTRICT y = batch.grains.y.data();
  std::size_t begun = 0;
  for (std::size_t s = 0; s < steps.count; ++s) {
    for (std::size_t k = group.first_pair; k < group.last_pair; ++k) {
      GrainPair& pair = batch.pairs[k];
      const double dx = x[pair.a] - x[pair.b] - pair.shift_x;
      const double dy = y[pair.a] - y[pair.b] - pair.shift_y;
      const double distance2 = dx * dx + dy * dy;
      if (distance2 <= reach * reach)
        begun += contact.meet(pair, dx, dy, std::sqrt(distance2), s, steps.begun || s > 0);
      else if (pair.touching)
        contact.part(pair, dx, dy, std::sqrt(distance2), s);
    }
    KickAndDrift<kRubs, kOnPlane, kDriven>(batch, group, R, s == 0 ? steps.first_kick : steps.step,
                                           steps.drift ? steps.step : 0,
                                           kDriven ? steps.driving->steps[s] : kNoPush);
  }
  return begun;
}

template <bool kRubs, bool kOnPlane, bool kDriven>
HWY_ATTR std::size_t RunWith(const GrainFeatures& features, GrainBatch& batch,
                             const std::vector<GrainLaw>& laws, double R, const GrainGroup& group,
                             const GrainSteps& steps) {
  if (features.any_normal)
    return RunOf<GrainContact<false, kRubs, kOnPlane>, kRubs, kOnPlane, kDriven>(batch, laws, R,
                                                                                 group, steps);
  return RunOf<GrainContact<true, kRubs, kOnPlane>, kRubs, kOnPlane, kDriven>(batch, laws, R, group,
                                                                              steps);
}

template <bool kRubs>
HWY_ATTR std::size_t RunOn(const GrainFeatures& features, GrainBatch& batch,
                           const std::vector<GrainLaw>& laws, double R, const GrainGroup& group,
                           const GrainSteps& steps) {
  if (features.driven) return RunWith<kRubs, true, true>(features, batch, laws, R, group, steps);
  if (features.on_plane) return RunWith<kRubs, true, false>(features, batch, laws, R, group, steps);
  return RunWith<kRubs, false, false>(features, batch, laws, R, group, steps);
}

HWY_ATTR std::size_t Run(const GrainFeatures& features, GrainBatch& batch,
                         const std::vector<GrainLaw>& laws, double R, const GrainGroup& group,
                         const GrainSteps& steps) {
  return features.rubs ? RunOn<true>(features, batch, laws, R, group, steps)
                       : RunOn<false>(features, batch, laws, R, group, steps);
}

// --- grains that meet none -----------------------------------------------------------------------

/// Without friction: straight on.
HWY_ATTR inline void GlideFreely(GrainArrays& grains, std::size_t first, std::size_t last,
                                 double time) {
  double* HWY_RESTRICT x = grains.x.data();
  double* HWY_RESTRICT y = grains.y.data();
  const double* HWY_RESTRICT vx = grains.vx.data();
  const double* HWY_RESTRICT vy = grains.vy.data();
  for (std::size_t i = first; i < last; ++i) {
    x[i] += time * vx[i];
    y[i] += time * vy[i];
  }
}

/// Steps against a constant friction μ_k g, m of them until one stops the slip, then straight on:
/// the sums over the steps that StepBody's kick and drift make one by one.
HWY_ATTR inline void GlideWithFriction(GrainArrays& grains, std::size_t first, std::size_t last,
                                       const std::vector<GrainKind>& kinds, double R, double h,
                                       double count) {
  double* HWY_RESTRICT x = grains.x.data();
  double* HWY_RESTRICT y = grains.y.data();
  double* HWY_RESTRICT vx = grains.vx.data();
  double* HWY_RESTRICT vy = grains.vy.data();
  double* HWY_RESTRICT wx = grains.wx.data();
  double* HWY_RESTRICT wy = grains.wy.data();
  double* HWY_RESTRICT dvx = grains.dvx.data();
  double* HWY_RESTRICT dvy = grains.dvy.data();
  double* HWY_RESTRICT dwx = grains.dwx.data();
  double* HWY_RESTRICT dwy = grains.dwy.data();
  double* HWY_RESTRICT sticks = grains.sticks.data();
  const std::uint32_t* HWY_RESTRICT kind = grains.kind.data();
  const GrainKind* HWY_RESTRICT table = kinds.data();
  SLIPCHECK_EACH_ALONE
  for (std::size_t i = first; i < last; ++i) {
    const GrainKind& k = table[kind[i]];
    const double lost = k.kinetic_friction * k.weight * k.inverse_mass * h;  // of |v| in a step
    const double ux = vx[i] - R * wy[i], uy = vy[i] + R * wx[i];
    const double slip = std::sqrt(ux * ux + uy * uy);
    const double until = slip * k.share / lost - 1;
    // A comparison that is false for 0/0, where there is neither slip nor friction.
    const double whole = std::ceil(until > 0 ? until : 0);
    const double m = whole < count ? whole : count;
    const double per_slip = slip > 0 ? lost / slip : 0;
    const double ax = per_slip * ux, ay = per_slip * uy;  // taken from v in a step of sliding
    const double drift = 0.5 * m * (m + 1);
    const double sx = vx[i] - m * ax, sy = vy[i] - m * ay;  // velocity after sliding
    const double rx = wx[i] - m * k.turn * ay, ry = wy[i] + m * k.turn * ax;
    const bool stops = m < count;
    const double gx = stops ? k.share * (sx - R * ry) : 0, gy = stops ? k.share * (sy + R * rx) : 0;
    const double ex = sx - gx, ey = sy - gy;  // velocity in the end
    const double fx = stops ? -ey / R : rx, fy = stops ? ex / R : ry;
    const double rest = count - m;
    x[i] += h * (m * vx[i] - drift * ax + rest * ex);
    y[i] += h * (m * vy[i] - drift * ay + rest * ey);
    dvx[i] = stops ? (rest > 1 ? 0 : -gx) : -ax;
    dvy[i] = stops ? (rest > 1 ? 0 : -gy) : -ay;
    dwx[i] = stops ? (rest > 1 ? 0 : fx - rx) : -k.turn * ay;
    dwy[i] = stops ? (rest > 1 ? 0 : fy - ry) : k.turn * ax;
    vx[i] = ex;
    vy[i] = ey;
    wx[i] = fx;
    wy[i] = fy;
    sticks[i] = stops ? 1 : 0;
  }
}

/// How many slide at once, in the nearest cache.
inline constexpr std::size_t kSliding = 128;

/// Those that roll and go on rolling on a plane that carries them along.
HWY_ATTR inline void GlideRolling(GrainArrays& grains, std::size_t first, std::size_t last,
                                  double R, double time, const GrainDriving& driving) {
  double* HWY_RESTRICT x = grains.x.data();
  double* HWY_RESTRICT y = grains.y.data();
  double* HWY_RESTRICT vx = grains.vx.data();
  double* HWY_RESTRICT vy = grains.vy.data();
  double* HWY_RESTRICT wx = grains.wx.data();
  double* HWY_RESTRICT wy = grains.wy.data();
  double* HWY_RESTRICT dvx = grains.dvx.data();
  double* HWY_RESTRICT dvy = grains.dvy.data();
  double* HWY_RESTRICT dwx = grains.dwx.data();
  double* HWY_RESTRICT dwy = grains.dwy.data();
  const double* HWY_RESTRICT sticks = grains.sticks.data();
  const std::uint32_t* HWY_RESTRICT kind = grains.kind.data();
  const GrainRoll* HWY_RESTRICT table = driving.rolls.data();
  const GrainPush push = driving.steps.back();
  const double plane_dx = push.plane_x - push.before_x, plane_dy = push.plane_y - push.before_y;
  const double per_R = 1 / R;
  SLIPCHECK_EACH_ALONE
  for (std::size_t i = first; i < last; ++i) {
    const GrainRoll& roll = table[kind[i]];
    const bool rolls = roll.holds * sticks[i] > 0;
    const double ex = vx[i] + roll.dvx, ey = vy[i] + roll.dvy;
    const double to_x = x[i] + (time * vx[i] + roll.x), to_y = y[i] + (time * vy[i] + roll.y);
    const double turned_x = -(ey - push.plane_y) * per_R, turned_y = (ex - push.plane_x) * per_R;
    x[i] = rolls ? to_x : x[i];
    y[i] = rolls ? to_y : y[i];
    vx[i] = rolls ? ex : vx[i];
    vy[i] = rolls ? ey : vy[i];
    wx[i] = rolls ? turned_x : wx[i];
    wy[i] = rolls ? turned_y : wy[i];
    dvx[i] = rolls ? roll.last_dvx : dvx[i];
    dvy[i] = rolls ? roll.last_dvy : dvy[i];
    dwx[i] = rolls ? -(roll.last_dvy - plane_dy) * per_R : dwx[i];
    dwy[i] = rolls ? (roll.last_dvx - plane_dx) * per_R : dwy[i];
  }
}

/// Those that slide, or come to roll, on a plane that carries them along: no sum over the steps is
/// known, so each is done, of the slip u alone. What friction takes from v is summed.
HWY_ATTR inline void GlideSliding(GrainArrays& g, std::span<const std::size_t> grains,
                                  const std::vector<GrainKind>& kinds, double R,
                                  const GrainSteps& steps) {
  struct alignas(64) Row {
    double of[kSliding];
  };
  Row ux, uy, dx, dy, sx, sy, tx, ty, held_by, slides_by, share, grow, sticks;
  const std::size_t n = grains.size(), padded = (n + 7) / 8 * 8;  // vectors, and nothing beside
  for (Row* row :
       {&ux, &uy, &dx, &dy, &sx, &sy, &tx, &ty, &held_by, &slides_by, &share, &grow, &sticks})
    std::fill(row->of + n, row->of + padded, 0.0);
  const double h = steps.step;
  const GrainPush& first = steps.driving->steps.front();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = grains[k];
    ux.of[k] = g.vx[i] - R * g.wy[i] - first.before_x;
    uy.of[k] = g.vy[i] + R * g.wx[i] - first.before_y;
    dx.of[k] = g.dvx[i] - R * g.dwy[i];  // of the slip, were the plane still
    dy.of[k] = g.dvy[i] + R * g.dwx[i];
    sx.of[k] = sy.of[k] = tx.of[k] = ty.of[k] = 0;
    sticks.of[k] = g.sticks[i];
    const GrainKind& kind = kinds[g.kind[i]];
    const double load = kind.weight * kind.inverse_mass * h;
    slides_by.of[k] = kind.kinetic_friction * load;
    held_by.of[k] = kind.static_friction * load;
    share.of[k] = kind.share;
    grow.of[k] = 1 / kind.share;
  }
  for (const GrainPush& push : steps.driving->steps) {
    const double ax = h * push.slope_x, ay = h * push.slope_y;
    const double plane_dx = push.plane_x - push.before_x, plane_dy = push.plane_y - push.before_y;
    SLIPCHECK_EACH_ALONE
    for (std::size_t k = 0; k < padded; ++k) {
      const double x = ux.of[k] + (ax - plane_dx), y = uy.of[k] + (ay - plane_dy);
      const double px = ux.of[k] + 0.5 * (dx.of[k] - plane_dx);
      const double py = uy.of[k] + 0.5 * (dy.of[k] - plane_dy);
      const double share2 = share.of[k] * share.of[k], slip2 = x * x + y * y;
      const double cap = sticks.of[k] > 0 ? held_by.of[k] : slides_by.of[k];
      const bool held = slip2 * share2 <= cap * cap;
      const double friction = slides_by.of[k], expected2 = px * px + py * py;
      const bool follows = (px * x + py * y > 0) & (expected2 * share2 > friction * friction);
      const double along_x = follows ? px : x, along_y = follows ? py : y;
      const double size2 = follows ? expected2 : slip2;
      const double sliding = friction * (1 / std::sqrt(size2 > 0 ? size2 : 1));
      const double lost_x = held ? share.of[k] * x : sliding * along_x;  // of v
      const double lost_y = held ? share.of[k] * y : sliding * along_y;
      const double slip_x = grow.of[k] * lost_x, slip_y = grow.of[k] * lost_y;
      ux.of[k] = held ? 0 : x - slip_x;
      uy.of[k] = held ? 0 : y - slip_y;
      dx.of[k] = ax - slip_x;
      dy.of[k] = ay - slip_y;
      const double all_x = sx.of[k] + lost_x, all_y = sy.of[k] + lost_y;
      sx.of[k] = all_x;
      sy.of[k] = all_y;
      tx.of[k] += all_x;
      ty.of[k] += all_y;
      sticks.of[k] = held ? 1 : 0;
    }
  }
  const GrainPush& last = steps.driving->steps.back();
  const double ax = h * last.slope_x, ay = h * last.slope_y;
  const auto count = static_cast<double>(steps.count);
  const double drift = 0.5 * count * (count + 1);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = grains[k];
    const bool rolls = sticks.of[k] > 0;
    const double turn = kinds[g.kind[i]].turn;
    g.x[i] += h * (count * g.vx[i] + drift * ax - tx.of[k]);
    g.y[i] += h * (count * g.vy[i] + drift * ay - ty.of[k]);
    g.vx[i] += count * ax - sx.of[k];
    g.vy[i] += count * ay - sy.of[k];
    g.wx[i] = rolls ? -(g.vy[i] - last.plane_y) / R : g.wx[i] - turn * sy.of[k];
    g.wy[i] = rolls ? (g.vx[i] - last.plane_x) / R : g.wy[i] + turn * sx.of[k];
    const double lost_x = share.of[k] * (ax - dx.of[k]), lost_y = share.of[k] * (ay - dy.of[k]);
    g.dvx[i] = ax - lost_x;
    g.dvy[i] = ay - lost_y;
    g.dwx[i] = -turn * lost_y;
    g.dwy[i] = turn * lost_x;
    g.sticks[i] = sticks.of[k];
  }
}

/// On a plane that carries them along.
HWY_ATTR void GlideDriven(GrainArrays& grains, std::size_t first, std::size_t last,
                          const std::vector<GrainKind>& kinds, double R, const GrainSteps& steps) {
  const GrainDriving& driving = *steps.driving;
  const double time = steps.step * static_cast<double>(steps.count);
  std::array<std::size_t, kSliding> sliding;
  for (std::size_t begin = first; begin < last; begin += kSliding) {
    const std::size_t end = std::min(last, begin + kSliding);
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      sliding[count] = i;
      count += grains.sticks[i] * driving.rolls[grains.kind[i]].holds > 0 ? 0 : 1;
    }
    if (count < end - begin) GlideRolling(grains, begin, end, R, time, driving);
    GlideSliding(grains, {sliding.data(), count}, kinds, R, steps);
  }
}

HWY_ATTR double LargestSquare(const std::vector<double>& x, const std::vector<double>& y,
                              std::size_t first, std::size_t last, double from_x, double from_y) {
  const hn::ScalableTag<double> d;
  const auto bx = hn::Set(d, from_x), by = hn::Set(d, from_y);
  const std::size_t lanes = hn::Lanes(d);
  auto largest = hn::Zero(d);
  std::size_t i = first;
  for (; i + lanes <= last; i += lanes) {
    const auto a = hn::Sub(hn::LoadU(d, x.data() + i), bx);
    const auto b = hn::Sub(hn::LoadU(d, y.data() + i), by);
    largest = hn::Max(largest, hn::Add(hn::Mul(a, a), hn::Mul(b, b)));
  }
  double found = hn::GetLane(hn::MaxOfLanes(d, largest));
  for (; i < last; ++i) {
    const double a = x[i] - from_x, b = y[i] - from_y;
    found = std::max(found, a * a + b * b);
  }
  return found;
}

HWY_ATTR double Glide(const GrainFeatures& features, GrainArrays& grains, std::size_t first,
                      std::size_t last, const std::vector<GrainKind>& kinds, double radius,
                      const GrainSteps& steps) {
  const auto count = static_cast<double>(steps.count);
  if (features.driven)
    GlideDriven(grains, first, last, kinds, radius, steps);
  else if (features.on_plane)
    GlideWithFriction(grains, first, last, kinds, radius, steps.step, count);
  else
    GlideFreely(grains, first, last, steps.step * count);
  const GrainPush& push = features.driven ? steps.driving->steps.back() : kNoPush;
  return LargestSquare(grains.vx, grains.vy, first, last, push.drift_x, push.drift_y);
}

std::int64_t Target() { return HWY_TARGET; }

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
