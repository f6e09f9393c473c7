#include "bullet_backend/bullet_world.h"

#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "bullet_backend/combine.h"
#include "bullet_backend/margins.h"
#include "bullet_backend/settings.h"
#include "bullet_backend/surfaces.h"

namespace slipcheck::bullet {
namespace {

btVector3 to_bullet(const Vector3& v) {
  return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
}

Vector3 from_bullet(const btVector3& v) { return Vector3(v.x(), v.y(), v.z()); }

void set_fields(btRigidBody& body, const BodyFields& fields) {
  body.setFriction(btScalar(fields.friction));
  body.setRestitution(btScalar(fields.restitution));
  body.setRollingFriction(btScalar(fields.rolling_friction));
  body.setSpinningFriction(btScalar(fields.spinning_friction));
}

/// With the margins of margins.h.
class World final : public btDiscreteDynamicsWorld {
 public:
  World(double scale, btDispatcher* dispatcher, btBroadphaseInterface* broadphase,
        btConstraintSolver* solver, btCollisionConfiguration* configuration)
      : btDiscreteDynamicsWorld(dispatcher, broadphase, solver, configuration),
        body_margin_(btScalar(kBodyMargin * scale)) {
    gDbvtMargin = btScalar(kTreeMargin * scale);
  }

  void updateAabbs() override {
    // The same number is elsewhere a factor on the size of a shape, and there it stays.
    const btScalar as_a_factor = std::exchange(gContactBreakingThreshold, body_margin_);
    btDiscreteDynamicsWorld::updateAabbs();
    gContactBreakingThreshold = as_a_factor;
  }

 private:
  btScalar body_margin_;  // [m]
};

/// Whether the solver saw the manifold in the last step. It does not where both bodies sleep (the
/// plane always does where it is still), and the impulses found there are those of the last step
/// before.
bool was_solved(const btPersistentManifold& manifold) {
  return manifold.getBody0()->getActivationState() != ISLAND_SLEEPING ||
         manifold.getBody1()->getActivationState() != ISLAND_SLEEPING;
}

/// Summed over a manifold's points: a rolling sphere keeps up to four. A point further away than
/// the processing threshold is passed over by the solver and keeps an old impulse.
double normal_impulse(const btPersistentManifold& manifold) {
  double sum = 0;
  for (int k = 0; k < manifold.getNumContacts(); ++k) {
    const btManifoldPoint& point = manifold.getContactPoint(k);
    if (point.getDistance() > manifold.getContactProcessingThreshold()) continue;
    sum += double(point.getAppliedImpulse());
  }
  return sum;
}

}  // namespace

/// In the order in which they need each other; the bodies leave before the world goes.
struct BulletWorld::Parts {
  Parts(const HardScene& scene, std::span<const BodyState> states, double time, double time_step);
  ~Parts();
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher;
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  std::vector<std::unique_ptr<btSphereShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> balls;
  World world;
  Surfaces surfaces;
};

BulletWorld::Parts::Parts(const HardScene& scene, std::span<const BodyState> states, double time,
                          double time_step)
    : dispatcher(&configuration),
      world(margin_scale(scene), &dispatcher, &broadphase, &solver, &configuration),
      surfaces(world, scene, time, time_step) {
  world.setGravity(btVector3(btScalar(scene.downhill.x()), btScalar(scene.downhill.y()),
                             btScalar(-scene.gravity)));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Sphere& sphere = scene.bodies[i];
    shapes.push_back(std::make_unique<btSphereShape>(btScalar(sphere.radius)));
    const auto inertia = static_cast<btScalar>(sphere.moment_of_inertia());
    btRigidBody::btRigidBodyConstructionInfo ball(
        btScalar(sphere.mass), nullptr, shapes.back().get(), btVector3(inertia, inertia, inertia));
    ball.m_startWorldTransform.setOrigin(to_bullet(states[i].position));
    balls.push_back(std::make_unique<btRigidBody>(ball));
    balls.back()->setLinearVelocity(to_bullet(states[i].velocity));
    balls.back()->setAngularVelocity(to_bullet(states[i].angular_velocity));
    balls.back()->setUserIndex(static_cast<int>(i));
    if (scene.box) {
      balls.back()->setLinearFactor(btVector3(1, 0, 1));
      balls.back()->setAngularFactor(btVector3(0, 1, 0));
    }
    world.addRigidBody(balls.back().get());
  }
}

BulletWorld::Parts::~Parts() {
  for (const auto& ball : balls) world.removeRigidBody(ball.get());
}

BulletWorld::BulletWorld(const HardScene& scene, Profile profile,
                         const PairCoefficients& coefficients, double time_step,
                         std::span<const BodyState> states, double time)
    : scene_(scene),
      profile_(profile),
      time_step_(time_step),
      start_time_(time),
      parts_(std::make_unique<Parts>(scene, states, time, time_step)) {
  switch (profile) {
    case Profile::default_:
      // Only read through the pointer, which Bullet keeps without const.
      for (const auto& ball : parts_->balls) {
        ball->setUserPointer(const_cast<PairCoefficients*>(&coefficients));
      }
      combine_by_pair();
      break;
    case Profile::naive:
      for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        set_fields(*parts_->balls[i], naive_ball(scene, i));
      }
      for (btRigidBody* surface : parts_->surfaces.bodies()) {
        set_fields(*surface, naive_surface(scene, surface->getUserIndex()));
      }
      combine_as_shipped();
      break;
  }
}

BulletWorld::~BulletWorld() = default;

void BulletWorld::step() {
  parts_->surfaces.set_time(start_time_ + static_cast<double>(steps_++) * time_step_);
  parts_->world.stepSimulation(btScalar(time_step_), 0);
}

void BulletWorld::read(Frame& frame) const {
  frame.bodies.clear();
  for (const auto& ball : parts_->balls) {
    frame.bodies.push_back({from_bullet(ball->getCenterOfMassPosition()),
                            from_bullet(ball->getLinearVelocity()),
                            from_bullet(ball->getAngularVelocity())});
  }
  frame.touches.clear();
  const btDispatcher& dispatcher = parts_->dispatcher;
  for (int k = 0; k < dispatcher.getNumManifolds(); ++k) {
    const btPersistentManifold& manifold = *parts_->dispatcher.getManifoldByIndexInternal(k);
    if (!was_solved(manifold)) continue;
    const double impulse = normal_impulse(manifold);
    if (!(impulse > 0)) continue;
    int first = manifold.getBody0()->getUserIndex();
    int second = manifold.getBody1()->getUserIndex();
    if (first < 0 || (second >= 0 && second < first)) std::swap(first, second);
    if (second == kWall || second == kLid) continue;
    frame.touches.push_back({first, second, impulse});
  }
  std::sort(frame.touches.begin(), frame.touches.end(), [](const Touch& a, const Touch& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
}

std::map<std::string, Setting> BulletWorld::settings() const {
  return read_settings(parts_->world, scene_, profile_, time_step_);
}

std::string bullet_version() {
  return fmt::format("{}.{:02}", btGetVersion() / 100, btGetVersion() % 100);
}

std::string bullet_precision() { return sizeof(btScalar) == sizeof(double) ? "double" : "single"; }

bool is_no_time(double time_step) { return btFuzzyZero(btScalar(time_step)); }

}  // namespace slipcheck::bullet
