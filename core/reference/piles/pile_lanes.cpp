// Compiled once for each instruction set by Google Highway. No operation is fused and nothing is
// summed over lanes, so that every set gives the same bits.
#include "reference/piles/pile_lanes.h"

#include <utility>
#include <variant>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/piles/pile_lanes.cpp"
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "reference/piles/pile_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {

HWY_ATTR bool take_on(const PileWorld& world, const PileLaneLaw* laws, std::span<PileLanes> lanes,
                      PileLaneForce* forces) {
  if (world.scene->hard.periodic.isZero(0))
    return PileLaneStep<false>(world, laws).run(lanes, forces);
  return PileLaneStep<true>(world, laws).run(lanes, forces);
}

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace slipcheck {

HWY_EXPORT(take_on);

bool take_on_lanes(const PileWorld& world, std::span<const PileLaneLaw> laws, std::size_t contact,
                   PileLaneContacts& contacts) {
  const auto [lanes, forces] = contacts.take_group(contact);
  return HWY_DYNAMIC_DISPATCH(take_on)(world, laws.data(), lanes, forces);
}

PileLaneLaw::PileLaneLaw(const PileLaw& law)
    : stiffness(std::get<LinearForce>(law.normal).stiffness),
      damping(std::get<LinearForce>(law.normal).damping),
      sliding_stiffness(law.sliding.stiffness),
      sliding_damping(law.sliding.damping),
      static_friction(law.sliding.static_friction),
      kinetic_friction(law.sliding.kinetic_friction),
      deepest(law.deepest),
      sliding_compliance(-1 / law.sliding.stiffness) {}

PileLaneContacts::Contact PileLaneContacts::get(std::size_t k, const PileLaw& law) const {
  const PileLanes& lanes = lanes_[k / kLanes];
  const std::size_t l = k % kLanes;
  const auto vector = [&](const std::array<PileLanes::Row, 3>& rows) {
    return Vector3(rows[0][l], rows[1][l], rows[2][l]);
  };
  Contact c;
  c.first = lanes.first[l];
  c.second = static_cast<int>(lanes.second[l]);
  c.touching = touches(k);
  c.impulse = lanes.impulse[l];
  c.law = &law;
  if (!c.touching) return c;
  c.overlap = lanes.overlap[l];
  c.normal = vector(lanes.normal);
  c.normal_force = lanes.normal_force[l];
  const auto& normal = std::get<LinearForce>(c.law->normal);
  c.normal_dashpot = c.normal_force - normal.elastic(c.overlap);
  const Vector3 across = vector(lanes.across);
  c.force.all = c.normal_force * c.normal + across;
  c.force.across = across;
  c.sliding = {vector(lanes.stretch), bit(lanes.slide, k)};
  if (c.law->sliding.static_friction == 0) return c;
  c.stiffness = c.law->sliding.stiffness;
  c.sliding_dashpot = across - Vector3(-c.stiffness * c.sliding.stretch);
  return c;
}

void PileLaneContacts::keep(PileNear& near, const Contact& contact, const PileLawTable&) {
  near.contact = places_.take();
  if (near.contact == kLanes * lanes_.size()) {
    // Lanes without a contact look at bodies too: at these, as another thread may be moving others.
    PileLanes& added = lanes_.emplace_back();
    added.first.fill(near.first);
    added.second.fill(static_cast<std::uint32_t>(near.second));
  }
  put(near, contact);
}

void PileLaneContacts::put(const PileNear& near, const Contact& contact) {
  const std::size_t k = near.contact, l = k % kLanes;
  PileLanes& lanes = lanes_[k / kLanes];
  const auto set = [&](std::uint8_t& bits, bool value) {
    const auto mask = static_cast<std::uint8_t>(1u << l);
    bits = static_cast<std::uint8_t>(value ? bits | mask : bits & ~mask);
  };
  const auto set_vector = [&](std::array<PileLanes::Row, 3>& rows, const Vector3& value) {
    for (std::size_t i = 0; i < 3; ++i) rows[i][l] = value[static_cast<Eigen::Index>(i)];
  };
  lanes.first[l] = near.first;
  lanes.second[l] = static_cast<std::uint32_t>(near.second);
  lanes.law[l] = near.law;
  lanes.periods[0][l] = near.across_x;
  lanes.periods[1][l] = near.across_y;
  lanes.overlap[l] = contact.overlap;
  lanes.normal_force[l] = contact.normal_force;
  lanes.impulse[l] = contact.impulse;
  set_vector(lanes.normal, contact.normal);
  set_vector(lanes.across, contact.force.across);
  set_vector(lanes.stretch, contact.sliding.stretch);
  set(lanes.touch, contact.touching);
  set(lanes.slide, contact.sliding.slides);
}

}  // namespace slipcheck
#endif
