#include "studies/stability/scene_variation.h"

#include <cassert>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

template <class... Cases>
struct Match : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Match(Cases...) -> Match<Cases...>;

void drop_expectations(Scenario& scenario) {
  for (EngineRequest& request : scenario.compare.engines) request.expect.reset();
}

/// The factors of Froude's similarity, for all that a scene holds.
class Scale {
 public:
  explicit Scale(double lambda) : length(lambda), time(std::sqrt(lambda)) {}

  /// Of a quantity of this dimension.
  double of(double masses, double lengths, double times) const {
    return std::pow(length, 3 * masses + lengths + 0.5 * times);
  }
  double of(const Dimension& d) const { return of(d.mass, d.length, d.time); }

  void operator()(Material& material) const {
    times(material.young_modulus, of(kPressure));
    times(material.dissipation_time, time);
  }
  void operator()(BodyContact& contact) const {
    std::visit(*this, contact.normal);
    std::visit(*this, contact.tangential);
  }

  void operator()(HardNormal& model) const {
    if (auto* law = std::get_if<BridgesRestitution>(&model.restitution)) law->speed *= speed();
  }
  void operator()(LinearNormal& model) const {
    times(model.damping_rate, 1 / time);
    times(model.collision_time, time);
    times(model.stiffness, of(kStiffness));
  }
  void operator()(HertzNormal&) const {}
  void operator()(PowerNormal& model) const {
    model.modulus *= of(1, 1 - model.alpha, -2);
    times(model.viscosity, of(1, -model.gamma, -1));
    times(model.at_speed, speed());
  }
  void operator()(ViscoelasticNormal& model) const {
    times(model.dissipation_time, time);
    if (model.viscosity) {
      model.viscosity->first *= of(kViscosity);
      model.viscosity->second *= of(kViscosity);
    }
    times(model.at_speed, speed());
  }

  void operator()(NoTangential&) const {}
  void operator()(ViscousTangential& model) const { times(model.damping_rate, 1 / time); }
  void operator()(AsperityTangential& model) const {
    times(model.roughness_factor, of(kPerRootLength));
    times(model.asperity_size, length);
  }
  void operator()(HardTangential&) const {}

  void operator()(MaterialOnSubstrate& contact) const {
    for (auto& point : contact.rolling.table) point.first *= speed();
    times(contact.drilling.contact_radius, length);
  }
  void operator()(Substrate& substrate) const {
    if (substrate.periodic) *substrate.periodic *= length;
    std::visit(*this, substrate.motion);
  }
  void operator()(StillMotion&) const {}
  void operator()(ConstantMotion& motion) const { motion.velocity *= speed(); }
  void operator()(OscillatingMotion& motion) const {
    motion.amplitude *= length;
    motion.frequency /= time;
  }
  void operator()(TableMotion& motion) const {
    for (TableMotion::Point& point : motion.table) {
      point.time *= time;
      point.position *= length;
    }
  }
  void operator()(Container& box) const {
    box.width *= length;
    box.floor_amplitude *= length;
    box.floor_frequency /= time;
    times(box.height, length);
  }

  void operator()(Body& body) const {
    body.sphere.radius *= length;
    body.sphere.mass *= of(kMass);
    body.initial.position *= length;
    body.initial.velocity *= speed();
    body.initial.angular_velocity /= time;
  }
  void operator()(Run& run) const {
    run.time *= time;
    run.limit *= time;
    run.most_events /= time;
    std::visit(Match{[](SlowestRebound&) {}, [this](auto& model) { model.contact_time *= time; }},
               run.collapse);
  }
  void operator()(Compare& compare) const {
    for (EngineRequest& request : compare.engines)
      for (double& rate : request.rates) rate /= time;
    for (auto& [name, tolerance] : compare.tolerance)
      if (const ObservableName* observable = observable_key(name).known();
          observable && tolerance.absolute)
        tolerance.value *= of(observable->dimension);
  }

 private:
  static void times(std::optional<double>& quantity, double factor) {
    if (quantity) *quantity *= factor;
  }
  double speed() const { return time; }  // λ/√λ

  double length, time;
};

}  // namespace

Scenario scaled_lengths(Scenario scenario, double lambda) {
  assert(lambda > 0);
  const Scale scale(lambda);
  drop_expectations(scenario);
  for (auto& [name, material] : scenario.materials) scale(material);
  for (BodyContact& contact : scenario.contacts) scale(contact);
  for (MaterialOnSubstrate& contact : scenario.substrate_contacts) scale(contact);
  std::visit(scale, scenario.surroundings);
  for (Body& body : scenario.bodies) scale(body);
  scale(scenario.run);
  scale(scenario.compare);
  return scenario;
}

Scenario with_mass_ratio(Scenario scenario, double q) {
  assert(q > 0 && scenario.bodies.size() >= 2);
  drop_expectations(scenario);
  scenario.bodies[1].sphere.mass *= q;
  return scenario;
}

Scenario with_speed(Scenario scenario, double speed) {
  assert(speed > 0 && scenario.bodies.size() >= 2);
  drop_expectations(scenario);
  Body &one = scenario.bodies[0], &other = scenario.bodies[1];
  const Vector3 apart = other.initial.position - one.initial.position;
  const Vector3 n = apart.normalized();
  const double closing = (one.initial.velocity - other.initial.velocity).dot(n);
  assert(closing > 0);
  const double factor = speed / closing;
  const double gap = apart.norm() - one.sphere.radius - other.sphere.radius;
  const Vector3 way = 0.5 * (factor - 1) * gap * n;
  one.initial.position -= way;
  other.initial.position += way;
  for (Body& body : scenario.bodies) {
    body.initial.velocity *= factor;
    body.initial.angular_velocity *= factor;
  }
  return scenario;
}

Scenario with_restitution(Scenario scenario, double restitution) {
  assert(restitution >= 0 && restitution <= 1);
  drop_expectations(scenario);
  for (BodyContact& contact : scenario.contacts) {
    if (auto* hard = std::get_if<HardNormal>(&contact.normal)) {
      if (auto* number = std::get_if<double>(&hard->restitution)) *number = restitution;
    } else if (auto* linear = std::get_if<LinearNormal>(&contact.normal)) {
      assert(restitution > 0);
      linear->restitution = restitution;
      linear->damping_rate.reset();
    }
  }
  return scenario;
}

Scenario with_stiffness(Scenario scenario, double stiffness) {
  assert(stiffness > 0);
  drop_expectations(scenario);
  for (BodyContact& contact : scenario.contacts)
    if (auto* linear = std::get_if<LinearNormal>(&contact.normal)) {
      linear->stiffness = stiffness;
      linear->collision_time.reset();
    }
  return scenario;
}

}  // namespace slipcheck
