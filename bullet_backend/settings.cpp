#include "bullet_backend/settings.h"

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace slipcheck::bullet {
namespace {

constexpr const char* kBySpeed = "by speed";

/// Values of one name for several bodies or pairs, merged into one entry where all are the same.
class Gathered {
 public:
  void add(const std::string& name, const std::string& whose, const Setting& value) {
    values_[name].emplace_back(whose, value);
  }

  void move_to(std::map<std::string, Setting>& settings) {
    for (const auto& [name, values] : values_) {
      const Setting& first = values.front().second;
      const bool all_alike = std::all_of(values.begin(), values.end(),
                                         [&](const auto& each) { return each.second == first; });
      if (all_alike) {
        settings[name] = first;
        continue;
      }
      for (const auto& [whose, value] : values)
        settings[fmt::format("{}[{}]", name, whose)] = value;
    }
  }

 private:
  std::map<std::string, std::vector<std::pair<std::string, Setting>>> values_;
};

double number(btScalar value) { return double(value); }

/// The scene's bodies in the world, by index.
std::vector<const btCollisionObject*> find_balls(const btDiscreteDynamicsWorld& world) {
  std::vector<const btCollisionObject*> balls(
      static_cast<std::size_t>(world.getNumCollisionObjects()) - 1);
  for (int k = 0; k < world.getNumCollisionObjects(); ++k) {
    const btCollisionObject* object = world.getCollisionObjectArray()[k];
    if (object->getUserIndex() == kSubstrate) continue;
    balls[static_cast<std::size_t>(object->getUserIndex())] = object;
  }
  return balls;
}

const btCollisionObject* find_plane(const btDiscreteDynamicsWorld& world) {
  for (int k = 0; k < world.getNumCollisionObjects(); ++k) {
    const btCollisionObject* object = world.getCollisionObjectArray()[k];
    if (object->getUserIndex() == kSubstrate) return object;
  }
  return nullptr;
}

void gather_substrate(Gathered& out, const btDiscreteDynamicsWorld& world, const HardScene& scene,
                      Profile profile) {
  const btCollisionObject* plane = find_plane(world);
  const auto balls = find_balls(world);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const btCollisionObject* ball = balls[i];
    const std::string whose = fmt::format("{}", i);
    const bool by_speed =
        profile == Profile::default_ && !scene.on_substrate(i).rolling.is_constant();
    out.add("friction", whose, number(gCalculateCombinedFrictionCallback(ball, plane)));
    out.add("substrate_restitution", whose,
            number(gCalculateCombinedRestitutionCallback(ball, plane)));
    out.add("rolling_friction", whose,
            by_speed ? Setting(kBySpeed)
                     : number(gCalculateCombinedRollingFrictionCallback(ball, plane)));
    out.add("spinning_friction", whose,
            number(gCalculateCombinedSpinningFrictionCallback(ball, plane)));
    // Relative to the size of the smaller shape unless the dispatcher is told otherwise.
    out.add(
        "contact_breaking_threshold", whose,
        number(ball->getCollisionShape()->getContactBreakingThreshold(gContactBreakingThreshold)));
  }
}

void gather_pairs(Gathered& out, const btDiscreteDynamicsWorld& world, const HardScene& scene,
                  Profile profile) {
  const auto balls = find_balls(world);
  std::set<std::pair<std::size_t, std::size_t>> seen;  // materials
  for (std::size_t i = 0; i < balls.size(); ++i) {
    for (std::size_t j = i + 1; j < balls.size(); ++j) {
      if (!seen.insert(std::minmax({scene.material[i], scene.material[j]})).second) continue;
      const std::string whose = fmt::format("{}-{}", i, j);
      const bool by_speed = profile == Profile::default_ &&
                            !std::holds_alternative<double>(scene.between(i, j).restitution);
      out.add("restitution", whose,
              by_speed ? Setting(kBySpeed)
                       : number(gCalculateCombinedRestitutionCallback(balls[i], balls[j])));
      out.add("pair_friction", whose,
              number(gCalculateCombinedFrictionCallback(balls[i], balls[j])));
    }
  }
}

}  // namespace

std::map<std::string, Setting> read_settings(btDiscreteDynamicsWorld& world, const HardScene& scene,
                                             Profile profile, double time_step) {
  const btContactSolverInfo& info = world.getSolverInfo();
  const btRigidBody& ball = *btRigidBody::upcast(find_balls(world).front());
  std::map<std::string, Setting> settings = {
      {"time_step", number(btScalar(time_step))},
      {"gravity", number(-world.getGravity().z())},
      {"erp", number(info.m_erp)},
      {"erp2", number(info.m_erp2)},
      {"global_cfm", number(info.m_globalCfm)},
      {"linear_slop", number(info.m_linearSlop)},
      {"solver_iterations", double(info.m_numIterations)},
      {"split_impulse", info.m_splitImpulse != 0},
      {"split_impulse_threshold", number(info.m_splitImpulsePenetrationThreshold)},
      {"restitution_velocity_threshold", number(info.m_restitutionVelocityThreshold)},
      {"warm_starting", (info.m_solverMode & SOLVER_USE_WARMSTARTING) != 0},
      {"warm_starting_factor", number(info.m_warmstartingFactor)},
      {"two_friction_directions", (info.m_solverMode & SOLVER_USE_2_FRICTION_DIRECTIONS) != 0},
      {"contact_processing_threshold", number(ball.getContactProcessingThreshold())},
      {"sleeping", ball.getActivationState() != DISABLE_DEACTIVATION},
      {"sleeping_time", number(gDeactivationTime)},
      {"linear_sleeping_threshold", number(ball.getLinearSleepingThreshold())},
      {"angular_sleeping_threshold", number(ball.getAngularSleepingThreshold())},
      {"linear_damping", number(ball.getLinearDamping())},
      {"angular_damping", number(ball.getAngularDamping())},
  };
  if (const btVector3 gravity = world.getGravity(); gravity.x() != 0 || gravity.y() != 0) {
    settings["downhill_x"] = number(gravity.x());
    settings["downhill_y"] = number(gravity.y());
  }
  Gathered by_contact;
  gather_substrate(by_contact, world, scene, profile);
  gather_pairs(by_contact, world, scene, profile);
  by_contact.move_to(settings);
  return settings;
}

}  // namespace slipcheck::bullet
