#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/stop_scope.h"
#include "reference/steps/step_bodies.h"
#include "reference/steps/step_pairs.h"
#include "reference/steps/step_surfaces.h"

namespace slipcheck {

/// The steps x_{n+1} = x_n + h v_{n+1/2}, v_{n+1/2} = v_{n−1/2} + (h/m) F(x_n, ṽ_n) (velocity
/// Verlet with its two half kicks in one) with ṽ_n = v_{n−1/2} + ½ (v_{n−1/2} − v_{n−3/2}), which
/// makes damped motion second order too.
///
/// A few bodies go over all pairs; more of them, and those on a periodic plane, over
/// StepNeighbours. Pairs, a StepPairs, know nothing of the substrate, and StepBodies nothing of the
/// contacts' laws.
template <class Pairs, class Substrate>
class StepLoop final : public StepKernel {
 public:
  /// neighbours: null: all pairs; surfaces: null: there are none.
  StepLoop(Pairs pairs, std::unique_ptr<StepNeighbours> neighbours,
           std::unique_ptr<StepSurfaces> surfaces, std::vector<std::string> features)
      : features_(std::move(features)),
        neighbours_(std::move(neighbours)),
        pairs_(std::move(pairs)),
        surfaces_(std::move(surfaces)) {}

  void find_forces(StepWorld& world) override {
    if (world.forces_known) return;
    if (neighbours_)
      find_forces_of_many(world);
    else
      step_few(world, 0, StepStop::never);
  }

  void advance(StepWorld& world, std::size_t steps, StepStop stop) override {
    const std::size_t batch = 1 + kBodySteps / world.bodies.size();
    for (std::size_t begin = 0; begin < steps; begin += batch) {
      heed_stop();
      const std::size_t some = std::min(steps - begin, batch);
      if (neighbours_ ? step_many(world, some, stop) : step_few(world, some, stop)) return;
    }
  }

  bool is_met(const StepWorld& world, StepStop stop) const override { return world.is_met(stop); }

  std::vector<std::string> features() const override { return features_; }

  void exchange(StateArchive& archive, StepWorld& world) override {
    archive(world, pairs_);
    if (surfaces_) archive(*surfaces_);
    if (!neighbours_) return;
    archive(*neighbours_);
    if (!archive.reads()) return;
    pairs_.take(*neighbours_, world);
    shares_.divide(*neighbours_, world.bodies.size());
  }

  void show(const StepWorld& world, Frame& frame, bool with_touches) override {
    const std::size_t bodies = world.bodies.size();
    frame.bodies.resize(bodies);
    impulses_.resize(with_touches ? bodies : 0);
    Bodies::show(world, neighbours_.get(), shares_, frame.bodies, impulses_);
    frame.touches.clear();
    if (!with_touches) return;
    for (std::size_t i = 0; i < bodies; ++i)
      if (impulses_[i] > 0)
        frame.touches.push_back({static_cast<int>(i), kSubstrate, impulses_[i]});
    pairs_.show(world, neighbours_.get(), frame.touches);
    if (surfaces_) surfaces_->show(world, frame.touches);
  }

 private:
  using Bodies = StepBodies<Substrate>;
  /// Steps, times the bodies, between two looks at whether to stop.
  static constexpr std::size_t kBodySteps = 4096;

  /// So many steps, and the forces after them. Whether `stop` was met before. A few bodies are done
  /// sooner than functions are called.
  [[gnu::noinline]] SLIPCHECK_FLATTEN_WIDE bool step_few(StepWorld& world, std::size_t steps,
                                                         StepStop stop) {
    bodies_.resize(world.bodies.size());
    for (std::size_t k = 0;; ++k) {
      if (k < steps) bodies_.look_ahead(world);
      if (!world.forces_known) pairs_.meet(world);
      if (!world.forces_known && surfaces_) surfaces_->meet(world);
      world.forces_known = true;
      if (k == steps) return false;
      if (stop != StepStop::never && world.is_met(stop)) return true;
      bodies_.move(world);
      ++world.n;
      world.forces_known = false;
    }
  }

  bool step_many(StepWorld& world, std::size_t steps, StepStop stop) {
    for (std::size_t k = 0; k < steps; ++k) {
      if (!world.forces_known) find_forces_of_many(world);
      if (stop != StepStop::never && world.is_met(stop)) return true;
      Bodies::move(world, *neighbours_, shares_);
      ++world.n;
      world.forces_known = false;
    }
    return false;
  }

  void find_forces_of_many(StepWorld& world) {
    pairs_.meet(world, *neighbours_, shares_);
    if (surfaces_) surfaces_->meet(world);
    world.forces_known = true;
  }

  std::vector<std::string> features_;
  std::unique_ptr<StepNeighbours> neighbours_;  ///< null: a few bodies, all pairs
  Pairs pairs_;
  std::unique_ptr<StepSurfaces> surfaces_;
  Bodies bodies_;
  StepShares shares_;             ///< of neighbours
  std::vector<double> impulses_;  ///< of the substrate, for show() [N s]
};

}  // namespace slipcheck
