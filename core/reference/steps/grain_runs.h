#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/thread_team.h"
#include "reference/steps/grain_contacts.h"
#include "reference/steps/grain_islands.h"
#include "reference/steps/grain_kernels.h"
#include "reference/steps/grain_neighbours.h"

namespace slipcheck {

/// The steps of a block that groups of islands do. What comes of them is put aside until it is
/// given back, as a block in which a grain got faster than foreseen has to be done again.
class GrainRuns {
 public:
  struct Total {
    std::size_t begun = 0, touching = 0;  ///< contacts
    GrainSpeeds fastest;                  ///< of the grains, in the end
  };

  /// Of what must outlive this.
  GrainRuns(const GrainKernels& kernels, const GrainIslands& islands, const GrainNeighbours& list)
      : kernels_(&kernels), islands_(&islands), list_(&list) {}

  /// Groups share no grain: whoever takes them, each does the same.
  Total run(const GrainArrays& grains, const GrainContacts& contacts, const GrainSteps& steps,
            ThreadTeam& team) {
    const std::vector<GrainIslandGroup>& groups = islands_->groups();
    after_.hold(islands_->grain_places(), kernels_->features());
    workers_.resize(team.size());
    for (Worker& worker : workers_) worker.left.touching.clear(), worker.left.parted.clear();
    ended_.resize(groups.size());
    team.run_own_first(groups.size(), [&](std::size_t own, std::size_t k) {
      ended_[k] = run_group(groups[k], grains, contacts, steps, workers_[own]);
    });
    Total all;
    for (Ended& each : ended_) {
      each.touching_before = all.touching;
      all.begun += each.begun;
      all.touching += each.touching.size();
      all.fastest.add(each.fastest);
    }
    return all;
  }

  /// Has those of grains first … last − 1, the share of thread `own`, of which something will be
  /// given back roll until then: that costs least. On all threads at once.
  void let_roll(std::size_t own, std::size_t first, std::size_t last, const ThreadTeam& team,
                GrainArrays& grains) const {
    for (const GrainIslandPart& part : islands_->parts()) {
      if (part.stretch != own && part.stretch != team.size()) continue;
      for (const std::uint32_t i : part.grains)
        if (first <= i && i < last) grains.sticks[i] = 1;
    }
  }

  /// What came of grains first … last − 1, the share of thread `own`, and contacts of as large a
  /// share of the groups, for which these must have been renewed. On all threads at once.
  void give_back(std::size_t own, std::size_t first, std::size_t last, const ThreadTeam& team,
                 GrainArrays& grains, GrainContacts& contacts) const {
    const GrainFeatures& has = kernels_->features();
    for (const GrainIslandPart& part : islands_->parts()) {
      if (part.stretch == own) grains.scatter(part.grains, after_, part.first, has);
      if (part.stretch != team.size()) continue;
      for (std::size_t k = 0; k < part.grains.size(); ++k) {
        const std::uint32_t i = part.grains[k];
        if (first <= i && i < last) grains.take(i, after_, part.first + k, has);
      }
    }
    const auto [begin, end] = team.share_of(ended_.size(), own);
    for (std::size_t k = begin; k < end; ++k)
      contacts.keep(of(ended_[k].touching, ended_[k].left->touching), ended_[k].touching_before);
  }
  /// What belongs to no share.
  void give_back_parted(GrainContacts& contacts) const {
    for (const Ended& each : ended_) contacts.add_parted(of(each.parted, each.left->parted));
  }

  /// Gives back memory: of many grains as much as what is shown of them.
  void forget() {
    after_ = {};
    workers_.clear();
  }

 private:
  /// What a thread does groups' steps with, and what they leave.
  struct alignas(64) Worker {
    GrainBatch batch;
    GrainContacts::Left left;
  };
  /// What a group's steps came to.
  struct Ended {
    std::size_t begun = 0;
    GrainSpeeds fastest;
    const GrainContacts::Left* left = nullptr;
    GrainStretch touching, parted;    ///< of that
    std::size_t touching_before = 0;  ///< of the groups before it
  };

  template <class T>
  static std::span<const T> of(const GrainStretch& stretch, const std::vector<T>& all) {
    return std::span(all).subspan(stretch.begin, stretch.size());
  }

  Ended run_group(const GrainIslandGroup& group, const GrainArrays& grains,
                  const GrainContacts& contacts, const GrainSteps& steps, Worker& worker) {
    GrainBatch& batch = worker.batch;
    contacts.take(group, *islands_, *list_, grains, after_, group.first, batch);
    Ended ended;
    ended.begun = kernels_->run(batch, steps);
    ended.fastest = fastest_of(batch, kernels_->features());
    GrainContacts::Left& left = worker.left;
    const auto count = [](const auto& all) { return static_cast<std::uint32_t>(all.size()); };
    ended.left = &left;
    ended.touching.begin = count(left.touching);
    ended.parted.begin = count(left.parted);
    GrainContacts::leave(group, batch, steps.count, *list_, left);
    ended.touching.end = count(left.touching);
    ended.parted.end = count(left.parted);
    return ended;
  }

  const GrainKernels* kernels_;
  const GrainIslands* islands_;
  const GrainNeighbours* list_;
  std::vector<Worker> workers_;  ///< by thread
  std::vector<Ended> ended_;     ///< by group
  GrainArrays after_;            ///< grains of all groups after the block
};

}  // namespace slipcheck
