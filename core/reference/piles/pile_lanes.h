#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/state_archive.h"
#include "reference/piles/pile_contacts.h"

namespace slipcheck {

/// Eight contacts of two bodies, whose laws are as of PileLaws::is_plain(), number by number: the
/// lanes of vectors. Of what PileContact has, that from which the rest follows to the bit.
struct alignas(64) PileLanes {
  static constexpr std::size_t kCount = 8;
  using Row = std::array<double, kCount>;
  using Numbers = std::array<std::uint32_t, kCount>;

  Row overlap, normal_force, impulse;          ///< as of PileContact
  std::array<Row, 3> normal, across, stretch;  ///< across: the tangential force on the first [N]
  Numbers first, second, law;                  ///< as of PileNear
  std::array<std::array<std::int32_t, kCount>, 2> periods;  ///< as of PileNear
  std::uint8_t touch, slide;                                ///< a bit for each
  std::uint8_t lasted;                                      ///< take_on_lanes() has taken it on
};

/// What a contact that lasts does in a step.
struct alignas(64) PileLaneForce {
  Vector3 all;    ///< on the first [N]
  Vector3 lever;  ///< F×n, which turns both [N]
  double lost;    ///< [J]
  double unused;
};

/// The numbers of a law.
struct alignas(64) PileLaneLaw {
  explicit PileLaneLaw(const PileLaw& law);

  double stiffness, damping;                  ///< k [N/m], c [N s/m]
  double sliding_stiffness, sliding_damping;  ///< k_t [N/m], c_t [N s/m]
  double static_friction, kinetic_friction;   ///< [-]
  double deepest;                             ///< as of PileLaw
  double sliding_compliance;                  ///< −1/k_t [m/N]
};

/// The contacts of two bodies of a slab in lanes, by PileNear::contact; as PileContacts.
class PileLaneContacts {
 public:
  using Contact = PileContact<false>;

  bool touches(std::size_t k) const { return bit(lanes_[k / kLanes].touch, k); }
  double impulse(std::size_t k) const { return lanes_[k / kLanes].impulse[k % kLanes]; }
  Contact get(std::size_t k, const PileLaw& law) const;
  template <class What>
  void change(const PileNear& near, const PileLawTable& laws, const What& what) {
    Contact contact = get(near.contact, laws[near.law]);
    what(contact);
    put(near, contact);
  }
  void keep(PileNear& near, const Contact& contact, const PileLawTable&);
  void drop(PileNear& near) {
    places_.leave(near.contact);
    near.contact = PileNear::kNone;
  }
  void set_law(const PileNear& near, const PileLawTable&) {
    lanes_[near.contact / kLanes].law[near.contact % kLanes] = near.law;
  }
  void exchange(StateArchive& archive) { archive(lanes_, places_); }

  /// No group is taken on yet. forces: where those of the step go, until the next one.
  void begin_step(std::vector<PileLaneForce>& forces) {
    const std::size_t contacts = lanes_.size() * kLanes;
    if (forces.size() < contacts) forces.resize(contacts);
    forces_ = forces.data();
    is_taken_on_.assign((contacts + kInGroup - 1) / kInGroup, false);
  }
  bool is_taken_on(std::size_t k) const { return is_taken_on_[k / kInGroup]; }
  /// Whether take_on_lanes() has told its force.
  bool lasted(std::size_t k) const { return bit(lanes_[k / kLanes].lasted, k); }
  const PileLaneForce& force(std::size_t k) const { return forces_[k]; }
  /// The lanes of a contact's group, which is taken on now, and where their forces go.
  std::pair<std::span<PileLanes>, PileLaneForce*> take_group(std::size_t k) {
    const std::size_t group = k / kInGroup, first = group * (kInGroup / kLanes);
    is_taken_on_[group] = true;
    return {std::span(lanes_).subspan(first, std::min(kInGroup / kLanes, lanes_.size() - first)),
            &forces_[first * kLanes]};
  }

 private:
  static constexpr std::size_t kLanes = PileLanes::kCount;
  /// Contacts that are taken on together: their forces lie in the nearest caches when they act.
  static constexpr std::size_t kInGroup = 256;
  static bool bit(std::uint8_t bits, std::size_t k) { return bits >> k % kLanes & 1; }
  void put(const PileNear& near, const Contact& contact);

  std::vector<PileLanes> lanes_;
  PileLaneForce* forces_ = nullptr;        ///< of one step
  std::vector<std::uint8_t> is_taken_on_;  ///< by group, in this step
  PilePlaces places_;
};

/// Takes those of the contact's group that touch, and neither begin nor end, on to now, as PileStep
/// does and with the same bits, and tells their forces. Returns whether one of them slides.
bool take_on_lanes(const PileWorld& world, std::span<const PileLaneLaw> laws, std::size_t contact,
                   PileLaneContacts& contacts);

}  // namespace slipcheck
