#include "scenario/hard_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <tuple>

#include "scenario/fault.h"

namespace slipcheck {
namespace {

/// Collects what cannot be solved, one line for each.
class Obstacles {
 public:
  explicit Obstacles(const Scenario& scenario) : scenario_(scenario) {}

  void add(const std::string& path, const std::string& rule, const std::string& value) {
    if (!text_.empty()) text_ += '\n';
    text_ += Fault{scenario_.file, location_of(path), path, rule, value}.message();
  }
  void throw_any() const {
    if (!text_.empty()) throw Unsupported(text_);
  }

 private:
  /// Of the path or what encloses it.
  Location location_of(std::string path) const {
    while (!path.empty()) {
      const auto found = scenario_.locations.find(path);
      if (found != scenario_.locations.end()) return found->second;
      const std::size_t end = path.find_last_of(".[");
      path.resize(end == std::string::npos ? 0 : end);
    }
    return {};
  }

  const Scenario& scenario_;
  std::string text_;
};

void look_at(const BodyContact& contact, Obstacles& obstacles) {
  constexpr const char* kNormalNames[] = {"hard", "linear", "hertz", "power", "viscoelastic"};
  constexpr const char* kTangentialNames[] = {"none", "viscous", "asperity", "hard"};
  const auto* normal = std::get_if<HardNormal>(&contact.normal);
  if (!normal) {
    obstacles.add(contact.path + ".normal.model", "only the normal model hard can be solved",
                  kNormalNames[contact.normal.index()]);
  } else if (std::holds_alternative<ViscoelasticRestitution>(normal->restitution)) {
    obstacles.add(contact.path + ".normal.restitution",
                  "only a number or {bridges: …} can be solved", "viscoelastic");
  }
  if (!std::holds_alternative<NoTangential>(contact.tangential) &&
      !std::holds_alternative<HardTangential>(contact.tangential)) {
    obstacles.add(contact.path + ".tangential.model",
                  "only the tangential models none and hard can be solved",
                  kTangentialNames[contact.tangential.index()]);
  }
}

bool is_zero(const RollingLaw& law) {
  for (const auto& point : law.table) {
    if (point.second != 0) return false;
  }
  return true;
}

void look_at(const MaterialOnSubstrate& contact, Obstacles& obstacles) {
  if (contact.rolling.while_sliding && !is_zero(contact.rolling)) {
    obstacles.add(contact.path + ".rolling.while_sliding",
                  "rolling friction on a sliding body cannot be solved", "true");
  }
  if (contact.drilling.model == Drilling::Model::coupled) {
    obstacles.add(contact.path + ".drilling.model", "only none and uncoupled can be solved",
                  "coupled");
  }
}

void look_at(const Substrate& substrate, Obstacles& obstacles) {
  constexpr const char* kMotionNames[] = {"still", "constant", "oscillate", "table"};
  if (substrate.periodic) {
    obstacles.add("substrate.periodic", "only an unbounded substrate can be solved",
                  "a periodic cell");
  }
  if (substrate.tilt != 0) {
    obstacles.add("substrate.tilt", "only a level substrate can be solved",
                  fmt::format("{:.6g} deg", substrate.tilt * 180 / std::numbers::pi));
  }
  const auto* constant = std::get_if<ConstantMotion>(&substrate.motion);
  const bool still = std::holds_alternative<StillMotion>(substrate.motion) ||
                     (constant && constant->velocity.isZero(0));
  if (!still) {
    obstacles.add("substrate.motion.kind", "only a still substrate can be solved",
                  kMotionNames[substrate.motion.index()]);
  }
}

PairContact pair_contact(const BodyContact& contact) {
  PairContact pair;
  const auto& restitution = std::get<HardNormal>(contact.normal).restitution;
  if (const auto* law = std::get_if<BridgesRestitution>(&restitution)) {
    pair.restitution = PowerLawRestitution{law->coefficient, law->exponent, law->speed};
  } else {
    pair.restitution = std::get<double>(restitution);
  }
  if (const auto* tangential = std::get_if<HardTangential>(&contact.tangential)) {
    pair.friction = tangential->friction;
    pair.tangential_restitution = tangential->tangential_restitution;
  }
  return pair;
}

/// Torque per normal force, M/F = (2/3) μ_k a_c over a uniform contact disc. Without a given radius
/// the Hertzian one under the body's weight on a rigid plane, a_c³ = 3 F R (1 − ν²)/(4 Y), where
/// M/F = (3π/16) μ_k a_c.
double drilling_length(const MaterialOnSubstrate& contact, const Material& material,
                       const Sphere& sphere, double gravity) {
  if (contact.drilling.model == Drilling::Model::none) return 0;
  const double mu = contact.friction.kinetic;
  if (contact.drilling.contact_radius) return 2.0 / 3 * mu * *contact.drilling.contact_radius;
  const double nu = material.poisson_ratio.value();
  const double force = sphere.mass * gravity;
  const double radius =
      std::cbrt(3 * force * sphere.radius * (1 - nu * nu) / (4 * material.young_modulus.value()));
  return 3 * std::numbers::pi / 16 * mu * radius;
}

SubstrateContact substrate_contact(const MaterialOnSubstrate& from) {
  SubstrateContact contact;
  contact.static_friction = from.friction.static_;
  contact.kinetic_friction = from.friction.kinetic;
  std::vector<RollingFriction::Point> points;
  for (const auto& [speed, coefficient] : from.rolling.table)
    points.push_back({speed, coefficient});
  contact.rolling = RollingFriction(std::move(points));
  contact.restitution = from.restitution;
  return contact;
}

}  // namespace

HardScene make_hard_scene(const Scenario& scenario) {
  Obstacles obstacles(scenario);
  for (const BodyContact& contact : scenario.contacts) look_at(contact, obstacles);
  for (const MaterialOnSubstrate& contact : scenario.substrate_contacts)
    look_at(contact, obstacles);
  const auto* substrate = std::get_if<Substrate>(&scenario.surroundings);
  if (substrate) {
    look_at(*substrate, obstacles);
  } else {
    obstacles.add("container", "only an unbounded substrate can be solved", "a container");
  }
  if (scenario.compare.reference == Compare::Reference::contact) {
    obstacles.add("compare.reference", "resolved contacts cannot be solved", "contact");
  }
  obstacles.throw_any();

  HardScene scene;
  scene.gravity = -scenario.gravity.z();
  scene.confined = substrate->confined;

  std::map<std::string, const MaterialOnSubstrate*> on_substrate;
  for (const MaterialOnSubstrate& contact : scenario.substrate_contacts) {
    on_substrate.emplace(contact.material, &contact);
  }
  // A Hertzian contact radius depends on the body: such a material becomes one for each size and
  // mass.
  std::map<std::tuple<std::string, double, double>, std::size_t> index;
  std::vector<std::string> names;
  for (const Body& body : scenario.bodies) {
    const auto found = on_substrate.find(body.material);
    const MaterialOnSubstrate none;
    const MaterialOnSubstrate& contact = found == on_substrate.end() ? none : *found->second;
    const bool hertzian =
        contact.drilling.model != Drilling::Model::none && !contact.drilling.contact_radius;
    const Sphere& sphere = body.sphere;
    const auto [entry, is_new] = index.try_emplace(
        {body.material, hertzian ? sphere.radius : 0, hertzian ? sphere.mass : 0}, names.size());
    if (is_new) {
      names.push_back(body.material);
      SubstrateContact& target = scene.substrate.emplace_back(substrate_contact(contact));
      const auto material = scenario.materials.find(body.material);
      target.drilling_length = drilling_length(
          contact, material == scenario.materials.end() ? Material{} : material->second, sphere,
          scene.gravity);
    }
    scene.bodies.push_back(sphere);
    scene.initial.push_back(body.initial);
    scene.material.push_back(entry->second);
  }

  std::map<std::pair<std::string, std::string>, PairContact> pairs;
  for (const BodyContact& contact : scenario.contacts) {
    pairs[{contact.first, contact.second}] = pairs[{contact.second, contact.first}] =
        pair_contact(contact);
  }
  for (const std::string& first : names) {
    for (const std::string& second : names) {
      const auto found = pairs.find({first, second});
      scene.pairs.push_back(found == pairs.end() ? PairContact{} : found->second);
    }
  }
  return scene;
}

}  // namespace slipcheck
