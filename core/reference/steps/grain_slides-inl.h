// Grains that meet none and slide on a plane that carries them along; included once for each
// instruction set.
#if defined(SLIPCHECK_GRAIN_SLIDES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_GRAIN_SLIDES_INL_H
#undef SLIPCHECK_GRAIN_SLIDES_INL_H
#else
#define SLIPCHECK_GRAIN_SLIDES_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "reference/steps/grain_slips-inl.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {

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
