// Grains that meet none; included once for each instruction set.
#if defined(SLIPCHECK_GRAIN_GLIDES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_GRAIN_GLIDES_INL_H
#undef SLIPCHECK_GRAIN_GLIDES_INL_H
#else
#define SLIPCHECK_GRAIN_GLIDES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "reference/steps/grain_kernels.h"
#include "reference/steps/grain_slides-inl.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {

/// What a plane that is not driven does in every step.
inline constexpr GrainPush kNoPush;

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
/// the sums over the steps that StepBody's kick and drift make one by one. Those that fly stay.
///
/// Rolling friction takes r from the speed in each step from the one that stops the slip on, until
/// it is zero.
template <bool kOneKind, bool kLifts, bool kRolls>
HWY_ATTR inline void GlideWithFriction(GrainArrays& grains, std::size_t first, std::size_t last,
                                       const std::vector<GrainKind>& kinds, double h,
                                       double steps) {
  double* HWY_RESTRICT x = grains.x.data();
  double* HWY_RESTRICT y = grains.y.data();
  double* HWY_RESTRICT vx = grains.vx.data();
  double* HWY_RESTRICT vy = grains.vy.data();
  double* HWY_RESTRICT wx = grains.wx.data();
  double* HWY_RESTRICT wy = grains.wy.data();
  double* HWY_RESTRICT wz = grains.wz.data();
  double* HWY_RESTRICT dvx = grains.dvx.data();
  double* HWY_RESTRICT dvy = grains.dvy.data();
  double* HWY_RESTRICT dwx = grains.dwx.data();
  double* HWY_RESTRICT dwy = grains.dwy.data();
  double* HWY_RESTRICT dwz = grains.dwz.data();
  double* HWY_RESTRICT sticks = grains.sticks.data();
  const double* HWY_RESTRICT flies = grains.flies.data();
  const std::uint32_t* HWY_RESTRICT kind = grains.kind.data();
  const GrainKind* HWY_RESTRICT table = kinds.data();
  SLIPCHECK_EACH_ALONE
  for (std::size_t i = first; i < last; ++i) {
    const GrainKind& k = table[kOneKind ? 0 : kind[i]];
    const bool stays = kLifts && flies[i] > 0;
    const double count = stays ? 0 : steps;
    // Of |v| in a step.
    const double lost = stays ? 0 : k.kinetic_friction * k.weight * k.inverse_mass * h;
    const double R = k.radius;
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
    const double rest = count - m;
    double ex = sx - gx, ey = sy - gy;  // velocity in the end
    double way = rest, last_x = 0, last_y = 0;
    const double from_x = ex, from_y = ey;  // where it begins to roll
    if constexpr (kRolls) {
      const double r = k.rolling_friction * k.weight * k.inverse_mass * h;
      const double speed = std::sqrt(ex * ex + ey * ey), per_speed = speed > 0 ? 1 / speed : 0;
      // Steps after which it still moves.
      const double all = std::ceil(speed / r) - 1, moving = all < rest ? all : rest;
      const double left = stops ? (moving < rest ? 0 : 1 - rest * r * per_speed) : 1;
      const double before = moving + 1 < rest ? 0 : 1 - (rest - 1) * r * per_speed;
      way = stops ? moving - 0.5 * moving * (moving + 1) * r * per_speed : rest;
      ex = left * from_x;
      ey = left * from_y;
      last_x = ex - before * from_x;
      last_y = ey - before * from_y;
      const double lost_spin = k.drilling_length * k.weight * k.inverse_inertia * h;
      const double spin = std::abs(wz[i]);
      const double kept = spin - count * lost_spin, kept_before = kept + lost_spin;
      const double turned = std::copysign(kept > 0 ? kept : 0, wz[i]);
      dwz[i] = count > 0 ? turned - std::copysign(kept_before > 0 ? kept_before : 0, wz[i]) : 0;
      wz[i] = turned;
    }
    const double fx = stops ? -ey / R : rx, fy = stops ? ex / R : ry;
    x[i] += h * (m * vx[i] - drift * ax + way * from_x);
    y[i] += h * (m * vy[i] - drift * ay + way * from_y);
    dvx[i] = stops ? (rest > 1 ? last_x : kRolls ? ex - sx : -gx) : -ax;
    dvy[i] = stops ? (rest > 1 ? last_y : kRolls ? ey - sy : -gy) : -ay;
    dwx[i] = stops ? (rest > 1 ? -last_y / R : fx - rx) : -k.turn * ay;
    dwy[i] = stops ? (rest > 1 ? last_x / R : fy - ry) : k.turn * ax;
    vx[i] = ex;
    vy[i] = ey;
    wx[i] = fx;
    wy[i] = fy;
    sticks[i] = stops ? 1 : 0;
  }
}

/// Those that roll and go on rolling on a plane that carries them along.
template <bool kOneKind>
HWY_ATTR inline void GlideRolling(GrainArrays& grains, std::size_t first, std::size_t last,
                                  double time, const GrainDriving& driving) {
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
  SLIPCHECK_EACH_ALONE
  for (std::size_t i = first; i < last; ++i) {
    const GrainRoll& roll = table[kOneKind ? 0 : kind[i]];
    const bool rolls = roll.holds * sticks[i] > 0;
    const double ex = vx[i] + roll.dvx, ey = vy[i] + roll.dvy;
    const double to_x = x[i] + (time * vx[i] + roll.x), to_y = y[i] + (time * vy[i] + roll.y);
    const double turned_x = -(ey - push.plane_y) * roll.per_radius,
                 turned_y = (ex - push.plane_x) * roll.per_radius;
    x[i] = rolls ? to_x : x[i];
    y[i] = rolls ? to_y : y[i];
    vx[i] = rolls ? ex : vx[i];
    vy[i] = rolls ? ey : vy[i];
    wx[i] = rolls ? turned_x : wx[i];
    wy[i] = rolls ? turned_y : wy[i];
    dvx[i] = rolls ? roll.last_dvx : dvx[i];
    dvy[i] = rolls ? roll.last_dvy : dvy[i];
    dwx[i] = rolls ? -(roll.last_dvy - plane_dy) * roll.per_radius : dwx[i];
    dwy[i] = rolls ? (roll.last_dvx - plane_dx) * roll.per_radius : dwy[i];
  }
}

/// On a plane that carries them along. Those that fly stay.
template <bool kOneKind, bool kLifts>
HWY_ATTR void GlideDriven(GrainArrays& grains, std::size_t first, std::size_t last,
                          const GrainSteps& steps) {
  const GrainDriving& driving = *steps.driving;
  const double time = steps.step * static_cast<double>(steps.count);
  SlidingList through, other;
  const auto slide = [&](bool all_through, SlidingList& list, std::size_t count) HWY_ATTR {
    GlideSliding(grains, all_through, list, count, driving.rolls, steps.step, driving.steps);
  };
  SlipRows slips;
  for (std::size_t begin = first; begin < last; begin += kSliding) {
    const std::size_t end = std::min(last, begin + kSliding);
    GlideRolling<kOneKind>(grains, begin, end, time, driving);
    FindSliding<kOneKind, kLifts>(grains, begin, end, driving.rolls, driving.steps.front(), slips);
    through.add(slips, slips.through, begin, end);
    other.add(slips, slips.maybe, begin, end);
    if (through.count() >= kSliding) slide(true, through, kSliding);
    if (other.count() >= kSliding) slide(false, other, kSliding);
  }
  slide(true, through, through.count());
  slide(false, other, other.count());
}

/// The last `left` of the steps of one that has come down.
HWY_ATTR inline void GlideLanded(GrainArrays& g, std::size_t i, const GrainSteps& steps,
                                 std::size_t left) {
  const std::vector<GrainRoll>& rolls = steps.driving->rolls;
  const auto pushes = std::span(steps.driving->steps).last(left);
  SlipRows slip;
  SlidingList alone;
  FindSliding<false, false>(g, i, i + 1, rolls, pushes.front(), slip);
  slip.maybe[0] = 1;
  alone.add(slip, slip.maybe, i, i + 1);
  GlideSliding(g, false, alone, 1, rolls, steps.step, pushes);
}

/// The next `count` steps of one that flies, or as many as it takes to come down. Returns their
/// number.
HWY_ATTR inline std::size_t Fly(GrainArrays& g, std::size_t i, double radius, double gravity,
                                const GrainPush& push, double h, std::size_t count) {
  const double fall = h * gravity, z = g.z[i], vz = g.vz[i];
  const auto height = [=](double m) { return z + h * (m * vz - 0.5 * m * (m + 1) * fall); };
  const auto is_down = [=](std::size_t steps) {
    const auto m = static_cast<double>(steps);
    return height(m) < radius && vz - m * fall < 0;
  };
  if (is_down(count)) {  // and will be: the first of those steps
    for (std::size_t above = 0; count - above > 1;) {
      const std::size_t between = (above + count) / 2;
      (is_down(between) ? count : above) = between;
    }
  }
  const auto m = static_cast<double>(count);
  const double ax = h * push.slope_x, ay = h * push.slope_y, drift = 0.5 * m * (m + 1);
  g.x[i] += h * (m * g.vx[i] + drift * ax);
  g.y[i] += h * (m * g.vy[i] + drift * ay);
  g.z[i] = height(m);
  g.vx[i] += m * ax;
  g.vy[i] += m * ay;
  g.vz[i] = vz - m * fall;
  g.dvx[i] = ax;
  g.dvy[i] = ay;
  g.dvz[i] = -fall;
  g.dwx[i] = g.dwy[i] = g.dwz[i] = g.bounced[i] = 0;
  return count;
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

/// On a level, still plane. Those that fly stay.
HWY_ATTR void GlideOn(const GrainFeatures& has, GrainArrays& grains, std::size_t first,
                      std::size_t last, const std::vector<GrainKind>& kinds, double h,
                      double count) {
  const bool one = kinds.size() == 1;
  const auto glide = has.rolls && has.lifts ? GlideWithFriction<false, true, true>
                     : has.rolls            ? GlideWithFriction<false, false, true>
                     : has.lifts && one     ? GlideWithFriction<true, true, false>
                     : has.lifts            ? GlideWithFriction<false, true, false>
                     : one                  ? GlideWithFriction<true, false, false>
                                            : GlideWithFriction<false, false, false>;
  glide(grains, first, last, kinds, h, count);
}

/// Those that fly, on or until they come down; what does so glides from there.
template <bool kDriven>
HWY_ATTR void GlideFlying(const GrainFeatures& has, GrainArrays& g, std::size_t first,
                          std::size_t last, const std::vector<GrainKind>& kinds,
                          const GrainPlane& plane, const GrainSteps& steps) {
  for (std::size_t i = first; i < last; ++i) {
    if (!(g.flies[i] > 0)) continue;
    const GrainKind& kind = kinds[g.kind[i]];
    std::size_t left = steps.count;
    const auto push_after = [&](std::size_t done) -> const GrainPush& {
      return kDriven ? steps.driving->steps[done - 1] : kNoPush;
    };
    while (left > 0 && g.flies[i] > 0) {
      left -= Fly(g, i, kind.radius, plane.gravity, push_after(1), steps.step, left);
      land_grain(kind, plane, push_after(steps.count - left), {g, 0}, i);
    }
    if (left == 0) continue;
    if constexpr (kDriven)
      GlideLanded(g, i, steps, left);
    else
      GlideOn(has, g, i, i + 1, kinds, steps.step, static_cast<double>(left));
  }
}

HWY_ATTR GrainSpeeds Glide(const GrainFeatures& features, GrainArrays& grains, std::size_t first,
                           std::size_t last, const std::vector<GrainKind>& kinds,
                           const GrainPlane& plane, const GrainSteps& steps) {
  if (features.driven && features.lifts) {
    GlideDriven<false, true>(grains, first, last, steps);
    GlideFlying<true>(features, grains, first, last, kinds, plane, steps);
  } else if (features.driven && kinds.size() == 1) {
    GlideDriven<true, false>(grains, first, last, steps);
  } else if (features.driven) {
    GlideDriven<false, false>(grains, first, last, steps);
  } else if (!features.on_plane) {
    GlideFreely(grains, first, last, steps.step * static_cast<double>(steps.count));
  } else {
    const auto count = static_cast<double>(steps.count);
    GlideOn(features, grains, first, last, kinds, steps.step, count);
    if (features.lifts) GlideFlying<false>(features, grains, first, last, kinds, plane, steps);
  }
  const GrainPush& push = features.driven ? steps.driving->steps.back() : kNoPush;
  GrainSpeeds fastest;
  fastest.along2 = LargestSquare(grains.vx, grains.vy, first, last, push.drift_x, push.drift_y);
  if (features.lifts) fastest.across2 = LargestSquare(grains.vz, grains.vz, first, last, 0, 0) / 2;
  if (features.lifts && features.walls)
    fastest.height = *std::max_element(grains.z.begin() + static_cast<std::ptrdiff_t>(first),
                                       grains.z.begin() + static_cast<std::ptrdiff_t>(last));
  return fastest;
}

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
