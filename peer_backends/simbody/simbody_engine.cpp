#include "peer_backends/simbody/simbody_engine.h"

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <variant>

#include "engine/scene_needs.h"
#include "peer_backends/shared/applied.h"
#include "peer_backends/shared/momentum_touches.h"
#include "peer_backends/shared/moving_frame.h"
#include "peer_backends/simbody/hunt_crossley.h"

namespace slipcheck::simbody {
namespace {

/// There is a set of contacts for each two.
constexpr std::size_t kMostBodies = 200;

void refuse_unfit(const Scene& scene) {
  if (scene.box)
    throw Refused("simbody: the walls of a box move with its floor, and these are at rest");
  if (scene.periodic != Vector2::Zero())
    throw Refused(
        "simbody: the substrate repeats itself, and a Simbody system has no periodic boundaries");
  if (scene.bodies.size() > kMostBodies)
    throw Refused(
        fmt::format("simbody: {} bodies, and with a set of contacts for each two at most "
                    "{} are feasible",
                    scene.bodies.size(), kMostBodies));
}

/// A half-space may pass by as a belt does; a ball that does would be elsewhere.
void refuse_surfaces(const Scene& scene) {
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    const slipcheck::Surface& surface = scene.surfaces[k];
    const bool plane = std::holds_alternative<PlaneShape>(surface.shape);
    if (!plane && !std::holds_alternative<BallShape>(surface.shape))
      throw Refused(fmt::format(
          "simbody: surface {} is a plate or a cylinder, and HuntCrossleyForce knows half-spaces "
          "and spheres",
          k));
    const SurfaceMotion& motion = surface.motion;
    const bool steady =
        motion.is_still() ||
        (motion.rate().isZero(0) && motion.course().kind() == SubstrateMotion::Kind::constant);
    if (!steady || (motion.is_belt() && !plane))
      throw Refused(fmt::format(
          "simbody: surface {} turns or swings, and what carries one has a constant velocity", k));
  }
  if (!scene.surfaces.empty() && !scene.motion.is_still())
    throw Refused("simbody: the substrate moves beside surfaces, and the world is seen from it");
}

SurfacePlan plan_of(const slipcheck::Surface& surface, double start) {
  SurfacePlan plan;
  plan.velocity = surface.motion.velocity(start, Vector3::Zero());
  if (const auto* ball = std::get_if<BallShape>(&surface.shape)) {
    plan.is_ball = true;
    plan.radius = ball->radius;
    plan.place = surface.motion.now(start, ball->centre);
  } else {
    const auto& plane = std::get<PlaneShape>(surface.shape);
    plan.place = surface.motion.now(start, plane.point);
    plan.normal = plane.normal;
  }
  return plan;
}

std::vector<Lack> not_represented(const EngineScene& scene, const SimbodySettings& settings,
                                  double time_step) {
  const SceneNeeds needs = needs_of(scene, time_step);
  bool any_hard = false;
  for (const auto& [i, j] : material_pairs(scene)) any_hard |= !scene.soft_between(i, j);
  LackList missing;
  missing.note(needs.friction && needs.static_friction, lack::kStaticFriction,
               settings.fields ? "one coefficient for sticking and sliding"
                               : "what would stick creeps below the transition velocity");
  missing.note(needs.rolling, lack::kRolling);
  missing.note(needs.drilling || needs.coupled_drilling, lack::kDrilling);
  if (needs.bounce)
    missing.add(
        {fmt::format("restitution at other speeds than {}",
                     settings.impact_speed > 0 ? fmt::format("{:.3g} m/s", settings.impact_speed)
                                               : "the first impact's"),
         "restitution at other speeds than …"});
  missing.note(needs.reversed_slip && any_hard, lack::kTangentialRestitution,
               "friction only stops the slip");
  missing.note(scene.confined, lack::kConfinement);
  missing.note(true, "contacts without duration",
               any_hard ? "hard ones and the substrate are Hertz's" : "the substrate is Hertz's");
  return missing.take();
}

Settings applied(const EngineScene& scene, const SimbodySettings& settings) {
  Settings all = write_rows(setting_rows(), settings);
  const auto tell = [&](const std::string& of, const HuntCrossley& contact) {
    all[of + "_modulus"] = contact.modulus;
    all[of + "_dissipation"] = contact.dissipation;
    all[of + "_static_friction"] = contact.static_friction;
    all[of + "_dynamic_friction"] = contact.dynamic_friction;
  };
  if (scene.has_substrate) tell("substrate", substrate_contact(scene, 0, settings));
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k)
    for (const std::size_t body : peer::one_of_each_material(scene))
      tell(fmt::format("surface[{}-{}]", body, k), surface_contact(scene, body, k, settings));
  if (scene.bodies.size() > 1) tell("pair", pair_contact(scene, 0, 1, settings));
  return all;
}

SystemPlan plan_of(const EngineScene& scene, const SimbodySettings& settings,
                   const std::vector<BodyState>& states, double start) {
  SystemPlan plan;
  plan.has_substrate = scene.has_substrate;
  for (const slipcheck::Surface& surface : scene.surfaces)
    plan.surfaces.push_back(plan_of(surface, start));
  plan.bodies = scene.bodies;
  plan.states = states;
  plan.gravity = Vector3(scene.downhill.x(), scene.downhill.y(), -scene.gravity);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    plan.on_substrate.push_back(substrate_contact(scene, i, settings));
    for (std::size_t k = 0; k < scene.surfaces.size(); ++k)
      plan.on_surfaces.push_back(surface_contact(scene, i, k, settings));
    for (std::size_t j = i + 1; j < scene.bodies.size(); ++j)
      plan.pairs.push_back(pair_contact(scene, i, j, settings));
  }
  plan.transition_velocity = settings.transition_velocity;
  plan.integrator = settings.integrator;
  plan.accuracy = settings.accuracy;
  plan.interpolate = settings.interpolate;
  return plan;
}

class SimbodyEngine final : public Engine {
 public:
  EngineInfo info() const override {
    return {"simbody",
            SLIPCHECK_SIMBODY_VERSION,
            "double",
            infos_of(setting_rows()),
            {scene_part::kSurfaces}};
  }

  Applied configure(const EngineScene& scene, const Settings& chosen, double time_step) override {
    refuse_unfit(scene);
    refuse_surfaces(scene);
    const SimbodySettings settings = read_rows(setting_rows(), chosen);
    setup_.emplace(Setup{scene, settings, time_step, MovingFrame(scene, "simbody")});
    start(scene.initial, 0);
    return {applied(scene, settings), not_represented(scene, settings, time_step), {}};
  }

  void start(std::span<const BodyState> states, double time) override {
    steps_ = 0;
    start_time_ = time;
    blown_up_ = false;
    states_ = setup_->frame.enter(states, time);
    SystemPlan plan = plan_of(setup_->scene, setup_->settings, states_, time);
    const MovingFrame& frame = setup_->frame;
    if (frame.is_accelerated())
      plan.plane_acceleration = [frame](double since) { return frame.acceleration(since); };
    world_ = std::make_unique<System>(plan);
  }

  void step() override {
    const int frames = setup_->settings.frames;
    const double length = setup_->time_step / frames;
    shown_.clear();
    std::vector<BodyState> last = states_;
    double since = 0;  // `last`, in parts of the step
    for (int k = 1; k <= frames; ++k) {
      const double part = k == frames ? 1.0 : k / double(frames);
      advance_to((static_cast<double>(steps_) + part) * setup_->time_step);
      const double now = start_time_ + (static_cast<double>(steps_) + part) * setup_->time_step;
      if (k < frames && in_impact(setup_->scene, states_, length, now)) continue;
      shown_.push_back({part, part - since, last, states_});
      last = states_;
      since = part;
    }
    ++steps_;
  }

  std::span<const Frame> parts() const override {
    frames_.clear();
    for (const Shown& each : shown_) frames_.push_back(frame_of(each));
    return std::span(frames_).first(frames_.size() - 1);
  }

  void read(Frame& frame) const override { frame = frame_of(shown_.back()); }

 private:
  struct Setup {
    EngineScene scene;
    SimbodySettings settings;
    double time_step;
    MovingFrame frame;
  };
  /// What was seen in a part of a step, from the substrate.
  struct Shown {
    double part;    // of the step, that has passed
    double length;  // since the state before, likewise
    std::vector<BodyState> before, after;
  };

  void advance_to(double time) {
    if (blown_up_) return;
    try {
      world_->advance_to(time);
      states_ = world_->states();
    } catch (const std::exception&) {  // no step is small enough: the simulation has blown up
      blown_up_ = true;
      for (BodyState& state : states_)
        state.position.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }

  Frame frame_of(const Shown& seen) const {
    Frame frame;
    frame.bodies = seen.after;
    frame.part = seen.part;
    const double time = (static_cast<double>(steps_) - 1 + seen.part) * setup_->time_step;
    const double length = seen.length * setup_->time_step;
    std::vector<BodyState> before = seen.before;
    setup_->frame.leave(before, time - length);
    setup_->frame.leave(frame.bodies, time);
    if (!blown_up_)
      frame.touches = momentum_touches(setup_->scene, before, frame.bodies, length,
                                       start_time_ + time - length, OverlapPushes::yes);
    return frame;
  }

  std::optional<Setup> setup_;
  std::unique_ptr<System> world_;
  std::vector<Shown> shown_;
  mutable std::vector<Frame> frames_;
  std::vector<BodyState> states_;  // as seen from the substrate
  long steps_ = 0;
  double start_time_ = 0;  // [s]
  bool blown_up_ = false;
};

}  // namespace

std::unique_ptr<Engine> make_simbody_engine() { return std::make_unique<SimbodyEngine>(); }

}  // namespace slipcheck::simbody
