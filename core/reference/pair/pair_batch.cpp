// Compiled once for each instruction set by Google Highway. No operation is fused and nothing is
// summed over lanes, so that every set gives the same bits.
#include "reference/pair/pair_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <variant>
#include <vector>

#include "base/stop_scope.h"
#include "physics/contact/elastic_pair.h"
#include "reference/pair/scaled_pair.h"
#include "scene/scaled_impact.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/pair/pair_batch.cpp"
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "reference/pair/pair_batch_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {

template <BatchNormal kNormal>
HWY_ATTR void collide_with(const BatchLaw& law, std::span<const ScaledPair> pairs,
                           std::span<ScaledPairEnd> ends) {
  switch (law.tangential) {
    case BatchTangential::none:
      return Lanes<kNormal, BatchTangential::none>(law, pairs, ends).run();
    case BatchTangential::viscous:
      return Lanes<kNormal, BatchTangential::viscous>(law, pairs, ends).run();
    case BatchTangential::printed:
      return Lanes<kNormal, BatchTangential::printed>(law, pairs, ends).run();
    case BatchTangential::passive:
      return Lanes<kNormal, BatchTangential::passive>(law, pairs, ends).run();
  }
}

HWY_ATTR void collide_lanes(const BatchLaw& law, std::span<const ScaledPair> pairs,
                            std::span<ScaledPairEnd> ends) {
  switch (law.normal) {
    case BatchNormal::linear:
      return collide_with<BatchNormal::linear>(law, pairs, ends);
    case BatchNormal::hertz:
      return collide_with<BatchNormal::hertz>(law, pairs, ends);
    case BatchNormal::viscoelastic:
      return collide_with<BatchNormal::viscoelastic>(law, pairs, ends);
    case BatchNormal::compact:
      return collide_with<BatchNormal::compact>(law, pairs, ends);
  }
}

const char* target_of_lanes() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace slipcheck {

HWY_EXPORT(collide_lanes);
HWY_EXPORT(target_of_lanes);

namespace {

constexpr std::size_t kLongest = 1000;  // undamped durations
constexpr std::size_t kBlock = 1024;    // collisions that are prepared at once

BatchNormal normal_of(const SoftContact& contact) {
  if (std::holds_alternative<LinearForce>(contact.normal)) return BatchNormal::linear;
  if (std::holds_alternative<CompactViscoelasticForce>(contact.normal)) return BatchNormal::compact;
  const auto* damped = std::get_if<ViscoelasticForce>(&contact.normal);
  return damped && damped->dissipation_time > 0 ? BatchNormal::viscoelastic : BatchNormal::hertz;
}

BatchTangential tangential_of(const SoftContact& contact) {
  if (std::holds_alternative<ImpactAngleForce>(contact.tangential))
    throw std::domain_error(
        "the rule of the impact's angle needs no integration: it is the hard one");
  if (std::holds_alternative<ViscousForce>(contact.tangential)) return BatchTangential::viscous;
  const auto* asperity = std::get_if<AsperityForce>(&contact.tangential);
  if (!asperity) return BatchTangential::none;
  return asperity->form == AsperityForce::Form::passive ? BatchTangential::passive
                                                        : BatchTangential::printed;
}

class Batch {
 public:
  Batch(const SoftContact& contact, const Sphere& first, const Sphere& second, int steps)
      : contact_(contact),
        steps_(steps),
        mass_(effective_mass(first, second)),
        tangential_mass_(tangential_mass_ratio(first, second) * mass_) {
    const double kappa = tangential_mass_ratio(first, second);
    law_.normal = normal_of(contact);
    law_.tangential = tangential_of(contact);
    law_.by_force = contact.end == ContactEnd::zero_force;
    law_.step = (law_.normal == BatchNormal::linear ? M_PI : hertz_duration(1, 1, 1)) / steps;
    law_.limit = kLongest * static_cast<std::size_t>(steps);
    if (const auto* viscous = std::get_if<ViscousForce>(&contact.tangential))
      law_.friction = viscous->friction / kappa;
    else if (const auto* asperity = std::get_if<AsperityForce>(&contact.tangential))
      law_.friction = asperity->friction / kappa;
  }

  void collide(std::span<const double> normal_speed, std::span<const double> tangential_speed,
               std::span<PairCollision> out) {
    const std::size_t n = out.size();
    for (std::size_t k = 0; k < n; ++k) prepare(k, normal_speed[k], tangential_speed[k]);
    HWY_DYNAMIC_DISPATCH(collide_lanes)(law_, {pairs_.data(), n}, {ends_.data(), n});
    for (std::size_t k = 0; k < n; ++k) {
      const ScaledPairEnd& end = ends_[k];
      out[k] = pair_collision(mass_, tangential_mass_, normal_speed[k], tangential_speed[k],
                              -end.rate, end.slip * normal_speed[k] / tangential_speed[k],
                              end.steps * law_.step * times_[k]);
    }
  }

 private:
  void prepare(std::size_t k, double normal_speed, double tangential_speed) {
    const ImpactScales scales = impact_scales(contact_.normal, mass_, normal_speed);
    const double D = scales.dissipation;
    // How fast the damping acts at most, in 1/T.
    const double damping = law_.normal == BatchNormal::compact ? 1.5 * D * std::sqrt(D) : D;
    if (!(damping * law_.step <= 1))
      throw std::domain_error(fmt::format(
          "a collision at {} m/s is damped so strongly that it needs {:.0f} steps, got {}",
          normal_speed, std::ceil(damping * law_.step * steps_), steps_));
    ScaledPair& pair = pairs_[k];
    pair.damping = D;
    pair.slip = tangential_speed / normal_speed;
    if (const auto* viscous = std::get_if<ViscousForce>(&contact_.tangential))
      pair.surface = law_.step * scales.time * viscous->damping / tangential_mass_;
    else if (const auto* asperity = std::get_if<AsperityForce>(&contact_.tangential))
      pair.surface = law_.step * scales.length / asperity->size;
    times_[k] = scales.time;
  }

  const SoftContact& contact_;
  int steps_;
  double mass_, tangential_mass_;
  BatchLaw law_;
  std::array<ScaledPair, kBlock> pairs_;
  std::array<ScaledPairEnd, kBlock> ends_;
  std::array<double, kBlock> times_;  // T [s]
};

}  // namespace

bool can_batch(const SoftContact& contact) {
  const NormalForce& law = contact.normal;
  return std::holds_alternative<LinearForce>(law) || std::holds_alternative<HertzForce>(law) ||
         std::holds_alternative<ViscoelasticForce>(law) ||
         std::holds_alternative<CompactViscoelasticForce>(law);
}

void collide_batch(const SoftContact& contact, const Sphere& first, const Sphere& second,
                   std::span<const double> normal_speed, std::span<const double> tangential_speed,
                   int steps, std::span<PairCollision> out) {
  if (!can_batch(contact)) throw std::invalid_argument("a batch has no power law");
  if (normal_speed.size() != out.size() || tangential_speed.size() != out.size())
    throw std::invalid_argument(fmt::format("speeds and results differ in number: {}, {}, {}",
                                            normal_speed.size(), tangential_speed.size(),
                                            out.size()));
  if (steps < 8)
    throw std::invalid_argument(fmt::format("steps must be at least 8, got {}", steps));
  Batch batch(contact, first, second, steps);
  for (std::size_t k = 0; k < out.size(); k += kBlock) {
    heed_stop();
    const std::size_t n = std::min(kBlock, out.size() - k);
    batch.collide(normal_speed.subspan(k, n), tangential_speed.subspan(k, n), out.subspan(k, n));
  }
}

void collide_batch(const SoftContact& contact, const Sphere& first, const Sphere& second,
                   std::span<const double> normal_speed, std::span<const double> tangential_speed,
                   int steps, std::span<PairCollision> out, std::span<PairDoubt> doubt) {
  if (doubt.size() != out.size())
    throw std::invalid_argument(
        fmt::format("results and doubts differ in number: {}, {}", out.size(), doubt.size()));
  if (steps % 2 != 0 || steps < 16)
    throw std::invalid_argument(fmt::format("steps must be even and at least 16, got {}", steps));
  std::vector<PairCollision> coarse(out.size());
  collide_batch(contact, first, second, normal_speed, tangential_speed, steps / 2, coarse);
  collide_batch(contact, first, second, normal_speed, tangential_speed, steps, out);
  const auto distance = [](double a, double b) { return a == b ? 0 : std::abs(a - b); };
  for (std::size_t k = 0; k < out.size(); ++k)
    doubt[k] = {distance(out[k].normal_restitution, coarse[k].normal_restitution),
                distance(out[k].tangential_restitution, coarse[k].tangential_restitution),
                distance(out[k].duration, coarse[k].duration)};
}

const char* batch_target() { return HWY_DYNAMIC_DISPATCH(target_of_lanes)(); }

}  // namespace slipcheck
#endif
