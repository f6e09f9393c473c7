#include "bullet_backend/applied.h"

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "bullet_backend/coefficients.h"
#include "bullet_backend/margins.h"
#include "engine/gathered_settings.h"
#include "engine/scene_needs.h"

namespace slipcheck::bullet {
namespace {

constexpr const char* kBySpeed = "by speed";
constexpr const char* kBySlip = "by slip";

double number(btScalar value) { return double(value); }

/// What is in the world by its user index: the scene's bodies from 0 on, and what they bounce off.
using ByIndex = std::map<int, const btCollisionObject*>;

ByIndex find_objects(const btDiscreteDynamicsWorld& world) {
  ByIndex objects;
  for (int k = 0; k < world.getNumCollisionObjects(); ++k) {
    const btCollisionObject* object = world.getCollisionObjectArray()[k];
    objects[object->getUserIndex()] = object;
  }
  return objects;
}

void gather_substrate(GatheredSettings& out, const ByIndex& objects, const Scene& scene,
                      const BulletSettings& settings) {
  const btCollisionObject* plane = objects.at(kFloor);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const btCollisionObject* ball = objects.at(static_cast<int>(i));
    const std::string whose = fmt::format("{}", i);
    const bool by_speed = settings.coefficients != CoefficientMap::fields &&
                          !scene.on_substrate(i).rolling.is_constant();
    const SubstrateContact& ground = scene.on_substrate(i);
    const bool by_slip = settings.coefficients == CoefficientMap::pair_and_slip;
    const bool friction_by_slip = by_slip && ground.static_friction != ground.kinetic_friction;
    const bool rolling_by_slip =
        by_slip && !ground.rolling.is_zero() && !ground.rolling_while_sliding;
    out.add("friction", whose,
            friction_by_slip ? Setting(kBySlip)
                             : number(gCalculateCombinedFrictionCallback(ball, plane)));
    out.add("substrate_restitution", whose,
            number(gCalculateCombinedRestitutionCallback(ball, plane)));
    out.add("rolling_friction", whose,
            by_speed          ? Setting(kBySpeed)
            : rolling_by_slip ? Setting(kBySlip)
                              : number(gCalculateCombinedRollingFrictionCallback(ball, plane)));
    out.add("spinning_friction", whose,
            number(gCalculateCombinedSpinningFrictionCallback(ball, plane)));
  }
}

/// One body for each material.
void gather_surfaces(GatheredSettings& out, const ByIndex& objects, const Scene& scene,
                     const BulletSettings& settings) {
  std::set<std::size_t> seen;  // materials
  const bool by_slip = settings.coefficients == CoefficientMap::pair_and_slip;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!seen.insert(scene.material[i]).second) continue;
    const btCollisionObject* ball = objects.at(static_cast<int>(i));
    for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
      const btCollisionObject* surface = objects.at(surface_touch(k));
      const SurfaceContact& contact = scene.on_surface(i, k);
      const std::string whose = fmt::format("{}-{}", i, k);
      const auto add = [&](const char* name, bool told, const char* how, auto callback) {
        out.add(name, whose, told ? Setting(how) : Setting(number(callback(ball, surface))));
      };
      const RollingFriction& rolling = contact.lasting.rolling;
      const bool sticks_alike = contact.lasting.static_friction == contact.lasting.kinetic_friction;
      const bool fields = settings.coefficients == CoefficientMap::fields;
      add("surface_friction", by_slip && !sticks_alike, kBySlip,
          gCalculateCombinedFrictionCallback);
      add("surface_restitution",
          !fields && !std::holds_alternative<double>(contact.impact.restitution), kBySpeed,
          gCalculateCombinedRestitutionCallback);
      const bool rolls_by_speed = !fields && !rolling.is_constant();
      const bool rolls_by_slip =
          by_slip && !rolling.is_zero() && !contact.lasting.rolling_while_sliding;
      add("surface_rolling_friction", rolls_by_speed || rolls_by_slip,
          rolls_by_speed ? kBySpeed : kBySlip, gCalculateCombinedRollingFrictionCallback);
      add("surface_spinning_friction", false, kBySlip, gCalculateCombinedSpinningFrictionCallback);
    }
  }
}

/// One body for each material.
void gather_box(GatheredSettings& out, const ByIndex& objects, const Scene& scene,
                const BulletSettings& settings) {
  const Box& box = *scene.box;
  std::set<std::size_t> seen;  // materials
  const auto gather = [&](std::size_t body, int surface, const std::string& name,
                          const PairContact& contact) {
    const btCollisionObject* ball = objects.at(static_cast<int>(body));
    const btCollisionObject* other = objects.at(surface);
    const std::string whose = fmt::format("{}", body);
    const bool by_speed = settings.coefficients != CoefficientMap::fields &&
                          !std::holds_alternative<double>(contact.restitution);
    out.add(
        name + "_restitution", whose,
        by_speed ? Setting(kBySpeed) : number(gCalculateCombinedRestitutionCallback(ball, other)));
    out.add(name + "_friction", whose, number(gCalculateCombinedFrictionCallback(ball, other)));
  };
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::size_t material = scene.material[i];
    if (!seen.insert(material).second) continue;
    gather(i, kFloor, "floor", box.on_floor[material]);
    gather(i, kWall, "wall", box.on_wall[material]);
    if (box.lid) gather(i, kLid, "lid", box.on_lid[material]);
  }
}

void gather_pairs(GatheredSettings& out, const ByIndex& objects, const Scene& scene,
                  const BulletSettings& settings) {
  for (const auto& [i, j] : material_pairs(scene)) {
    const btCollisionObject* first = objects.at(static_cast<int>(i));
    const btCollisionObject* second = objects.at(static_cast<int>(j));
    const std::string whose = fmt::format("{}-{}", i, j);
    const bool by_speed = settings.coefficients != CoefficientMap::fields &&
                          !std::holds_alternative<double>(scene.between(i, j).restitution);
    out.add("restitution", whose,
            by_speed ? Setting(kBySpeed)
                     : number(gCalculateCombinedRestitutionCallback(first, second)));
    out.add("pair_friction", whose, number(gCalculateCombinedFrictionCallback(first, second)));
  }
}

/// Relative to the size of the smaller shape unless the dispatcher is told otherwise.
void gather_thresholds(GatheredSettings& out, const ByIndex& objects, const Scene& scene) {
  const auto threshold = [&](std::size_t body) {
    return number(objects.at(static_cast<int>(body))
                      ->getCollisionShape()
                      ->getContactBreakingThreshold(gContactBreakingThreshold));
  };
  const char* name = "contact_breaking_threshold";
  if (!scene.box) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      out.add(name, fmt::format("{}", i), threshold(i));
    return;
  }
  // The bodies may be hundreds of as many sizes.
  const auto [small, large] = std::ranges::minmax_element(scene.bodies, {}, &Sphere::radius);
  for (const auto& body : {small, large}) {
    const auto i = static_cast<std::size_t>(body - scene.bodies.begin());
    out.add(name, fmt::format("{}", i), threshold(i));
  }
}

/// Those of a profile's settings that Bullet itself can be asked for.
void read_back(Settings& out, btDiscreteDynamicsWorld& world, const btCollisionObject& ball) {
  const btContactSolverInfo& info = world.getSolverInfo();
  out["erp2"] = number(info.m_erp2);
  out["global_cfm"] = number(info.m_globalCfm);
  out["linear_slop"] = number(info.m_linearSlop);
  out["solver_iterations"] = double(info.m_numIterations);
  out["split_impulse"] = info.m_splitImpulse != 0;
  out["split_impulse_threshold"] = number(info.m_splitImpulsePenetrationThreshold);
  out["restitution_velocity_threshold"] = number(info.m_restitutionVelocityThreshold);
  out["warm_starting_factor"] = number(info.m_warmstartingFactor);
  out["two_friction_directions"] = (info.m_solverMode & SOLVER_USE_2_FRICTION_DIRECTIONS) != 0;
  out["contact_processing_threshold"] = number(ball.getContactProcessingThreshold());
  out["sleeping"] = ball.getActivationState() != DISABLE_DEACTIVATION;
  out["sleeping_time"] = number(gDeactivationTime);
  if (const btRigidBody* body = btRigidBody::upcast(&ball)) {
    out["linear_sleeping_threshold"] = number(body->getLinearSleepingThreshold());
    out["angular_sleeping_threshold"] = number(body->getAngularSleepingThreshold());
    out["linear_damping"] = number(body->getLinearDamping());
    out["angular_damping"] = number(body->getAngularDamping());
  }
}

}  // namespace

Settings applied_settings(btDiscreteDynamicsWorld& world, const Scene& scene,
                          const BulletSettings& settings, const WorldUnits& units,
                          double time_step) {
  const ByIndex objects = find_objects(world);
  Settings applied = write_settings(settings);
  read_back(applied, world, *objects.at(0));
  applied["erp"] = number(world.getSolverInfo().m_erp);
  applied["time_step"] = number(btScalar(time_step));
  const btVector3 gravity = world.getGravity();
  applied["gravity"] = number(-gravity.z());
  if (gravity.x() != 0 || gravity.y() != 0) {
    applied["downhill_x"] = number(gravity.x());
    applied["downhill_y"] = number(gravity.y());
  }
  if (units.length != 1 || units.time != 1 || units.mass != 1) {
    applied["length_unit"] = 1 / units.length;
    applied["time_unit"] = 1 / units.time;
    applied["mass_unit"] = 1 / units.mass;
  }
  GatheredSettings by_contact;
  if (scene.box) {
    applied["aabb_margin"] = settings.breaking_threshold * margin_scale(scene);
    applied["broadphase_tree_margin"] = number(gDbvtMargin);
    applied["walls_move"] = !scene.box->floor.is_still() && scene.box->moving_walls;
    gather_box(by_contact, objects, scene, settings);
  } else {
    if (scene.has_substrate) gather_substrate(by_contact, objects, scene, settings);
    gather_surfaces(by_contact, objects, scene, settings);
  }
  gather_thresholds(by_contact, objects, scene);
  gather_pairs(by_contact, objects, scene, settings);
  by_contact.move_to(applied);
  return applied;
}

}  // namespace slipcheck::bullet
