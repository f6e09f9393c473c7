// ODE by its own API alone, as its manual has it, beside the worker.

#include <ode/ode.h>

#include "peer_run.h"

namespace slipcheck::test {
namespace {

/// What a program of ODE's knows of its contacts.
struct BareOde {
  dWorldID world;
  dJointGroupID group;
  double mu_ground, bounce_ground, mu_balls, bounce_balls;
  dGeomID belt = nullptr;  ///< along x
  double belt_velocity = 0;
};

void near_callback(void* data, dGeomID o1, dGeomID o2) {
  const auto& bare = *static_cast<BareOde*>(data);
  const dBodyID b1 = dGeomGetBody(o1), b2 = dGeomGetBody(o2);
  const bool balls = b1 && b2;
  dContact contact;
  std::memset(&contact, 0, sizeof contact);
  contact.surface.mode = dContactBounce | dContactApprox1;
  contact.surface.mu = balls ? bare.mu_balls : bare.mu_ground;
  contact.surface.bounce = balls ? bare.bounce_balls : bare.bounce_ground;
  if (!dCollide(o1, o2, 1, &contact.geom, sizeof contact)) return;
  if (bare.belt && (o1 == bare.belt || o2 == bare.belt)) {
    dVector3 p, q;
    dPlaneSpace(contact.geom.normal, p, q);
    contact.surface.mode |= dContactFDir1 | dContactMotion1 | dContactMotion2 | dContactMotionN;
    dCopyVector3(contact.fdir1, p);
    // The second direction is normal × fdir1.
    dCalcVectorCross3(q, contact.geom.normal, p);
    contact.surface.motion1 = bare.belt_velocity * p[0];
    contact.surface.motion2 = bare.belt_velocity * q[0];
    contact.surface.motionN = bare.belt_velocity * contact.geom.normal[0];
  }
  dJointAttach(dJointCreateContact(bare.world, bare.group, &contact), b1, b2);
}

/// The surfaces of plate_peg_and_belt().
void add_surfaces(dSpaceID space, BareOde& bare) {
  const dGeomID plate = dCreateBox(space, 0.2, 0.2, 2 * 1e-12 * 0.1);
  dGeomSetPosition(plate, 0, 0, 0.1);
  dGeomSetPosition(dCreateSphere(space, 0.05), 0.25, 0, -0.03);
  bare.belt = dCreatePlane(space, 0, 0, 1, -0.1);
}

States run_bare_ode(const Scene& scene, BareOde bare, double rate, int steps) {
  dInitODE2(0);
  bare.world = dWorldCreate();
  bare.group = dJointGroupCreate(0);
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  dWorldSetGravity(bare.world, 0, 0, -scene.gravity);
  std::vector<dBodyID> balls;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Sphere& sphere = scene.bodies[i];
    const BodyState& start = scene.initial[i];
    const dBodyID ball = dBodyCreate(bare.world);
    dMass mass;
    dMassSetSphereTotal(&mass, sphere.mass, sphere.radius);
    // ODE takes 0.4 m R² in another order of factors: the last bit is the scene's.
    mass.I[0] = mass.I[5] = mass.I[10] = sphere.moment_of_inertia();
    dBodySetMass(ball, &mass);
    dBodySetPosition(ball, start.position.x(), start.position.y(), start.position.z());
    dBodySetLinearVel(ball, start.velocity.x(), start.velocity.y(), start.velocity.z());
    const Vector3& w = start.angular_velocity;
    dBodySetAngularVel(ball, w.x(), w.y(), w.z());
    dGeomSetBody(dCreateSphere(space, sphere.radius), ball);
    balls.push_back(ball);
  }
  if (scene.has_substrate)
    dCreatePlane(space, 0, 0, 1, 0);
  else
    add_surfaces(space, bare);
  States states;
  for (int n = 0; n < steps; ++n) {
    dSpaceCollide(space, &bare, &near_callback);
    dWorldStep(bare.world, 1 / rate);
    dJointGroupEmpty(bare.group);
    auto& now = states.emplace_back();
    for (const dBodyID ball : balls) {
      const auto vector = [](const dReal* v) { return Vector3(v[0], v[1], v[2]); };
      now.push_back({vector(dBodyGetPosition(ball)), vector(dBodyGetLinearVel(ball)),
                     vector(dBodyGetAngularVel(ball))});
    }
  }
  dJointGroupDestroy(bare.group);
  dSpaceDestroy(space);
  dWorldDestroy(bare.world);
  return states;
}

TEST(OdeBare, SlideToRoll) {
  const Scene scene = bundled_scene("slide-to-roll");
  expect_as_bare("ode", scene, run_bare_ode(scene, {nullptr, nullptr, 0.2, 0, 0, 0}, 240, 240));
}

TEST(OdeBare, BouncingBall) {
  const Scene scene = bundled_scene("bouncing-ball");
  expect_as_bare("ode", scene, run_bare_ode(scene, {nullptr, nullptr, 0.3, 0.8, 0, 0}, 240, 240));
}

TEST(OdeBare, TwoRollingBallsMeet) {
  const Scene scene = bundled_scene("symmetric-30cms");
  expect_as_bare("ode", scene, run_bare_ode(scene, {nullptr, nullptr, 0.1, 0, 0, 0.9}, 240, 240));
}

TEST(OdeBare, APlateAPegAndABelt) {
  BareOde bare{nullptr, nullptr, 0.3, 0.5, 0, 0};
  bare.belt_velocity = -0.5;
  const Scene scene = plate_peg_and_belt(0.3, 0.5, bare.belt_velocity);
  expect_as_bare("ode", scene, run_bare_ode(scene, bare, 240, 240));
}

}  // namespace
}  // namespace slipcheck::test
