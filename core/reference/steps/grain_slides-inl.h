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
namespace hn = hwy::HWY_NAMESPACE;

/// How many slide at once, in the nearest cache; a step reads and writes ten rows.
inline constexpr std::size_t kSliding = 256;

/// Two of them are no multiple of 4 kB apart, which a processor takes for the same place.
struct alignas(64) SlidingRow {
  double of[kSliding + 8];
};

/// Of grains in a row, at most kSliding: slips u, and what the last step changed of them beside the
/// plane's motion in the next [m/s].
struct SlipRows {
  SlidingRow ux, uy, dx, dy;
  /// 1: it slides in all of the steps, and friction against the slip that the last one lets expect;
  /// it slides, but maybe not so. Else it rolls or flies.
  alignas(64) std::array<std::uint64_t, kSliding> through, maybe;
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
  std::fill(slips.through.begin() + (last - first), slips.through.end(), 0);
  std::fill(slips.maybe.begin() + (last - first), slips.maybe.end(), 0);
}

/// Those that slide, or come to roll, and what is known of them from step to step. Of the slip u
/// only what friction takes is kept for each: what pushes give is the same for all.
struct SlidingGrains {
  std::size_t padded = 0;                    ///< so many, in vectors and nothing beside
  double unit = 1;                           ///< of velocities here [m/s]
  SlidingRow ux, uy;                         ///< u before the first step
  std::array<SlidingRow, 2> left_x, left_y;  ///< what is left of it after step n, in n % 2
  SlidingRow sum_x, sum_y;                   ///< of that over the steps
  SlidingRow slides_by;                      ///< what friction takes of u in a step at most
  SlidingRow slides2, holds2;                ///< squares of that, sliding and at rest
  SlidingRow share;                          ///< of what u loses that v does [-]
  SlidingRow turn;                           ///< |ΔΩ| for each |Δv| by friction [1/m]
  SlidingRow sticks;
};

/// Whether friction takes as much of every slip, which is the unit of velocities then.
inline bool slide_alike(const std::vector<GrainRoll>& rolls) {
  return rolls.size() == 1 && rolls.front().slides_by > 0;
}

/// Grains that slide the same way, until as many are found as slide at once.
class SlidingList {
 public:
  std::size_t count() const { return count_; }

  /// Those of grains first … last − 1 that are `among` them.
  HWY_ATTR void add(const SlipRows& slips, const std::array<std::uint64_t, kSliding>& among,
                    std::size_t first, std::size_t last) {
    const hn::CappedTag<std::uint64_t, 8> d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t count = count_;
    // Which are is written down without a branch for some, then read.
    constexpr std::size_t kAtOnce = 64;
    for (std::size_t k = 0; k < last - first; k += kAtOnce) {
      std::uint64_t all = 0;
      for (std::size_t at = 0; at < kAtOnce; at += lanes) {
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::Ne(hn::Load(d, among.data() + k + at), hn::Zero(d)), bits);
        all |= std::uint64_t{bits[0]} << at;
      }
      for (; all != 0; all &= all - 1, ++count) {
        const std::size_t at = k + static_cast<std::size_t>(std::countr_zero(all));
        grain_[count] = first + at;
        ux_[count] = slips.ux.of[at];
        uy_[count] = slips.uy.of[at];
        dx_[count] = slips.dx.of[at];
        dy_[count] = slips.dy.of[at];
      }
    }
    count_ = count;
  }
  /// The last `some`, in no list any more then. Their indices stay until others are added.
  HWY_ATTR std::span<const std::uint64_t> take(std::size_t some, const GrainArrays& g,
                                               const std::vector<GrainRoll>& rolls,
                                               SlidingGrains& s) {
    count_ -= some;
    const std::uint64_t* HWY_RESTRICT grain = grain_ + count_;
    s.unit = slide_alike(rolls) ? rolls.front().slides_by : 1;
    const double per_unit = 1 / s.unit;
    if (rolls.size() == 1) {
      const GrainRoll& roll = rolls.front();
      std::fill_n(s.slides_by.of, some, roll.slides_by / s.unit);
      const double holds = roll.holds_by / s.unit;
      std::fill_n(s.holds2.of, some, holds * holds);
      std::fill_n(s.share.of, some, roll.share);
      std::fill_n(s.turn.of, some, roll.turn);
    } else {
      const std::uint32_t* HWY_RESTRICT kind = g.kind.data();
      const GrainRoll* HWY_RESTRICT table = rolls.data();
      SLIPCHECK_EACH_ALONE
      for (std::size_t k = 0; k < some; ++k) {
        const GrainRoll& roll = table[kind[grain[k]]];
        s.slides_by.of[k] = roll.slides_by;
        s.holds2.of[k] = roll.holds_by * roll.holds_by;
        s.share.of[k] = roll.share;
        s.turn.of[k] = roll.turn;
      }
    }
    const double* HWY_RESTRICT sticks = g.sticks.data();
    SLIPCHECK_EACH_ALONE
    for (std::size_t k = 0; k < some; ++k) s.sticks.of[k] = sticks[grain[k]];
    s.padded = (some + 7) / 8 * 8;
    for (SlidingRow* row : {&s.slides_by, &s.holds2, &s.share, &s.sticks})
      std::fill(row->of + some, row->of + s.padded, 0.0);
    for (std::size_t k = count_ + some; k < count_ + s.padded; ++k) {
      ux_[k] = 1e6 * s.unit;  // a slip that lasts
      uy_[k] = dx_[k] = dy_[k] = 0;
    }
    const double* HWY_RESTRICT ux = ux_ + count_;
    const double* HWY_RESTRICT uy = uy_ + count_;
    const double* HWY_RESTRICT dx = dx_ + count_;
    const double* HWY_RESTRICT dy = dy_ + count_;
    SLIPCHECK_EACH_ALONE
    for (std::size_t k = 0; k < s.padded; ++k) {
      s.ux.of[k] = s.left_x[0].of[k] = per_unit * ux[k];
      s.uy.of[k] = s.left_y[0].of[k] = per_unit * uy[k];
      s.left_x[1].of[k] = per_unit * (ux[k] - dx[k]);
      s.left_y[1].of[k] = per_unit * (uy[k] - dy[k]);
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

/// After the steps, which are read no more: what friction took from v takes the place of the first
/// slips, that of the last step the place of the step before, and ways take that of the sums.
HWY_ATTR inline void PutSliding(SlidingGrains& s, std::span<const std::uint64_t> grains,
                                const std::vector<GrainRoll>& rolls, double h,
                                std::span<const GrainPush> pushes, GrainArrays& g) {
  const GrainPush& last = pushes.back();
  const auto count = static_cast<double>(pushes.size());
  const double ax = h * last.slope_x, ay = h * last.slope_y, time = h * count;
  const double gain_x = count * ax, gain_y = count * ay, drift = 0.5 * time * (count + 1);
  const SlidingRow &left_x = s.left_x[pushes.size() % 2], &left_y = s.left_y[pushes.size() % 2];
  SlidingRow &lost_x = s.left_x[1 - pushes.size() % 2], &lost_y = s.left_y[1 - pushes.size() % 2];
  SLIPCHECK_EACH_ALONE
  for (std::size_t k = 0; k < s.padded; ++k) {
    const double share = s.share.of[k] * s.unit, of_way = h * share;
    s.sum_x.of[k] = drift * ax - of_way * (count * s.ux.of[k] - s.sum_x.of[k]);
    s.sum_y.of[k] = drift * ay - of_way * (count * s.uy.of[k] - s.sum_y.of[k]);
    s.ux.of[k] = share * (s.ux.of[k] - left_x.of[k]);
    s.uy.of[k] = share * (s.uy.of[k] - left_y.of[k]);
    lost_x.of[k] = share * (lost_x.of[k] - left_x.of[k]);
    lost_y.of[k] = share * (lost_y.of[k] - left_y.of[k]);
  }
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
  const GrainRoll* HWY_RESTRICT table = rolls.data();
  const std::uint64_t* HWY_RESTRICT grain = grains.data();
  SLIPCHECK_EACH_ALONE
  for (std::size_t k = 0; k < grains.size(); ++k) {
    const std::size_t i = grain[k];
    const double turn = s.turn.of[k];
    x[i] += time * vx[i] + s.sum_x.of[k];
    y[i] += time * vy[i] + s.sum_y.of[k];
    vx[i] += gain_x - s.ux.of[k];
    vy[i] += gain_y - s.uy.of[k];
    wx[i] -= turn * s.uy.of[k];
    wy[i] += turn * s.ux.of[k];
    dvx[i] = ax - lost_x.of[k];
    dvy[i] = ay - lost_y.of[k];
    dwx[i] = -turn * lost_y.of[k];
    dwy[i] = turn * lost_x.of[k];
    sticks[i] = s.sticks.of[k];
    if (!(sticks[i] > 0)) continue;
    const double per_radius = table[kind[i]].per_radius;
    wx[i] = -(vy[i] - last.plane_y) * per_radius;
    wy[i] = (vx[i] - last.plane_x) * per_radius;
  }
}

/// What pushes have given every slip until the end of a step, and until its middle as the change in
/// the step before lets expect; in the first step that is known of each grain.
struct SlipPush {
  double x = 0, y = 0, ahead_x = 0, ahead_y = 0;
};

/// Calls step(n, push) for one after the other.
template <class Step>
HWY_ATTR HWY_INLINE void ForEachStep(const SlidingGrains& s, double h,
                                     std::span<const GrainPush> pushes, const Step& step) {
  const double per_unit = 1 / s.unit, per_slope = h * per_unit;
  SlipPush all;
  for (std::size_t n = 0; n < pushes.size(); ++n) {
    const GrainPush& push = pushes[n];
    const double moved_x = per_unit * (push.plane_x - push.before_x);
    const double moved_y = per_unit * (push.plane_y - push.before_y);
    if (n > 0) {
      all.ahead_x = all.x + 0.5 * (per_slope * pushes[n - 1].slope_x - moved_x);
      all.ahead_y = all.y + 0.5 * (per_slope * pushes[n - 1].slope_y - moved_y);
    }
    all.x += per_slope * push.slope_x - moved_x;
    all.y += per_slope * push.slope_y - moved_y;
    step(n, all);
  }
}

/// a·b + c where the product is exact, so that one rounding gives the bits of two.
HWY_ATTR HWY_INLINE double AddExact(double a, double b, double c) {
#if HWY_NATIVE_FMA
  return std::fma(a, b, c);
#else
  return c + a * b;
#endif
}

/// A slip in the middle of a step, where it was what was left `before` the last one.
HWY_ATTR HWY_INLINE double Ahead(double now, double before, double push) {
  return AddExact(0.5, now - before, now + push);
}

/// One by one.
template <bool kAlike>
HWY_ATTR void SlideEach(SlidingGrains& s, double h, std::span<const GrainPush> pushes) {
  ForEachStep(s, h, pushes, [&](std::size_t n, const SlipPush push) HWY_ATTR {
    const double* HWY_RESTRICT now_x = s.left_x[n % 2].of;
    const double* HWY_RESTRICT now_y = s.left_y[n % 2].of;
    double* HWY_RESTRICT next_x = s.left_x[(n + 1) % 2].of;
    double* HWY_RESTRICT next_y = s.left_y[(n + 1) % 2].of;
    SLIPCHECK_EACH_ALONE
    for (std::size_t k = 0; k < s.padded; ++k) {
      const double x = now_x[k] + push.x, y = now_y[k] + push.y;
      const double px = Ahead(now_x[k], next_x[k], push.ahead_x);
      const double py = Ahead(now_y[k], next_y[k], push.ahead_y);
      const double slip2 = x * x + y * y, expected2 = px * px + py * py;
      const double slides2 = kAlike ? 1 : s.slides2.of[k];
      const bool held = slip2 <= (s.sticks.of[k] > 0 ? s.holds2.of[k] : slides2);
      const bool follows = (px * x + py * y > 0) & (expected2 > slides2);
      const double along_x = follows ? px : x, along_y = follows ? py : y;
      const double size2 = follows ? expected2 : slip2;
      const double per_size = 1 / std::sqrt(size2 > 0 ? size2 : 1);
      const double lost = kAlike ? per_size : s.slides_by.of[k] * per_size;
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

/// What follows values that hardly differ, the last one first. Their difference has digits to spare
/// for the product.
HWY_ATTR HWY_INLINE double Next(double last, double second, double third) {
  return AddExact(3, last - second, third);
}

/// How 1/|u| of a step is found: by itself, or from what its last three values let expect, which is
/// less than 1e-3 or, as long as friction takes no fortieth of u, 1e-4 off.
enum class Root { by_itself, near, nearer };

/// 1/√x from a guess g that is off by a part d: 4.4 d⁴ are left of it, where it is nearer 2.5 d³.
template <Root kRoot>
HWY_ATTR HWY_INLINE double PerRootNear(double x, double g) {
  const double z = x * (g * g);  // nearly 1
  if constexpr (kRoot == Root::near) return g * (((1.3125 - 0.3125 * z) * z - 2.1875) * z + 2.1875);
  return g * ((0.375 * z - 1.25) * z + 1.875);
}

/// As SlideEach(), of those that FindSliding() tells: a step is little more than the direction of
/// the friction. From the fifth on 1/|u| is what its last three values let expect, or nearly: the
/// one of the first step is not, as an impact may have been before it.
template <bool kAlike>
HWY_ATTR void SlideThrough(SlidingGrains& s, double h, std::span<const GrainPush> pushes) {
  std::array<SlidingRow, 3> roots;
  const auto slide = [&]<Root kRoot>(std::size_t n, const SlipPush push,
                                     std::integral_constant<Root, kRoot>) HWY_ATTR {
    const double* HWY_RESTRICT now_x = s.left_x[n % 2].of;
    const double* HWY_RESTRICT now_y = s.left_y[n % 2].of;
    double* HWY_RESTRICT next_x = s.left_x[(n + 1) % 2].of;
    double* HWY_RESTRICT next_y = s.left_y[(n + 1) % 2].of;
    const double* HWY_RESTRICT last = roots[(n + 2) % 3].of;
    const double* HWY_RESTRICT before = roots[(n + 1) % 3].of;
    double* HWY_RESTRICT root = roots[n % 3].of;
    SLIPCHECK_EACH_ALONE
    for (std::size_t k = 0; k < s.padded; ++k) {
      const double px = Ahead(now_x[k], next_x[k], push.ahead_x);
      const double py = Ahead(now_y[k], next_y[k], push.ahead_y);
      const double expected2 = px * px + py * py;
      double per_slip;
      if constexpr (kRoot == Root::by_itself)
        per_slip = PerRoot(expected2);
      else
        per_slip = PerRootNear<kRoot>(expected2, Next(last[k], before[k], root[k]));
      const double lost = kAlike ? per_slip : s.slides_by.of[k] * per_slip;
      const double to_x = now_x[k] - lost * px, to_y = now_y[k] - lost * py;
      next_x[k] = to_x;
      next_y[k] = to_y;
      s.sum_x.of[k] += to_x;
      s.sum_y.of[k] += to_y;
      root[k] = per_slip;
    }
  };
  ForEachStep(s, h, pushes, [&](std::size_t n, const SlipPush& push) HWY_ATTR {
    if (n < 4)
      slide(n, push, std::integral_constant<Root, Root::by_itself>());
    else if (n + kLastSlides < pushes.size())
      slide(n, push, std::integral_constant<Root, Root::nearer>());
    else
      slide(n, push, std::integral_constant<Root, Root::near>());
  });
}

/// On a plane that carries them along: no sum over the steps is known, so each is done. The last
/// `count` of a list, at most kSliding.
HWY_ATTR inline void GlideSliding(GrainArrays& g, bool through, SlidingList& list,
                                  std::size_t count, const std::vector<GrainRoll>& rolls, double h,
                                  std::span<const GrainPush> pushes) {
  SlidingGrains s;
  const auto grains = list.take(count, g, rolls, s);
  const bool alike = slide_alike(rolls);
  const auto slide = through ? (alike ? SlideThrough<true> : SlideThrough<false>)
                             : (alike ? SlideEach<true> : SlideEach<false>);
  slide(s, h, pushes);
  PutSliding(s, grains, rolls, h, pushes, g);
}

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
