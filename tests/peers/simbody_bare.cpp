#include "simbody_bare.h"

#include <Simbody.h>

namespace slipcheck::test {

// What somebody writes who has Simbody and no adapter.
std::vector<std::vector<double>> simbody_bare(const std::vector<BareBall>& balls,
                                              const BareContact& ground, const BareContact& pair,
                                              double rate, int steps) {
  using namespace SimTK;
  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  GeneralContactSubsystem contacts(system);
  Force::UniformGravity gravity(forces, matter, Vec3(0, 0, -9.81));
  std::vector<MobilizedBody::Free> bodies;
  for (const BareBall& b : balls)
    bodies.emplace_back(
        matter.Ground(),
        Body::Rigid(MassProperties(b.mass, Vec3(0), Inertia(0.4 * b.mass * b.radius * b.radius))));
  const auto parameters = [&](ContactSetIndex set, const BareContact& c) {
    HuntCrossleyForce force(forces, contacts, set);
    for (int k = 0; k < 2; ++k)
      force.setBodyParameters(ContactSurfaceIndex(k), c.modulus, c.dissipation, c.static_friction,
                              c.dynamic_friction, 0);
    force.setTransitionVelocity(0.01);
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const ContactSetIndex floor = contacts.createContactSet();
    contacts.addBody(floor, bodies[i], ContactGeometry::Sphere(balls[i].radius), Transform());
    contacts.addBody(floor, matter.Ground(), ContactGeometry::HalfSpace(),
                     Transform(Rotation(Pi / 2, YAxis)));
    parameters(floor, ground);
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      const ContactSetIndex both = contacts.createContactSet();
      contacts.addBody(both, bodies[i], ContactGeometry::Sphere(balls[i].radius), Transform());
      contacts.addBody(both, bodies[j], ContactGeometry::Sphere(balls[j].radius), Transform());
      parameters(both, pair);
    }
  }
  system.realizeTopology();
  State state = system.getDefaultState();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].setQToFitTranslation(state, Vec3(balls[i].x, 0, balls[i].z));
    bodies[i].setUToFitLinearVelocity(state, Vec3(balls[i].vx, 0, 0));
    bodies[i].setUToFitAngularVelocity(state, Vec3(0, balls[i].wy, 0));
  }
  RungeKuttaMersonIntegrator integrator(system);
  TimeStepper stepper(system, integrator);
  stepper.initialize(state);
  std::vector<std::vector<double>> frames;
  for (int n = 1; n <= steps; ++n) {
    stepper.stepTo(n * (1 / rate));
    const State& now = stepper.getState();
    system.realize(now, Stage::Velocity);
    std::vector<double>& frame = frames.emplace_back();
    for (const MobilizedBody::Free& body : bodies)
      for (const Vec3& v : {body.getBodyOriginLocation(now), body.getBodyOriginVelocity(now),
                            body.getBodyAngularVelocity(now)})
        frame.insert(frame.end(), {v[0], v[1], v[2]});
  }
  return frames;
}

}  // namespace slipcheck::test
