// Which grains slide on a plane that carries them along, and what is known of them; included once
// for each instruction set.
#if defined(SLIPCHECK_GRAIN_SLIPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_GRAIN_SLIPS_INL_H
#undef SLIPCHECK_GRAIN_SLIPS_INL_H
#else
#define SLIPCHECK_GRAIN_SLIPS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
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
/// only what friction leaves of it is kept for each: what pushes give is the same for all.
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

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
