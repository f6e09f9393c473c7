// One step of a lane of pair_batch.cpp; included once for each instruction set.
#if defined(SLIPCHECK_PAIR_BATCH_STEP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_PAIR_BATCH_STEP_INL_H
#undef SLIPCHECK_PAIR_BATCH_STEP_INL_H
#else
#define SLIPCHECK_PAIR_BATCH_STEP_INL_H
#endif

#include <hwy/highway.h>

#include "reference/pair/scaled_pair.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// All normal laws are one system without a root singularity,
//   ẋ = p − G a(x),  ṗ = −a(x),
// with a = x for springs and a = x^{3/2} for spheres:
//   K (2)   x the overlap,       v = p − G a,  G = D
//   B (24)  x the overlap,       v = p − G a,  G = 2D/3, as D √x ẋ = (2D/3) d(x^{3/2})/dt
//   B (25)  x = overlap + D v,   v = p,        G = D
// v is the overlap's rate in g^N. Its change in a step is the impulse of F_N.

/// What a lane's collision has come to; V: a vector, or double.
template <class V>
struct LaneState {
  V x, p;
  V root;   ///< √|x|; springs have none
  V power;  ///< a(x)
  V rate;   ///< v
  V slip;   ///< in g^N
  V bend;   ///< of the asperity in ζ0, printed: ζ/ζ0 since the first touch
  V force;  ///< F_N, for passive asperities where it repels; others need none
};

/// A lane's constants.
template <class V>
struct LaneLaw {
  V drag;     ///< G
  V brake;    ///< h/2 of the drift's own damping: springs 1/(1 + h G/2), spheres (3/4) h G
  V by_rate;  ///< the contact ends with x + by_rate v = 0
  V surface;  ///< viscous: the part of the slip that a step takes; asperities: ScaledPair's
};

/// The batch's constants.
template <class V>
struct LaneStep {
  V step, half, friction;
};

template <BatchNormal kNormal, class D, class V = hn::Vec<D>>
HWY_INLINE V lane_force(D d, const LaneLaw<V>& law, const LaneState<V>& s) {
  if constexpr (kNormal == BatchNormal::linear)
    return s.power + law.drag * s.rate;
  else if constexpr (kNormal == BatchNormal::viscoelastic)
    return s.root * (s.x + (hn::Set(d, 1.5) * law.drag) * s.rate);
  else
    return s.power;
}

/// Half a kick, a drift, half a kick. The drift is of second order: for springs the trapezoidal
/// rule, for spheres Taylor's series, which needs no division and is stable up to a damping of 2/h;
/// collide_batch() asks for 1/h.
template <BatchNormal kNormal, class D, class V = hn::Vec<D>>
HWY_INLINE LaneState<V> lane_moved(D d, const LaneStep<V>& h, const LaneLaw<V>& law,
                                   const LaneState<V>& s) {
  LaneState<V> next = s;
  const V middle = s.p - h.half * s.power;
  if constexpr (kNormal == BatchNormal::linear) {
    next.x = s.x + (h.step * (middle - law.drag * s.power)) * law.brake;
    next.power = next.x;
  } else {
    if constexpr (kNormal == BatchNormal::hertz)
      next.x = s.x + h.step * middle;
    else
      next.x =
          s.x + (h.step * (middle - law.drag * s.power)) * (hn::Set(d, 1.0) - law.brake * s.root);
    next.root = hn::Sqrt(hn::Abs(next.x));
    next.power = next.x * next.root;
  }
  next.p = middle - h.half * next.power;
  if constexpr (kNormal == BatchNormal::linear || kNormal == BatchNormal::viscoelastic)
    next.rate = next.p - law.drag * next.power;
  else
    next.rate = next.p;
  return next;
}

/// The mean over a step of the odd saw-tooth y − trunc(y), where y goes evenly from `from` to `to`:
/// of its integral (|trunc y| + (y − trunc y)²)/2.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V mean_tooth(D d, V from, V to) {
  const V cell = hn::Trunc(from), last = hn::Trunc(to);
  const V tooth = from - cell, end = to - last;
  const V half = hn::Set(d, 0.5);
  const V unbroken = half * (tooth + end);
  const auto same = hn::Eq(cell, last);
  if (hn::AllTrue(d, same)) return unbroken;
  const V broken = half * ((hn::Abs(last) - hn::Abs(cell)) + (end - tooth) * (end + tooth)) /
                   hn::IfThenElse(same, hn::Set(d, 1.0), to - from);
  return hn::IfThenElse(same, unbroken, broken);
}

/// The slip after a step whose normal forces gave `impulse` and came to next.force, and the
/// asperity's bend.
template <BatchTangential kTangential, class D, class V = hn::Vec<D>>
HWY_INLINE void rub_lane(D d, V step, V friction, V surface, V impulse, const LaneState<V>& s,
                         LaneState<V>& next) {
  [[maybe_unused]] const V zero = hn::Zero(d), one = hn::Set(d, 1.0), half = hn::Set(d, 0.5);
  if constexpr (kTangential == BatchTangential::viscous) {
    // Exact below the cap and at it.
    const V most = hn::Abs(s.slip) * surface, cap = friction * step;
    V taken = hn::Min(most, friction * hn::Abs(impulse));
    const V from = cap * s.force, to = cap * next.force;
    const V size_from = hn::Abs(from), size_to = hn::Abs(to);
    const auto between =
        hn::Or(hn::Lt(from * to, zero), hn::Lt((size_from - most) * (size_to - most), zero));
    if (!hn::AllFalse(d, between)) {
      // The cap starts or ends to hold within the step: the mean of min(most, |f|) while f goes
      // evenly to its new value, from the integral min(…) (|f| − min(…)/2) sgn f.
      const V low = hn::Min(most, size_from), high = hn::Min(most, size_to);
      const V before = hn::CopySign(low * (size_from - half * low), from);
      const V after = hn::CopySign(high * (size_to - half * high), to);
      taken = hn::IfThenElse(between, (after - before) / hn::IfThenElse(between, to - from, one),
                             taken);
    }
    next.slip = s.slip - hn::CopySign(hn::Min(most, taken), s.slip);
  } else if constexpr (kTangential == BatchTangential::printed) {
    const V kick = friction * impulse;
    next.bend = s.bend + surface * (s.slip - half * (kick * (s.bend - hn::Trunc(s.bend))));
    next.slip = s.slip - kick * mean_tooth(d, s.bend, next.bend);
  } else if constexpr (kTangential == BatchTangential::passive) {
    const V kick = friction * hn::Max(impulse, zero);
    const V path = surface * (s.slip - half * (kick * s.bend));
    // d(F_N b) = F_N du by the trapezoidal rule while F_N grows, then db = du.
    const auto grows = hn::Gt(next.force, s.force);
    const V kept = hn::IfThenElse(grows, s.force, one) / hn::IfThenElse(grows, next.force, one);
    const V bend = kept * (s.bend + half * path) + half * path;
    const V mean = half * (s.bend + bend);
    const auto breaks = hn::Ge(hn::Abs(bend), one);
    next.bend = bend;
    next.slip = s.slip - kick * mean;
    if (hn::AllFalse(d, breaks)) return;
    // It breaks after this part of the step; from then on others bend and break along the path.
    const V size = hn::CopySign(one, bend);
    const V part = (size - s.bend) / hn::IfThenElse(breaks, bend - s.bend, one);
    const V rest = (one - part) * path;
    const V cell = hn::Trunc(rest), tooth = rest - cell;
    const V after = half * (hn::Abs(cell) + tooth * tooth) / hn::IfThenElse(breaks, path, one);
    next.bend = hn::IfThenElse(breaks, tooth, bend);
    next.slip = hn::IfThenElse(breaks, s.slip - kick * (part * (half * (s.bend + size)) + after),
                               next.slip);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
