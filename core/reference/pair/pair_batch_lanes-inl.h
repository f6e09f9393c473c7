// The lanes of pair_batch.cpp; included once for each instruction set.
#if defined(SLIPCHECK_PAIR_BATCH_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_PAIR_BATCH_LANES_INL_H
#undef SLIPCHECK_PAIR_BATCH_LANES_INL_H
#else
#define SLIPCHECK_PAIR_BATCH_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "reference/pair/pair_batch_step-inl.h"
#include "reference/pair/scaled_pair.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kMostLanes = 8;
static_assert(hn::MaxLanes(hn::ScalableTag<double>()) <= kMostLanes);

/// One number for each lane, as memory has it.
struct LaneColumn {
  alignas(64) double lane[kMostLanes];
};

/// Collisions of one batch in the lanes of kVectors vectors, whose steps hide each other's latency.
template <BatchNormal kNormal, BatchTangential kTangential>
class Lanes {
 public:
  Lanes(const BatchLaw& batch, std::span<const ScaledPair> pairs, std::span<ScaledPairEnd> ends)
      : batch_(batch), pairs_(pairs), ends_(ends) {}

  HWY_ATTR void run() {
    const D d;
    for (Vector& vector : vectors_)
      for (std::size_t k = 0; k < hn::Lanes(d); ++k) take_next(vector, k);
    const LaneStep<V> h{hn::Set(d, batch_.step), hn::Set(d, 0.5 * batch_.step),
                        hn::Set(d, batch_.friction)};
    static_assert(kVectors == 2);
    Vector &first = vectors_[0], &second = vectors_[1];
    LaneLaw<V> law_a = loaded(first.law), law_b = loaded(second.law);
    LaneState<V> a = loaded(first.next), b = loaded(second.next);
    for (std::size_t now = 0; live_ > 0;) {
      const LaneState<V> next_a = stepped(h, law_a, a), next_b = stepped(h, law_b, b);
      ++now;
      const V end_a = next_a.x + law_a.by_rate * next_a.rate;
      const V end_b = next_b.x + law_b.by_rate * next_b.rate;
      const auto ends = hn::Or(hn::Le(end_a, hn::Zero(d)), hn::Le(end_b, hn::Zero(d)));
      if (HWY_LIKELY(hn::AllFalse(d, ends) && now < next_look_)) {
        a = next_a, b = next_b;
        continue;
      }
      now_ = now;
      store(a, first.state), store(next_a, first.next), store(end_a, first.end);
      store(b, second.state), store(next_b, second.next), store(end_b, second.end);
      look();
      law_a = loaded(first.law), a = loaded(first.next);
      law_b = loaded(second.law), b = loaded(second.next);
    }
  }

 private:
  using D = hn::ScalableTag<double>;
  using V = hn::Vec<D>;
  static constexpr std::size_t kVectors = 2;
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  struct Vector {
    LaneLaw<LaneColumn> law;
    LaneState<LaneColumn> state, next;  ///< before and after a step
    LaneColumn end;                     ///< <= 0: it ended in that step
    std::size_t pair[kMostLanes];       ///< kNone: the lane is dead
    std::size_t since[kMostLanes];      ///< the step at which it began
  };

  static HWY_INLINE LaneState<V> stepped(const LaneStep<V>& h, const LaneLaw<V>& law,
                                         const LaneState<V>& s) {
    const D d;
    LaneState<V> next = lane_moved<kNormal>(d, h, law, s);
    if constexpr (kTangential == BatchTangential::viscous)
      next.force = lane_force<kNormal>(d, law, next);
    else if constexpr (kTangential == BatchTangential::passive)
      next.force = hn::Max(lane_force<kNormal>(d, law, next), hn::Zero(d));
    rub_lane<kTangential>(d, h.step, h.friction, law.surface, s.rate - next.rate, s, next);
    return next;
  }

  static HWY_INLINE V load(const LaneColumn& c) { return hn::Load(D(), c.lane); }
  static HWY_INLINE void store(V v, LaneColumn& c) { hn::Store(v, D(), c.lane); }
  static HWY_INLINE LaneLaw<V> loaded(const LaneLaw<LaneColumn>& l) {
    return {load(l.drag), load(l.brake), load(l.by_rate), load(l.surface)};
  }
  static HWY_INLINE LaneState<V> loaded(const LaneState<LaneColumn>& s) {
    return {load(s.x),    load(s.p),    load(s.root), load(s.power),
            load(s.rate), load(s.slip), load(s.bend), load(s.force)};
  }
  static HWY_INLINE void store(const LaneState<V>& v, LaneState<LaneColumn>& s) {
    store(v.x, s.x), store(v.p, s.p), store(v.root, s.root), store(v.power, s.power);
    store(v.rate, s.rate), store(v.slip, s.slip), store(v.bend, s.bend), store(v.force, s.force);
  }
  static LaneState<double> lane(const LaneState<LaneColumn>& s, std::size_t k) {
    return {s.x.lane[k],    s.p.lane[k],    s.root.lane[k], s.power.lane[k],
            s.rate.lane[k], s.slip.lane[k], s.bend.lane[k], s.force.lane[k]};
  }

  /// The lanes after a step in which some ended.
  HWY_NOINLINE void look() {
    for (Vector& vector : vectors_)
      for (std::size_t k = 0; k < hn::Lanes(D()); ++k) {
        if (vector.pair[k] == kNone) continue;
        const std::size_t steps = now_ - vector.since[k];
        ScaledPairEnd& found = ends_[vector.pair[k]];
        if (vector.end.lane[k] <= 0)
          found = finished(vector, k, static_cast<double>(steps - 1));
        else if (steps >= batch_.limit)
          found = {0, vector.next.slip.lane[k], std::numeric_limits<double>::infinity()};
        else
          continue;
        --live_;
        take_next(vector, k);
      }
    find_next_look();
  }

  /// Gives the lane the next collision, if there is one.
  void take_next(Vector& vector, std::size_t k) {
    const bool any = taken_ < pairs_.size();
    vector.pair[k] = any ? taken_ : kNone;
    vector.since[k] = now_;
    // A dead lane is not a number: it never ends.
    const double none = std::numeric_limits<double>::quiet_NaN();
    ScaledPair pair{none, none, none};
    if (any) pair = pairs_[taken_++], ++live_;
    const bool compact = kNormal == BatchNormal::compact;
    const double h = batch_.step, damping = pair.damping;
    const double drag = kNormal == BatchNormal::viscoelastic ? damping / 1.5 : damping;
    LaneLaw<LaneColumn>& law = vector.law;
    law.drag.lane[k] = drag;
    law.brake.lane[k] = kNormal == BatchNormal::linear ? 1 / (1 + 0.5 * h * drag) : 0.75 * h * drag;
    law.by_rate.lane[k] = batch_.by_force == compact ? 0 : compact ? -damping : damping;
    law.surface.lane[k] =
        kTangential == BatchTangential::viscous ? -std::expm1(-pair.surface) : pair.surface;
    LaneState<LaneColumn>& s = vector.next;
    const double x = any ? (compact ? damping : 0) : none;
    s.x.lane[k] = x;
    s.p.lane[k] = s.rate.lane[k] = any ? 1 : none;
    s.root.lane[k] = std::sqrt(x);
    s.power.lane[k] = x * (kNormal == BatchNormal::linear ? 1 : s.root.lane[k]);
    s.slip.lane[k] = pair.slip;
    s.bend.lane[k] = any ? 0 : none;
    s.force.lane[k] = kNormal == BatchNormal::linear ? damping : s.power.lane[k];
  }

  /// When a collision has reached its limit at the earliest.
  void find_next_look() {
    if (now_ < next_look_) return;
    std::size_t first = now_;
    for (const Vector& vector : vectors_)
      for (std::size_t k = 0; k < hn::Lanes(D()); ++k)
        if (vector.pair[k] != kNone) first = std::min(first, vector.since[k]);
    next_look_ = first + batch_.limit;
  }

  /// x and p within a step by Hermite's cubics, as their rates are known at both ends.
  struct WithinStep {
    double h, drag;
    LaneState<double> a, b;

    static double between(double part, double from, double to, double from_rate, double to_rate) {
      const double left = 1 - part;
      return left * left * ((1 + 2 * part) * from + part * from_rate) +
             part * part * ((1 + 2 * left) * to - left * to_rate);
    }
    double x(double part) const {
      return between(part, a.x, b.x, h * (a.p - drag * a.power), h * (b.p - drag * b.power));
    }
    double rate(double part, double x) const {
      const double p = between(part, a.p, b.p, -h * a.power, -h * b.power);
      if constexpr (kNormal == BatchNormal::linear) return p - drag * x;
      if constexpr (kNormal == BatchNormal::viscoelastic)
        return p - drag * (x * std::sqrt(std::abs(x)));
      return p;
    }
  };

  /// A lane whose contact ended within its last step.
  ScaledPairEnd finished(const Vector& vector, std::size_t k, double steps) const {
    const LaneState<double> a = lane(vector.state, k), b = lane(vector.next, k);
    const WithinStep within{batch_.step, vector.law.drag.lane[k], a, b};
    const double by_rate = vector.law.by_rate.lane[k];
    // False position with the Illinois rule.
    double low = 0, high = 1, part = 1, rate = b.rate;
    double at_low = a.x + by_rate * a.rate, at_high = b.x + by_rate * b.rate;
    for (int n = 0, side = 0; n < 50 && at_high < 0; ++n) {
      part = at_low > 0 ? low + (high - low) * (at_low / (at_low - at_high)) : 0;
      const double x = within.x(part);
      rate = within.rate(part, x);
      const double value = x + by_rate * rate;
      if (std::abs(value) <= 1e-13 * (a.x - b.x) || !(part > low && part < high)) break;
      if (value > 0) {
        low = part, at_low = value;
        if (side == 1) at_high *= 0.5;
        side = 1;
      } else {
        high = part, at_high = value;
        if (side == -1) at_low *= 0.5;
        side = -1;
      }
    }
    ScaledPairEnd end{rate, rub_for(part, a, rate, k, vector), steps + part};
    // An overlap that decays without end comes to 0 by rounding alone.
    if (!(-rate > 1e-100)) end.rate = 0, end.steps = std::numeric_limits<double>::infinity();
    return end;
  }

  /// The slip after this part of the last step.
  double rub_for(double part, const LaneState<double>& a, double rate, std::size_t k,
                 const Vector& vector) const {
    using D1 = hn::CappedTag<double, 1>;
    using V1 = hn::Vec<D1>;
    const D1 d;
    LaneState<V1> from, to;
    from.slip = to.slip = hn::Set(d, a.slip);
    from.bend = to.bend = hn::Set(d, a.bend);
    from.force = hn::Set(d, a.force);
    to.force =
        hn::Set(d, kTangential == BatchTangential::viscous ? last_force(rate, k, vector) : 0);
    const double surface = kTangential == BatchTangential::viscous
                               ? -std::expm1(-part * pairs_[vector.pair[k]].surface)
                               : part * vector.law.surface.lane[k];
    rub_lane<kTangential>(d, hn::Set(d, part * batch_.step), hn::Set(d, batch_.friction),
                          hn::Set(d, surface), hn::Set(d, a.rate - rate), from, to);
    return hn::GetLane(to.slip);
  }

  /// F_N at a contact's end, which never repels.
  double last_force(double rate, std::size_t k, const Vector& vector) const {
    const double pull = vector.law.drag.lane[k] * rate;
    if (batch_.by_force) return 0;
    if constexpr (kNormal == BatchNormal::linear) return pull;
    if constexpr (kNormal == BatchNormal::compact) return pull * std::sqrt(std::abs(pull));
    return 0;
  }

  const BatchLaw batch_;
  std::span<const ScaledPair> pairs_;
  std::span<ScaledPairEnd> ends_;
  Vector vectors_[kVectors];
  std::size_t taken_ = 0, live_ = 0, now_ = 0, next_look_ = batch_.limit;
};

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
