#include "peer_backends/simbody/system.h"

#include <Simbody.h>

namespace slipcheck::simbody {
namespace {

using SimTK::Vec3;

Vec3 to_simbody(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
Vector3 from_simbody(const Vec3& v) { return {v[0], v[1], v[2]}; }

std::unique_ptr<SimTK::Integrator> make_integrator(const SimTK::System& system,
                                                   const SystemPlan& plan) {
  std::unique_ptr<SimTK::Integrator> made;
  switch (plan.integrator) {
    case IntegratorKind::runge_kutta_merson:
      made = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(system);
      break;
    case IntegratorKind::runge_kutta_3:
      made = std::make_unique<SimTK::RungeKutta3Integrator>(system);
      break;
    case IntegratorKind::verlet:
      made = std::make_unique<SimTK::VerletIntegrator>(system);
      break;
    case IntegratorKind::cpodes:
      made = std::make_unique<SimTK::CPodesIntegrator>(system);
      break;
  }
  made->setAccuracy(plan.accuracy);
  made->setAllowInterpolation(plan.interpolate);
  return made;
}

/// What balls weigh beyond gravity as seen from a plane that is accelerated.
class Shaking final : public SimTK::Force::Custom::Implementation {
 public:
  Shaking(std::vector<SimTK::MobilizedBody::Free> balls, const SystemPlan& plan)
      : balls_(std::move(balls)), acceleration_(plan.plane_acceleration) {
    for (const Sphere& sphere : plan.bodies) masses_.push_back(sphere.mass);
  }
  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& on_bodies,
                 SimTK::Vector_<Vec3>&, SimTK::Vector&) const override {
    const Vec3 acceleration = to_simbody(acceleration_(state.getTime()));
    for (std::size_t i = 0; i < balls_.size(); ++i)
      on_bodies[balls_[i].getMobilizedBodyIndex()] +=
          SimTK::SpatialVec(Vec3(0), -masses_[i] * acceleration);
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }

 private:
  std::vector<SimTK::MobilizedBody::Free> balls_;
  std::vector<double> masses_;
  std::function<Vector3(double)> acceleration_;
};

}  // namespace

struct System::Parts {
  explicit Parts(const SystemPlan& plan) : matter(system), forces(system), contacts(system) {
    SimTK::Force::UniformGravity(forces, matter, to_simbody(plan.gravity));
    for (const Sphere& sphere : plan.bodies) {
      const SimTK::Inertia inertia(sphere.moment_of_inertia());
      const SimTK::Body::Rigid body(SimTK::MassProperties(sphere.mass, Vec3(0), inertia));
      balls.emplace_back(matter.Ground(), body);
    }
    if (plan.plane_acceleration) SimTK::Force::Custom(forces, new Shaking(balls, plan));
    for (const SurfacePlan& surface : plan.surfaces) add_carrier(surface);
    std::size_t pair = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      if (plan.has_substrate)
        add(plan.on_substrate[i], plan, i, matter.Ground(), SimTK::ContactGeometry::HalfSpace(),
            SimTK::Transform(SimTK::Rotation(SimTK::Pi / 2, SimTK::YAxis)));  // its x points down
      for (std::size_t k = 0; k < plan.surfaces.size(); ++k) add_beside(plan, i, k);
      for (std::size_t j = i + 1; j < balls.size(); ++j)
        add(plan.pairs[pair++], plan, i, balls[j],
            SimTK::ContactGeometry::Sphere(plan.bodies[j].radius), SimTK::Transform());
    }
    system.realizeTopology();
  }

  /// What a surface that moves is fixed to: a body whose motion is prescribed.
  void add_carrier(const SurfacePlan& surface) {
    if (surface.velocity.isZero(0)) {
      carriers.push_back(matter.Ground());
      return;
    }
    const SimTK::Body::Rigid body(SimTK::MassProperties(1, Vec3(0), SimTK::Inertia(1)));
    SimTK::MobilizedBody::Translation carrier(matter.Ground(), body);
    SimTK::Motion::Steady(carrier, to_simbody(surface.velocity));
    carriers.push_back(carrier);
  }

  void add_beside(const SystemPlan& plan, std::size_t ball, std::size_t k) {
    const SurfacePlan& surface = plan.surfaces[k];
    const HuntCrossley& contact = plan.on_surfaces[ball * plan.surfaces.size() + k];
    const Vec3 place = to_simbody(surface.place);
    if (surface.is_ball) {
      add(contact, plan, ball, carriers[k], SimTK::ContactGeometry::Sphere(surface.radius),
          SimTK::Transform(place));
      return;
    }
    const SimTK::UnitVec3 inward(-to_simbody(surface.normal));
    add(contact, plan, ball, carriers[k], SimTK::ContactGeometry::HalfSpace(),
        SimTK::Transform(SimTK::Rotation(inward, SimTK::XAxis), place));
  }

  void add(const HuntCrossley& contact, const SystemPlan& plan, std::size_t ball,
           SimTK::MobilizedBody& other, const SimTK::ContactGeometry& geometry,
           const SimTK::Transform& place) {
    const SimTK::ContactSetIndex set = contacts.createContactSet();
    contacts.addBody(set, balls[ball], SimTK::ContactGeometry::Sphere(plan.bodies[ball].radius),
                     SimTK::Transform());
    contacts.addBody(set, other, geometry, place);
    SimTK::HuntCrossleyForce force(forces, contacts, set);
    for (int surface = 0; surface < 2; ++surface)
      force.setBodyParameters(SimTK::ContactSurfaceIndex(surface), contact.modulus,
                              contact.dissipation, contact.static_friction,
                              contact.dynamic_friction, 0);
    force.setTransitionVelocity(plan.transition_velocity);
  }

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::GeneralContactSubsystem contacts;
  std::vector<SimTK::MobilizedBody::Free> balls;
  std::vector<SimTK::MobilizedBody> carriers;  // by surface; the ground where it is at rest
  std::unique_ptr<SimTK::Integrator> integrator;
  std::unique_ptr<SimTK::TimeStepper> stepper;
};

System::System(const SystemPlan& plan) : parts_(std::make_unique<Parts>(plan)) {
  Parts& parts = *parts_;
  SimTK::State start = parts.system.getDefaultState();
  for (std::size_t i = 0; i < plan.states.size(); ++i) {
    parts.balls[i].setQToFitTranslation(start, to_simbody(plan.states[i].position));
    parts.balls[i].setUToFitLinearVelocity(start, to_simbody(plan.states[i].velocity));
    parts.balls[i].setUToFitAngularVelocity(start, to_simbody(plan.states[i].angular_velocity));
  }
  parts.integrator = make_integrator(parts.system, plan);
  parts.stepper = std::make_unique<SimTK::TimeStepper>(parts.system, *parts.integrator);
  parts.stepper->initialize(start);
}

System::~System() = default;

void System::advance_to(double time) { parts_->stepper->stepTo(time); }

std::vector<BodyState> System::states() const {
  const SimTK::State& state = parts_->stepper->getState();
  parts_->system.realize(state, SimTK::Stage::Velocity);
  std::vector<BodyState> states;
  for (const SimTK::MobilizedBody::Free& ball : parts_->balls) {
    BodyState& seen = states.emplace_back();
    seen.position = from_simbody(ball.getBodyOriginLocation(state));
    seen.velocity = from_simbody(ball.getBodyOriginVelocity(state));
    seen.angular_velocity = from_simbody(ball.getBodyAngularVelocity(state));
  }
  return states;
}

}  // namespace slipcheck::simbody
