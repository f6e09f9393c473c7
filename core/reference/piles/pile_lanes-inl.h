// The contacts of pile_lanes.cpp; included once for each instruction set.
#if defined(SLIPCHECK_PILE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_PILE_LANES_INL_H
#undef SLIPCHECK_PILE_LANES_INL_H
#else
#define SLIPCHECK_PILE_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reference/piles/pile_lanes.h"
#include "reference/piles/pile_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// PileStep's contact of two bodies that lasts, in the lanes of vectors: the same operations in the
/// same order. kRepeats: the plane is periodic.
template <bool kRepeats>
class PileLaneStep {
 public:
  PileLaneStep(const PileWorld& world, const PileLaneLaw* laws)
      : bodies_(reinterpret_cast<const double*>(world.bodies.data())),
        laws_(reinterpret_cast<const double*>(laws)),
        h_(hn::Set(D(), world.step)),
        period_x_(hn::Set(D(), world.scene->hard.periodic.x())),
        period_y_(hn::Set(D(), world.scene->hard.periodic.y())) {}

  /// Whether one of them slides.
  HWY_INLINE bool run(std::span<PileLanes> all, PileLaneForce* forces) const {
    unsigned slides = 0;
    for (PileLanes& lanes : all) {
      lanes.lasted = 0;
      if (lanes.touch)
        for (std::size_t l = 0; l < PileLanes::kCount; l += kLanes) take_on(lanes, l, forces + l);
      slides |= lanes.lasted & lanes.slide;
      forces += PileLanes::kCount;
    }
    return slides != 0;
  }

 private:
  using D = hn::ScalableTag<double>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  using V3 = Lane3<V>;
  static constexpr std::size_t kLanes = hn::MaxLanes(D());
  static_assert(PileLanes::kCount % kLanes == 0);

  static HWY_INLINE V load(const PileLanes::Row& row, std::size_t l) {
    return hn::Load(D(), row.data() + l);
  }
  static HWY_INLINE V3 load(const std::array<PileLanes::Row, 3>& rows, std::size_t l) {
    return {load(rows[0], l), load(rows[1], l), load(rows[2], l)};
  }
  static HWY_INLINE void store(M which, V v, PileLanes::Row& row, std::size_t l) {
    hn::Store(hn::IfThenElse(which, v, load(row, l)), D(), row.data() + l);
  }
  static HWY_INLINE void store(M which, const V3& v, std::array<PileLanes::Row, 3>& rows,
                               std::size_t l) {
    store(which, v.x, rows[0], l), store(which, v.y, rows[1], l), store(which, v.z, rows[2], l);
  }
  static HWY_INLINE M mask(unsigned bits, std::size_t l) {
    const auto own = static_cast<std::uint8_t>(bits >> l);
    return hn::LoadMaskBits(D(), &own);
  }
  static HWY_INLINE std::uint8_t bits(M which, std::size_t l) {
    std::uint8_t own[8] = {};
    hn::StoreMaskBits(D(), which, own);
    return static_cast<std::uint8_t>(own[0] << l);
  }

  HWY_INLINE V periods(const std::array<std::int32_t, PileLanes::kCount>& row,
                       std::size_t l) const {
    return hn::PromoteTo(D(), hn::LoadU(hn::Rebind<std::int32_t, D>(), row.data() + l));
  }

  HWY_INLINE void take_on(PileLanes& lanes, std::size_t l, PileLaneForce* forces) const {
    const D d;
    const V zero = hn::Zero(d), half = hn::Set(d, 0.5), one = hn::Set(d, 1.0);

    // How the two move: of_bodies(), look().
    const double *first[kLanes], *second[kLanes], *law_row[kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) {
      first[k] = bodies_ + lanes.first[l + k] * kBody;
      second[k] = bodies_ + lanes.second[l + k] * kBody;
      law_row[k] = laws_ + lanes.law[l + k] * 8;
      // Where the forces go.
      __builtin_prefetch(first[k] + kForce, 1);
      __builtin_prefetch(second[k] + kForce, 1);
    }
    V a[8], b[8];
    load_rows(first, 0, a);
    load_rows(second, 0, b);
    const V ra = a[0], rb = b[0];
    V3 apart{a[1] - b[1], a[2] - b[2], a[3] - b[3]};
    if constexpr (kRepeats) {
      apart.x = apart.x - periods(lanes.periods[0], l) * period_x_;
      apart.y = apart.y - periods(lanes.periods[1], l) * period_y_;
    }
    const V3 dv{a[4] - b[4], a[5] - b[5], a[6] - b[6]};
    V3 wa{a[7], zero, zero}, wb{b[7], zero, zero};
    load_rows(first, 8, a);
    load_rows(second, 8, b);
    wa.y = a[0], wa.z = a[1], wb.y = b[0], wb.z = b[1];
    const V distance = hn::Sqrt(dot(apart, apart));
    const V overlap = ra + rb - distance;
    const V3 n{apart.x / distance, apart.y / distance, apart.z / distance};
    const V3 velocity = dv + half * V3{a[2] - b[2], a[3] - b[3], a[4] - b[4]};
    const V3 turning = ra * wa + rb * wb;
    const V3 turn_now = turning + half * (ra * V3{a[5], a[6], a[7]} + rb * V3{b[5], b[6], b[7]});
    const V closing = hn::Neg(dot(n, velocity));
    const V3 slip = velocity + closing * n - cross(turn_now, n);
    const V3 before = load(lanes.normal, l);
    const V3 mean_way = dv - cross(turning, half * (n + before));
    const V3 way = h_ * (mean_way - dot(mean_way, n) * n);
    const V angle = h_ * (half * dot(wa + wb, n));

    // Whether the contact lasts: meet().
    V law[8];
    load_rows(law_row, 0, law);
    const V k_n = law[0], k_t = law[2], c_t = law[3];
    const V normal = k_n * overlap + law[1] * closing;
    const M lasts =
        hn::And(hn::And(mask(lanes.touch, l), hn::Gt(normal, zero)),
                hn::And(hn::And(hn::Ge(overlap, zero), hn::Le(overlap, law[6] * hn::Min(ra, rb))),
                        hn::Or(hn::Gt(overlap, zero), hn::Gt(closing, zero))));

    // The spring against sliding: carried(), slide(), take(), respond().
    const V3 old_stretch = load(lanes.stretch, l), old_across = load(lanes.across, l);
    const V3 tilted = old_stretch - dot(old_stretch, n) / (one + dot(before, n)) * (before + n);
    const V3 carried = (one - half * angle * angle) * tilted + angle * cross(n, tilted);
    const V3 stretched = carried + way;
    const V3 elastic = hn::Neg(k_t) * stretched, force = elastic - c_t * slip;
    const V size = hn::Sqrt(dot(force, force)), pressed = hn::Abs(normal);
    const V holds = law[4] * pressed, slides_at = law[5] * pressed;
    const M rubs = hn::Gt(law[4], zero);
    const M sticks = hn::Le(size, hn::IfThenElse(mask(lanes.slide, l), slides_at, holds));
    const M slides = hn::AndNot(sticks, rubs);
    const V3 capped = slides_at / size * force;
    const V3 left = law[7] * (capped + c_t * slip);
    const V3 cut = keep(slides, stretched - left);
    const V3 stretch = keep(rubs, choose(slides, left, stretched));
    const V3 across = keep(rubs, choose(slides, capped, force));
    const V3 elastic_now = choose(slides, hn::Neg(k_t) * left, elastic);
    const V3 dashpot = old_across - hn::Neg(k_t) * old_stretch;
    const V3 dashpot_now = across - elastic_now;
    const V spring_lost =
        half * dot(dashpot + dashpot_now, way) + half * dot(elastic_now - k_t * carried, cut);

    // The ledger and the force: follow(), push().
    const V old_overlap = load(lanes.overlap, l);
    const V normal_dashpot = normal - k_n * overlap;
    const V old_dashpot = load(lanes.normal_force, l) - k_n * old_overlap;
    V out[8];
    out[6] = hn::IfThenElseZero(rubs, hn::Neg(spring_lost)) +
             half * (old_dashpot + normal_dashpot) * (overlap - old_overlap);
    out[7] = zero;
    const V3 all = normal * n + across, lever = cross(across, n);
    out[0] = all.x, out[1] = all.y, out[2] = all.z;
    out[3] = lever.x, out[4] = lever.y, out[5] = lever.z;
    store_rows(out, reinterpret_cast<double*>(forces));

    store(lasts, n, lanes.normal, l);
    store(lasts, stretch, lanes.stretch, l);
    store(lasts, across, lanes.across, l);
    store(lasts, overlap, lanes.overlap, l);
    store(lasts, normal, lanes.normal_force, l);
    store(lasts, load(lanes.impulse, l) + pressed * h_, lanes.impulse, l);
    const unsigned lasted = bits(lasts, l);
    lanes.lasted = static_cast<std::uint8_t>(lanes.lasted | lasted);
    lanes.slide =
        static_cast<std::uint8_t>((lanes.slide & ~lasted) | bits(hn::And(slides, lasts), l));
  }

  static constexpr std::size_t kBody = sizeof(PileBody) / sizeof(double);
  static constexpr std::size_t kForce = offsetof(PileBody, force) / sizeof(double);

  const double* bodies_;
  const double* laws_;
  V h_, period_x_, period_y_;
};

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
