#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/state_archive.h"
#include "reference/steps/grain_islands.h"
#include "reference/steps/grain_kernels.h"
#include "reference/steps/grain_neighbours.h"

namespace slipcheck {

/// The pairs of grains in contact, and what each remembers, between two blocks of steps.
class GrainContacts {
 public:
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
    for (const Contact& contact : touching_) hit.push_back(contact.pair.a);
  }

  /// The list has sorted the grains.
  void reorder(const GrainNeighbours& list) {
    for (std::uint32_t& i : parted_) i = list.sorted(i);
    for (Contact& contact : touching_) {
      GrainPair& pair = contact.pair;
      pair.a = list.sorted(pair.a);
      pair.b = list.sorted(pair.b);
      if (pair.a <= pair.b) continue;
      std::swap(pair.a, pair.b);
      const GrainPair::Force& f = pair.force;
      pair.force = {-f.x, -f.y, -f.z, -f.across_x, -f.across_y, -f.across_z};
    }
  }

  /// The list is new.
  void find(const GrainNeighbours& list) {
    for (Contact& contact : touching_)
      contact.listed = list.place_of(contact.pair.a, contact.pair.b, contact.pair.wall);
    remember(list);
  }

  /// Where the contact of a pair of the list is found; after exchange() with the list.
  void remember(const GrainNeighbours& list) {
    contact_of_.assign(list.first().size(), kNone);
    for (std::uint32_t c = 0; c < touching_.size(); ++c) contact_of_[touching_[c].listed] = c;
  }

  /// A pair of the list, by grain, with what it remembers if in contact.
  void take(std::uint32_t listed, const GrainNeighbours& list, const GrainArrays& grains,
            GrainPair& pair) const {
    const GrainPlane& plane = kernels_->plane();
    const std::uint32_t contact = contact_of_[listed];
    pair.touching = false;
    if (contact != kNone) pair = touching_[contact].pair;
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

  /// Forgets all and makes room for so many.
  void renew(std::size_t count) {
    for (const Contact& contact : touching_) contact_of_[contact.listed] = kNone;
    touching_.resize(count);
    parted_.clear();
  }

  /// Of a group's pairs after a block of so many steps those that touch, from place `c` on; appends
  /// to `parted` a grain of each two that did so in the last step. On several threads at once.
  void keep(const GrainIslandGroup& group, std::span<const GrainPair> pairs, std::size_t length,
            std::size_t c, const GrainNeighbours& list, std::vector<std::uint32_t>& parted) {
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const std::uint32_t listed = group.pairs[p];
      if (pairs[p].parted_in == length) parted.push_back(list.first()[listed]);
      if (!pairs[p].touching) continue;
      Contact& contact = touching_[c];
      contact = {listed, pairs[p]};
      contact.pair.a = list.first()[listed];
      contact.pair.b = list.second()[listed];
      contact_of_[listed] = static_cast<std::uint32_t>(c++);
    }
  }

  void add_parted(std::span<const std::uint32_t> parted) {
    parted_.insert(parted_.end(), parted.begin(), parted.end());
  }

 private:
  struct Contact {
    std::uint32_t listed = 0;
    GrainPair pair;  ///< by grain
  };
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  const GrainKernels* kernels_;
  std::size_t materials_;
  std::vector<Contact> touching_;
  std::vector<std::uint32_t> parted_;      ///< a grain of each two that did in the last step
  std::vector<std::uint32_t> contact_of_;  ///< of a pair of the list, in touching_ or kNone
};

}  // namespace slipcheck
