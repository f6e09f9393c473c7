// The loops of grain_kernels.cpp; included once for each instruction set.
#if defined(SLIPCHECK_GRAIN_LOOPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_GRAIN_LOOPS_INL_H
#undef SLIPCHECK_GRAIN_LOOPS_INL_H
#else
#define SLIPCHECK_GRAIN_LOOPS_INL_H
#endif

#include <hwy/highway.h>

#include <numeric>

#include "reference/steps/grain_contact-inl.h"
#include "reference/steps/grain_glides-inl.h"
#include "reference/steps/grain_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// --- which grains are near -----------------------------------------------------------------------

template <bool kRadii, bool kLifts>
HWY_ATTR void FindNearOf(const GrainArrays& grains, const GrainPlane& plane,
                         std::span<const std::uint32_t> first,
                         std::span<const std::uint32_t> second, double margin,
                         std::vector<std::uint32_t>& near) {
  const hn::ScalableTag<double> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<std::uint32_t, decltype(d)> du;
  const std::size_t lanes = hn::Lanes(d);
  const auto length_x = hn::Set(d, plane.length_x), length_y = hn::Set(d, plane.length_y);
  const auto per_x = hn::Set(d, plane.length_x > 0 ? 1 / plane.length_x : 0);
  const auto per_y = hn::Set(d, plane.length_y > 0 ? 1 / plane.length_y : 0);
  const double reach = 2 * plane.radius + margin;
  const auto reach2 = hn::Set(d, reach * reach), four = hn::Set(d, 4.0);
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
      auto most2 = reach2;
      if constexpr (kRadii) {
        const double* const R = grains.radius.data();
        const auto a = hn::GatherIndex(d, R, i), b = hn::GatherIndex(d, R, j);
        auto level = hn::Add(a, b);
        if constexpr (!kLifts) level = hn::Sqrt(hn::Mul(four, hn::Mul(a, b)));
        const auto most = hn::Add(level, hn::Set(d, margin));
        most2 = hn::Mul(most, most);
      }
      const auto is_near = hn::Le(distance2, most2);
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
    const double most = kRadii ? level_reach(grains, i, j) + margin : reach;
    if (dx * dx + dy * dy <= most * most) near.push_back(static_cast<std::uint32_t>(k));
  }
}

HWY_ATTR void FindNear(const GrainFeatures& features, const GrainArrays& grains,
                       const GrainPlane& plane, std::span<const std::uint32_t> first,
                       std::span<const std::uint32_t> second, double margin,
                       std::vector<std::uint32_t>& near) {
  if (features.radii && features.lifts)
    FindNearOf<true, true>(grains, plane, first, second, margin, near);
  else if (features.radii)
    FindNearOf<true, false>(grains, plane, first, second, margin, near);
  else
    FindNearOf<false, false>(grains, plane, first, second, margin, near);
}

// --- grains that may meet ------------------------------------------------------------------------

/// Velocities after a kick of dt, and positions after a drift of h; StepBody's kick.
template <class Has>
HWY_ATTR HWY_INLINE void KickAndDrift(GrainBatch& batch, const GrainPlane& plane, double dt,
                                      double h, const GrainPush& push) {
  constexpr bool kRubs = Has::kRubs, kOnPlane = Has::kOnPlane, kDriven = Has::kDriven;
  constexpr bool kUneven = Has::kUneven, kLifts = Has::kLifts, kRolls = Has::kRolls;
  const std::size_t n = batch.count;
  const GrainView& g = batch.grains;
  double* HWY_RESTRICT x = g.x;
  double* HWY_RESTRICT y = g.y;
  double* HWY_RESTRICT vx = g.vx;
  double* HWY_RESTRICT vy = g.vy;
  double* HWY_RESTRICT wx = g.wx;
  double* HWY_RESTRICT wy = g.wy;
  double* HWY_RESTRICT wz = g.wz;
  double* HWY_RESTRICT dvx = g.dvx;
  double* HWY_RESTRICT dvy = g.dvy;
  double* HWY_RESTRICT dwx = g.dwx;
  double* HWY_RESTRICT dwy = g.dwy;
  double* HWY_RESTRICT dwz = g.dwz;
  double* HWY_RESTRICT sticks = g.sticks;
  double* HWY_RESTRICT fx = batch.fx.data();
  double* HWY_RESTRICT fy = batch.fy.data();
  double* HWY_RESTRICT fz = batch.fz.data();
  double* HWY_RESTRICT tx = batch.tx.data();
  double* HWY_RESTRICT ty = batch.ty.data();
  double* HWY_RESTRICT tz = batch.tz.data();
  double* HWY_RESTRICT load_of = batch.load.data();
  double* HWY_RESTRICT fastest = batch.fastest.data();
  const double* HWY_RESTRICT inverse_mass = batch.inverse_mass.data();
  const double* HWY_RESTRICT inverse_inertia = batch.inverse_inertia.data();
  const double* HWY_RESTRICT weight = batch.weight.data();
  const double* HWY_RESTRICT share = batch.share.data();
  const double* HWY_RESTRICT turn = batch.turn.data();
  const double* HWY_RESTRICT mu_s = batch.mu_s.data();
  const double* HWY_RESTRICT mu_k = batch.mu_k.data();
  const double* HWY_RESTRICT mu_r = batch.mu_r.data();
  const double* HWY_RESTRICT drilling = batch.drilling.data();
  const double* HWY_RESTRICT radius_of = batch.radius.data();
  double* HWY_RESTRICT z = g.z;
  double* HWY_RESTRICT vz = g.vz;
  double* HWY_RESTRICT dvz = g.dvz;
  double* HWY_RESTRICT flies = g.flies;
  double* HWY_RESTRICT bounced = g.bounced;
  const double radius = plane.radius, per_radius = 1 / radius, fall = dt * plane.gravity;
  SLIPCHECK_EACH_ALONE
  for (std::size_t i = 0; i < n; ++i) {
    double ax = vx[i] + (dt * inverse_mass[i]) * fx[i];
    double ay = vy[i] + (dt * inverse_mass[i]) * fy[i];
    fx[i] = fy[i] = 0;
    if constexpr (kDriven) {
      ax += dt * push.slope_x;
      ay += dt * push.slope_y;
    }
    bool on_plane = true;
    double load = 0;
    if constexpr (kOnPlane) {
      const double normal = weight[i] - fz[i];
      if constexpr (kLifts) on_plane = (flies[i] <= 0) & (normal >= 0);
      load = on_plane ? std::abs(normal) * dt : 0;
    }
    if constexpr (kRubs) {
      double az = wz[i] + (dt * inverse_inertia[i]) * tz[i];
      if constexpr (kRolls) {
        const double left = std::abs(az) - (drilling[i] * load) * inverse_inertia[i];
        az = std::copysign(left > 0 ? left : 0, az);
      }
      dwz[i] = az - wz[i];
      wz[i] = az;
      tz[i] = 0;
    }
    if constexpr (kOnPlane) {
      const double R = kUneven ? radius_of[i] : radius, per_R = kUneven ? 1 / R : per_radius;
      double bx = wx[i] + (dt * inverse_inertia[i]) * tx[i];
      double by = wy[i] + (dt * inverse_inertia[i]) * ty[i];
      if constexpr (kLifts) {
        const double az = on_plane ? 0 : vz[i] + (dt * inverse_mass[i]) * fz[i] - fall;
        dvz[i] = az - vz[i];
        vz[i] = az;
        z[i] += h * az;
        flies[i] = on_plane ? 0 : 1;
        bounced[i] = 0;
      }
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
      const bool held = on_plane & (slip2 * share2 <= cap * cap);
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
      if constexpr (kRolls) {  // relative to the plane
        const double rx = rolling_x - push.plane_x, ry = rolling_y - push.plane_y;
        const double speed = std::sqrt(rx * rx + ry * ry), lost = mu_r[i] * per_slip;
        const double factor = (lost < speed ? lost : speed) / (speed > 0 ? speed : 1);
        rolling_x -= factor * rx;
        rolling_y -= factor * ry;
      }
      const double turned_x = bx - change * turn[i] * sy, turned_y = by + change * turn[i] * sx;
      ax = held ? rolling_x : ax - change * sx;
      ay = held ? rolling_y : ay - change * sy;
      if constexpr (kDriven) {  // relative to the plane
        rolling_x -= push.plane_x;
        rolling_y -= push.plane_y;
      }
      bx = held ? -rolling_y * per_R : turned_x;
      by = held ? rolling_x * per_R : turned_y;
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

/// Those that have come down on the substrate within the step.
HWY_ATTR HWY_INLINE void Land(GrainBatch& batch, const GrainPlane& plane, const GrainPush& push) {
  const GrainView& g = batch.grains;
  const hn::ScalableTag<double> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= batch.count; i += lanes) {
    const auto below = hn::Lt(hn::LoadU(d, g.z + i), hn::LoadU(d, batch.radius.data() + i));
    const auto falls = hn::Lt(hn::LoadU(d, g.vz + i), hn::Zero(d));
    if (hn::AllFalse(d, hn::And(below, falls))) continue;
    for (std::size_t k = i; k < i + lanes; ++k) land_grain(*batch.kind[k], plane, push, g, k);
  }
  for (; i < batch.count; ++i) land_grain(*batch.kind[i], plane, push, g, i);
}

/// Of so many pairs a processor foresees from the step before which act.
inline constexpr std::size_t kForeseen = 32;

template <class Has>
HWY_ATTR std::size_t RunAs(GrainBatch& batch, const std::vector<GrainLaw>& laws,
                           const GrainPlane& plane, const GrainSteps& steps) {
  using Contact = GrainContact<Has>;
  const Contact contact(batch, laws, plane, steps.step);
  GrainPair* const pairs = batch.pairs.data();
  std::uint32_t* const acts = batch.acting.data();
  const bool foreseen = batch.pair_count <= kForeseen;
  std::size_t acting = batch.pair_count;
  if (foreseen) std::iota(acts, acts + acting, 0u);
  std::size_t begun = 0;
  for (std::size_t s = 0; s < steps.count; ++s) {
    // Which pairs act is written down without a branch; they follow each other then.
    if (!foreseen) acting = 0;
    for (std::size_t k = 0; !foreseen && k < batch.pair_count; ++k) {
      const typename Contact::Between between = contact.between(pairs[k]);
      const bool overlaps = between.distance2() <= between.reach * between.reach;
      acts[acting] = static_cast<std::uint32_t>(k);
      acting += (overlaps | pairs[k].touching) ? 1 : 0;
    }
    for (std::size_t k = 0; k < acting; ++k) {
      GrainPair& pair = pairs[acts[k]];
      const typename Contact::Between between = contact.between(pair);
      const double distance2 = between.distance2();
      if (distance2 <= between.reach * between.reach)
        begun += contact.meet(pair, between, std::sqrt(distance2), s, steps.begun || s > 0) &&
                 (!Has::kWalls || pair.wall == GrainPair::kNoWall);
      else if (pair.touching)
        contact.part(pair, between, std::sqrt(distance2), s);
    }
    const GrainPush& push = Has::kDriven ? steps.driving->steps[s] : kNoPush;
    KickAndDrift<Has>(batch, plane, s == 0 ? steps.first_kick : steps.step,
                      steps.drift ? steps.step : 0, push);
    if (Has::kLifts && steps.drift) Land(batch, plane, push);
  }
  return begun;
}

using RunLoop = std::size_t (*)(GrainBatch&, const std::vector<GrainLaw>&, const GrainPlane&,
                                const GrainSteps&);

template <bool kRubs, bool kOnPlane, bool kDriven>
RunLoop LoopWith(const GrainFeatures& has) {
  return has.any_normal ? RunAs<GrainHas<false, kRubs, kOnPlane, kDriven>>
                        : RunAs<GrainHas<true, kRubs, kOnPlane, kDriven>>;
}

template <bool kRubs>
RunLoop LoopOn(const GrainFeatures& has) {
  return has.driven     ? LoopWith<kRubs, true, true>(has)
         : has.on_plane ? LoopWith<kRubs, true, false>(has)
                        : LoopWith<kRubs, false, false>(has);
}

/// Centres at unlike heights, maybe.
template <bool kDriven, bool kRolls, bool kWalls>
RunLoop UnevenLoop(const GrainFeatures& has) {
  return has.lifts ? RunAs<GrainHas<false, true, true, kDriven, true, true, kRolls, kWalls>>
                   : RunAs<GrainHas<false, true, true, kDriven, true, false, kRolls, kWalls>>;
}

template <bool kDriven>
RunLoop UnevenLoopOn(const GrainFeatures& has) {
  return has.rolls ? UnevenLoop<kDriven, true, false>(has) : UnevenLoop<kDriven, false, false>(has);
}

RunLoop LoopBetweenWalls(const GrainFeatures& has) {
  return has.rolls ? UnevenLoop<false, true, true>(has) : UnevenLoop<false, false, true>(has);
}

HWY_ATTR std::size_t Run(const GrainFeatures& has, GrainBatch& batch,
                         const std::vector<GrainLaw>& laws, const GrainPlane& plane,
                         const GrainSteps& steps) {
  const RunLoop loop = has.walls                       ? LoopBetweenWalls(has)
                       : has.is_uneven() && has.driven ? UnevenLoopOn<true>(has)
                       : has.is_uneven()               ? UnevenLoopOn<false>(has)
                       : has.rubs                      ? LoopOn<true>(has)
                                                       : LoopOn<false>(has);
  return loop(batch, laws, plane, steps);
}

std::int64_t Target() { return HWY_TARGET; }

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
