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

#include "base/fused-inl.h"
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

/// Of grains in a row, at most kSliding.
struct SlipRows {
  SlidingRow ux, uy;  ///< slip u [m/s]
  SlidingRow dx,
      dy;  ///< what the last step changed of it beside the plane's motion in the next [m/s]
  /// 1: it slides in all of the steps, and friction against the slip that the last one lets expect;
  /// it slides, but maybe not so. Else it rolls or flies.
  std::array<std::uint64_t, kSliding> through, maybe;
};

/// Of the grains first … last − 1 before steps of which `push` is the first.
template <bool kOneKind, bool kLifts>
HWY_ATTR inline void FindSliding(const GrainArrays& grains, std::size_t first, std::size_t last,
                                 const std::vector<GrainRoll>& rolls, const GrainPush& push,
                                 SlipRows& slips) {
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
  const GrainRoll* HWY_RESTRICT table = rolls.data();
  const double moved_x = push.plane_x - push.before_x, moved_y = push.plane_y - push.before_y;
  SLIPCHECK_EACH_ALONE
  for (std::size_t k = 0; k < last - first; ++k) {
    const GrainRoll& roll = table[kOneKind ? 0 : kind[k]];
    const double R = roll.radius, least = roll.slides_from;
    const double ux = vx[k] - R * wy[k] - push.before_x, uy = vy[k] + R * wx[k] - push.before_y;
    const double dx = dvx[k] - R * dwy[k] - moved_x, dy = dvy[k] + R * dwx[k] - moved_y;
    const double slip2 = ux * ux + uy * uy;
    const bool through =
        (sticks[k] <= 0) & (slip2 > least * least) & (4 * (dx * dx + dy * dy) <= slip2);
    const bool slides = !(sticks[k] * roll.holds > 0) & !(kLifts && flies[k] > 0);
    slips.ux.of[k] = ux;
    slips.uy.of[k] = uy;
    slips.dx.of[k] = dx;
    slips.dy.of[k] = dy;
    slips.through[k] = (slides & through) ? 1 : 0;
    slips.maybe[k] = (slides & !through) ? 1 : 0;
  }
}

/// Those that slide, or come to roll, and what is known of them from step to step. Of the slip u
/// only what friction takes is kept for each: what pushes give is the same for all.
struct SlidingGrains {
  std::size_t padded = 0;                    ///< so many, in vectors and nothing beside
  SlidingRow ux, uy;                         ///< u before the first step [m/s]
  std::array<SlidingRow, 2> left_x, left_y;  ///< what is left of it after step n, in n % 2 [m/s]
  SlidingRow sum_x, sum_y;                   ///< of that over the steps [m/s]
  SlidingRow slides_by;                      ///< what friction takes of u in a step at most [m/s]
  SlidingRow slides2, holds2;                ///< squares of that, sliding and at rest [m²/s²]
  SlidingRow share;                          ///< of what u loses that v does [-]
  SlidingRow sticks;
};

/// Grains that slide the same way, until as many are found as slide at once.
class SlidingList {
 public:
  std::size_t count() const { return count_; }

  /// Those of grains first … last − 1 that are `among` them.
  HWY_ATTR void add(const SlipRows& slips, const std::array<std::uint64_t, kSliding>& among,
                    std::size_t first, std::size_t last) {
    std::size_t all = count_;
    for (std::size_t i = first; i < last; ++i) {
      grain_[all] = i;
      all += among[i - first];
    }
    const double* HWY_RESTRICT ux = slips.ux.of;
    const double* HWY_RESTRICT uy = slips.uy.of;
    const double* HWY_RESTRICT dx = slips.dx.of;
    const double* HWY_RESTRICT dy = slips.dy.of;
    for (std::size_t k = count_; k < all; ++k) {
      const std::size_t at = grain_[k] - first;
      ux_[k] = ux[at];
      uy_[k] = uy[at];
      dx_[k] = dx[at];
      dy_[k] = dy[at];
    }
    count_ = all;
  }
  /// The last `some`, in no list any more then. Their indices stay until others are added.
  HWY_ATTR std::span<const std::uint64_t> take(std::size_t some, const GrainArrays& g,
                                               const std::vector<GrainRoll>& rolls,
                                               SlidingGrains& s) {
    count_ -= some;
    const std::uint64_t* HWY_RESTRICT grain = grain_ + count_;
    if (rolls.size() == 1) {
      const GrainRoll& roll = rolls.front();
      std::fill_n(s.slides_by.of, some, roll.slides_by);
      std::fill_n(s.holds2.of, some, roll.holds_by * roll.holds_by);
      std::fill_n(s.share.of, some, roll.share);
    } else {
      const std::uint32_t* HWY_RESTRICT kind = g.kind.data();
      const GrainRoll* HWY_RESTRICT table = rolls.data();
      SLIPCHECK_EACH_ALONE
      for (std::size_t k = 0; k < some; ++k) {
        const GrainRoll& roll = table[kind[grain[k]]];
        s.slides_by.of[k] = roll.slides_by;
        s.holds2.of[k] = roll.holds_by * roll.holds_by;
        s.share.of[k] = roll.share;
      }
    }
    const double* HWY_RESTRICT sticks = g.sticks.data();
    SLIPCHECK_EACH_ALONE
    for (std::size_t k = 0; k < some; ++k) s.sticks.of[k] = sticks[grain[k]];
    s.padded = (some + 7) / 8 * 8;
    for (SlidingRow* row : {&s.slides_by, &s.holds2, &s.share, &s.sticks})
      std::fill(row->of + some, row->of + s.padded, 0.0);
    for (std::size_t k = count_ + some; k < count_ + s.padded; ++k) {
      ux_[k] = 1;  // a slip that has a direction
      uy_[k] = dx_[k] = dy_[k] = 0;
    }
    const double* HWY_RESTRICT ux = ux_ + count_;
    const double* HWY_RESTRICT uy = uy_ + count_;
    const double* HWY_RESTRICT dx = dx_ + count_;
    const double* HWY_RESTRICT dy = dy_ + count_;
    SLIPCHECK_EACH_ALONE
    for (std::size_t k = 0; k < s.padded; ++k) {
      s.ux.of[k] = s.left_x[0].of[k] = ux[k];
      s.uy.of[k] = s.left_y[0].of[k] = uy[k];
      s.left_x[1].of[k] = ux[k] - dx[k];
      s.left_y[1].of[k] = uy[k] - dy[k];
      s.slides2.of[k] = s.slides_by.of[k] * s.slides_by.of[k];
      s.sum_x.of[k] = s.sum_y.of[k] = 0;
    }
    return {grain, some};
  }

 private:
  static constexpr std::size_t kRoom = 2 * kSliding + 8;
  std::size_t count_ = 0;
  std::uint64_t grain_[kRoom];
  double ux_[kRoom], uy_[kRoom], dx_[kRoom], dy_[kRoom];  // [m/s]
};

HWY_ATTR inline void PutSliding(const SlidingGrains& s, std::span<const std::uint64_t> grains,
                                const std::vector<GrainKind>& kinds, double h,
                                std::span<const GrainPush> pushes, GrainArrays& g) {
  const GrainPush& last = pushes.back();
  const double ax = h * last.slope_x, ay = h * last.slope_y;
  const auto count = static_cast<double>(pushes.size());
  const double drift = 0.5 * count * (count + 1);
  const std::size_t now = pushes.size() % 2, before = 1 - now;
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
  const std::uint64_t* HWY_RESTRICT grain = grains.data();
  SLIPCHECK_EACH_ALONE
  for (std::size_t k = 0; k < grains.size(); ++k) {
    const std::size_t i = grain[k];
    const bool rolls = s.sticks.of[k] > 0;
    const double turn = table[kind[i]].turn, R = table[kind[i]].radius, share = s.share.of[k];
    const double left_x = s.left_x[now].of[k], left_y = s.left_y[now].of[k];
    const double sx = share * (s.ux.of[k] - left_x);  // what v has lost
    const double sy = share * (s.uy.of[k] - left_y);
    const double lost_x = share * (s.left_x[before].of[k] - left_x);  // in the last step
    const double lost_y = share * (s.left_y[before].of[k] - left_y);
    const double ex = vx[i] + (count * ax - sx), ey = vy[i] + (count * ay - sy);
    const double turned_x = wx[i] - turn * sy, turned_y = wy[i] + turn * sx;
    const double rolling_x = -(ey - last.plane_y) / R, rolling_y = (ex - last.plane_x) / R;
    const double tx = share * (count * s.ux.of[k] - s.sum_x.of[k]);
    const double ty = share * (count * s.uy.of[k] - s.sum_y.of[k]);
    x[i] += h * (count * vx[i] + drift * ax - tx);
    y[i] += h * (count * vy[i] + drift * ay - ty);
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

/// What pushes have given every slip until the end of a step [m/s], and twice what they have until
/// its middle, as the change in the step before lets expect. In the first step that is known of
/// each grain.
struct SlipPush {
  double x = 0, y = 0, twice_x = 0, twice_y = 0;
};

/// Calls step(n, push) for one after the other.
template <class Step>
HWY_ATTR HWY_INLINE void ForEachStep(std::span<const GrainPush> pushes, double h,
                                     const Step& step) {
  SlipPush all;
  for (std::size_t n = 0; n < pushes.size(); ++n) {
    const GrainPush& push = pushes[n];
    const double moved_x = push.plane_x - push.before_x, moved_y = push.plane_y - push.before_y;
    if (n > 0) {
      all.twice_x = 2 * all.x + (h * pushes[n - 1].slope_x - moved_x);
      all.twice_y = 2 * all.y + (h * pushes[n - 1].slope_y - moved_y);
    }
    all.x += h * push.slope_x - moved_x;
    all.y += h * push.slope_y - moved_y;
    step(n, all);
  }
}

/// One by one.
HWY_ATTR HWY_NOINLINE void SlideEach(SlidingGrains& s, double h,
                                     std::span<const GrainPush> pushes) {
  ForEachStep(pushes, h, [&](std::size_t n, const SlipPush push) HWY_ATTR {
    const double* HWY_RESTRICT now_x = s.left_x[n % 2].of;
    const double* HWY_RESTRICT now_y = s.left_y[n % 2].of;
    double* HWY_RESTRICT next_x = s.left_x[(n + 1) % 2].of;
    double* HWY_RESTRICT next_y = s.left_y[(n + 1) % 2].of;
    SLIPCHECK_EACH_ALONE
    for (std::size_t k = 0; k < s.padded; ++k) {
      const double x = now_x[k] + push.x, y = now_y[k] + push.y;
      const double px = (now_x[k] - next_x[k]) + (now_x[k] + (now_x[k] + push.twice_x));
      const double py = (now_y[k] - next_y[k]) + (now_y[k] + (now_y[k] + push.twice_y));
      const double slip2 = x * x + y * y, expected2 = px * px + py * py;
      const bool held = slip2 <= (s.sticks.of[k] > 0 ? s.holds2.of[k] : s.slides2.of[k]);
      const bool follows = (px * x + py * y > 0) & (expected2 > 4 * s.slides2.of[k]);
      const double along_x = follows ? px : x, along_y = follows ? py : y;
      const double size2 = follows ? expected2 : slip2;
      const double lost = s.slides_by.of[k] * (1 / std::sqrt(size2 > 0 ? size2 : 1));
      const double to_x = held ? -push.x : now_x[k] - lost * along_x;
      const double to_y = held ? -push.y : now_y[k] - lost * along_y;
      next_x[k] = to_x;
      next_y[k] = to_y;
      s.sum_x.of[k] += to_x;
      s.sum_y.of[k] += to_y;
      s.sticks.of[k] = held ? 1 : 0;
    }
  });
}

/// 1/√x of x > 0 by Newton's steps, from the guess that its bits are: the same everywhere.
HWY_ATTR HWY_INLINE double PerRoot(double x) {
  constexpr std::uint64_t kGuess = 0x5FE6EB50C7B537A9;  // within 3.5 %, then 2e-3, 5e-6, 3e-11
  double root = std::bit_cast<double>(kGuess - (std::bit_cast<std::uint64_t>(x) >> 1));
  const double half = 0.5 * x;
  for (int n = 0; n < 4; ++n) root *= 1.5 - half * root * root;
  return root;
}

/// 1/√x from a guess g that is less than 1e-3 of it off: 4.4 of the fourth power of that is left.
HWY_ATTR HWY_INLINE double PerRootNear(double x, double g) {
  const double z = x * (g * g);  // nearly 1
  return g * Fused(Fused(Fused(-0.3125, z, 1.3125), z, -2.1875), z, 2.1875);
}

/// As SlideEach(), of those that FindSliding() tells: a step is little more than the direction of
/// the friction. From the fifth on 1/|u| is what its last three values let expect, or nearly: the
/// one of the first step is not, as an impact may have been before it.
HWY_ATTR HWY_NOINLINE void SlideThrough(SlidingGrains& s, double h,
                                        std::span<const GrainPush> pushes) {
  std::array<SlidingRow, 3> roots;
  const auto slide = [&](std::size_t n, const SlipPush push, auto goes_on) HWY_ATTR {
    const double* HWY_RESTRICT now_x = s.left_x[n % 2].of;
    const double* HWY_RESTRICT now_y = s.left_y[n % 2].of;
    double* HWY_RESTRICT next_x = s.left_x[(n + 1) % 2].of;
    double* HWY_RESTRICT next_y = s.left_y[(n + 1) % 2].of;
    const double* HWY_RESTRICT last = roots[(n + 2) % 3].of;
    const double* HWY_RESTRICT before = roots[(n + 1) % 3].of;
    double* HWY_RESTRICT root = roots[n % 3].of;
    SLIPCHECK_EACH_ALONE
    for (std::size_t k = 0; k < s.padded; ++k) {
      const double px = (now_x[k] - next_x[k]) + (now_x[k] + (now_x[k] + push.twice_x));
      const double py = (now_y[k] - next_y[k]) + (now_y[k] + (now_y[k] + push.twice_y));
      const double expected2 = Fused(px, px, py * py);
      double per_slip;
      if constexpr (goes_on)
        per_slip = PerRootNear(expected2, Fused(3, last[k] - before[k], root[k]));
      else
        per_slip = PerRoot(expected2);
      const double lost = s.slides_by.of[k] * per_slip;
      const double to_x = Fused(-lost, px, now_x[k]), to_y = Fused(-lost, py, now_y[k]);
      next_x[k] = to_x;
      next_y[k] = to_y;
      s.sum_x.of[k] += to_x;
      s.sum_y.of[k] += to_y;
      root[k] = per_slip;
    }
  };
  ForEachStep(pushes, h, [&](std::size_t n, const SlipPush& push) HWY_ATTR {
    n < 4 ? slide(n, push, std::false_type()) : slide(n, push, std::true_type());
  });
}

/// On a plane that carries them along: no sum over the steps is known, so each is done. The last
/// `count` of a list, at most kSliding.
using Slide = void(SlidingGrains& s, double h, std::span<const GrainPush> pushes);
HWY_ATTR inline void GlideSliding(GrainArrays& g, Slide& slide, SlidingList& list,
                                  std::size_t count, const std::vector<GrainKind>& kinds,
                                  const std::vector<GrainRoll>& rolls, double h,
                                  std::span<const GrainPush> pushes) {
  SlidingGrains s;
  const auto grains = list.take(count, g, rolls, s);
  slide(s, h, pushes);
  PutSliding(s, grains, kinds, h, pushes, g);
}

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
