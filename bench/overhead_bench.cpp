#include <benchmark/benchmark.h>
#include <btBulletDynamicsCommon.h>
#include <time.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "bullet_backend/bullet_engine.h"
#include "bullet_backend/combine.h"
#include "scenes.h"

namespace slipcheck {
namespace {

constexpr double kStep = 1.0 / 240;
constexpr std::size_t kSteps = 200;

/// Steel balls that roll one after the other, so that all contacts last.
Scene rolling(std::size_t balls) {
  Scene scene = test::steel_scene(balls);
  for (std::size_t i = 0; i < balls; ++i)
    scene.initial[i] = test::rolling_at(0.01 * static_cast<double>(i), 0, 0.3, 0);
  return scene;
}

/// The same world as a user of Bullet writes it: its own settings, and coefficients in its fields.
class BareWorld {
 public:
  explicit BareWorld(const Scene& scene) : world_(&dispatcher_, &broadphase_, &solver_, &config_) {
    bullet::combine_as_shipped();  // global in Bullet
    world_.setGravity(btVector3(0, 0, btScalar(-scene.gravity)));
    add(0, &plane_shape_, btVector3(0, 0, 0));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Sphere& sphere = scene.bodies[i];
      const BodyState& state = scene.initial[i];
      shapes_.push_back(std::make_unique<btSphereShape>(btScalar(sphere.radius)));
      const auto inertia = btScalar(sphere.moment_of_inertia());
      btRigidBody& ball =
          add(btScalar(sphere.mass), shapes_.back().get(), btVector3(inertia, inertia, inertia));
      ball.setCenterOfMassTransform(
          btTransform(btQuaternion::getIdentity(),
                      btVector3(btScalar(state.position.x()), btScalar(state.position.y()),
                                btScalar(state.position.z()))));
      ball.setLinearVelocity(btVector3(btScalar(state.velocity.x()), btScalar(state.velocity.y()),
                                       btScalar(state.velocity.z())));
      ball.setAngularVelocity(btVector3(btScalar(state.angular_velocity.x()),
                                        btScalar(state.angular_velocity.y()),
                                        btScalar(state.angular_velocity.z())));
      ball.setFriction(btScalar(scene.on_substrate(i).kinetic_friction));
    }
  }
  ~BareWorld() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  BareWorld(const BareWorld&) = delete;
  BareWorld& operator=(const BareWorld&) = delete;

  void step() { world_.stepSimulation(btScalar(kStep), 0); }

 private:
  btRigidBody& add(btScalar mass, btCollisionShape* shape, const btVector3& inertia) {
    bodies_.push_back(std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, shape, inertia)));
    world_.addRigidBody(bodies_.back().get());
    return *bodies_.back();
  }

  btDefaultCollisionConfiguration config_;
  btCollisionDispatcher dispatcher_{&config_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  btStaticPlaneShape plane_shape_{btVector3(0, 0, 1), 0};
  std::vector<std::unique_ptr<btSphereShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

double now() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Steps>
double seconds(const Steps& steps) {
  const double before = now();
  steps();
  return now() - before;
}

/// What the adapter adds to each step of Bullet's, as timings (`slipcheck precision`) see it: the
/// least of many runs of both, in turn, with nothing left out. "overhead" is its share of the bare
/// step.
void BM_OverheadOfTheHarness(benchmark::State& state) {
  const Scene scene = rolling(static_cast<std::size_t>(state.range(0)));
  const std::unique_ptr<Engine> engine = bullet::make_bullet_engine();
  engine->configure(scene, {{"leaves_out", false}}, kStep);
  double bare = std::numeric_limits<double>::infinity(), ours = bare;
  for (auto _ : state) {
    {
      BareWorld world(scene);
      bare = std::min(bare, seconds([&] {
                        for (std::size_t k = 0; k < kSteps; ++k) world.step();
                      }));
    }
    engine->start(scene.initial, 0);
    ours = std::min(ours, seconds([&] {
                      for (std::size_t k = 0; k < kSteps; ++k) engine->step();
                    }));
  }
  state.counters["bare_step_us"] = 1e6 * bare / kSteps;
  state.counters["our_step_us"] = 1e6 * ours / kSteps;
  state.counters["overhead"] = ours / bare - 1;
}
BENCHMARK(BM_OverheadOfTheHarness)->Arg(1)->Arg(2)->Unit(benchmark::kMicrosecond)->Iterations(3000);

}  // namespace
}  // namespace slipcheck
