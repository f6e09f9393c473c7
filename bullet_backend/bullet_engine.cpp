#include "bullet_backend/bullet_engine.h"

#include <fmt/format.h>

#include <optional>

#include "bullet_backend/bullet_settings.h"
#include "bullet_backend/bullet_world.h"
#include "bullet_backend/not_represented.h"
#include "bullet_backend/world_units.h"
#include "engine/scene_needs.h"

namespace slipcheck::bullet {
namespace {

void refuse_beyond_reach(const Scene& scene, const BulletSettings& settings, double time_step) {
  if (settings.beyond_reach != BeyondReach::refuse || settings.reach == 0) return;
  const double approach = approach_in_a_step(scene, time_step);
  if (approach > settings.reach)
    throw Refused(fmt::format(
        "bullet: bodies approach each other by {:.3g} radii in a step, and these settings are for "
        "up to {:.3g}",
        approach, settings.reach));
}

class BulletEngine final : public Engine {
 public:
  EngineInfo info() const override {
    return {"bullet",
            bullet_version(),
            bullet_precision(),
            setting_table(),
            {scene_part::kFrictionLaw, scene_part::kBlock, scene_part::kCylinder,
             scene_part::kSurfaces}};
  }

  Applied configure(const EngineScene& scene, const Settings& chosen, double time_step) override {
    const BulletSettings settings = read_settings(chosen);
    if (is_no_time(time_step * world_units(scene, settings).time)) {
      throw Refused(fmt::format("bullet in {} precision takes a step of {} s for none",
                                bullet_precision(), time_step));
    }
    refuse_beyond_reach(scene, settings, time_step);
    world_.reset();
    setup_.emplace(Setup{scene, settings, time_step});
    start(scene.initial, 0);
    return {world_->applied(), not_represented(scene, settings, time_step), world_->left_out()};
  }

  void start(std::span<const BodyState> states, double time) override {
    world_.reset();  // not two at a time
    world_.emplace(setup_->scene, setup_->settings, setup_->time_step, states, time);
  }

  void step() override { world_->step(); }

  void read(Frame& frame) const override { world_->read(frame); }

  std::span<const Frame> parts() const override { return world_->parts(); }

 private:
  struct Setup {
    Scene scene;
    BulletSettings settings;
    double time_step;  // [s]
  };
  std::optional<Setup> setup_;
  std::optional<BulletWorld> world_;
};

}  // namespace

std::unique_ptr<Engine> make_bullet_engine() { return std::make_unique<BulletEngine>(); }

}  // namespace slipcheck::bullet
