#include "siconos_bare.h"

// clang-format off
#include <Eigen/Geometry>
#include <MechanicsFwd.hpp>
#include <SiconosKernel.hpp>
#include <SphereNEDS.hpp>
#include <SphereNEDSPlanR.hpp>
#include <SphereNEDSSphereNEDSR.hpp>
// clang-format on

namespace slipcheck::test {

// What somebody writes who has Siconos and no adapter.
std::vector<std::vector<double>> siconos_bare(const std::vector<BareSphere>& balls,
                                              const BareLaw& ground, const BareLaw& pair,
                                              double rate, int steps) {
  SP::NonSmoothDynamicalSystem model(new NonSmoothDynamicalSystem(0, 1e30));
  std::vector<SP::NewtonEulerDS> bodies;
  for (const BareSphere& b : balls) {
    SP::SiconosVector q(new SiconosVector(7)), twist(new SiconosVector(6)),
        weight(new SiconosVector(3));
    q->zero();
    twist->zero();
    weight->zero();
    q->setValue(0, b.x);
    q->setValue(2, b.z);
    q->setValue(3, 1);
    twist->setValue(0, b.vx);
    twist->setValue(4, b.wy);
    weight->setValue(2, -b.mass * 9.81);
    SP::SimpleMatrix inertia(new SimpleMatrix(3, 3));
    inertia->eye();
    *inertia *= 0.4 * b.mass * b.radius * b.radius;
    bodies.push_back(SP::NewtonEulerDS(new SphereNEDS(b.radius, b.mass, inertia, q, twist)));
    bodies.back()->setFExtPtr(weight);
    model->insertDynamicalSystem(bodies.back());
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    SP::NonSmoothLaw on_ground(
        new NewtonImpactFrictionNSL(ground.restitution, 0, ground.friction, 3));
    SP::Relation plane(new SphereNEDSPlanR(balls[i].radius, 0, 0, 1, 0));
    model->link(SP::Interaction(new Interaction(on_ground, plane)), bodies[i]);
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      SP::NonSmoothLaw law(new NewtonImpactFrictionNSL(pair.restitution, 0, pair.friction, 3));
      SP::Relation spheres(new SphereNEDSSphereNEDSR(balls[i].radius, balls[j].radius));
      model->link(SP::Interaction(new Interaction(law, spheres)), bodies[i], bodies[j]);
    }
  }
  SP::OneStepIntegrator scheme(new MoreauJeanOSI(0.5));
  SP::TimeDiscretisation clock(new TimeDiscretisation(0, 1 / rate));
  SP::TimeStepping stepping(
      new TimeStepping(model, clock, scheme, SP::OneStepNSProblem(new FrictionContact(3))));
  std::vector<std::vector<double>> frames;
  for (int n = 0; n < steps; ++n) {
    stepping->computeOneStep();
    stepping->nextStep();
    std::vector<double>& frame = frames.emplace_back();
    for (const SP::NewtonEulerDS& body : bodies) {
      const SiconosVector &q = *body->q(), &v = *body->twist();
      const Eigen::Quaterniond turn(q.getValue(3), q.getValue(4), q.getValue(5), q.getValue(6));
      const Eigen::Vector3d spin =
          turn.normalized() * Eigen::Vector3d(v.getValue(3), v.getValue(4), v.getValue(5));
      for (unsigned int k = 0; k < 3; ++k) frame.push_back(q.getValue(k));
      for (unsigned int k = 0; k < 3; ++k) frame.push_back(v.getValue(k));
      for (int k = 0; k < 3; ++k) frame.push_back(spin[k]);
    }
  }
  return frames;
}

}  // namespace slipcheck::test
