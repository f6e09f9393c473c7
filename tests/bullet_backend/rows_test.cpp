// How many rows Bullet's solvers make of a contact, looked up in the solver: none for rolling and
// spinning friction where the scene has none.

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include "bullet_backend/balls.h"
#include "bullet_backend/coefficients.h"
#include "bullet_backend/combine.h"
#include "bullet_backend/dynamics_world.h"
#include "bullet_backend/surfaces.h"
#include "scenes.h"

namespace slipcheck::bullet {
namespace {

/// Capacities of the solvers' lists, which grow with the first row and never shrink.
struct Rows {
  int friction, rolling, spinning;
};

struct RigidLists : btSequentialImpulseConstraintSolver {
  static Rows of(btConstraintSolver* solver) {
    auto& made = static_cast<btSequentialImpulseConstraintSolver&>(*solver);
    return {(made.*(&RigidLists::m_tmpSolverContactFrictionConstraintPool)).capacity(),
            (made.*(&RigidLists::m_tmpSolverContactRollingFrictionConstraintPool)).capacity(), 0};
  }
};

struct MultibodyLists : btMultiBodyConstraintSolver {
  static Rows of(btConstraintSolver* solver) {
    auto& made = static_cast<btMultiBodyConstraintSolver&>(*solver);
    return {(made.*(&MultibodyLists::m_multiBodyFrictionContactConstraints)).capacity(),
            (made.*(&MultibodyLists::m_multiBodyTorsionalFrictionContactConstraints)).capacity(),
            (made.*(&MultibodyLists::m_multiBodySpinningFrictionContactConstraints)).capacity()};
  }
};

Rows rows_of(BodyKind body, double mu_r, double drilling_length) {
  Scene scene = test::steel_scene(1);
  scene.initial[0] = test::rolling_at(0, 0, 0.1, 0.05);
  scene.substrate[0].rolling = RollingFriction(mu_r);
  scene.substrate[0].drilling_length = drilling_length;
  BulletSettings settings;
  settings.body = body;
  settings.two_friction_directions = body == BodyKind::multibody;
  constexpr double kStep = 1.0 / 240;
  const PeriodicCell cell;
  const DynamicsWorld dynamics(settings, 1, find_leave_outs(scene, scene.initial, settings), cell);
  const PairCoefficients coefficients(scene, settings, kStep);
  const Surfaces surfaces(dynamics.world(), scene, {}, settings);
  const auto balls =
      make_balls(dynamics.world(), scene, scene.initial, Eigen::Matrix3d::Identity(), settings);
  balls->object(0).setUserPointer(const_cast<PairCoefficients*>(&coefficients));
  combine_by_pair();
  dynamics.world().setGravity(btVector3(0, 0, btScalar(-scene.gravity)));
  for (int k = 0; k < 20; ++k) dynamics.world().stepSimulation(btScalar(kStep), 0);
  btConstraintSolver* solver = dynamics.world().getConstraintSolver();
  return body == BodyKind::rigid ? RigidLists::of(solver) : MultibodyLists::of(solver);
}

TEST(BulletRows, NoneForRollingAndSpinningFrictionThatIsNotThere) {
  for (const BodyKind body : {BodyKind::rigid, BodyKind::multibody}) {
    const Rows rows = rows_of(body, 0, 0);
    EXPECT_GT(rows.friction, 0);
    EXPECT_EQ(rows.rolling, 0);
    EXPECT_EQ(rows.spinning, 0);
  }
}

TEST(BulletRows, OneKindWithoutTheOtherOnlyForMultibodies) {
  EXPECT_GT(rows_of(BodyKind::multibody, 0.01, 0).rolling, 0);
  EXPECT_EQ(rows_of(BodyKind::multibody, 0.01, 0).spinning, 0);
  EXPECT_EQ(rows_of(BodyKind::multibody, 0, 1e-4).rolling, 0);
  EXPECT_GT(rows_of(BodyKind::multibody, 0, 1e-4).spinning, 0);
  // A rigid body's are in one list, three for a contact: the map asks for a rolling friction of
  // 1e-12 where there is a spinning one.
  EXPECT_GE(rows_of(BodyKind::rigid, 0.01, 0).rolling, 3);
  EXPECT_GE(rows_of(BodyKind::rigid, 0, 1e-4).rolling, 3);
}

}  // namespace
}  // namespace slipcheck::bullet
