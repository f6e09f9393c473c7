#include "peer_backends/dart/dart_world.h"

#include <dart/collision/CollisionObject.hpp>
#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/config.hpp>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/constraint/DantzigBoxedLcpSolver.hpp>
#include <dart/constraint/PgsBoxedLcpSolver.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/simulation/World.hpp>

#include "engine/scene_needs.h"
#include "peer_backends/dart/dart_shapes.h"
#include "peer_backends/shared/applied.h"
#include "peer_backends/shared/surfaces.h"
#include "peer_backends/shared/touch_list.h"
#include "physics/solid.h"

namespace slipcheck::dart_engine {
namespace {

namespace dd = ::dart::dynamics;
using ::dart::constraint::ContactConstraint;

/// Of the box that stands for the plane [m], as in DART's own examples: neither detector knows a
/// PlaneShape (FCL's makes an upright plate of it). Wide, and thin, so that its top is exact.
constexpr double kPlaneWidth = 1e4, kPlaneThickness = 1;

dd::Inertia inertia_of(double mass, const Eigen::Vector3d& moments) {
  return dd::Inertia(mass, Eigen::Vector3d::Zero(), moments.asDiagonal());
}

void set_globals(const DartSettings& chosen) {
  ContactConstraint::setErrorReductionParameter(chosen.error_reduction_parameter);
  ContactConstraint::setMaxErrorReductionVelocity(chosen.max_error_reduction_velocity);
  ContactConstraint::setErrorAllowance(chosen.error_allowance);
  ContactConstraint::setConstraintForceMixing(chosen.constraint_force_mixing);
}

}  // namespace

struct DartWorld::Parts {
  Parts(const DartSetup& made, std::span<const BodyState> states, double time)
      : setup(made),
        unit(made.settings.length_unit),
        time_step(made.time_step / made.settings.substeps),
        start_time(time),
        shapes(setup.scene, setup.settings),
        surface(peer::surfaces_of(setup.scene).front()),
        world(::dart::simulation::World::create("slipcheck")) {
    set_globals(setup.settings);
    const Scene& scene = setup.scene;
    world->setTimeStep(time_step);
    world->setGravity(Eigen::Vector3d(scene.downhill.x(), scene.downhill.y(), -scene.gravity) /
                      unit);
    set_solver();
    add_plane();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      add_ball(scene.bodies[i], states[i], static_cast<int>(i));
  }

  void set_solver() {
    using namespace ::dart::constraint;
    if (setup.settings.lcp_solver == LcpSolver::pgs) {
      auto solver = std::make_unique<BoxedLcpConstraintSolver>();
      solver->setBoxedLcpSolver(std::make_shared<PgsBoxedLcpSolver>());
      solver->setSecondaryBoxedLcpSolver(nullptr);
      world->setConstraintSolver(std::move(solver));
    }
    if (setup.settings.collision_detector == Detector::dart)
      world->getConstraintSolver()->setCollisionDetector(
          ::dart::collision::DARTCollisionDetector::create());
    auto& option = world->getConstraintSolver()->getCollisionOption();
    option.collisionFilter = shapes.filter();
  }

  void add_plane() {
    plane = dd::Skeleton::create("plane");
    auto pair = plane->createJointAndBodyNodePair<dd::FreeJoint>();
    plane_joint = pair.first;
    const double width = kPlaneWidth / unit, thickness = kPlaneThickness / unit;
    shapes.dress_surface(*pair.second, surface.index,
                         std::make_shared<dd::BoxShape>(Eigen::Vector3d(width, width, thickness)));
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.translation().z() = -thickness / 2;
    plane_joint->setTransform(place);
    plane->setMobile(false);  // its velocity is felt all the same
    world->addSkeleton(plane);
  }

  void add_ball(const Sphere& sphere, const BodyState& state, int body) {
    const auto& extents = setup.scene.extents;
    const Extent* extent = extents.empty() ? nullptr : &*extents[static_cast<std::size_t>(body)];
    dd::ShapePtr shape;
    if (extent)
      shape = std::make_shared<dd::BoxShape>(extent->size / unit);
    else
      shape = std::make_shared<dd::SphereShape>(sphere.radius / unit);
    const Eigen::Vector3d moments =
        (extent ? moments_of_inertia(sphere, *extent)
                : Vector3(Vector3::Constant(sphere.moment_of_inertia()))) /
        (unit * unit);
    const dd::SkeletonPtr ball = dd::Skeleton::create(std::to_string(body));
    const auto [joint, node] = ball->createJointAndBodyNodePair<dd::FreeJoint>();
    node->setInertia(inertia_of(sphere.mass, moments));
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    if (extent) place.linear() = turn_of(*extent).toRotationMatrix();
    place.translation() = state.position / unit;
    joint->setTransform(place);
    joint->setLinearVelocity(state.velocity / unit);
    joint->setAngularVelocity(state.angular_velocity);
    shapes.dress_ball(*node, body, shape);
    world->addSkeleton(ball);
    balls.push_back(node);
  }

  void step() {
    if (surface.moves) {
      const double end = start_time + static_cast<double>(steps + 1) * time_step;
      plane_joint->setLinearVelocity(surface.velocity(setup.scene, end) / unit);
    }
    world->step();
    ++steps;
    for (const auto& contact : world->getLastCollisionResult().getContacts())
      touches.add(index_of(contact.collisionObject1->getShapeFrame()),
                  index_of(contact.collisionObject2->getShapeFrame()),
                  contact.force.dot(contact.normal) * time_step * unit);
  }

  const DartSetup& setup;
  double unit, time_step, start_time;  // [m], [s] of DART's own, [s]
  std::size_t steps = 0;
  PairShapes shapes;
  peer::Surface surface;
  ::dart::simulation::WorldPtr world;
  dd::SkeletonPtr plane;
  dd::FreeJoint* plane_joint = nullptr;
  std::vector<dd::BodyNode*> balls;
  peer::TouchList touches;
};

EngineInfo DartWorld::info() {
  return {"dart", DART_VERSION, "double", setting_table(), {scene_part::kBlock}};
}

std::string DartWorld::refusal(const DartSetup& setup) {
  if (setup.scene.box) return "only scenes on a substrate, not in a box, are mapped";
  return "";
}

std::vector<Lack> DartWorld::lacks(const DartSetup& setup) {
  const SceneNeeds needs = needs_of(setup.scene, setup.time_step);
  const DartSettings& chosen = setup.settings;
  LackList missing;
  missing.note(needs.static_friction, lack::kStaticFriction,
               "one coefficient for sticking and sliding");
  missing.note(needs.friction, lack::kFrictionHeadings, "up to 1.41 times on diagonals");
  missing.note(needs.rolling, lack::kRolling);
  missing.note(needs.drilling, lack::kDrilling);
  missing.note_threshold(needs.bounce, 0.1 * chosen.length_unit);
  missing.note(needs.reversed_slip, lack::kTangentialRestitution, "friction only stops the slip");
  missing.note(setup.scene.confined, lack::kConfinement);
  missing.note(needs.bounce_law, lack::kRestitutionLaw);
  return missing.take();
}

DartWorld::DartWorld(const DartSetup& setup, std::span<const BodyState> states, double time)
    : parts_(std::make_unique<Parts>(setup, states, time)) {}

DartWorld::~DartWorld() = default;

void DartWorld::step() { parts_->step(); }

void DartWorld::forget_touches() { parts_->touches.clear(); }

void DartWorld::look(Frame& frame) const {
  const double unit = parts_->unit;
  frame.bodies.clear();
  for (const dd::BodyNode* ball : parts_->balls)
    frame.bodies.push_back({unit * ball->getTransform().translation(),
                            unit * ball->getLinearVelocity(), ball->getAngularVelocity()});
  parts_->touches.write(frame.touches);
}

Settings DartWorld::applied() const {
  const Parts& parts = *parts_;
  Settings settings = write_settings(parts.setup.settings);
  settings["error_reduction_parameter"] = ContactConstraint::getErrorReductionParameter();
  settings["constraint_force_mixing"] = ContactConstraint::getConstraintForceMixing();
  peer::add_world(settings, parts.setup.scene, parts.time_step);
  peer::add_coefficients(settings, parts.setup.scene, peer::SlipRule::ignored,
                         [&](int body, int other) { return parts.shapes.values(body, other); });
  return settings;
}

}  // namespace slipcheck::dart_engine
