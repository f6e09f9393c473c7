#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/state_archive.h"
#include "base/thread_team.h"
#include "reference/steps/grain_islands.h"
#include "reference/steps/grain_kernels.h"
#include "reference/steps/grain_neighbours.h"

namespace slipcheck {

/// The pairs of grains in contact, and what each remembers, between two blocks of steps.
class GrainContacts {
 public:
  /// A pair of the list in contact, by grain, and what it remembers of the last step.
  struct Contact {
    std::uint32_t listed = 0;
    std::uint32_t a = 0, b = 0;
    std::uint16_t wall = GrainPair::kNoWall;
    double normal_force = 0;
    GrainPair::Force force;
  };
  /// What pairs leave after a block: contacts, and of each two that parted in its last step a
  /// grain.
  struct Left {
    std::vector<Contact> touching;
    std::vector<std::uint32_t> parted;
  };

  /// kernels: of the scene, which outlives this; materials: their number.
  GrainContacts(const GrainKernels& kernels, std::size_t materials)
      : kernels_(&kernels), materials_(materials) {}

  std::size_t size() const { return touching_.size(); }
  void exchange(StateArchive& archive) { archive(touching_, parted_); }

  /// Of each pair whose steps must be done one by one in the next block, a grain: of those that
  /// touch, and of those that parted in the last step, as what has just acted on them counts in the
  /// next one.
  void find_hit(std::vector<std::uint32_t>& hit) const {
    hit = parted_;
    for (const Known& known : known_) hit.push_back(known.a);
  }

  /// The list has sorted the grains.
  void reorder(const GrainNeighbours& list, ThreadTeam& team) {
    for (std::uint32_t& i : parted_) i = list.sorted(i);
    for_each(team, [&](Contact& contact) {
      contact.a = list.sorted(contact.a);
      contact.b = list.sorted(contact.b);
      if (contact.a <= contact.b) return;
      std::swap(contact.a, contact.b);
      const GrainPair::Force& f = contact.force;
      contact.force = {-f.x, -f.y, -f.z, -f.across_x, -f.across_y, -f.across_z};
    });
  }

  /// The list is new.
  void find(const GrainNeighbours& list, ThreadTeam& team) {
    for_each(team, [&](Contact& contact) {
      contact.listed = list.place_of(contact.a, contact.b, contact.wall);
    });
    remember(list);
  }

  /// Where the contact of a pair of the list is found; after exchange() with the list.
  void remember(const GrainNeighbours& list) {
    contact_of_.resize(list.first().size());
    known_.resize(touching_.size());
    for (std::uint32_t c = 0; c < touching_.size(); ++c) name(touching_[c], c);
  }

  /// The batch becomes a group, with what its contacts remember; `in`, first: as in its hold(). On
  /// several threads at once.
  void take(const GrainIslandGroup& group, const GrainIslands& islands, const GrainNeighbours& list,
            const GrainArrays& grains, GrainArrays& in, std::size_t first,
            GrainBatch& batch) const {
    batch.hold(in, first, group.grains.size(), group.pairs.size(), kernels_->features());
    batch.take(grains, group.grains, kernels_->kinds(), kernels_->features());
    for (std::size_t p = 0; p < group.pairs.size(); ++p) {
      GrainPair& pair = batch.pairs[p];
      take(group.pairs[p], list, grains, pair);
      pair.a = islands.place(pair.a) + group.shift;
      pair.b = pair.wall == GrainPair::kNoWall ? islands.place(pair.b) + group.shift
                                               : static_cast<std::uint32_t>(batch.count);
    }
  }

  /// Forgets all and makes room for so many.
  void renew(std::size_t count) {
    touching_.resize(count);
    known_.resize(count);
    parted_.clear();
  }

  /// Appends what a group's pairs leave after a block of so many steps.
  static void leave(const GrainIslandGroup& group, const GrainBatch& batch, std::size_t length,
                    const GrainNeighbours& list, Left& left) {
    for (std::size_t p = 0; p < batch.pair_count; ++p) {
      const GrainPair& pair = batch.pairs[p];
      const std::uint32_t listed = group.pairs[p], i = list.first()[listed];
      if (pair.parted_in == length) left.parted.push_back(i);
      if (pair.touching)
        left.touching.push_back(
            {listed, i, list.second()[listed], pair.wall, pair.normal_force, pair.force});
    }
  }

  /// Keeps those as its contacts from place `c` on. On several threads at once.
  void keep(std::span<const Contact> touching, std::size_t c) {
    for (const Contact& contact : touching) {
      touching_[c] = contact;
      name(contact, c++);
    }
  }

  void add_parted(std::span<const std::uint32_t> parted) {
    parted_.insert(parted_.end(), parted.begin(), parted.end());
  }

 private:
  /// What a contact is known by.
  struct Known {
    std::uint32_t listed, a;
  };

  void name(const Contact& contact, std::size_t c) {
    known_[c] = {contact.listed, contact.a};
    contact_of_[contact.listed] = static_cast<std::uint32_t>(c);
  }
  /// Null: none.
  const Contact* contact_of(std::uint32_t listed) const {
    const std::uint32_t c = contact_of_[listed];
    return c < known_.size() && known_[c].listed == listed ? &touching_[c] : nullptr;
  }

  template <class Work>
  void for_each(ThreadTeam& team, Work&& work) {
    team.run_shares(touching_.size(), [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t c = first; c < last; ++c) work(touching_[c]);
    });
  }

  /// A pair of the list, by grain.
  void take(std::uint32_t listed, const GrainNeighbours& list, const GrainArrays& grains,
            GrainPair& pair) const {
    const GrainPlane& plane = kernels_->plane();
    const Contact* contact = contact_of(listed);
    pair.touching = contact != nullptr;
    if (contact) {
      pair.normal_force = contact->normal_force;
      pair.force = contact->force;
    }
    pair.parted_in = 0;
    const std::uint32_t i = list.first()[listed], j = list.second()[listed];
    pair.a = i;
    pair.b = j;
    pair.shift_x = shift_to_nearest_image(grains.x[i] - grains.x[j], plane.length_x);
    pair.shift_y = shift_to_nearest_image(grains.y[i] - grains.y[j], plane.length_y);
    const std::vector<GrainKind>& kinds = kernels_->kinds();
    const std::size_t material = kinds[grains.kind[i]].material;
    pair.wall = list.wall(listed);
    pair.law = static_cast<std::uint32_t>(
        pair.wall == GrainPair::kNoWall
            ? material * materials_ + kinds[grains.kind[j]].material
            : materials_ * materials_ + material * plane.walls.size() + pair.wall);
  }

  const GrainKernels* kernels_;
  std::size_t materials_;
  std::vector<Contact> touching_;
  std::vector<std::uint32_t> parted_;  ///< a grain of each two that did in the last step
  std::vector<Known> known_;           ///< of touching_
  /// Of a pair of the list, in touching_, if that is known by the pair: else it is left from a
  /// contact that has ended, as clearing these would go through the caches of all threads.
  std::vector<std::uint32_t> contact_of_;
};

}  // namespace slipcheck
