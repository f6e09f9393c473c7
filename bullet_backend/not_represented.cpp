#include "bullet_backend/not_represented.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bullet_backend/coefficients.h"
#include "bullet_backend/world_units.h"

namespace slipcheck::bullet {
namespace {

bool depends_on_speed(const PairContact& pair) {
  return !std::holds_alternative<double>(pair.restitution);
}

bool bounces(const PairContact& pair) {
  return depends_on_speed(pair) || std::get<double>(pair.restitution) > 0;
}

/// Slip is neither kept (β0 = −1) nor just stopped (β0 = 0): Bullet's friction can only stop it.
bool reverses_slip(const PairContact& pair) {
  const double beta0 = pair.tangential_restitution;
  return pair.friction > 0 && beta0 != 0 && beta0 != -1;
}

/// What the scene's bodies need of the engine, each found on any of them.
struct Needs {
  bool friction = false, static_friction = false, drilling = false, coupled_drilling = false;
  bool rolling = false, rolling_table = false, rolling_only = false;
  bool bounce = false, bounce_law = false, reversed_slip = false, cut_torque = false;
  bool moving_floor = false, far_in_a_step = false;

  void add(const PairContact& pair) {
    friction |= pair.friction > 0;
    bounce |= bounces(pair);
    bounce_law |= depends_on_speed(pair);
    reversed_slip |= reverses_slip(pair);
  }
};

/// Whether a body may go further than its radius in a step, so that it can be on the far side of
/// another before Bullet looks again: by its speed at the start, after a fall to the floor, or on
/// being hit by the floor.
bool can_pass_in_a_step(const Scene& scene, double time_step) {
  const double floor_speed = scene.box->floor.largest_speed();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyState& start = scene.initial[i];
    const double fall = std::max(0.0, 2 * scene.gravity * start.position.z());
    const double speed = std::max(floor_speed, std::sqrt(start.velocity.squaredNorm() + fall));
    if (speed * time_step > scene.bodies[i].radius) return true;
  }
  return false;
}

void add_box(Needs& needs, const Scene& scene, double time_step) {
  const Box& box = *scene.box;
  for (const std::size_t material : scene.material) {
    needs.add(box.on_floor[material]);
    needs.add(box.on_wall[material]);
    if (box.lid) needs.add(box.on_lid[material]);
  }
  needs.moving_floor = !box.floor.is_still();
  needs.far_in_a_step = can_pass_in_a_step(scene, time_step);
}

void add_substrate(Needs& needs, const Scene& scene, const BulletSettings& settings,
                   double time_step) {
  const WorldUnits units = world_units(scene, settings);
  const PairCoefficients coefficients(in_world_units(scene, units), settings,
                                      time_step * units.time);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SubstrateContact& ground = scene.on_substrate(i);
    needs.friction |= ground.kinetic_friction > 0;
    needs.static_friction |= ground.static_friction != ground.kinetic_friction;
    needs.rolling |= !ground.rolling.is_zero();
    needs.rolling_only |= !ground.rolling.is_zero() && !ground.rolling_while_sliding;
    needs.rolling_table |= !ground.rolling.is_constant();
    needs.drilling |= ground.drilling_length > 0;
    needs.coupled_drilling |= ground.coupled_radius > 0;
    needs.bounce |= ground.restitution > 0;
    needs.cut_torque |= coefficients.is_cut(static_cast<int>(i)) &&
                        (!ground.rolling.is_zero() || ground.drilling_length > 0);
  }
}

Needs needs_of(const Scene& scene, const BulletSettings& settings, double time_step) {
  Needs needs;
  if (scene.box) {
    add_box(needs, scene, time_step);
  } else {
    add_substrate(needs, scene, settings, time_step);
  }
  for (const auto& [i, j] : material_pairs(scene)) needs.add(scene.between(i, j));
  return needs;
}

}  // namespace

std::vector<Lack> not_represented(const Scene& scene, const BulletSettings& settings,
                                  double time_step) {
  const Needs needs = needs_of(scene, settings, time_step);
  const bool fields = settings.coefficients == CoefficientMap::fields;
  const bool by_slip = settings.coefficients == CoefficientMap::pair_and_slip;
  // btMLCPSolver gathers contacts and friction, but no rows of rolling and spinning friction, and
  // btLemkeSolver looks at no limit that depends on another row.
  const bool mlcp =
      settings.solver != SolverKind::sequential_impulse && settings.solver != SolverKind::nncg;
  const bool cone = settings.body == BodyKind::multibody && settings.two_friction_directions &&
                    settings.friction_cone && !mlcp;
  const double threshold =
      settings.restitution_velocity_threshold / world_units(scene, settings).speed();
  // Of all pairs; only some settings ask for it.
  const double approach = settings.reach > 0 ? approach_in_a_step(scene, time_step) : 0;
  std::vector<Lack> missing;
  const auto note = [&](bool condition, const char* kind, const char* why = nullptr) {
    if (condition) missing.push_back({why ? fmt::format("{} ({})", kind, why) : kind, kind});
  };
  note(needs.static_friction && !by_slip, "static friction",
       "one coefficient for sticking and sliding");
  note(needs.friction && settings.solver == SolverKind::lemke, "the limit of friction",
       "the Lemke solver takes the coefficient for an impulse");
  note(mlcp && (needs.rolling || needs.drilling), "rolling and drilling friction",
       "the solver passes over their torques");
  note(needs.coupled_drilling, "coupled drilling", "torque and friction are full, each by itself");
  note(needs.rolling_only && !by_slip && !mlcp, "rolling friction only while rolling",
       "it acts while sliding too");
  note(needs.rolling && !cone && !mlcp, "rolling friction alike in all headings",
       "up to 1.41 times on diagonals");
  if (needs.bounce && threshold > 0)
    missing.push_back({fmt::format("restitution below {:.3g} m/s of approach", threshold),
                       "restitution below … m/s of approach"});
  note(needs.reversed_slip, "tangential restitution", "friction only stops the slip");
  note(scene.confined, "confinement to the plane");
  note(needs.moving_floor && settings.surface_velocity == SurfaceVelocity::step_before,
       "the floor's velocity at the contact", "it is the mean over the step before");
  note(!scene.motion.is_still() && settings.surface_velocity == SurfaceVelocity::step_before,
       "the substrate's velocity at the end of a step", "it is the mean over the step before");
  note(needs.far_in_a_step && settings.splits_at_contacts == 0,
       "collisions of bodies that pass each other within a step");
  if (settings.reach > 0 && approach > settings.reach)
    missing.push_back(
        {fmt::format("an approach of {:.2g} radii in a step: the profile is meant for up to {:.2g}",
                     approach, settings.reach),
         "an approach of … radii in a step: the profile is meant for up to …"});
  note(needs.rolling_table && fields, "rolling friction that depends on the speed");
  note(needs.bounce_law && fields, "restitution that depends on the impact speed");
  if (needs.cut_torque && fields)
    missing.push_back({"rolling and drilling torque of normal impulses above 1 N s",
                       "rolling and drilling torque of normal impulses above … N s"});
  note(needs.cut_torque && !fields, "rolling and drilling torque of a load other than the weight");
  return missing;
}

double approach_in_a_step(const Scene& scene, double time_step) {
  double fastest = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double speed = (scene.initial[i].velocity - scene.initial[j].velocity).norm();
      const double radius = std::min(scene.bodies[i].radius, scene.bodies[j].radius);
      fastest = std::max(fastest, speed * time_step / radius);
    }
  return fastest;
}

}  // namespace slipcheck::bullet
