// DART by its own API alone, as its tutorials have it, beside the worker.

#include <cmath>
#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/simulation/World.hpp>

#include "peer_run.h"

namespace slipcheck::test {
namespace {

namespace dd = ::dart::dynamics;

/// Balls collide by their second shapes, and with the plane by their first ones.
class TwoLayers final : public ::dart::collision::CollisionFilter {
 public:
  bool ignoresCollision(const ::dart::collision::CollisionObject* a,
                        const ::dart::collision::CollisionObject* b) const override {
    const std::string &p = a->getShapeFrame()->getName(), &q = b->getShapeFrame()->getName();
    const bool on_plane = (p == "plane" && q == "below") || (p == "below" && q == "plane");
    const auto owner = [](const auto* object) {
      return object->getShapeFrame()->asShapeNode()->getBodyNodePtr();
    };
    return !on_plane && !(p == "beside" && q == "beside" && owner(a) != owner(b));
  }
};

void add_bare_shape(dd::BodyNode* node, const dd::ShapePtr& shape, const char* name, double mu,
                    double e) {
  auto* made = node->createShapeNodeWith<dd::CollisionAspect, dd::DynamicsAspect>(shape, name);
  made->getDynamicsAspect()->setFrictionCoeff(mu);
  made->getDynamicsAspect()->setRestitutionCoeff(e);
}

/// Adds a solid sphere, with the shapes that `give_shapes` gives it, and says how it begins.
template <class GiveShapes>
dd::BodyNode* add_bare_ball(::dart::simulation::World& world, const std::string& name,
                            const Sphere& sphere, const BodyState& initial,
                            const GiveShapes& give_shapes) {
  const auto ball = dd::Skeleton::create(name);
  auto [joint, node] = ball->createJointAndBodyNodePair<dd::FreeJoint>();
  dd::Inertia inertia;
  inertia.setMass(sphere.mass);
  inertia.setMoment(sphere.moment_of_inertia() * Eigen::Matrix3d::Identity());
  node->setInertia(inertia);
  give_shapes(node);
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.translation() = initial.position;
  joint->setTransform(place);
  joint->setLinearVelocity(initial.velocity);
  joint->setAngularVelocity(initial.angular_velocity);
  world.addSkeleton(ball);
  return node;
}

States run_bare_dart(const Scene& scene, double mu_ground, double e_ground, double mu_balls,
                     double e_balls, double rate, int steps) {
  const auto world = ::dart::simulation::World::create();
  world->setTimeStep(1 / rate);
  world->setGravity(Eigen::Vector3d(0, 0, -scene.gravity));
  world->getConstraintSolver()->getCollisionOption().collisionFilter =
      std::make_shared<TwoLayers>();
  const auto ground = dd::Skeleton::create("ground");
  auto [ground_joint, ground_node] = ground->createJointAndBodyNodePair<dd::FreeJoint>();
  add_bare_shape(ground_node, std::make_shared<dd::BoxShape>(Eigen::Vector3d(1e4, 1e4, 1)), "plane",
                 1e18, 1);
  Eigen::Isometry3d below = Eigen::Isometry3d::Identity();
  below.translation().z() = -0.5;
  ground_joint->setTransform(below);
  ground->setMobile(false);
  world->addSkeleton(ground);
  std::vector<dd::BodyNode*> balls;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Sphere& sphere = scene.bodies[i];
    const auto shape = std::make_shared<dd::SphereShape>(sphere.radius);
    const auto give_shapes = [&](dd::BodyNode* node) {
      add_bare_shape(node, shape, "below", mu_ground, e_ground);
      if (scene.bodies.size() > 1)
        add_bare_shape(node, shape, "beside", mu_balls, std::sqrt(e_balls));
    };
    balls.push_back(
        add_bare_ball(*world, "ball" + std::to_string(i), sphere, scene.initial[i], give_shapes));
  }
  States states;
  for (int n = 0; n < steps; ++n) {
    world->step();
    auto& now = states.emplace_back();
    for (const dd::BodyNode* ball : balls)
      now.push_back({ball->getTransform().translation(), ball->getLinearVelocity(),
                     ball->getAngularVelocity()});
  }
  return states;
}

/// A ball with a shape for each surface, as their names say, and surfaces of as good as no friction
/// limit, in the worker's order; the belt is put back before each step, with its velocity.
States run_bare_surfaces(const Scene& scene, double mu, double e, double belt_velocity, double rate,
                         int steps) {
  class ByName final : public ::dart::collision::CollisionFilter {
   public:
    bool ignoresCollision(const ::dart::collision::CollisionObject* a,
                          const ::dart::collision::CollisionObject* b) const override {
      const std::string &p = a->getShapeFrame()->getName(), &q = b->getShapeFrame()->getName();
      return p != "on " + q && q != "on " + p;
    }
  };
  const auto world = ::dart::simulation::World::create();
  world->setTimeStep(1 / rate);
  world->setGravity(Eigen::Vector3d(0, 0, -scene.gravity));
  world->getConstraintSolver()->getCollisionOption().collisionFilter = std::make_shared<ByName>();
  const auto surface = [&](const char* name, const dd::ShapePtr& shape, const Vector3& centre) {
    const auto skeleton = dd::Skeleton::create(name);
    auto [joint, node] = skeleton->createJointAndBodyNodePair<dd::FreeJoint>();
    add_bare_shape(node, shape, name, 1e18, 1);
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.translation() = centre;
    joint->setTransform(place);
    skeleton->setMobile(false);
    world->addSkeleton(skeleton);
    return joint;
  };
  const auto box = [](double length, double width, double height) {
    return std::make_shared<dd::BoxShape>(Eigen::Vector3d(length, width, height));
  };
  surface("plate", box(0.2, 0.2, 2 * 1e-10), {0, 0, 0.1});
  surface("peg", std::make_shared<dd::SphereShape>(0.05), {0.25, 0, -0.03});
  dd::FreeJoint* belt = surface("belt", box(1e4, 1e4, 1), {0, 0, -0.6});
  const Eigen::Isometry3d home = belt->getRelativeTransform();
  const Sphere& sphere = scene.bodies[0];
  const auto shape = std::make_shared<dd::SphereShape>(sphere.radius);
  const dd::BodyNode* node =
      add_bare_ball(*world, "ball", sphere, scene.initial[0], [&](dd::BodyNode* made) {
        for (const char* name : {"on belt", "on peg", "on plate"})
          add_bare_shape(made, shape, name, mu, e);
      });
  States states;
  for (int n = 0; n < steps; ++n) {
    belt->setTransform(home);
    belt->setLinearVelocity(Eigen::Vector3d(belt_velocity, 0, 0));
    belt->setAngularVelocity(Eigen::Vector3d::Zero());
    world->step();
    states.push_back({{node->getTransform().translation(), node->getLinearVelocity(),
                       node->getAngularVelocity()}});
  }
  return states;
}

TEST(DartBare, APlateAPegAndABelt) {
  const Scene scene = plate_peg_and_belt(0.3, 0.5, -0.5);
  expect_as_bare("dart", scene, run_bare_surfaces(scene, 0.3, 0.5, -0.5, 240, 240));
}

TEST(DartBare, SlideToRoll) {
  const Scene scene = bundled_scene("slide-to-roll");
  expect_as_bare("dart", scene, run_bare_dart(scene, 0.2, 0, 0, 0, 240, 240));
}

TEST(DartBare, BouncingBall) {
  const Scene scene = bundled_scene("bouncing-ball");
  expect_as_bare("dart", scene, run_bare_dart(scene, 0.3, 0.8, 0, 0, 240, 240));
}

TEST(DartBare, TwoRollingBallsMeet) {
  const Scene scene = bundled_scene("symmetric-30cms");
  expect_as_bare("dart", scene, run_bare_dart(scene, 0.1, 0, 0, 0.9, 240, 120));
}

}  // namespace
}  // namespace slipcheck::test
