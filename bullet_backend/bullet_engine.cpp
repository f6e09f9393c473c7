#include "bullet_backend/bullet_engine.h"

#include <fmt/format.h>

#include <optional>

#include "bullet_backend/bullet_world.h"
#include "bullet_backend/coefficients.h"
#include "bullet_backend/profiles.h"

namespace slipcheck::bullet {
namespace {

class BulletEngine final : public Engine {
 public:
  EngineInfo info() const override {
    return {"bullet", bullet_version(), bullet_precision(), profile_names()};
  }

  Applied configure(const HardScene& scene, const std::string& profile, double time_step) override {
    const Profile parsed = parse_profile(profile);
    if (scene.periodic != Vector2::Zero()) {
      throw Refused(
          "bullet: the substrate repeats itself, and a Bullet world has no periodic boundaries");
    }
    if (!scene.motion.is_still()) {
      throw Refused(
          "bullet: the substrate moves, and a static plane has no velocity that friction could "
          "feel");
    }
    if (is_no_time(time_step)) {
      throw Refused(fmt::format("bullet in {} precision takes a step of {} s for none",
                                bullet_precision(), time_step));
    }
    world_.reset();
    setup_.emplace(Setup{scene, parsed, time_step, PairCoefficients(scene, time_step)});
    start(scene.initial, 0);
    return {world_->settings(), not_represented(scene, parsed, time_step)};
  }

  void start(std::span<const BodyState> states, double time) override {
    world_.reset();  // not two at a time
    world_.emplace(setup_->scene, setup_->profile, setup_->coefficients, setup_->time_step, states,
                   time);
  }

  void step() override { world_->step(); }

  void read(Frame& frame) const override { world_->read(frame); }

 private:
  struct Setup {
    HardScene scene;
    Profile profile;
    double time_step;  // [s]
    PairCoefficients coefficients;
  };
  std::optional<Setup> setup_;
  std::optional<BulletWorld> world_;
};

}  // namespace

std::unique_ptr<Engine> make_bullet_engine() { return std::make_unique<BulletEngine>(); }

}  // namespace slipcheck::bullet
