#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/thread_team.h"
#include "physics/frame.h"
#include "reference/steps/grain_contacts.h"
#include "reference/steps/grain_islands.h"
#include "reference/steps/grain_kernels.h"
#include "reference/steps/grain_neighbours.h"

namespace slipcheck {

/// Which bodies of the scene grains are, in their order in memory, and in which of the periodic
/// cells.
struct GrainPlaces {
  std::vector<std::uint32_t> body;
  std::vector<std::int32_t> cell_x, cell_y;
};

/// Grains at the time of their positions: each gets the half kick from its velocities' time, and
/// stays as it is.
class GrainLook {
 public:
  /// Of what must outlive this. half: a half step without drift.
  GrainLook(const GrainKernels& kernels, const GrainArrays& grains, const GrainPlaces& places,
            const GrainNeighbours& list, const GrainContacts& contacts, const GrainSteps& half)
      : kernels_(kernels),
        grains_(grains),
        places_(places),
        list_(list),
        contacts_(contacts),
        half_(half) {}

  /// margin: how near two on the list must be to touch within a step [m]; islands: for its use.
  void show(double margin, GrainIslands& islands, ThreadTeam& team, Frame& frame) {
    shown_ = &frame.bodies;
    shown_->resize(grains_.size());
    impulses_.assign(grains_.size(), kNotShown);
    const auto look = [&](std::size_t first, std::size_t last, GrainNear& found) {
      find_near(margin, first, last, found);
    };
    islands.find(grains_.size(), {list_.first(), list_.second()}, {}, look, team);
    for (const GrainIslandGroup& group : islands.groups()) show_group(group, islands);
    show_others();
    std::ranges::sort(touches_, {}, [](const auto& each) { return each.first; });
    frame.touches.clear();
    frame.touches.reserve(grains_.size() + touches_.size());
    for (std::size_t i = 0; i < grains_.size(); ++i)
      if (impulses_[i] > 0)
        frame.touches.push_back({static_cast<int>(places_.body[i]), kSubstrate, impulses_[i]});
    for (const auto& [listed, touch] : touches_) frame.touches.push_back(touch);
  }

 private:
  static constexpr double kNotShown = -1;  ///< for an impulse

  /// Of the pairs first … last − 1 of the list those that may touch; all are hit.
  void find_near(double margin, std::size_t first, std::size_t last, GrainNear& found) const {
    const auto part = [=](const std::vector<std::uint32_t>& all) {
      return std::span(all).subspan(first, last - first);
    };
    found.near.clear();
    kernels_.find_near(grains_, part(list_.first()), part(list_.second()), margin, found.near);
    found.hit.clear();
    for (std::uint32_t& each : found.near) {
      each += static_cast<std::uint32_t>(first);
      found.hit.push_back(list_.first()[each]);
    }
  }

  void show_group(const GrainIslandGroup& group, const GrainIslands& islands) {
    contacts_.take(group, islands, list_, grains_, after_, 0, batch_);
    kernels_.run(batch_, half_);
    for (std::size_t k = 0; k < group.grains.size(); ++k) show_grain(k, group.grains[k]);
    for (std::size_t p = 0; p < group.pairs.size(); ++p) {
      const GrainPair& pair = batch_.pairs[p];
      const double impulse = std::abs(pair.normal_force) * half_.step;
      if (!pair.touching || !(impulse > 0)) continue;
      touches_.push_back({group.pairs[p], touch_of(pair, group, impulse)});
    }
  }

  Touch touch_of(const GrainPair& pair, const GrainIslandGroup& group, double impulse) const {
    const auto first = static_cast<int>(places_.body[group.grains[pair.a]]);
    if (pair.wall != GrainPair::kNoWall) return {first, surface_touch(pair.wall), impulse};
    const auto second = static_cast<int>(places_.body[group.grains[pair.b]]);
    return {std::min(first, second), std::max(first, second), impulse};
  }

  /// Those that no group has, so many at once.
  void show_others() {
    std::vector<std::uint32_t> others;
    const auto show_all = [&] {
      batch_.hold(after_, 0, others.size(), 0, kernels_.features());
      batch_.take(grains_, others, kernels_.kinds(), kernels_.features());
      kernels_.run(batch_, half_);
      for (std::size_t k = 0; k < others.size(); ++k) show_grain(k, others[k]);
      others.clear();
    };
    for (std::uint32_t i = 0; i < grains_.size(); ++i) {
      if (impulses_[i] != kNotShown) continue;
      others.push_back(i);
      if (others.size() == GrainBatch::kAtOnce) show_all();
    }
    show_all();
  }

  /// k of the batch, which is grain i. What steps do not change stays in the scene's order.
  void show_grain(std::size_t k, std::size_t i) {
    const GrainFeatures& has = kernels_.features();
    const GrainPlane& plane = kernels_.plane();
    const GrainView& g = batch_.grains;
    const std::uint32_t body = places_.body[i];
    const double x = grains_.x[i] + places_.cell_x[i] * plane.length_x;
    const double y = grains_.y[i] + places_.cell_y[i] * plane.length_y;
    const double wx = has.on_plane ? g.wx[k] : grains_.wx[body];
    const double wy = has.on_plane ? g.wy[k] : grains_.wy[body];
    const double wz = has.rubs ? g.wz[k] : grains_.wz[body];
    const GrainKind& kind = kernels_.kinds()[grains_.kind[i]];
    const double z = has.lifts ? g.z[k] : kind.radius, vz = has.lifts ? g.vz[k] : 0;
    (*shown_)[body] = {{x, y, z}, {g.vx[k], g.vy[k], vz}, {wx, wy, wz}};
    impulses_[i] = has.on_plane ? 2 * batch_.load[k] : half_.begun ? kind.weight * half_.step : 0;
    if (has.lifts && grains_.flies[i] > 0) impulses_[i] += grains_.bounced[i];
  }

  const GrainKernels& kernels_;
  const GrainArrays& grains_;
  const GrainPlaces& places_;
  const GrainNeighbours& list_;
  const GrainContacts& contacts_;
  GrainSteps half_;
  GrainArrays after_;  ///< of the batch
  GrainBatch batch_;
  std::vector<BodyState>* shown_ = nullptr;
  std::vector<double> impulses_;                          ///< of the substrate on each grain [N s]
  std::vector<std::pair<std::uint32_t, Touch>> touches_;  ///< of two, by place in the list
};

}  // namespace slipcheck
