#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "scenario/rules/spanning_rules.h"
#include "scenario/surfaces.h"

namespace slipcheck {
namespace {

using Pair = std::pair<std::string, std::string>;

Pair sorted(const std::string& a, const std::string& b) { return a < b ? Pair(a, b) : Pair(b, a); }

/// What a contact may name beside a material in these surroundings.
std::vector<std::string> boundaries(const WrittenScene& written) {
  if (written.substrate) return {"substrate"};
  if (!written.container && !written.surfaces.empty()) return {};
  if (!written.container) return {"substrate", "floor", "wall", "lid"};  // a fault by itself
  if (written.container->height) return {"floor", "wall", "lid"};
  return {"floor", "wall"};
}

/// Whether both names are good.
bool check_between(const WrittenContact& contact, const WrittenScene& written, Reading& reading) {
  const std::vector<std::string> allowed = boundaries(written);
  int reserved = 0;
  const std::size_t faults_before = reading.faults().size();
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string& name = contact.between[i];
    const std::string path = fmt::format("{}.between[{}]", contact.path, i);
    if (is_reserved_name(name)) {
      ++reserved;
      if (std::ranges::find(allowed, name) == allowed.end()) {
        reading.fault_at(path, "is not part of this scene's surroundings");
      }
    } else if (!written.materials.contains(name)) {
      reading.fault_at(path, "must be one of the materials or the scene's surroundings");
    }
  }
  if (reserved == 2) reading.fault_at(contact.path + ".between", "must name a material");
  if (reserved == 0 && contact.on_substrate &&
      std::ranges::none_of(contact.between,
                           [&](const std::string& name) { return is_of_surface(name, written); }))
    reading.fault_at(contact.path + ".between",
                     "must have normal and tangential, as none of the two is of a surface");
  return reading.faults().size() == faults_before;
}

void need_elastic(const std::string& material, const std::string& path, const std::string& what,
                  const WrittenScene& written, Reading& reading) {
  const auto found = written.materials.find(material);
  if (found == written.materials.end()) return;
  const auto need = [&](bool is_there, const char* key) {
    const std::string place = "materials." + material;
    if (is_there || reading.has(place + '.' + key)) return;
    reading.fault_at(place + '.' + key,
                     fmt::format("is missing, but {} ({}) needs it", path, what));
  };
  need(found->second.young_modulus.has_value(), "young_modulus");
  need(found->second.poisson_ratio.has_value(), "poisson_ratio");
}

/// Whether the normal force has a dashpot in proportion to the overlap's rate.
bool has_dashpot(const NormalModel& normal) {
  const auto* viscoelastic = std::get_if<ViscoelasticNormal>(&normal);
  return std::holds_alternative<LinearNormal>(normal) ||
         std::holds_alternative<PowerNormal>(normal) ||
         (viscoelastic && viscoelastic->form == ViscoelasticNormal::Form::expanded);
}

/// Springs that remember, beside the normal force.
void check_memory(const WrittenContact& contact, const WrittenScene& written, Reading& reading) {
  const NormalModel& normal = contact.body.normal;
  const bool is_linear = std::holds_alternative<LinearNormal>(normal);
  const auto check_friction = [&](const FrictionCoefficients& friction) {
    if (friction.static_ < friction.kinetic)
      reading.fault_at(contact.path + ".tangential.friction.static",
                       fmt::format("must be at least the kinetic friction {}", friction.kinetic));
  };
  const auto check_damping = [&](bool has_ratio) {
    if (has_ratio && !has_dashpot(normal))
      reading.fault_at(
          contact.path + ".tangential.damping_ratio",
          "needs the normal model linear, power or viscoelastic (form expanded), whose "
          "dashpot goes with the rate of the overlap");
  };
  if (const auto* spring = std::get_if<SpringTangential>(&contact.body.tangential)) {
    check_friction(spring->friction);
    check_damping(spring->damping_ratio.has_value());
    if (spring->damping_ratio && spring->damping_rate)
      reading.fault_at(contact.path + ".tangential.damping_ratio",
                       "must not stand beside damping_rate");
    if (spring->stiffness_ratio && !is_linear)
      reading.fault_at(contact.path + ".tangential.stiffness_ratio",
                       "needs the normal model linear; give stiffness");
  }
  if (const auto* mindlin = std::get_if<MindlinTangential>(&contact.body.tangential)) {
    check_friction(mindlin->friction);
    check_damping(mindlin->damping_ratio > 0);
    if (is_linear)
      reading.fault_at(contact.path + ".tangential.model",
                       "mindlin needs the normal model hertz, viscoelastic or power, of spheres");
    for (const std::string& name : std::set(contact.between.begin(), contact.between.end()))
      need_elastic(name, contact.path + ".tangential", "mindlin", written, reading);
  }
  if (!contact.body.rolling) return;
  if (std::holds_alternative<HardNormal>(normal))
    reading.fault_at(contact.path + ".rolling",
                     "needs a normal model whose contacts last: a collision at an instant rolls "
                     "nowhere");
  else if (contact.body.rolling->stiffness_ratio && !is_linear)
    reading.fault_at(contact.path + ".rolling.stiffness_ratio",
                     "needs the normal model linear; give stiffness");
  const bool has_friction_law =
      std::holds_alternative<AsperityTangential>(contact.body.tangential) ||
      std::holds_alternative<HardTangential>(contact.body.tangential);
  if (has_friction_law && !std::holds_alternative<HardNormal>(normal))
    reading.fault_at(contact.path + ".tangential.model",
                     "must be none, viscous, spring or mindlin beside rolling");
}

void check_friction_law(const std::string& path, const FrictionLaw& friction, bool is_hard,
                        Reading& reading) {
  if (!is_hard && !std::holds_alternative<double>(friction))
    reading.fault_at(path, "must be a number unless the normal model is hard");
  const auto* table = std::get_if<TabulatedFriction>(&friction);
  if (!table) return;
  const auto& points = table->points();
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].speed <= points[i - 1].speed)
      reading.fault_at(fmt::format("{}[{}][0]", path, i), "must be more than the speed before it");
}

void check_models(const WrittenContact& contact, const WrittenScene& written, Reading& reading) {
  const NormalModel& normal = contact.body.normal;
  const auto* hard = std::get_if<HardNormal>(&normal);
  std::string what;
  if (std::holds_alternative<HertzNormal>(normal)) what = "hertz";
  if (std::holds_alternative<ViscoelasticNormal>(normal) ||
      (hard && std::holds_alternative<ViscoelasticRestitution>(hard->restitution))) {
    what = "viscoelastic";
  }
  if (!what.empty()) {
    for (const std::string& name : std::set(contact.between.begin(), contact.between.end())) {
      need_elastic(name, contact.path + ".normal", what, written, reading);
    }
  }
  // The viscous law takes its ratio from a normal damping rate, which only two models have.
  const auto* viscous = std::get_if<ViscousTangential>(&contact.body.tangential);
  if (viscous && viscous->damping_ratio && !std::holds_alternative<LinearNormal>(normal)) {
    reading.fault_at(contact.path + ".tangential.damping_ratio",
                     "needs the normal model linear; give damping_rate");
  }
  if (const auto* rubbing = std::get_if<HardTangential>(&contact.body.tangential))
    check_friction_law(contact.path + ".tangential.friction", rubbing->friction, hard, reading);
  const TangentialModel& tangential = contact.body.tangential;
  if (hard && !std::holds_alternative<NoTangential>(tangential) &&
      !std::holds_alternative<HardTangential>(tangential)) {
    reading.fault_at(contact.path + ".tangential.model",
                     "must be none or hard with the normal model hard");
  }
  check_memory(contact, written, reading);
}

/// The least radius of the bodies of a material [m]; infinite where there are none.
double least_radius(const std::string& material, const WrittenScene& written) {
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const std::string& of, double radius) {
    if (of == material && radius > 0) least = std::min(least, radius);
  };
  for (const auto& entry : written.bodies) {
    if (const auto* body = std::get_if<WrittenBody>(&entry)) {
      look(body->material, body->sphere.radius);
    } else {
      look(std::get<Fill>(entry).material, std::get<Fill>(entry).least_radius);
    }
  }
  for (const Fill& fill : written.fill) look(fill.material, fill.least_radius);
  return least;
}

/// A sphere's contact is a part of its cross section.
void check_contact_radius(const WrittenContact& contact, const WrittenScene& written,
                          Reading& reading) {
  if (!contact.substrate.drilling.contact_radius) return;
  for (const std::string& name : contact.between) {
    const double least = least_radius(name, written);
    if (*contact.substrate.drilling.contact_radius <= least * (1 + 1e-12))
      continue;  // round-off of units
    reading.fault_at(contact.path + ".drilling.contact_radius",
                     fmt::format("must be at most the radius of the smallest body of {}, {:.6g} {}",
                                 name, least / to_si(1, kLength, reading.units()),
                                 unit_name(kLength, reading.units())));
  }
}

void check_on_substrate(const WrittenContact& contact, const WrittenScene& written,
                        Reading& reading) {
  const MaterialOnSubstrate& on = contact.substrate;
  if (on.friction.static_ < on.friction.kinetic) {
    reading.fault_at(contact.path + ".friction.static",
                     fmt::format("must be at least the kinetic friction {}", on.friction.kinetic));
  }
  const auto& table = on.rolling.table;
  const bool in_mapping = reading.has(contact.path + ".rolling.coefficient");
  const std::string path = contact.path + (in_mapping ? ".rolling.coefficient" : ".rolling");
  const bool is_table = reading.has(path + "[0]");
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::string point = is_table ? fmt::format("{}[{}]", path, i) : path;
    if (i > 0 && table[i].first <= table[i - 1].first) {
      reading.fault_at(point + "[0]", "must be more than the speed before it");
    }
    if (table[i].second > on.friction.static_) {
      reading.fault_at(is_table ? point + "[1]" : point,
                       fmt::format("must be at most the static friction {}, or the body would "
                                   "slide and not roll (K 17)",
                                   on.friction.static_));
    }
  }
  check_contact_radius(contact, written, reading);
  if (on.drilling.model != Drilling::Model::none && !on.drilling.contact_radius) {
    for (const std::string& name : contact.between) {
      need_elastic(name, contact.path + ".drilling", "contact_radius: hertz", written, reading);
    }
  }
}

/// Number of bodies of each material.
std::map<std::string, std::int64_t> count_by_material(const WrittenScene& written) {
  std::map<std::string, std::int64_t> count;
  for (const auto& entry : written.bodies) {
    if (const auto* body = std::get_if<WrittenBody>(&entry)) {
      ++count[body->material];
    } else {
      count[std::get<Fill>(entry).material] += std::get<Fill>(entry).count;
    }
  }
  for (const Fill& fill : written.fill) count[fill.material] += fill.count;
  std::erase_if(count, [&](const auto& each) { return !written.materials.contains(each.first); });
  return count;
}

/// Pairs of materials with a contact, and those of them that have it in the form of a substrate.
struct GivenPairs {
  std::set<Pair> all, of_surfaces;
};

void check_all_there(const GivenPairs& given, const WrittenScene& written, Reading& reading) {
  const auto count = count_by_material(written);
  std::size_t missing = 0;
  const auto need = [&](const std::string& a, const std::string& b, bool of_bodies = true) {
    const Pair pair = sorted(a, b);
    if (given.all.contains(pair) && !(of_bodies && given.of_surfaces.contains(pair))) return;
    ++missing;
    reading.fault_at("contacts",
                     fmt::format("needs a contact between {} and {}, which can meet", a, b));
  };
  for (auto a = count.begin(); a != count.end(); ++a) {
    if (written.substrate || written.container) {
      for (const std::string& boundary : boundaries(written)) need(a->first, boundary);
    }
    for (const WrittenSurface& surface : written.surfaces)
      if (written.materials.contains(surface.material)) need(a->first, surface.material, false);
    if (a->second > 1) need(a->first, a->first);
    for (auto b = std::next(a); b != count.end(); ++b) {
      need(a->first, b->first);
      if (missing > 100) return;  // a hostile file has millions of pairs
    }
  }
}

}  // namespace

void check_contacts(const WrittenScene& written, Reading& reading) {
  GivenPairs given;
  bool all_named = true;
  for (const WrittenContact& contact : written.contacts) {
    if (contact.between.size() != 2 || contact.between[0].empty() || contact.between[1].empty()) {
      all_named = false;
      continue;
    }
    all_named = check_between(contact, written, reading) && all_named;
    const Pair pair = sorted(contact.between[0], contact.between[1]);
    if (contact.on_substrate && !is_reserved_name(pair.first) && !is_reserved_name(pair.second))
      given.of_surfaces.insert(pair);
    if (!given.all.insert(pair).second) {
      reading.fault_at(contact.path + ".between",
                       fmt::format("must name a pair once, and {} and {} "
                                   "have a contact above",
                                   contact.between[0], contact.between[1]));
    }
    if (!contact.complete) continue;
    if (contact.on_substrate) {
      check_on_substrate(contact, written, reading);
    } else {
      check_models(contact, written, reading);
    }
  }
  const bool unreadable = written.contacts.empty() && reading.has("contacts[0]");
  if (all_named && !unreadable) check_all_there(given, written, reading);
}

}  // namespace slipcheck
