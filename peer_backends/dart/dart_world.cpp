#include "peer_backends/dart/dart_world.h"

#include <fmt/format.h>

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
#include "peer_backends/shared/surface_frame.h"
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
/// Of a plate, of its shorter side.
constexpr double kPlateThickness = 1e-9;

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
        world(::dart::simulation::World::create("slipcheck")),
        touches(setup.scene.box.has_value()) {
    set_globals(setup.settings);
    const Scene& scene = setup.scene;
    world->setTimeStep(time_step);
    world->setGravity(Eigen::Vector3d(scene.downhill.x(), scene.downhill.y(), -scene.gravity) /
                      unit);
    set_solver();
    if (scene.has_substrate) add_plane();
    for (std::size_t k = 0; k < scene.surfaces.size(); ++k) add_beside(k);
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

  dd::ShapePtr plane_shape() const {
    const double width = kPlaneWidth / unit;
    return std::make_shared<dd::BoxShape>(Eigen::Vector3d(width, width, kPlaneThickness / unit));
  }

  /// Something that is not mobile; its velocity is felt all the same.
  dd::FreeJoint* add_surface(int index, const dd::ShapePtr& shape,
                             const peer::SurfaceFrame& frame) {
    const dd::SkeletonPtr skeleton = dd::Skeleton::create("surface" + std::to_string(index));
    const auto [joint, node] = skeleton->createJointAndBodyNodePair<dd::FreeJoint>();
    shapes.dress_surface(*node, index, shape);
    joint->setTransform(place_of(frame));
    skeleton->setMobile(false);
    world->addSkeleton(skeleton);
    return joint;
  }

  Eigen::Isometry3d place_of(const peer::SurfaceFrame& frame) const {
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.linear() = frame.axes;
    place.translation() = frame.centre / unit;
    return place;
  }

  void add_plane() {
    surface = peer::surfaces_of(setup.scene).front();
    plane_joint =
        add_surface(surface.index, plane_shape(), peer::SurfaceFrame{}.behind(kPlaneThickness / 2));
  }

  dd::ShapePtr shape_of(const SurfaceShape& shape) const {
    if (const auto* plate = std::get_if<RectangleShape>(&shape))
      return std::make_shared<dd::BoxShape>(2 * peer::half_sizes(*plate, kPlateThickness) / unit);
    if (const auto* ball = std::get_if<BallShape>(&shape))
      return std::make_shared<dd::SphereShape>(ball->radius / unit);
    return plane_shape();
  }

  peer::SurfaceFrame frame_beside(std::size_t k, double time) const {
    const slipcheck::Surface& each = setup.scene.surfaces[k];
    const bool plane = std::holds_alternative<PlaneShape>(each.shape);
    return peer::frame_at(each, time).behind(plane ? kPlaneThickness / 2 : 0);
  }

  void add_beside(std::size_t k) {
    beside.push_back(add_surface(surface_touch(k), shape_of(setup.scene.surfaces[k].shape),
                                 frame_beside(k, start_time)));
  }

  /// To where they are at the begin of a step, with the velocity at its end.
  void move_beside() {
    const double now = start_time + static_cast<double>(steps) * time_step;
    for (std::size_t k = 0; k < beside.size(); ++k) {
      const SurfaceMotion& motion = setup.scene.surfaces[k].motion;
      if (motion.is_still()) continue;
      const peer::SurfaceFrame frame = frame_beside(k, now);
      beside[k]->setTransform(place_of(frame));
      beside[k]->setLinearVelocity(motion.velocity(now + time_step, frame.centre) / unit);
      beside[k]->setAngularVelocity(motion.rate());
    }
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
    if (plane_joint && surface.moves) {
      const double end = start_time + static_cast<double>(steps + 1) * time_step;
      plane_joint->setLinearVelocity(surface.velocity(setup.scene, end) / unit);
    }
    move_beside();
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
  dd::FreeJoint* plane_joint = nullptr;
  std::vector<dd::FreeJoint*> beside;  // of the scene's surfaces
  std::vector<dd::BodyNode*> balls;
  peer::TouchList touches;
};

EngineInfo DartWorld::info() {
  return {
      "dart", DART_VERSION, "double", setting_table(), {scene_part::kBlock, scene_part::kSurfaces}};
}

std::string DartWorld::refusal(const DartSetup& setup) {
  if (setup.scene.box) return "only scenes on a substrate, not in a box, are mapped";
  for (std::size_t k = 0; k < setup.scene.surfaces.size(); ++k)
    if (std::holds_alternative<RodShape>(setup.scene.surfaces[k].shape))
      return fmt::format(
          "surface {} is a cylinder, which DART's own collision detector does not know and FCL's "
          "takes for a mesh",
          k);
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
  missing.note(needs.through_in_a_step, lack::kThrough);
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
