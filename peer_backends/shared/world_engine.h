#pragma once

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/engine.h"

namespace slipcheck::peer {

/// A scene with the settings and the step that a world is made for.
template <class Chosen>
struct Setup {
  Scene scene;
  Chosen settings;
  double time_step;  ///< of the harness [s]; a world takes `substeps` steps in it
};

/// An engine each start of which makes a world of its own. `World` has
///   Chosen, its settings with a member `substeps`;
///   static EngineInfo info(); static Chosen read(const Settings&);
///   static std::string refusal(const Setup<Chosen>&), empty where there is none;
///   static std::vector<Lack> lacks(const Setup<Chosen>&);
///   World(const Setup<Chosen>&, std::span<const BodyState>, double time);
///   Settings applied() const; void step(), one of its own;
///   void look(Frame&), bodies and the touches since forget_touches().
///   kShowsParts: its own steps are shown. Where a contact lasts many of them it is no collision in
///   any one, and the harness sees the whole of it between steps of its own.
template <class World>
class WorldEngine final : public Engine {
 public:
  EngineInfo info() const override { return World::info(); }

  Applied configure(const EngineScene& scene, const Settings& chosen, double time_step) override {
    Setup<typename World::Chosen> setup{scene, World::read(chosen), time_step};
    if (scene.periodic != Vector2::Zero())
      throw Refused(
          fmt::format("{}: the substrate repeats itself, and {} has no periodic boundaries",
                      info().engine, info().engine));
    const std::string refusal = World::refusal(setup);
    if (!refusal.empty()) throw Refused(fmt::format("{}: {}", info().engine, refusal));
    world_.reset();
    setup_.emplace(std::move(setup));
    start(scene.initial, 0);
    return {world_->applied(), World::lacks(*setup_), {}};
  }

  void start(std::span<const BodyState> states, double time) override {
    world_.reset();  // not two at a time
    world_ = std::make_unique<World>(*setup_, states, time);
    parts_.clear();
  }

  void step() override {
    const int substeps = setup_->settings.substeps;
    parts_.clear();
    world_->forget_touches();
    for (int k = 1; k <= substeps; ++k) {
      world_->step();
      if (k == substeps) break;
      if constexpr (!World::kShowsParts) continue;
      world_->look(parts_.emplace_back());
      parts_.back().part = static_cast<double>(k) / substeps;
      world_->forget_touches();
    }
  }

  void read(Frame& frame) const override {
    world_->look(frame);
    frame.part = 1;
  }

  std::span<const Frame> parts() const override { return parts_; }

 private:
  std::optional<Setup<typename World::Chosen>> setup_;
  std::unique_ptr<World> world_;
  std::vector<Frame> parts_;  // of the last step
};

}  // namespace slipcheck::peer
