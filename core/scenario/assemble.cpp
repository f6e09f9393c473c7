#include "scenario/assemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

#include "scenario/contact_models.h"
#include "scenario/cue_start.h"
#include "scenario/fill/fill.h"
#include "scenario/rules/overlap.h"
#include "scenario/rules/rules.h"
#include "scenario/rules/solid_check.h"
#include "scenario/rules/spanning_rules.h"
#include "scenario/surfaces.h"

namespace slipcheck {
namespace {

/// Round-off that positions and radii from a file may carry.
constexpr double kRoundOff = 1e-12;
/// Part of its radius that a body may be in a surface: positions beside tilted ones are typed.
constexpr double kTouchingSurface = 1e-9;

/// Homogeneous [kg].
double mass_with(double density, const Sphere& body, const std::optional<Extent>& extent) {
  const double r = body.radius;
  if (!extent) return density * 4 / 3 * std::numbers::pi * r * r * r;
  const double of_box = density * extent->size.prod();
  return body.shape == Shape::cylinder ? std::numbers::pi / 4 * of_box : of_box;
}

/// From the density; 0 where there is none.
double mass_of(const WrittenScene& written, const std::string& material, const Sphere& body,
               const std::optional<Extent>& extent, const std::string& path, Reading& reading) {
  const auto found = written.materials.find(material);
  if (found == written.materials.end()) return 0;
  if (!found->second.density) {
    if (reading.has("materials." + material + ".density")) return 0;  // read with a fault
    reading.fault_at(path, "needs a mass, as its material " + material + " has no density");
    return 0;
  }
  const double mass = mass_with(*found->second.density, body, extent);
  if (!(mass >= 1e-30 && mass <= 1e30)) {
    reading.fault_at(path, "must have a mass between 1e-30 and 1e30 kg");
  }
  return mass;
}

/// [x, y] or [x, y, z] over a substrate, [x, z] in a container.
Vector3 vector_of(const std::vector<double>& written, bool in_container, double third) {
  if (in_container) return {written[0], 0, written[1]};
  return {written[0], written[1], written.size() == 3 ? written[2] : third};
}

/// What a body lies on at the start.
struct Ground {
  Vector3 normal = kUp, velocity = Vector3::Zero();
};

std::optional<Ground> ground_of(const Body& body, const WrittenScene& written) {
  const std::vector<NamedSurface> surfaces = named_surfaces(written);
  const BodyState& state = body.initial;
  if (const NamedSurface* on = touched_surface(surfaces, state.position, body.sphere.radius)) {
    const Surface surface = made_surface(*on);
    const NearestPoint near = surface.nearest(0, state.position);
    return Ground{near.normal, surface.motion.velocity(0, near.point)};
  }
  if (!written.substrate) return std::nullopt;
  const Vector2 substrate = initial_velocity(written.substrate->motion);
  return Ground{kUp, {substrate.x(), substrate.y(), 0}};
}

Vector3 spin_of(const WrittenBody& body, const BodyState& state,
                const std::optional<Ground>& ground, bool in_container, Reading& reading) {
  const std::string path = body.path + ".spin";
  const std::vector<double>& values = body.spin.values;
  switch (body.spin.kind) {
    case SpinKind::none:
      return Vector3::Zero();
    case SpinKind::rolling:
      if (in_container) reading.fault_at(path, "must be none or a number in a container");
      if (in_container) return Vector3::Zero();
      if (!ground) {
        reading.fault_at(path, "must be none or given for a body that touches nothing");
        return Vector3::Zero();
      }
      if (ground->normal == kUp)
        return rolling_angular_velocity(state.velocity - ground->velocity, body.sphere.radius);
      return ground->normal.cross(state.velocity - ground->velocity) / body.sphere.radius;
    case SpinKind::given:
      break;
  }
  if (values.size() == 1) {
    if (!in_container) reading.fault_at(path, "must be none, rolling or [ωx, ωy, ωz]");
    return {0, values[0], 0};
  }
  if (in_container && (values[0] != 0 || values[2] != 0)) {
    reading.fault_at(path, "must be about y alone in a container");
  }
  return {values[0], values[1], values[2]};
}

/// A soft contact may begin overlapped, by less than the radius.
bool may_overlap(const Body& body, const NamedSurface& surface, const WrittenScene& written) {
  return std::ranges::any_of(written.contacts, [&](const WrittenContact& contact) {
    return !contact.on_substrate && contact.between.size() == 2 &&
           std::ranges::is_permutation(contact.between,
                                       std::array{body.material, surface.material}) &&
           !std::holds_alternative<HardNormal>(contact.body.normal);
  });
}

void check_beside_surfaces(const Body& body, const WrittenScene& written, const std::string& path,
                           Reading& reading) {
  const double radius = body.sphere.radius;
  for (const NamedSurface& surface : named_surfaces(written)) {
    const double overlap = overlap_of(surface, body.initial.position, radius);
    const double most = may_overlap(body, surface, written) ? radius : kTouchingSurface * radius;
    if (overlap > most)
      reading.fault_at(
          path + ".position",
          fmt::format("must be at least the radius away from {}, but is {:.6g} {} in it",
                      surface.name, overlap / to_si(1, kLength, reading.units()),
                      unit_name(kLength, reading.units())));
  }
}

/// Onto the surface that it is to touch, if there is one.
bool place_on(const std::string& name, const WrittenScene& written, const std::string& path,
              Body& body, Reading& reading) {
  if (!std::ranges::all_of(written.surfaces, &WrittenSurface::complete)) return false;
  const std::vector<NamedSurface> surfaces = named_surfaces(written);
  const auto surface = std::ranges::find(surfaces, name, &NamedSurface::name);
  if (surface == surfaces.end()) {
    std::vector<std::string> names;
    for (const NamedSurface& each : surfaces) names.push_back(each.name);
    reading.fault_at(path + ".on", "must be one of the surfaces" + did_you_mean(name, names));
    return false;
  }
  const NearestPoint near = made_surface(*surface).nearest(0, body.initial.position);
  body.initial.position = near.point + body.sphere.radius * near.normal;
  return true;
}

void check_place(Body& body, const WrittenScene& written, const std::string& path,
                 Reading& reading) {
  const double radius = body.sphere.radius;
  check_beside_surfaces(body, written, path, reading);
  if (!written.substrate && !written.container) return;
  double& z = body.initial.position.z();
  if (std::abs(z - radius) <= kRoundOff * radius) z = radius;
  const std::string position = path + ".position";
  if (z < radius) {
    reading.fault_at(position, written.container ? "must be at least the radius above the floor"
                                                 : "must be at least the radius above z = 0");
  }
  if (written.substrate && written.substrate->confined) {
    if (z > radius) reading.fault_at(position, "must rest on a confined substrate");
    if (body.initial.velocity.z() != 0) {
      reading.fault_at(path + ".velocity", "must be horizontal on a confined substrate");
    }
  }
  if (written.container) {
    const Container& box = *written.container;
    const double x = body.initial.position.x();
    const double slack = kRoundOff * box.width;
    if (box.width > 0 && (x < radius - slack || x > box.width - radius + slack)) {
      reading.fault_at(position, "must be at least the radius away from both walls");
    }
    if (box.height && z > *box.height - radius + kRoundOff * *box.height) {
      reading.fault_at(position, "must be at least the radius below the lid");
    }
  }
}

Body resolve(const WrittenBody& written_body, const WrittenScene& written, Reading& reading) {
  const bool in_container = written.container.has_value();
  Body body{written_body.name, written_body.material, written_body.sphere, {}};
  if (written_body.extent) body.extent = std::make_shared<Extent>(*written_body.extent);
  const double radius = body.sphere.radius;
  body.sphere.mass = written_body.mass ? *written_body.mass
                                       : mass_of(written, body.material, body.sphere,
                                                 written_body.extent, written_body.path, reading);
  for (const auto& [key, values] : {std::pair(".position", &written_body.position),
                                    std::pair(".velocity", &written_body.velocity)}) {
    if (in_container && values->size() != 2) {
      reading.fault_at(written_body.path + key, "must be [x, z] in a container");
      return body;
    }
  }
  const bool on_surfaces = !written.surfaces.empty() && !reading.has("substrate");
  if (on_surfaces && written_body.position.size() != 3) {
    reading.fault_at(written_body.path + ".position", "must be [x, y, z] without a substrate");
    return body;
  }
  body.initial.position = vector_of(written_body.position, in_container, radius);
  body.initial.velocity = vector_of(written_body.velocity, in_container, 0);
  if (written_body.on && !place_on(*written_body.on, written, written_body.path, body, reading))
    return body;
  body.initial.angular_velocity =
      spin_of(written_body, body.initial, ground_of(body, written), in_container, reading);
  if (written_body.cue) strike(written_body, written, body, reading);
  check_place(body, written, written_body.path, reading);
  if (body.extent) check_solid(written_body, written, body, reading);
  return body;
}

/// Spheres of a fill, once what stands explicitly is in place.
std::vector<Body> resolve(const Fill& fill, const WrittenScene& written,
                          const std::vector<Body>& others, Reading& reading) {
  const double least_mass = mass_of(written, fill.material, Sphere{.radius = fill.least_radius},
                                    std::nullopt, fill.path, reading);
  if (least_mass == 0) return {};
  if (written.container && fill.spin == SpinKind::rolling) {
    reading.fault_at(fill.path + ".spin", "must be none in a container");
  }
  const std::size_t faults = reading.faults().size();
  if (fill.heights && (written.container || (written.substrate && written.substrate->periodic)))
    reading.fault_at(fill.path + ".volume", "must be area in a container and on a periodic plane");
  if (fill.heights && fill.arrange == Fill::Arrange::lattice)
    reading.fault_at(fill.path + ".arrange", "must be random in a volume");
  if (fill.heights && fill.spin == SpinKind::rolling)
    reading.fault_at(fill.path + ".spin", "must be none in a volume");
  if (!fill.heights && !written.container && !written.substrate)
    reading.fault_at(fill.path + ".area", "must be volume without a substrate");
  if (reading.faults().size() > faults) return {};
  std::vector<Body> bodies = expand(fill, written, others, reading);
  for (Body& body : bodies) {
    const double radius = body.sphere.radius;
    body.sphere.mass =
        mass_of(written, fill.material, body.sphere, std::nullopt, fill.path, reading);
    if (fill.spin == SpinKind::rolling && written.substrate) {
      const Vector2 substrate = initial_velocity(written.substrate->motion);
      body.initial.angular_velocity = rolling_angular_velocity(
          body.initial.velocity - Vector3(substrate.x(), substrate.y(), 0), radius);
    }
  }
  return bodies;
}

/// Where nothing repeats or encloses them, bodies whose contact lasts may start in it.
std::optional<std::string> overlap_obstacle(const WrittenScene& written, const Scenario& scenario,
                                            const Body& first, const Body& second) {
  if (written.container || !written.substrate || written.substrate->periodic) return "";
  const BodyContact* contact = find_contact(scenario, first.material, second.material);
  if (!contact || std::holds_alternative<HardNormal>(contact->normal))
    return " (only bodies with a soft contact may, by less than the smaller radius)";
  if (written.compare.reference == Compare::Reference::event)
    return " (not with the reference event, which takes soft contacts as hard ones)";
  return std::nullopt;
}

void resolve_bodies(const WrittenScene& written, Scenario& scenario, Reading& reading) {
  std::vector<Body> explicit_bodies;
  std::vector<std::string> paths;
  for (const auto& entry : written.bodies) {
    const auto* body = std::get_if<WrittenBody>(&entry);
    if (!body || !body->complete) continue;
    explicit_bodies.push_back(resolve(*body, written, reading));
    paths.push_back(body->path);
  }
  check_overlaps(explicit_bodies, paths,
                 written.substrate ? written.substrate->periodic : std::nullopt, reading,
                 [&](const Body& first, const Body& second) {
                   return overlap_obstacle(written, scenario, first, second);
                 });
  if (!reading.faults().empty()) return;  // a fill might only repeat them

  std::vector<Body> placed = explicit_bodies;
  auto next = explicit_bodies.begin();
  const std::size_t fills = written.fill.size() + written.bodies.size() - explicit_bodies.size();
  const auto add_fill = [&](const Fill& fill) {
    std::vector<Body> filled = resolve(fill, written, placed, reading);
    if (fills > 1) placed.insert(placed.end(), filled.begin(), filled.end());
    if (scenario.bodies.empty())
      scenario.bodies = std::move(filled);
    else
      std::ranges::move(filled, std::back_inserter(scenario.bodies));
  };
  for (const auto& entry : written.bodies) {
    if (const auto* fill = std::get_if<Fill>(&entry)) {
      add_fill(*fill);
    } else {
      scenario.bodies.push_back(*next++);
    }
  }
  for (const Fill& fill : written.fill) add_fill(fill);
}

Run resolve_run(const WrittenScene& written) {
  Run run;
  const WrittenRun& from = written.run;
  run.until = from.until.value_or(Run::Until::time);
  run.time = from.time;
  run.periods = from.periods;
  run.discard = from.discard.value_or(0);
  run.discard_until_steady = from.discard_until_steady;
  run.sample_phase_zero = from.sample_phase_zero.value_or(false);
  run.collapse = from.collapse;
  run.most_events = from.most_events;
  if (from.periods && written.container && written.container->floor_frequency > 0) {
    run.time = static_cast<double>(*from.periods) / written.container->floor_frequency;
  }
  // A time that is asked for is also the limit, unless a longer one is given.
  run.limit = from.limit.value_or(run.until == Run::Until::time ? run.time : run.limit);
  return run;
}

}  // namespace

Vector2 initial_velocity(const Motion& motion) {
  if (const auto* constant = std::get_if<ConstantMotion>(&motion)) return constant->velocity;
  if (const auto* wave = std::get_if<OscillatingMotion>(&motion)) {
    return wave->amplitude * (2 * std::numbers::pi * wave->frequency * std::cos(wave->phase));
  }
  if (const auto* points = std::get_if<TableMotion>(&motion)) {
    const auto& table = points->table;
    for (std::size_t i = 0; i + 1 < table.size(); ++i) {
      if (table[i].time <= 0 && table[i + 1].time > 0) {
        return (table[i + 1].position - table[i].position) / (table[i + 1].time - table[i].time);
      }
    }
  }
  return Vector2::Zero();
}

Scenario assemble(const WrittenScene& written, Reading& reading) {
  check_names(written, reading);
  check_contacts(written, reading);
  check_surroundings(written, reading);
  check_run(written, reading);
  check_expectations(written, reading);
  check_tolerances(written, reading);

  Scenario scenario;
  scenario.name = written.name;
  scenario.title = written.title;
  scenario.source = written.source;
  scenario.materials = written.materials;
  double tilt = 0;
  if (written.container) {
    scenario.surroundings = *written.container;
  } else if (written.substrate) {
    scenario.surroundings = *written.substrate;
    tilt = written.substrate->tilt;
  } else {
    scenario.surroundings.emplace<Substrate>().is_there = false;
  }
  scenario.surfaces = named_surfaces(written);
  scenario.gravity =
      tilt == 0 ? Vector3(0, 0, -written.gravity)
                : Vector3(0, -written.gravity * std::sin(tilt), -written.gravity * std::cos(tilt));
  for (const WrittenContact& contact : written.contacts) {
    if (contact.between.size() != 2) continue;
    const bool swapped = contact.on_substrate && !is_reserved_name(contact.between[1])
                             ? !is_of_surface(contact.between[1], written)
                             : is_reserved_name(contact.between[0]);
    const std::string& first = contact.between[swapped ? 1 : 0];
    const std::string& second = contact.between[swapped ? 0 : 1];
    if (contact.on_substrate && !is_reserved_name(first) && !is_reserved_name(second)) {
      MaterialOnSurface& on = scenario.surface_contacts.emplace_back();
      static_cast<MaterialOnSubstrate&>(on) = contact.substrate;
      on.material = first;
      on.surface = second;
      on.path = contact.path;
    } else if (contact.on_substrate) {
      MaterialOnSubstrate& on = scenario.substrate_contacts.emplace_back(contact.substrate);
      on.material = first;
      on.path = contact.path;
    } else {
      BodyContact& pair = scenario.contacts.emplace_back(contact.body);
      pair.first = first;
      pair.second = second;
      pair.path = contact.path;
    }
  }
  resolve_bodies(written, scenario, reading);
  scenario.run = resolve_run(written);
  scenario.compare = written.compare;
  return scenario;
}

}  // namespace slipcheck
