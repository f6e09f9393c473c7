// Grains that meet none and slide on a plane that carries them along; included once for each
// instruction set.
#if defined(SLIPCHECK_GRAIN_SLIDES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_GRAIN_SLIDES_INL_H
#undef SLIPCHECK_GRAIN_SLIDES_INL_H
#else
#define SLIPCHECK_GRAIN_SLIDES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "reference/steps/grain_kernels.h"

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

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {

/// How many slide at once, in the nearest cache; a step reads and writes ten rows.
inline constexpr std::size_t kSliding = 256;

/// Two of them are no multiple of 4 kB apart, which a processor takes for the same place.
struct alignas(64) SlidingRow {
  double of[kSliding + 8];
};

/// Those that slide, or come to roll, and what is known of them from step to step.
struct SlidingGrains {
  std::size_t padded = 0;         ///< so many, in vectors and nothing beside
  SlidingRow ux, uy;              ///< slip [m/s]
  SlidingRow dx, dy;              ///< its last change, were the plane still [m/s]
  SlidingRow sx, sy;              ///< what friction has taken from v [m/s]
  SlidingRow tx, ty;              ///< the sum of that over the steps [m/s]
  SlidingRow held_by, slides_by;  ///< what friction takes at most in a step [m/s]
  SlidingRow share, grow;         ///< 1/(1 + A), and 1 + A
  SlidingRow sticks;
};

HWY_ATTR inline void TakeSliding(const GrainArrays& g, std::span<const std::size_t> grains,
                                 const std::vector<GrainKind>& kinds, double h,
                                 const GrainPush& first, SlidingGrains& s) {
  const std::size_t n = grains.size();
  s.padded = (n + 7) / 8 * 8;
  for (SlidingRow* row : {&s.ux, &s.uy, &s.dx, &s.dy, &s.sx, &s.sy, &s.tx, &s.ty, &s.held_by,
                          &s.slides_by, &s.share, &s.grow, &s.sticks})
    std::fill(row->of + n, row->of + s.padded, 0.0);
  std::fill(s.ux.of + n, s.ux.of + s.padded, 1.0);  // a slip that has a direction
  const double* HWY_RESTRICT vx = g.vx.data();
  const double* HWY_RESTRICT vy = g.vy.data();
  const double* HWY_RESTRICT wx = g.wx.data();
  const double* HWY_RESTRICT wy = g.wy.data();
  const double* HWY_RESTRICT dvx = g.dvx.data();
  const double* HWY_RESTRICT dvy = g.dvy.data();
  const double* HWY_RESTRICT dwx = g.dwx.data();
  const double* HWY_RESTRICT dwy = g.dwy.data();
  const double* HWY_RESTRICT sticks = g.sticks.data();
  const std::uint32_t* HWY_RESTRICT kind_of = g.kind.data();
  const GrainKind* HWY_RESTRICT table = kinds.data();
  const std::size_t* HWY_RESTRICT grain = grains.data();
  SLIPCHECK_EACH_ALONE
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = grain[k];
    const GrainKind& kind = table[kind_of[i]];
    const double R = kind.radius, load = kind.weight * kind.inverse_mass * h;
    s.ux.of[k] = vx[i] - R * wy[i] - first.before_x;
    s.uy.of[k] = vy[i] + R * wx[i] - first.before_y;
    s.dx.of[k] = dvx[i] - R * dwy[i];
    s.dy.of[k] = dvy[i] + R * dwx[i];
    s.sx.of[k] = s.sy.of[k] = s.tx.of[k] = s.ty.of[k] = 0;
    s.sticks.of[k] = sticks[i];
    s.slides_by.of[k] = kind.kinetic_friction * load;
    s.held_by.of[k] = kind.static_friction * load;
    s.share.of[k] = kind.share;
    s.grow.of[k] = 1 / kind.share;
  }
}

HWY_ATTR inline void PutSliding(const SlidingGrains& s, std::span<const std::size_t> grains,
                                const std::vector<GrainKind>& kinds, double h,
                                std::span<const GrainPush> pushes, GrainArrays& g) {
  const GrainPush& last = pushes.back();
  const double ax = h * last.slope_x, ay = h * last.slope_y;
  const auto count = static_cast<double>(pushes.size());
  const double drift = 0.5 * count * (count + 1);
  double* HWY_RESTRICT x = g.x.data();
  double* HWY_RESTRICT y = g.y.data();
  double* HWY_RESTRICT vx = g.vx.data();
  double* HWY_RESTRICT vy = g.vy.data();
  double* HWY_RESTRICT wx = g.wx.data();
  double* HWY_RESTRICT wy = g.wy.data();
  double* HWY_RESTRICT dvx = g.dvx.data();
  double* HWY_RESTRICT dvy = g.dvy.data();
  double* HWY_RESTRICT dwx = g.dwx.data();
  double* HWY_RESTRICT dwy = g.dwy.data();
  double* HWY_RESTRICT sticks = g.sticks.data();
  const std::uint32_t* HWY_RESTRICT kind = g.kind.data();
  const GrainKind* HWY_RESTRICT table = kinds.data();
  const std::size_t* HWY_RESTRICT grain = grains.data();
  SLIPCHECK_EACH_ALONE
  for (std::size_t k = 0; k < grains.size(); ++k) {
    const std::size_t i = grain[k];
    const bool rolls = s.sticks.of[k] > 0;
    const double turn = table[kind[i]].turn, R = table[kind[i]].radius;
    const double ex = vx[i] + (count * ax - s.sx.of[k]), ey = vy[i] + (count * ay - s.sy.of[k]);
    const double turned_x = wx[i] - turn * s.sy.of[k], turned_y = wy[i] + turn * s.sx.of[k];
    const double rolling_x = -(ey - last.plane_y) / R, rolling_y = (ex - last.plane_x) / R;
    const double lost_x = s.share.of[k] * (ax - s.dx.of[k]);
    const double lost_y = s.share.of[k] * (ay - s.dy.of[k]);
    x[i] += h * (count * vx[i] + drift * ax - s.tx.of[k]);
    y[i] += h * (count * vy[i] + drift * ay - s.ty.of[k]);
    vx[i] = ex;
    vy[i] = ey;
    wx[i] = rolls ? rolling_x : turned_x;
    wy[i] = rolls ? rolling_y : turned_y;
    dvx[i] = ax - lost_x;
    dvy[i] = ay - lost_y;
    dwx[i] = -turn * lost_y;
    dwy[i] = turn * lost_x;
    sticks[i] = s.sticks.of[k];
  }
}

/// 1/√x of x > 0 by Newton's steps, from the guess that its bits are: the same everywhere.
HWY_ATTR HWY_INLINE double PerRoot(double x) {
  constexpr std::uint64_t kGuess = 0x5FE6EB50C7B537A9;  // within 3.5 %, then 2e-3, 5e-6, 3e-11
  double root = std::bit_cast<double>(kGuess - (std::bit_cast<std::uint64_t>(x) >> 1));
  const double half = 0.5 * x;
  for (int n = 0; n < 4; ++n) root *= 1.5 - half * root * root;
  return root;
}

/// One by one, of the slip u alone.
HWY_ATTR inline void SlideEach(SlidingGrains& s, double h, std::span<const GrainPush> pushes) {
  for (const GrainPush& push : pushes) {
    const double ax = h * push.slope_x, ay = h * push.slope_y;
    const double plane_dx = push.plane_x - push.before_x, plane_dy = push.plane_y - push.before_y;
    SLIPCHECK_EACH_ALONE
    for (std::size_t k = 0; k < s.padded; ++k) {
      const double x = s.ux.of[k] + (ax - plane_dx), y = s.uy.of[k] + (ay - plane_dy);
      const double px = s.ux.of[k] + 0.5 * (s.dx.of[k] - plane_dx);
      const double py = s.uy.of[k] + 0.5 * (s.dy.of[k] - plane_dy);
      const double share2 = s.share.of[k] * s.share.of[k], slip2 = x * x + y * y;
      const double cap = s.sticks.of[k] > 0 ? s.held_by.of[k] : s.slides_by.of[k];
      const bool held = slip2 * share2 <= cap * cap;
      const double friction = s.slides_by.of[k], expected2 = px * px + py * py;
      const bool follows = (px * x + py * y > 0) & (expected2 * share2 > friction * friction);
      const double along_x = follows ? px : x, along_y = follows ? py : y;
      const double size2 = follows ? expected2 : slip2;
      const double sliding = friction * (1 / std::sqrt(size2 > 0 ? size2 : 1));
      const double lost_x = held ? s.share.of[k] * x : sliding * along_x;  // of v
      const double lost_y = held ? s.share.of[k] * y : sliding * along_y;
      const double slip_x = s.grow.of[k] * lost_x, slip_y = s.grow.of[k] * lost_y;
      s.ux.of[k] = held ? 0 : x - slip_x;
      s.uy.of[k] = held ? 0 : y - slip_y;
      s.dx.of[k] = ax - slip_x;
      s.dy.of[k] = ay - slip_y;
      const double all_x = s.sx.of[k] + lost_x, all_y = s.sy.of[k] + lost_y;
      s.sx.of[k] = all_x;
      s.sy.of[k] = all_y;
      s.tx.of[k] += all_x;
      s.ty.of[k] += all_y;
      s.sticks.of[k] = held ? 1 : 0;
    }
  }
}

/// 1/√x from a guess g that is less than 1e-3 of it off: 4.4 of the fourth power of that is left.
HWY_ATTR HWY_INLINE double PerRootNear(double x, double g) {
  const double left = 1 - x * (g * g);
  return g + (g * left) * (0.5 + left * (0.375 + 0.3125 * left));
}

/// What a step gives every slip u, and that with half of what the next one will [m/s].
struct SlipPush {
  double x, y, ahead_x, ahead_y;
};

/// Of step n. After the last one the plane is thought still: PutSliding() keeps what changes v.
HWY_ATTR inline SlipPush FindSlipPush(std::span<const GrainPush> pushes, std::size_t n, double h) {
  const auto moved_x = [&](std::size_t k) { return pushes[k].plane_x - pushes[k].before_x; };
  const auto moved_y = [&](std::size_t k) { return pushes[k].plane_y - pushes[k].before_y; };
  const bool is_last = n + 1 == pushes.size();
  const double ax = h * pushes[n].slope_x, ay = h * pushes[n].slope_y;
  const double x = ax - moved_x(n), y = ay - moved_y(n);
  const double next_x = is_last ? ax : ax - moved_x(n + 1);
  const double next_y = is_last ? ay : ay - moved_y(n + 1);
  return {x, y, x + 0.5 * next_x, y + 0.5 * next_y};
}

/// As SlideEach(), of those that FindSliding() tells: a step is little more than the direction of
/// the friction, and what that takes is the difference between the pushes and the slip. From the
/// fifth on 1/|u| is what its last three values let expect, or nearly: the one of the first step
/// is not, as an impact may have been before it.
HWY_ATTR inline void SlideThrough(SlidingGrains& s, double h, std::span<const GrainPush> pushes) {
  SlidingRow px, py, friction;  // the slip expected in the middle of a step, and what u loses
  std::array<SlidingRow, 3> roots;
  const GrainPush& first = pushes.front();
  const double first_x = first.plane_x - first.before_x, first_y = first.plane_y - first.before_y;
  SLIPCHECK_EACH_ALONE
  for (std::size_t k = 0; k < s.padded; ++k) {
    px.of[k] = s.ux.of[k] + 0.5 * (s.dx.of[k] - first_x);
    py.of[k] = s.uy.of[k] + 0.5 * (s.dy.of[k] - first_y);
    friction.of[k] = s.grow.of[k] * s.slides_by.of[k];
    s.sx.of[k] = s.ux.of[k];
    s.sy.of[k] = s.uy.of[k];
  }
  double pushed_x = 0, pushed_y = 0, way_x = 0, way_y = 0;
  const auto step = [&](std::size_t n, auto goes_on) HWY_ATTR {
    const SlipPush push = FindSlipPush(pushes, n, h);
    way_x += pushed_x += push.x;
    way_y += pushed_y += push.y;
    const double* HWY_RESTRICT last = roots[(n + 2) % 3].of;
    const double* HWY_RESTRICT before = roots[(n + 1) % 3].of;
    double* HWY_RESTRICT root = roots[n % 3].of;
    SLIPCHECK_EACH_ALONE
    for (std::size_t k = 0; k < s.padded; ++k) {
      const double slip_x = px.of[k], slip_y = py.of[k];
      const double slip2 = slip_x * slip_x + slip_y * slip_y;
      double per_slip;
      if constexpr (goes_on)
        per_slip = PerRootNear(slip2, 3 * (last[k] - before[k]) + root[k]);
      else
        per_slip = PerRoot(slip2);
      const double lost_x = friction.of[k] * slip_x * per_slip;
      const double lost_y = friction.of[k] * slip_y * per_slip;
      const double x = (s.ux.of[k] + push.x) - lost_x, y = (s.uy.of[k] + push.y) - lost_y;
      px.of[k] = (s.ux.of[k] + push.ahead_x) - 1.5 * lost_x;
      py.of[k] = (s.uy.of[k] + push.ahead_y) - 1.5 * lost_y;
      s.ux.of[k] = x;
      s.uy.of[k] = y;
      s.tx.of[k] += x;
      s.ty.of[k] += y;
      root[k] = per_slip;
    }
  };
  const std::size_t looks = std::min<std::size_t>(pushes.size(), 4);
  for (std::size_t n = 0; n < looks; ++n) step(n, std::false_type());
  for (std::size_t n = looks; n < pushes.size(); ++n) step(n, std::true_type());
  const auto count = static_cast<double>(pushes.size());
  SLIPCHECK_EACH_ALONE
  for (std::size_t k = 0; k < s.padded; ++k) {
    const double from_x = s.sx.of[k], from_y = s.sy.of[k];
    s.sx.of[k] = s.share.of[k] * (pushed_x - (s.ux.of[k] - from_x));
    s.sy.of[k] = s.share.of[k] * (pushed_y - (s.uy.of[k] - from_y));
    s.tx.of[k] = s.share.of[k] * (way_x - (s.tx.of[k] - count * from_x));
    s.ty.of[k] = s.share.of[k] * (way_y - (s.ty.of[k] - count * from_y));
    s.dx.of[k] = 2 * (px.of[k] - s.ux.of[k]);
    s.dy.of[k] = 2 * (py.of[k] - s.uy.of[k]);
  }
}

/// How a grain's steps are done: it rolls or flies, slides in all of them, or maybe not.
inline constexpr double kNoSlide = 0, kSlidesThrough = 1, kSlides = 2;

/// Which of these it is for first … last − 1, at most kSliding: those are sure to slide in all the
/// steps that do, and friction against the slip that the last step lets expect.
template <bool kOneKind, bool kLifts>
HWY_ATTR inline void FindSliding(const GrainArrays& grains, std::size_t first, std::size_t last,
                                 const GrainDriving& driving, SlidingRow& slides) {
  const double* HWY_RESTRICT vx = grains.vx.data() + first;
  const double* HWY_RESTRICT vy = grains.vy.data() + first;
  const double* HWY_RESTRICT wx = grains.wx.data() + first;
  const double* HWY_RESTRICT wy = grains.wy.data() + first;
  const double* HWY_RESTRICT dvx = grains.dvx.data() + first;
  const double* HWY_RESTRICT dvy = grains.dvy.data() + first;
  const double* HWY_RESTRICT dwx = grains.dwx.data() + first;
  const double* HWY_RESTRICT dwy = grains.dwy.data() + first;
  const double* HWY_RESTRICT sticks = grains.sticks.data() + first;
  const double* HWY_RESTRICT flies = kLifts ? grains.flies.data() + first : nullptr;
  const std::uint32_t* HWY_RESTRICT kind = grains.kind.data() + first;
  const GrainRoll* HWY_RESTRICT table = driving.rolls.data();
  const GrainPush& push = driving.steps.front();
  SLIPCHECK_EACH_ALONE
  for (std::size_t k = 0; k < last - first; ++k) {
    const GrainRoll& roll = table[kOneKind ? 0 : kind[k]];
    const double R = roll.radius, least = roll.slides_from;
    const double ux = vx[k] - R * wy[k] - push.before_x, uy = vy[k] + R * wx[k] - push.before_y;
    const double dx = dvx[k] - R * dwy[k] - (push.plane_x - push.before_x);
    const double dy = dvy[k] + R * dwx[k] - (push.plane_y - push.before_y);
    const double slip2 = ux * ux + uy * uy;
    const bool through =
        (sticks[k] <= 0) & (slip2 > least * least) & (4 * (dx * dx + dy * dy) <= slip2);
    const bool rolls = sticks[k] * roll.holds > 0, glides = !(kLifts && flies[k] > 0);
    slides.of[k] = (rolls | !glides) ? kNoSlide : through ? kSlidesThrough : kSlides;
  }
}

/// Grains that slide, and how their steps are done.
struct SlidingList {
  void (*slide)(SlidingGrains&, double, std::span<const GrainPush>);
  std::size_t count = 0;
  std::array<std::size_t, kSliding> of = {};
};

/// On a plane that carries them along: no sum over the steps is known, so each is done.
HWY_ATTR inline void GlideSliding(GrainArrays& g, const SlidingList& list,
                                  const std::vector<GrainKind>& kinds, double h,
                                  std::span<const GrainPush> pushes) {
  const std::span<const std::size_t> grains(list.of.data(), list.count);
  SlidingGrains s;
  TakeSliding(g, grains, kinds, h, pushes.front(), s);
  list.slide(s, h, pushes);
  PutSliding(s, grains, kinds, h, pushes, g);
}

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
