#include "scenario/scaled_lengths.h"

#include <cassert>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "base/match.h"
#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

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
    if (contact.rolling) times(contact.rolling->stiffness, of(kStiffness));
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
  void operator()(HardTangential& model) const {
    model.friction = with_speeds_times(model.friction, speed());
  }
  void operator()(SpringTangential& model) const {
    times(model.stiffness, of(kStiffness));
    times(model.damping_rate, 1 / time);
  }
  void operator()(MindlinTangential&) const {}

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
  void operator()(NamedSurface& surface) const {
    std::visit(*this, surface.shape);
    std::visit(*this, surface.motion);
  }
  void operator()(PlaneShape& plane) const { plane.point *= length; }
  void operator()(RectangleShape& plate) const {
    plate.centre *= length;
    plate.half_length *= length;
    plate.half_width *= length;
  }
  void operator()(RodShape& rod) const {
    rod.begin *= length;
    rod.end *= length;
    rod.radius *= length;
  }
  void operator()(BallShape& ball) const {
    ball.centre *= length;
    ball.radius *= length;
  }
  void operator()(BeltMotion& motion) const { motion.velocity *= speed(); }
  void operator()(SurfaceTranslation& motion) const { motion.velocity *= speed(); }
  void operator()(SurfaceOscillation& motion) const {
    motion.amplitude *= length;
    motion.frequency /= time;
  }
  void operator()(SurfaceTurning& motion) const {
    motion.about *= length;
    motion.rate /= time;
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
    if (body.extent)
      body.extent = std::make_shared<Extent>(length * body.extent->size, body.extent->axis);
    if (body.stroke)
      body.stroke =
          std::make_shared<Stroke>(of(1, 1, -1) * body.stroke->impulse, body.stroke->direction);
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
    if (compare.all_engines)
      for (double& rate : compare.all_engines->rates) rate /= time;
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
  for (EngineRequest& request : scenario.compare.engines) request.expect.reset();
  for (auto& [name, material] : scenario.materials) scale(material);
  for (BodyContact& contact : scenario.contacts) scale(contact);
  for (MaterialOnSubstrate& contact : scenario.substrate_contacts) scale(contact);
  for (MaterialOnSurface& contact : scenario.surface_contacts) scale(contact);
  std::visit(scale, scenario.surroundings);
  for (NamedSurface& surface : scenario.surfaces) scale(surface);
  for (Body& body : scenario.bodies) scale(body);
  scale(scenario.run);
  scale(scenario.compare);
  return scenario;
}

}  // namespace slipcheck
