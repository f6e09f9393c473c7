#include "peer_backends/siconos/siconos_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "engine/scene_needs.h"
#include "peer_backends/shared/applied.h"
#include "peer_backends/shared/contact_values.h"
#include "peer_backends/shared/moving_frame.h"
#include "peer_backends/siconos/siconos_settings.h"

namespace slipcheck::siconos {
namespace {

static_assert(Impulse::kPlane == kSubstrate);

/// There is an interaction for each two, from the start on.
constexpr std::size_t kMostBodies = 60;

void refuse_unfit(const Scene& scene) {
  if (scene.box)
    throw Refused(
        "siconos: the walls of a box move with its floor, and these relations are at rest");
  if (scene.periodic != Vector2::Zero())
    throw Refused(
        "siconos: the substrate repeats itself, and a Siconos system has no periodic boundaries");
  if (scene.bodies.size() > kMostBodies)
    throw Refused(fmt::format(
        "siconos: {} bodies, and with an interaction for each two at most {} are feasible",
        scene.bodies.size(), kMostBodies));
}

bool is_steady(const SurfaceMotion& motion) {
  return motion.is_still() ||
         (motion.rate().isZero(0) && motion.course().kind() == SubstrateMotion::Kind::constant);
}

void refuse_surfaces(const Scene& scene) {
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k)
    if (!is_steady(scene.surfaces[k].motion))
      throw Refused(fmt::format(
          "siconos: surface {} turns or swings, and what carries one has a constant velocity", k));
  if (!scene.surfaces.empty() && !scene.motion.is_still())
    throw Refused(
        "siconos: the substrate moves beside surfaces, and the world is seen from one of them");
}

/// The approach of two bodies by the velocities at the start, or 1 mm/s.
double approach(const Scene& scene, std::size_t i, std::size_t j) {
  return std::max(1e-3, (scene.initial[i].velocity - scene.initial[j].velocity).norm());
}

ImpactLaw pair_law(const Scene& scene, std::size_t i, std::size_t j) {
  const PairContact& pair = scene.between(i, j);
  const double beta0 = pair.tangential_restitution;
  // β0 = −1, u_t' = u_t: no tangential impulse whatever μ is.
  return {restitution_at(pair.restitution, approach(scene, i, j)), std::max(beta0, 0.0),
          beta0 == -1 ? 0 : std::get<double>(pair.friction), 0};
}

ImpactLaw substrate_law(const Scene& scene, std::size_t body, const SiconosSettings& settings) {
  const Sphere& sphere = scene.bodies[body];
  const SubstrateContact& ground = scene.on_substrate(body);
  const double mu_r = ground.rolling.points().front().coefficient;
  const double length = settings.coefficients == Coefficients::fields
                            ? mu_r
                            : (1 + sphere.shape_factor) * mu_r * sphere.radius;
  return {ground.restitution, 0, ground.kinetic_friction, length};
}

ImpactLaw surface_law(const Scene& scene, std::size_t body, std::size_t k,
                      const SiconosSettings& settings) {
  const SurfaceContact& contact = scene.on_surface(body, k);
  const int touch = surface_touch(k);
  const peer::ContactValues exact = peer::exact_values(scene, static_cast<int>(body), touch, {});
  const peer::ContactValues typed = peer::typed_values(scene, static_cast<int>(body), touch);
  const bool fields = settings.coefficients == Coefficients::fields;
  return {typed.restitution, std::max(contact.impact.tangential_restitution, 0.0), exact.friction,
          fields ? typed.rolling : exact.rolling};
}

bool rolls(const Scene& scene) {
  return std::ranges::any_of(
             scene.substrate,
             [](const SubstrateContact& ground) { return !ground.rolling.is_zero(); }) ||
         std::ranges::any_of(scene.on_surfaces, [](const SurfaceContact& contact) {
           return !contact.lasting.rolling.is_zero();
         });
}

FixedSurface fixed_surface(const slipcheck::Surface& surface, double start) {
  return {[surface, start](double time, const Vector3& from) {
            const NearestPoint found = surface.nearest(start + time, from);
            return NearestPlace{found.point, found.normal, found.distance};
          },
          surface.motion.velocity(start, Vector3::Zero())};
}

SystemPlan plan_of(const Scene& scene, const SiconosSettings& settings,
                   const std::vector<BodyState>& states, double start, double time_step) {
  SystemPlan plan;
  plan.has_substrate = scene.has_substrate;
  for (const slipcheck::Surface& surface : scene.surfaces)
    plan.surfaces.push_back(fixed_surface(surface, start));
  plan.bodies = scene.bodies;
  plan.states = states;
  plan.gravity = Vector3(scene.downhill.x(), scene.downhill.y(), -scene.gravity);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    plan.on_substrate.push_back(substrate_law(scene, i, settings));
    for (std::size_t k = 0; k < scene.surfaces.size(); ++k)
      plan.on_surfaces.push_back(surface_law(scene, i, k, settings));
    for (std::size_t j = i + 1; j < scene.bodies.size(); ++j)
      plan.pairs.push_back(pair_law(scene, i, j));
  }
  plan.time_step = time_step / settings.substeps;
  plan.rolls = rolls(scene);
  plan.theta = settings.theta;
  plan.solver = settings.solver;
  plan.tolerance = settings.tolerance;
  plan.iterations = settings.iterations;
  plan.newton_tolerance = settings.newton_tolerance;
  plan.activation_threshold = settings.activation_threshold;
  return plan;
}

std::vector<Lack> not_represented(const Scene& scene, double time_step) {
  const SceneNeeds needs = needs_of(scene, time_step);
  const auto is_less = [](const PairContact& pair) {
    return has_friction(pair.friction) && pair.tangential_restitution < 0 &&
           pair.tangential_restitution > -1;
  };
  const bool sticks_less = std::ranges::any_of(scene.pairs, is_less) ||
                           std::ranges::any_of(scene.on_surfaces, is_less, &SurfaceContact::impact);
  LackList missing;
  missing.note(needs.static_friction, lack::kStaticFriction,
               "one coefficient for sticking and sliding");
  missing.note(needs.drilling || needs.coupled_drilling, lack::kDrilling);
  missing.note(needs.rolling_only, lack::kRollingOnly, "it acts while sliding too");
  missing.note(needs.rolling_table, lack::kRollingTable);
  missing.note(needs.bounce_law, lack::kRestitutionLaw);
  missing.note(sticks_less, lack::kTangentialRestitution, "none below 0");
  missing.note(scene.confined, lack::kConfinement);
  missing.note(needs.through_in_a_step, lack::kThrough);
  return missing.take();
}

Settings applied(const Scene& scene, const SiconosSettings& settings) {
  Settings all = write_rows(setting_rows(), settings);
  const auto tell = [&](const std::string& of, const ImpactLaw& law) {
    all[of + "_restitution"] = law.restitution;
    all[of + "_friction"] = law.friction;
    all[of + "_tangential_restitution"] = law.tangential_restitution;
    all[of + "_rolling_length"] = law.rolling_length;
  };
  if (scene.has_substrate) tell("substrate", substrate_law(scene, 0, settings));
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k)
    for (const std::size_t body : peer::one_of_each_material(scene))
      tell(fmt::format("surface[{}-{}]", body, k), surface_law(scene, body, k, settings));
  if (scene.bodies.size() > 1) tell("pair", pair_law(scene, 0, 1));
  return all;
}

class SiconosEngine final : public Engine {
 public:
  EngineInfo info() const override {
    return {"siconos",
            SLIPCHECK_SICONOS_VERSION,
            "double",
            infos_of(setting_rows()),
            {scene_part::kSurfaces}};
  }

  Applied configure(const EngineScene& scene, const Settings& chosen, double time_step) override {
    refuse_unfit(scene);
    refuse_surfaces(scene);
    const SiconosSettings settings = read_rows(setting_rows(), chosen);
    setup_.emplace(Setup{scene, settings, time_step, MovingFrame(scene, "siconos")});
    start(scene.initial, 0);
    return {applied(scene, settings), not_represented(scene, time_step), {}};
  }

  void start(std::span<const BodyState> states, double time) override {
    steps_ = 0;
    states_ = setup_->frame.enter(states, time);
    system_.reset();
    SystemPlan plan = plan_of(setup_->scene, setup_->settings, states_, time, setup_->time_step);
    const MovingFrame& frame = setup_->frame;
    if (frame.is_accelerated())
      plan.plane_acceleration = [frame](double since) { return frame.acceleration(since); };
    system_ = std::make_unique<System>(plan);
  }

  void step() override {
    ++steps_;
    touches_.clear();
    for (int k = 0; k < setup_->settings.substeps; ++k) {
      system_->step();
      for (const Impulse& each : system_->impulses())
        touches_[{each.first, each.second}] += each.normal;
    }
    states_ = system_->states();
  }

  void read(Frame& frame) const override {
    frame.bodies = states_;
    frame.touches.clear();
    for (const auto& [pair, impulse] : touches_)
      frame.touches.push_back({pair.first, pair.second, impulse});
    setup_->frame.leave(frame.bodies, static_cast<double>(steps_) * setup_->time_step);
  }

 private:
  struct Setup {
    Scene scene;
    SiconosSettings settings;
    double time_step;
    MovingFrame frame;
  };
  std::optional<Setup> setup_;
  std::unique_ptr<System> system_;
  std::vector<BodyState> states_;  // as seen from the substrate
  std::map<std::pair<int, int>, double> touches_;
  long steps_ = 0;
};

}  // namespace

std::unique_ptr<Engine> make_siconos_engine() { return std::make_unique<SiconosEngine>(); }

}  // namespace slipcheck::siconos
