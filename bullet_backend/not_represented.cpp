#include "bullet_backend/not_represented.h"

#include <fmt/format.h>

#include <algorithm>

#include "bullet_backend/coefficients.h"
#include "bullet_backend/world_units.h"
#include "engine/scene_needs.h"

namespace slipcheck::bullet {
namespace {

/// Whether a rigid body's load is so large that Bullet would cut the two torques (coefficients.h).
bool cuts_torque(const Scene& scene, const BulletSettings& settings, double time_step) {
  if (scene.box) return false;
  const WorldUnits units = world_units(scene, settings);
  const PairCoefficients coefficients(in_world_units(scene, units), settings,
                                      time_step * units.time);
  const auto has_torque = [](const SubstrateContact& ground) {
    return !ground.rolling.is_zero() || ground.drilling_length > 0;
  };
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!coefficients.is_cut(static_cast<int>(i))) continue;
    if (scene.has_substrate && has_torque(scene.on_substrate(i))) return true;
    for (std::size_t k = 0; k < scene.surfaces.size(); ++k)
      if (has_torque(scene.on_surface(i, k).lasting)) return true;
  }
  return false;
}

bool has_rod(const Scene& scene) {
  return std::ranges::any_of(scene.surfaces, [](const Surface& surface) {
    return std::holds_alternative<RodShape>(surface.shape);
  });
}

}  // namespace

std::vector<Lack> not_represented(const Scene& scene, const BulletSettings& settings,
                                  double time_step) {
  const SceneNeeds needs = needs_of(scene, time_step);
  const bool cut_torque = cuts_torque(scene, settings, time_step);
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
  LackList missing;
  missing.note(needs.static_friction && !by_slip, lack::kStaticFriction,
               "one coefficient for sticking and sliding");
  missing.note(needs.friction && settings.solver == SolverKind::lemke, "the limit of friction",
               "the Lemke solver takes the coefficient for an impulse");
  missing.note(mlcp && (needs.rolling || needs.drilling), lack::kRollingAndDrilling,
               "the solver passes over their torques");
  missing.note(needs.coupled_drilling, lack::kCoupledDrilling,
               "torque and friction are full, each by itself");
  missing.note(needs.rolling_only && !by_slip && !mlcp, lack::kRollingOnly,
               "it acts while sliding too");
  missing.note(needs.rolling && !cone && !mlcp, lack::kRollingHeadings,
               "up to 1.41 times on diagonals");
  missing.note_threshold(needs.bounce, threshold);
  missing.note(needs.reversed_slip, lack::kTangentialRestitution, "friction only stops the slip");
  missing.note(scene.confined, lack::kConfinement);
  missing.note(needs.moving_floor && settings.surface_velocity == SurfaceVelocity::step_before,
               lack::kFloorVelocity, "it is the mean over the step before");
  missing.note(needs.moving_substrate && settings.surface_velocity == SurfaceVelocity::step_before,
               lack::kSubstrateVelocity, "it is the mean over the step before");
  missing.note(needs.swinging_surface && settings.surface_velocity == SurfaceVelocity::step_before,
               lack::kSurfaceVelocity, "it is the mean over the step before");
  missing.note(has_rod(scene), "normals of rods",
               "GJK finds them to 0.03 rad in double, 0.5 rad in single precision in metres");
  missing.note(needs.through_in_a_step && settings.splits_at_contacts == 0, lack::kThrough);
  missing.note(needs.far_in_a_step && settings.splits_at_contacts == 0, lack::kPassing);
  missing.note(settings.ccd && settings.ccd_motion_threshold > 0 && !scene.periodic.isZero(0),
               "sweeps across the edges of the plane", "images are looked for where bodies are");
  if (settings.reach > 0 && approach > settings.reach)
    missing.add(
        {fmt::format("an approach of {:.2g} radii in a step: the profile is meant for up to {:.2g}",
                     approach, settings.reach),
         "an approach of … radii in a step: the profile is meant for up to …"});
  missing.note(needs.rolling_table && fields, lack::kRollingTable);
  missing.note(needs.bounce_law && fields, lack::kRestitutionLaw);
  missing.note(needs.friction_law && fields, lack::kFrictionLaw);
  if (cut_torque && fields)
    missing.add({"rolling and drilling torque of normal impulses above 1 N s",
                 "rolling and drilling torque of normal impulses above … N s"});
  missing.note(cut_torque && !fields,
               "rolling and drilling torque of a load other than the weight");
  return missing.take();
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
