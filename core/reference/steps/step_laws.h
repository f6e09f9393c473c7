#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "reference/steps/step_contact.h"
#include "reference/steps/step_neighbours.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// The laws of StepPairs: one for each two rows of the scene's table, or one for each two
/// bodies that are near each other, where each two have their own.
template <class Normal, class Tangential>
class StepLaws {
 public:
  using Law = StepLaw<Normal, Tangential>;

  /// The scene must outlive them. example: of those that never meet; can_meet: whether bodies of
  /// two rows do; make: a Law, but for `clamped`, of a SoftContact.
  template <class CanMeet, class Make>
  StepLaws(const ContactScene& scene, const Law& example, const CanMeet& can_meet, const Make& make)
      : scene_(&scene),
        rows_(scene.hard.row_count()),
        example_(example),
        laws_(rows_ * rows_, example) {
    make_ = [make](const SoftContact& contact) {
      Law law = make(contact);
      law.clamped = contact.end == ContactEnd::zero_force;
      return law;
    };
    for (std::size_t k = 0; k < laws_.size() && k < scene.soft.size(); ++k)
      if (const std::optional<SoftContact>& contact = scene.soft[k];
          contact && can_meet(k / rows_, k % rows_))
        laws_[k] = make_(*contact);
  }

  /// For all pairs (j, i) of bodies with i < j.
  void find_for_all_pairs() {
    number_.clear();
    for (std::size_t j = 1; j < scene_->hard.bodies.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) number_.push_back(in_table(i, j));
  }
  /// For the neighbours, which are new.
  void find(StepNeighbours& neighbours, const StepWorld& world) {
    const std::vector<StepNeighbour>& all = neighbours.all();
    number_.assign(all.size(), 0);
    if (!scene_->own && rows_ == 1) return;
    if (scene_->own) laws_.resize(all.size(), example_);
    constexpr std::size_t kPairsAtOnce = 1024;
    neighbours.team().run((all.size() + kPairsAtOnce - 1) / kPairsAtOnce, [&](std::size_t share) {
      const std::size_t end = std::min(all.size(), (share + 1) * kPairsAtOnce);
      for (std::size_t k = share * kPairsAtOnce; k < end; ++k) {
        const std::size_t i = world.number_of(all[k].first), j = world.number_of(all[k].second);
        number_[k] = scene_->own ? static_cast<std::uint32_t>(k) : in_table(i, j);
        if (scene_->own) laws_[k] = make_(*scene_->contact_of(i, j));
      }
    });
  }
  /// Of that pair, or those neighbours.
  const Law& operator[](std::size_t pair) const { return laws_[number_[pair]]; }

 private:
  std::uint32_t in_table(std::size_t i, std::size_t j) const {
    return static_cast<std::uint32_t>(scene_->hard.row_of(i) * rows_ + scene_->hard.row_of(j));
  }

  const ContactScene* scene_;
  std::size_t rows_;
  Law example_;
  std::function<Law(const SoftContact&)> make_;
  std::vector<Law> laws_;
  std::vector<std::uint32_t> number_;  // of laws, by pair
};

}  // namespace slipcheck
