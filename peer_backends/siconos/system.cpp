#include "peer_backends/siconos/system.h"

#include <Eigen/Geometry>

// clang-format off
#include <NonSmoothDrivers.h>
#include <SolverOptions.h>
#include <SiconosKernel.hpp>
#include <NewtonEuler5DR.hpp>
#include <NewtonImpactRollingFrictionNSL.hpp>
#include <RollingFrictionContact.hpp>
// clang-format on

namespace slipcheck::siconos {
namespace {

/// Of what carries a moving surface: mass over that of all bodies, and radius of gyration [m].
constexpr double kCarrierMass = 1e9, kCarrierGyration = 100;

void set(SiconosVector& to, const Vector3& from) {
  for (unsigned int k = 0; k < 3; ++k) to.setValue(k, from[k]);
}

/// The place of the first or second body [m]: seven coordinates each.
Vector3 centre(const BlockVector& q, unsigned int body) {
  return {q.getValue(7 * body), q.getValue(7 * body + 1), q.getValue(7 * body + 2)};
}

/// A sphere over the plane z = 0; Base: NewtonEuler3DR, or NewtonEuler5DR with rolling friction.
template <class Base>
class OnPlane : public Base {
 public:
  explicit OnPlane(double radius) : radius_(radius) {}
  void computeh(double, const BlockVector& q, SiconosVector& y) override {
    const Vector3 place = centre(q, 0);
    y.setValue(0, place.z() - radius_);
    set(*this->_Pc1, place - radius_ * Vector3::UnitZ());
    set(*this->_Pc2, {place.x(), place.y(), 0});
    set(*this->_Nc, Vector3::UnitZ());
  }

 private:
  double radius_;
};

/// A sphere and a surface beside the plane.
template <class Base>
class OnSurface : public Base {
 public:
  OnSurface(double radius, FixedSurface surface) : radius_(radius), surface_(std::move(surface)) {}
  void computeh(double time, const BlockVector& q, SiconosVector& y) override {
    const Vector3 place = centre(q, 0);
    const NearestPlace nearest = surface_.nearest(time, place);
    y.setValue(0, nearest.distance - radius_);
    set(*this->_Pc1, place - radius_ * nearest.normal);
    set(*this->_Pc2, nearest.point);
    set(*this->_Nc, nearest.normal);
  }

 private:
  double radius_;
  FixedSurface surface_;
};

/// Two spheres.
template <class Base>
class OnSphere : public Base {
 public:
  OnSphere(double first, double second) : first_(first), second_(second) {}
  void computeh(double, const BlockVector& q, SiconosVector& y) override {
    const Vector3 a = centre(q, 0), b = centre(q, 1), apart = a - b;
    const Vector3 normal = apart.normalized();
    y.setValue(0, apart.norm() - first_ - second_);
    set(*this->_Pc1, a - first_ * normal);
    set(*this->_Pc2, b + second_ * normal);
    set(*this->_Nc, normal);
  }

 private:
  double first_, second_;
};

template <class Relation3, class Relation5, class... Radii>
SP::Interaction make_interaction(const ImpactLaw& law, bool rolls, const Radii&... radii) {
  if (rolls) {
    SP::NonSmoothLaw five(new NewtonImpactRollingFrictionNSL(
        law.restitution, law.tangential_restitution, law.friction, law.rolling_length, 5));
    return SP::Interaction(new Interaction(five, SP::Relation(new Relation5(radii...))));
  }
  SP::NonSmoothLaw three(
      new NewtonImpactFrictionNSL(law.restitution, law.tangential_restitution, law.friction, 3));
  return SP::Interaction(new Interaction(three, SP::Relation(new Relation3(radii...))));
}

SP::LinearOSNS make_problem(const SystemPlan& plan) {
  const bool nsgs = plan.solver == Solver::nsgs;
  SP::LinearOSNS problem;
  if (plan.rolls)
    problem.reset(new RollingFrictionContact(
        5, nsgs ? SICONOS_ROLLING_FRICTION_3D_NSGS : SICONOS_ROLLING_FRICTION_3D_ADMM));
  else
    problem.reset(
        new FrictionContact(3, nsgs ? SICONOS_FRICTION_3D_NSGS : SICONOS_FRICTION_3D_ADMM));
  problem->numericsSolverOptions()->dparam[SICONOS_DPARAM_TOL] = plan.tolerance;
  problem->numericsSolverOptions()->iparam[SICONOS_IPARAM_MAX_ITER] = plan.iterations;
  return problem;
}

}  // namespace

struct System::Parts {
  struct Link {
    SP::Interaction interaction;
    Impulse impulse;
  };

  explicit Parts(const SystemPlan& plan)
      : origin(plan), model(new NonSmoothDynamicalSystem(0, 1e30)) {
    for (std::size_t i = 0; i < plan.bodies.size(); ++i) add_ball(plan, i);
    for (const FixedSurface& surface : plan.surfaces) add_carrier(plan, surface);
    std::size_t pair = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const double radius = plan.bodies[i].radius;
      if (plan.has_substrate)
        link(make_interaction<OnPlane<NewtonEuler3DR>, OnPlane<NewtonEuler5DR>>(
                 plan.on_substrate[i], plan.rolls, radius),
             i, Impulse::kPlane);
      for (std::size_t k = 0; k < plan.surfaces.size(); ++k)
        link(make_interaction<OnSurface<NewtonEuler3DR>, OnSurface<NewtonEuler5DR>>(
                 plan.on_surfaces[i * plan.surfaces.size() + k], plan.rolls, radius,
                 plan.surfaces[k]),
             i, Impulse::kPlane - 1 - static_cast<int>(k));
      for (std::size_t j = i + 1; j < balls.size(); ++j)
        if (const auto& law = plan.pairs[pair++])
          link(make_interaction<OnSphere<NewtonEuler3DR>, OnSphere<NewtonEuler5DR>>(
                   *law, plan.rolls, radius, plan.bodies[j].radius),
               i, static_cast<int>(j));
    }
    SP::MoreauJeanOSI scheme(new MoreauJeanOSI(plan.theta));
    scheme->setConstraintActivationThreshold(plan.activation_threshold);
    SP::TimeDiscretisation clock(new TimeDiscretisation(0, plan.time_step));
    stepping.reset(new TimeStepping(model, clock, scheme, make_problem(plan)));
    stepping->setNewtonTolerance(plan.newton_tolerance);
    if (plan.plane_acceleration) {
      set_weights(0);
      stepping->initialize();
    }
  }

  void add_ball(const SystemPlan& plan, std::size_t i) {
    const Sphere& sphere = plan.bodies[i];
    SP::SiconosVector place(new SiconosVector(7)), twist(new SiconosVector(6));
    place->zero();
    set(*place, plan.states[i].position);
    place->setValue(3, 1);  // a unit quaternion: body and space axes are alike at the start
    for (unsigned int k = 0; k < 3; ++k) {
      twist->setValue(k, plan.states[i].velocity[k]);
      twist->setValue(3 + k, plan.states[i].angular_velocity[k]);
    }
    SP::SimpleMatrix inertia(new SimpleMatrix(3, 3));
    inertia->eye();
    *inertia *= sphere.moment_of_inertia();
    SP::NewtonEulerDS ball(new NewtonEulerDS(place, twist, sphere.mass, inertia));
    weights.emplace_back(new SiconosVector(3));
    set(*weights.back(), sphere.mass * plan.gravity);
    ball->setFExtPtr(weights.back());
    model->insertDynamicalSystem(ball);
    balls.push_back(ball);
  }

  /// What has a surface's velocity: a body so heavy that nothing stops or turns it, without weight.
  /// Where the surface lies, its relations know; one at rest needs none.
  void add_carrier(const SystemPlan& plan, const FixedSurface& surface) {
    carriers.emplace_back();
    if (surface.velocity.isZero(0)) return;
    double mass = 0;
    for (const Sphere& body : plan.bodies) mass += kCarrierMass * body.mass;
    SP::SiconosVector place(new SiconosVector(7)), twist(new SiconosVector(6));
    place->zero();
    place->setValue(3, 1);
    twist->zero();
    for (unsigned int k = 0; k < 3; ++k) twist->setValue(k, surface.velocity[k]);
    SP::SimpleMatrix inertia(new SimpleMatrix(3, 3));
    inertia->eye();
    *inertia *= mass * kCarrierGyration * kCarrierGyration;
    carriers.back().reset(new NewtonEulerDS(place, twist, mass, inertia));
    model->insertDynamicalSystem(carriers.back());
  }

  /// Weights at a time since the start, as seen from a plane that is accelerated. The scheme has
  /// the force at the end of a step from here, and that at its begin from the step before.
  void set_weights(double time) {
    const Vector3 seen = origin.gravity - origin.plane_acceleration(time);
    for (std::size_t i = 0; i < balls.size(); ++i) set(*weights[i], origin.bodies[i].mass * seen);
  }

  void link(const SP::Interaction& interaction, std::size_t first, int second) {
    const SP::NewtonEulerDS carrier =
        second < Impulse::kPlane ? carriers[static_cast<std::size_t>(Impulse::kPlane - 1 - second)]
                                 : SP::NewtonEulerDS();
    if (carrier)
      model->link(interaction, balls[first], carrier);
    else if (second < 0)
      model->link(interaction, balls[first]);
    else
      model->link(interaction, balls[first], balls[static_cast<std::size_t>(second)]);
    links.push_back({interaction, {static_cast<int>(first), second, 0}});
  }

  SystemPlan origin;
  SP::NonSmoothDynamicalSystem model;
  std::vector<SP::NewtonEulerDS> balls;
  std::vector<SP::SiconosVector> weights;
  std::vector<SP::NewtonEulerDS> carriers;  // by surface; none where it is at rest
  std::vector<Link> links;
  SP::TimeStepping stepping;
  std::vector<Impulse> impulses;
  long steps = 0;  // taken
};

System::System(const SystemPlan& plan) : parts_(std::make_unique<Parts>(plan)) {}
System::~System() = default;

void System::step() {
  if (parts_->origin.plane_acceleration)
    parts_->set_weights(static_cast<double>(++parts_->steps) * parts_->origin.time_step);
  parts_->stepping->computeOneStep();
  parts_->impulses.clear();
  for (Parts::Link& link : parts_->links) {
    link.impulse.normal = link.interaction->lambda(1)->getValue(0);
    if (link.impulse.normal > 0) parts_->impulses.push_back(link.impulse);
  }
  parts_->stepping->nextStep();
}

std::vector<BodyState> System::states() const {
  std::vector<BodyState> states;
  for (const SP::NewtonEulerDS& ball : parts_->balls) {
    const SiconosVector &q = *ball->q(), &twist = *ball->twist();
    // The twist's angular part is along the body's axes.
    const Eigen::Quaterniond turn(q.getValue(3), q.getValue(4), q.getValue(5), q.getValue(6));
    const Vector3 spin(twist.getValue(3), twist.getValue(4), twist.getValue(5));
    BodyState& state = states.emplace_back();
    state.position = {q.getValue(0), q.getValue(1), q.getValue(2)};
    state.velocity = {twist.getValue(0), twist.getValue(1), twist.getValue(2)};
    state.angular_velocity = turn.normalized() * spin;
  }
  return states;
}

const std::vector<Impulse>& System::impulses() const { return parts_->impulses; }

}  // namespace slipcheck::siconos
