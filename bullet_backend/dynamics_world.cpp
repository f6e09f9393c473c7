#include "bullet_backend/dynamics_world.h"

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <BulletDynamics/ConstraintSolver/btNNCGConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyMLCPConstraintSolver.h>
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btLemkeSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <BulletDynamics/MLCPSolvers/btSolveProjectedGaussSeidel.h>
#include <btBulletDynamicsCommon.h>

#include <optional>
#include <utility>
#include <vector>

#include "bullet_backend/image_contacts.h"
#include "bullet_backend/margins.h"

namespace slipcheck::bullet {
namespace {

btDefaultCollisionConstructionInfo memory_for(const std::optional<int>& pairs) {
  btDefaultCollisionConstructionInfo info;
  if (pairs) {
    info.m_defaultMaxPersistentManifoldPoolSize = *pairs;
    info.m_defaultMaxCollisionAlgorithmPoolSize = *pairs;
  }
  return info;
}

/// With the margins of margins.h, with images across edges, and without what is left out. The last
/// object is a ball.
template <class Base>
class World final : public Base {
 public:
  template <class Solver>
  World(btScalar body_margin, const LeaveOuts& leaves, const PeriodicCell& cell,
        btCollisionDispatcher* dispatcher, btBroadphaseInterface* broadphase, Solver* solver,
        btCollisionConfiguration* configuration)
      : Base(dispatcher, broadphase, solver, configuration),
        body_margin_(body_margin),
        leaves_(leaves) {
    if (cell.repeats()) images_.emplace(cell, *dispatcher);
  }

  void updateAabbs() override {
    is_broad_ = !leaves_.broadphase || !has_plain_box();
    if (!is_broad_) return;
    // The same number is elsewhere a factor on the size of a shape, and there it stays.
    const btScalar as_a_factor = std::exchange(gContactBreakingThreshold, body_margin_);
    Base::updateAabbs();
    gContactBreakingThreshold = as_a_factor;
  }

  void computeOverlappingPairs() override {
    if (is_broad_) Base::computeOverlappingPairs();
  }

  /// Bullet asks for the friction of points that are new in a step. A block keeps some of those of
  /// steps before, when it may have slid while it sticks now.
  void performDiscreteCollisionDetection() override {
    Base::performDiscreteCollisionDetection();
    if (images_) find_images();
    const btCollisionObject* body = this->m_collisionObjects[this->m_collisionObjects.size() - 1];
    if (body->getCollisionShape()->getShapeType() == SPHERE_SHAPE_PROXYTYPE) return;
    btDispatcher& pairs = *this->getDispatcher();
    for (int k = 0; k < pairs.getNumManifolds(); ++k) {
      btPersistentManifold& manifold = *pairs.getManifoldByIndexInternal(k);
      for (int point = 0; point < manifold.getNumContacts(); ++point)
        manifold.getContactPoint(point).m_combinedFriction =
            gCalculateCombinedFrictionCallback(manifold.getBody0(), manifold.getBody1());
    }
  }

 protected:
  void predictUnconstraintMotion(btScalar time_step) override {
    if (!leaves_.predictions) return Base::predictUnconstraintMotion(time_step);
    // Multibodies are not among these, and their bounding boxes are of where they are.
    for (int k = 0; k < this->m_nonStaticRigidBodies.size(); ++k) {
      btRigidBody& body = *this->m_nonStaticRigidBodies[k];
      if (body.isStaticOrKinematicObject()) continue;
      const btVector3& now = body.getCenterOfMassPosition();
      body.getInterpolationWorldTransform().setOrigin(now + body.getLinearVelocity() * time_step);
    }
  }

  void createPredictiveContacts(btScalar time_step) override {
    if (!leaves_.sweeps) Base::createPredictiveContacts(time_step);
  }

 private:
  /// Whether the ball is far from where Bullet takes its bounding box, of a diagonal of 1e6, for an
  /// error and halts it, and from where half-spaces end for it, 1e18 away.
  bool has_plain_box() const {
    constexpr btScalar kFar = 1e4;
    const btCollisionObject* ball = this->m_collisionObjects[this->m_collisionObjects.size() - 1];
    const auto* shape = static_cast<const btSphereShape*>(ball->getCollisionShape());
    const btVector3& now = ball->getWorldTransform().getOrigin();
    const btVector3& then = ball->getInterpolationWorldTransform().getOrigin();
    return shape->getRadius() < kFar && now.length2() < kFar * kFar && then.length2() < kFar * kFar;
  }

  void find_images() {
    balls_.clear();
    for (int k = 0; k < this->m_collisionObjects.size(); ++k)
      if (this->m_collisionObjects[k]->getUserIndex() >= 0)
        balls_.push_back(this->m_collisionObjects[k]);
    images_->find(balls_, this->getDispatchInfo());
  }

  btScalar body_margin_;  // [m]
  LeaveOuts leaves_;
  std::optional<ImageContacts> images_;
  std::vector<btCollisionObject*> balls_;
  bool is_broad_ = true;
};

/// The method of a solver of mixed linear complementarity problems; none for the others.
std::unique_ptr<btMLCPSolverInterface> make_method(SolverKind kind) {
  switch (kind) {
    case SolverKind::dantzig:
      return std::make_unique<btDantzigSolver>();
    case SolverKind::pgs:
      return std::make_unique<btSolveProjectedGaussSeidel>();
    case SolverKind::lemke:
      return std::make_unique<btLemkeSolver>();
    default:
      return nullptr;
  }
}

std::unique_ptr<btSequentialImpulseConstraintSolver> make_rigid_solver(
    SolverKind kind, btMLCPSolverInterface* method) {
  if (method) return std::make_unique<btMLCPSolver>(method);
  if (kind == SolverKind::nncg) return std::make_unique<btNNCGConstraintSolver>();
  return std::make_unique<btSequentialImpulseConstraintSolver>();
}

std::unique_ptr<btMultiBodyConstraintSolver> make_multibody_solver(SolverKind kind,
                                                                   btMLCPSolverInterface* method) {
  if (kind == SolverKind::nncg)
    throw Refused("bullet: solver: nncg is for rigid bodies only, and body is multibody");
  if (method) return std::make_unique<btMultiBodyMLCPConstraintSolver>(method);
  return std::make_unique<btMultiBodyConstraintSolver>();
}

int solver_mode(const BulletSettings& settings) {
  // Without the first Bullet does not write impulses back, and nobody would know who touches whom;
  // a factor of zero does the same.
  int mode = SOLVER_USE_WARMSTARTING | SOLVER_SIMD;
  const auto set = [&](bool condition, int flag) { mode |= condition ? flag : 0; };
  set(settings.two_friction_directions, SOLVER_USE_2_FRICTION_DIRECTIONS);
  set(!settings.velocity_dependent_friction, SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION);
  set(settings.friction_direction_caching, SOLVER_ENABLE_FRICTION_DIRECTION_CACHING);
  set(!settings.friction_cone, SOLVER_DISABLE_IMPLICIT_CONE_FRICTION);
  set(settings.interleave_friction, SOLVER_INTERLEAVE_CONTACT_AND_FRICTION_CONSTRAINTS);
  set(settings.randomize_order, SOLVER_RANDMIZE_ORDER);
  set(settings.articulated_warm_starting, SOLVER_USE_ARTICULATED_WARMSTARTING);
  return mode;
}

void set_up(btContactSolverInfo& info, const BulletSettings& settings) {
  info.m_solverMode = solver_mode(settings);
  info.m_warmstartingFactor = btScalar(settings.warm_starting ? settings.warm_starting_factor : 0);
  info.m_articulatedWarmstartingFactor = btScalar(settings.warm_starting_factor);
  info.m_numIterations = settings.solver_iterations;
  info.m_sor = btScalar(settings.sor);
  info.m_leastSquaresResidualThreshold = btScalar(settings.residual_threshold);
  info.m_minimumSolverBatchSize = settings.minimum_batch_size;
  info.m_erp2 = btScalar(settings.erp2);
  info.m_globalCfm = btScalar(settings.global_cfm);
  info.m_frictionCFM = btScalar(settings.friction_cfm);
  info.m_frictionERP = btScalar(settings.friction_erp);
  info.m_splitImpulse = settings.split_impulse;
  info.m_splitImpulsePenetrationThreshold = btScalar(settings.split_impulse_threshold);
  info.m_splitImpulseTurnErp = btScalar(settings.split_impulse_turn_erp);
  info.m_linearSlop = btScalar(settings.linear_slop);
  info.m_restitutionVelocityThreshold = btScalar(settings.restitution_velocity_threshold);
}

}  // namespace

struct DynamicsWorld::Parts {
  Parts(SolverKind kind, const LeaveOuts& leaves)
      : configuration(memory_for(leaves.most_pairs)),
        dispatcher(&configuration),
        method(make_method(kind)) {}

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher;
  btDbvtBroadphase broadphase;
  std::unique_ptr<btMLCPSolverInterface> method;
  std::unique_ptr<btConstraintSolver> solver;
  std::unique_ptr<btDiscreteDynamicsWorld> world;
};

DynamicsWorld::DynamicsWorld(const BulletSettings& settings, double margin_scale,
                             const LeaveOuts& leaves, const PeriodicCell& cell)
    : parts_(std::make_unique<Parts>(settings.solver, leaves)) {
  Parts& parts = *parts_;
  const auto margin = static_cast<btScalar>(settings.breaking_threshold * margin_scale);
  const auto make = [&]<class Base>(std::type_identity<Base>, auto solver) {
    parts.world =
        std::make_unique<World<Base>>(margin, leaves, cell, &parts.dispatcher, &parts.broadphase,
                                      solver.get(), &parts.configuration);
    parts.solver = std::move(solver);
  };
  if (settings.body == BodyKind::rigid)
    make(std::type_identity<btDiscreteDynamicsWorld>{},
         make_rigid_solver(settings.solver, parts.method.get()));
  else
    make(std::type_identity<btMultiBodyDynamicsWorld>{},
         make_multibody_solver(settings.solver, parts.method.get()));

  gContactBreakingThreshold = btScalar(settings.breaking_threshold);
  gDbvtMargin = btScalar(kTreeMargin * margin_scale);
  gDeactivationTime = btScalar(settings.sleeping_time);
  const int relative = btCollisionDispatcher::CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD;
  const int flags = parts.dispatcher.getDispatcherFlags();
  parts.dispatcher.setDispatcherFlags(settings.relative_breaking_threshold ? flags | relative
                                                                           : flags & ~relative);
  set_up(parts.world->getSolverInfo(), settings);
  parts.world->getDispatchInfo().m_useContinuous = settings.ccd;
  parts.world->setApplySpeculativeContactRestitution(settings.speculative_restitution);
  parts.world->setForceUpdateAllAabbs(settings.update_all_aabbs);
  // Islands are of bodies whose boxes overlap, and an image's contact joins none.
  if (cell.repeats()) parts.world->getSimulationIslandManager()->setSplitIslands(false);
}

DynamicsWorld::~DynamicsWorld() = default;

btDiscreteDynamicsWorld& DynamicsWorld::world() const { return *parts_->world; }
btCollisionDispatcher& DynamicsWorld::dispatcher() const { return parts_->dispatcher; }

}  // namespace slipcheck::bullet
