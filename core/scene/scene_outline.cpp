#include "scene/scene_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

#include "scenario/contact_models.h"
#include "scenario/surfaces.h"
#include "scene/obstacles.h"

namespace slipcheck {
namespace {

bool is_hertzian(const Drilling& drilling) {
  return drilling.model != Drilling::Model::none && !drilling.contact_radius;
}

bool is_zero(const RollingLaw& law) {
  return std::ranges::all_of(law.table, [](const auto& point) { return point.second == 0; });
}

/// a_c [m]: as given, or the Hertzian one under the body's weight on a rigid plane,
/// a_c³ = 3 F R (1 − ν²)/(4 Y).
double contact_radius(const Drilling& drilling, const Material& material, const Sphere& sphere,
                      double gravity) {
  if (drilling.contact_radius) return *drilling.contact_radius;
  const double nu = material.poisson_ratio.value();
  const double force = sphere.mass * gravity;
  return std::cbrt(3 * force * sphere.radius * (1 - nu * nu) /
                   (4 * material.young_modulus.value()));
}

SubstrateContact substrate_contact(const MaterialOnSubstrate& from, const Material& material,
                                   const Sphere& sphere, double gravity) {
  SubstrateContact contact;
  contact.static_friction = from.friction.static_;
  contact.kinetic_friction = from.friction.kinetic;
  std::vector<RollingFriction::Point> points;
  for (const auto& [speed, coefficient] : from.rolling.table)
    points.push_back({speed, coefficient});
  contact.rolling = RollingFriction(std::move(points));
  contact.rolling_while_sliding = from.rolling.while_sliding && !is_zero(from.rolling);
  contact.restitution = from.restitution;
  if (from.drilling.model == Drilling::Model::none) return contact;
  const double radius = contact_radius(from.drilling, material, sphere, gravity);
  contact.hertzian_pressure = is_hertzian(from.drilling);
  // Torque per normal force of pure drilling: (2/3) μ_k a_c over a disc of uniform pressure,
  // (3π/16) μ_k a_c over a Hertzian one.
  const double share = contact.hertzian_pressure ? 3 * std::numbers::pi / 16 : 2.0 / 3;
  contact.drilling_length = share * contact.kinetic_friction * radius;
  if (from.drilling.model == Drilling::Model::coupled) contact.coupled_radius = radius;
  return contact;
}

SubstrateMotion substrate_motion(const Motion& motion) {
  if (const auto* constant = std::get_if<ConstantMotion>(&motion))
    return SubstrateMotion::constant(constant->velocity);
  if (const auto* wave = std::get_if<OscillatingMotion>(&motion))
    return SubstrateMotion::oscillation(wave->amplitude, wave->frequency, wave->phase);
  if (const auto* table = std::get_if<TableMotion>(&motion)) {
    std::vector<SubstrateMotion::Point> points;
    for (const TableMotion::Point& point : table->table)
      points.push_back({point.time, point.position});
    return SubstrateMotion::table(std::move(points));
  }
  return {};
}

Box box_of(const Container& container) {
  Box box;
  box.width = container.width;
  box.floor = {container.floor_amplitude, container.floor_frequency};
  box.moving_walls = container.walls == Container::Walls::moving;
  box.lid = container.height;
  return box;
}

CollapseRule collapse_rule(const CollapseModel& model) {
  using Model = CollapseRule::Model;
  if (const auto* tc = std::get_if<ContactTimeModel>(&model))
    return {Model::contact_time, tc->contact_time};
  if (const auto* largest = std::get_if<LargestVelocityModel>(&model))
    return {Model::largest_velocity, largest->contact_time};
  return {};
}

/// Contacts between bodies that depend on the two, and are all soft.
bool soft_ones_divide(const Scenario& scenario) {
  bool any = false;
  for (const BodyContact& contact : scenario.contacts) {
    if (!depends_on_bodies(contact)) continue;
    if (std::holds_alternative<HardNormal>(contact.normal)) return false;
    any = true;
  }
  return any;
}

bool is_of_surface(const Scenario& scenario, const std::string& name) {
  return name == "floor" || name == "wall" || name == "lid" ||
         std::ranges::find(scenario.surfaces, name, &NamedSurface::material) !=
             scenario.surfaces.end();
}

/// Materials of which each size, mass and shape is a class by itself. own: contacts between bodies
/// make none so, as each two have their own.
std::set<std::string> divided_materials(const Scenario& scenario, bool own) {
  std::set<std::string> divided;
  for (const MaterialOnSubstrate& contact : scenario.substrate_contacts) {
    if (is_hertzian(contact.drilling)) divided.insert(contact.material);
  }
  for (const MaterialOnSurface& contact : scenario.surface_contacts) {
    if (is_hertzian(contact.drilling)) divided.insert(contact.material);
  }
  for (const BodyContact& contact : scenario.contacts) {
    if (!depends_on_bodies(contact)) continue;
    if (!own || is_of_surface(scenario, contact.first) || is_of_surface(scenario, contact.second))
      divided.insert({contact.first, contact.second});
  }
  return divided;
}

/// Material, radius, mass and shape, these 0 where nothing tells them apart.
using ClassKey = std::tuple<std::string, double, double, double>;

ClassKey class_of(const Body& body, const std::set<std::string>& divided) {
  if (!divided.contains(body.material)) return {body.material, 0, 0, 0};
  return {body.material, body.sphere.radius, body.sphere.mass, body.sphere.shape_factor};
}

/// What of a hard contact depends on the bodies is kept for each two classes.
constexpr std::size_t kMostHardClasses = 2000;

void refuse(const Scenario& scenario, std::size_t classes) {
  const auto dividing = std::ranges::find_if(scenario.contacts, depends_on_bodies);
  Obstacles obstacles(scenario);
  obstacles.add(dividing == scenario.contacts.end() ? "contacts" : dividing->path,
                fmt::format("can only be solved with bodies of at most {} sizes, masses and shapes "
                            "where contacts tell them apart and are not all soft",
                            kMostHardClasses),
                fmt::format("{} of them", classes));
  obstacles.throw_any();
}

/// The contacts of all bodies of a material are in one row.
void share_rows(const Scenario& scenario, SceneOutline& outline) {
  std::map<std::string, std::size_t> row_of;
  for (const BodyClass& each : outline.classes)
    outline.scene.rows.of.push_back(row_of.try_emplace(each.material, row_of.size()).first->second);
  outline.scene.rows.count = row_of.size();
  for (std::size_t row = 0; row < row_of.size(); ++row) {
    std::vector<const Body*> all;
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i)
      if (outline.scene.row_of(i) == row) all.push_back(&scenario.bodies[i]);
    const auto [small, large] =
        std::ranges::minmax(all, {}, [](const Body* b) { return b->sphere.radius; });
    const auto [light, heavy] =
        std::ranges::minmax(all, {}, [](const Body* b) { return b->sphere.mass; });
    std::vector<BodyClass>& standing = outline.rows.emplace_back();
    for (const Body* body : {all.front(), small, large, light, heavy})
      standing.push_back({body->material, body->sphere});
  }
}

}  // namespace

SurfaceContact surface_contact(const MaterialOnSubstrate& from, const Material& material,
                               const Sphere& sphere, double gravity) {
  const SubstrateContact lasting = substrate_contact(from, material, sphere, gravity);
  return {lasting, {lasting.restitution, lasting.kinetic_friction, 0}};
}

SurfaceContact surface_contact(const PairContact& impact) {
  SubstrateContact lasting;
  lasting.static_friction = lasting.kinetic_friction = friction_at(impact.friction, 0);
  // Of a law over the impact speed nothing is left at rest.
  const double* restitution = std::get_if<double>(&impact.restitution);
  lasting.restitution = restitution ? *restitution : 0;
  return {lasting, impact};
}

PairContact hard_pair(const BodyContact& contact) {
  PairContact pair;
  const auto& restitution = std::get<HardNormal>(contact.normal).restitution;
  if (const auto* law = std::get_if<BridgesRestitution>(&restitution)) {
    pair.restitution = PowerLawRestitution{law->coefficient, law->exponent, law->speed};
  } else if (const auto* number = std::get_if<double>(&restitution)) {
    pair.restitution = *number;
  }
  if (const auto* tangential = std::get_if<HardTangential>(&contact.tangential)) {
    pair.friction = tangential->friction;
    pair.tangential_restitution = tangential->tangential_restitution;
  }
  return pair;
}

SceneOutline make_outline(const Scenario& scenario, std::size_t most_in_table) {
  SceneOutline outline;
  Scene& scene = outline.scene;
  scene.gravity = -scenario.gravity.z();
  scene.downhill = scenario.gravity.head<2>();
  scene.collapse = collapse_rule(scenario.run.collapse);
  if (const auto* substrate = std::get_if<Substrate>(&scenario.surroundings)) {
    scene.motion = substrate_motion(substrate->motion);
    scene.confined = substrate->confined;
    scene.periodic = substrate->periodic.value_or(Vector2::Zero());
    scene.has_substrate = substrate->is_there;
  } else {
    scene.box = box_of(std::get<Container>(scenario.surroundings));
  }

  for (const NamedSurface& surface : scenario.surfaces)
    scene.surfaces.push_back(made_surface(surface));

  std::map<std::string, const MaterialOnSubstrate*> on_substrate;
  for (const MaterialOnSubstrate& contact : scenario.substrate_contacts) {
    on_substrate.emplace(contact.material, &contact);
  }
  const bool own = has_own_contacts(scenario, most_in_table);
  const std::set<std::string> divided = divided_materials(scenario, own);
  std::map<ClassKey, std::size_t> index;
  scene.bodies.reserve(scenario.bodies.size());
  scene.initial.reserve(scenario.bodies.size());
  scene.material.reserve(scenario.bodies.size());
  for (const Body& body : scenario.bodies) {
    const Sphere& sphere = body.sphere;
    const auto [entry, is_new] = index.try_emplace(class_of(body, divided), outline.classes.size());
    if (is_new) {
      outline.classes.push_back({body.material, sphere});
      const auto contact = on_substrate.find(body.material);
      const auto material = scenario.materials.find(body.material);
      scene.substrate.push_back(substrate_contact(
          contact == on_substrate.end() ? MaterialOnSubstrate{} : *contact->second,
          material == scenario.materials.end() ? Material{} : material->second, sphere,
          scene.gravity));
    }
    scene.bodies.push_back(sphere);
    scene.initial.push_back(body.initial);
    if (body.extent) {
      scene.extents.resize(scene.bodies.size());
      scene.extents.back() = *body.extent;
    }
    scene.material.push_back(entry->second);
  }
  if (!scene.extents.empty()) scene.extents.resize(scene.bodies.size());
  if (own)
    share_rows(scenario, outline);
  else
    for (const BodyClass& each : outline.classes) outline.rows.push_back({each});
  if (outline.rows.size() > kMostHardClasses) refuse(scenario, outline.rows.size());
  scene.pairs.resize(outline.rows.size() * outline.rows.size());
  if (scene.box) {
    for (auto* contacts : {&scene.box->on_floor, &scene.box->on_wall, &scene.box->on_lid})
      contacts->resize(outline.classes.size());
  }
  return outline;
}

bool has_own_contacts(const Scenario& scenario, std::size_t most_in_table) {
  if (scenario.bodies.size() <= most_in_table || !soft_ones_divide(scenario)) return false;
  const std::set<std::string> divided = divided_materials(scenario, false);
  std::set<ClassKey> classes;
  for (const Body& body : scenario.bodies) {
    classes.insert(class_of(body, divided));
    if (classes.size() > most_in_table) return true;
  }
  return false;
}

}  // namespace slipcheck
