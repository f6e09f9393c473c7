// The bodies of pile_motion.cpp; included once for each instruction set.
#if defined(SLIPCHECK_PILE_MOTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SLIPCHECK_PILE_MOTION_INL_H
#undef SLIPCHECK_PILE_MOTION_INL_H
#else
#define SLIPCHECK_PILE_MOTION_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reference/piles/pile_motion.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Four numbers that follow each other in memory: a vector in space and what comes after it.
class Four {
  using D = hn::CappedTag<double, 4>;
  using V = hn::Vec<D>;
  static constexpr std::size_t kLanes = hn::MaxLanes(D()), kParts = 4 / kLanes;

 public:
  static HWY_INLINE Four all(double value) {
    return of([&](std::size_t) { return hn::Set(D(), value); });
  }
  static HWY_INLINE Four load(const double* from) {
    return of([&](std::size_t k) { return hn::LoadU(D(), from + k * kLanes); });
  }
  static HWY_INLINE Four of_space(const Vector3& v) {
    const double row[] = {v.x(), v.y(), v.z(), 0};
    return load(row);
  }
  HWY_INLINE void store(double* to) const {
    for (std::size_t k = 0; k < kParts; ++k) hn::StoreU(part_[k], D(), to + k * kLanes);
  }

  friend HWY_INLINE Four operator+(const Four& a, const Four& b) {
    return of([&](std::size_t k) { return a.part_[k] + b.part_[k]; });
  }
  friend HWY_INLINE Four operator-(const Four& a, const Four& b) {
    return of([&](std::size_t k) { return a.part_[k] - b.part_[k]; });
  }
  friend HWY_INLINE Four operator*(const Four& a, const Four& b) {
    return of([&](std::size_t k) { return a.part_[k] * b.part_[k]; });
  }
  friend HWY_INLINE Four operator/(const Four& a, const Four& b) {
    return of([&](std::size_t k) { return a.part_[k] / b.part_[k]; });
  }

  /// Of the vector in space.
  HWY_INLINE double squared_norm() const {
    double square[4];
    (*this * *this).store(square);
    return square[0] + square[1] + square[2];
  }

 private:
  template <class Part>
  static HWY_INLINE Four of(const Part& part) {
    Four result;
    for (std::size_t k = 0; k < kParts; ++k) result.part_[k] = part(k);
    return result;
  }

  V part_[kParts];
};

class PileMove {
 public:
  PileMove(const PileWorld& world, const Vector3& drift)
      : h_(Four::all(world.step)),
        kick_(Four::all(world.started ? world.step : 0.5 * world.step)),
        gravity_(Four::of_space(world.gravity)),
        drift_(Four::of_space(drift)),
        keep_(Four::all((1 - dragged(world)) / (1 + dragged(world)))),
        drags_(world.drag > 0) {}

  /// What is written over with the fourth number of a vector is the first of the next.
  HWY_INLINE void run(double* b, NearSphere& sphere, PileSpeed& fastest) const {
    const Four zero = Four::all(0);
    const Four gain = Four::load(b + kForce) / Four::all(b[kMass]) + Four::all(b[kLoad]) * gravity_;
    const Four turn = Four::load(b + kForce + 3) / Four::all(b[kMass + 1]);
    Four velocity = Four::load(b + kVelocity) + kick_ * gain;
    Four turning = Four::load(b + kVelocity + 3) + kick_ * turn;
    if (drags_) {
      velocity = velocity * keep_;
      turning = turning * keep_;
    }
    // Summed with what rounding took before: else a slow body stands while its springs stretch.
    const Four position = Four::load(b + kPosition);
    const Four way = h_ * velocity + Four::load(b + kRounded), next = position + way;
    const Four rounded = way - (next - position);
    const Four turned = Four::load(b + kRounded + 3) + h_ * turning;
    const Four change = h_ * gain;
    next.store(b + kPosition);
    velocity.store(b + kVelocity);
    turning.store(b + kVelocity + 3);
    change.store(b + kChange);
    (h_ * turn).store(b + kChange + 3);
    zero.store(b + kForce);
    zero.store(b + kForce + 2);
    rounded.store(b + kRounded);
    turned.store(b + kRounded + 3);
    const double radius = sphere.radius;
    next.store(sphere.position.data());
    sphere.radius = radius;
    fastest.still = std::max(fastest.still, velocity.squared_norm());
    fastest.adrift = std::max(fastest.adrift, (velocity - drift_).squared_norm());
    fastest.gain = std::max(fastest.gain, change.squared_norm());
  }

 private:
  // PileBody as a row of numbers.
  static constexpr std::size_t kPosition = offsetof(PileBody, position) / sizeof(double);
  static constexpr std::size_t kVelocity = offsetof(PileBody, velocity) / sizeof(double);
  static constexpr std::size_t kChange = offsetof(PileBody, change) / sizeof(double);
  static constexpr std::size_t kForce = offsetof(PileBody, force) / sizeof(double);
  static constexpr std::size_t kMass = offsetof(PileBody, mass) / sizeof(double);
  static constexpr std::size_t kLoad = offsetof(PileBody, load) / sizeof(double);
  static constexpr std::size_t kRounded = offsetof(PileBody, rounded) / sizeof(double);
  static_assert(kVelocity == kPosition + 3 && kChange == kVelocity + 6 && kForce == kChange + 6 &&
                kMass == kForce + 6 && kRounded + 7 <= sizeof(PileBody) / sizeof(double) &&
                offsetof(NearSphere, radius) == 3 * sizeof(double));

  /// Half of what drag takes of a velocity in a step, as a part of it.
  static double dragged(const PileWorld& world) { return 0.5 * world.step * world.drag; }

  Four h_, kick_, gravity_, drift_, keep_;
  bool drags_;
};

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#endif
