#include "scenario/rules/spanning_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scenario/rules/rules.h"
#include "scenario/rules/scene_names.h"
#include "scenario/surfaces.h"

namespace slipcheck {
namespace {

/// Observables of the pair "a-b" must not be taken for those of a body of that name or of another
/// pair: "a-b" with "c", and "a" with "b-c".
void check_joined_names(const SceneNames& names, Reading& reading) {
  std::map<std::string, std::string> left_rest, right_rest;  // by the rest: a name it belongs to
  const auto known = [&](const std::string& name) {
    return names.path_of(name) || name == "substrate" || name == "floor" || name == "wall" ||
           name == "lid";
  };
  for (const std::string& name : names.joined()) {
    for (std::size_t at = name.find('-'); at != std::string::npos; at = name.find('-', at + 1)) {
      const std::string left = name.substr(0, at), right = name.substr(at + 1);
      if (known(left) && known(right)) {
        reading.fault_at(*names.path_of(name) + ".name",
                         fmt::format("must not read like the pair of {} and {}", left, right));
      }
      if (known(left)) left_rest.emplace(right, name);
      if (known(right)) right_rest.emplace(left, name);
    }
  }
  for (const auto& [rest, name] : left_rest) {
    const auto other = right_rest.find(rest);
    if (other == right_rest.end() || other->second == name) continue;
    reading.fault_at(*names.path_of(name) + ".name",
                     fmt::format("must not make pairs that read alike, as with {}", other->second));
  }
}

void check_material(const std::string& material, const std::string& path,
                    const WrittenScene& written, Reading& reading) {
  if (material.empty() || written.materials.contains(material)) return;
  std::vector<std::string> names;
  for (const auto& each : written.materials) names.push_back(each.first);
  reading.fault_at(path, "must be one of the materials" + did_you_mean(material, names));
}

void check_rising(const std::vector<TableMotion::Point>& table, const std::string& path,
                  Reading& reading) {
  for (std::size_t i = 1; i < table.size(); ++i) {
    if (table[i].time <= table[i - 1].time) {
      reading.fault_at(fmt::format("{}[{}][0]", path, i), "must be later than the time before it");
    }
  }
}

}  // namespace

bool is_reserved_name(const std::string& name) {
  constexpr std::array kReserved = {"substrate", "floor", "wall", "lid", "all"};
  return std::ranges::find(kReserved, name) != kReserved.end();
}

void check_names(const WrittenScene& written, Reading& reading) {
  for (const auto& each : written.materials) {
    if (is_reserved_name(each.first)) {
      reading.fault_at("materials." + each.first, "must not have a reserved name");
    }
  }
  SceneNames names;
  const auto add_name = [&](const std::string& name, const std::string& path) {
    if (name.empty()) return;
    if (is_reserved_name(name)) {
      reading.fault_at(path + ".name", "must not be a reserved name");
    }
    if (!names.add(name, path)) {
      reading.fault_at(path + ".name",
                       fmt::format("must be unique, but is also {}", *names.path_of(name)));
    }
  };
  for (const WrittenSurface& surface : written.surfaces) {
    add_name(surface.name, surface.path);
    if (const auto* box = std::get_if<BoxOfPlates>(&surface.shape))
      for (const NamedSurface& plate : plates_of(surface, *box))
        names.add(plate.name, surface.path);
    check_material(surface.material, surface.path + ".material", written, reading);
  }
  std::vector<const Fill*> fills;
  for (const auto& entry : written.bodies) {
    if (const auto* body = std::get_if<WrittenBody>(&entry)) {
      add_name(body->name, body->path);
      check_material(body->material, body->path + ".material", written, reading);
    } else {
      fills.push_back(&std::get<Fill>(entry));
    }
  }
  for (const Fill& fill : written.fill) fills.push_back(&fill);
  for (const Fill* fill : fills) {
    check_material(fill->material, fill->path + ".material", written, reading);
    if (const auto shared = names.add(*fill))
      reading.fault_at(
          fill->path + ".prefix",
          fmt::format("must give unique names, but {} is also in {}", shared->name, shared->path));
  }
  check_joined_names(names, reading);
}

void check_surroundings(const WrittenScene& written, Reading& reading) {
  if (written.container) {
    if (written.substrate) reading.fault_at("substrate", "must not stand beside a container");
    if (!written.surfaces.empty())
      reading.fault_at("surfaces", "must not stand beside a container");
  }
  check_surfaces(written, reading);
  if (!written.substrate) return;
  const Substrate& substrate = *written.substrate;
  if (!written.surfaces.empty() && substrate.confined)
    reading.fault_at("substrate.confined", "must be false beside surfaces");
  if (!written.surfaces.empty() && substrate.periodic)
    reading.fault_at("substrate.periodic", "must not stand beside surfaces");
  if (const auto* motion = std::get_if<TableMotion>(&substrate.motion)) {
    check_rising(motion->table, "substrate.motion.table", reading);
  }
  if (!substrate.periodic) return;
  // Solvers look at the nearest image of a body, in the cells of their grid around the other's own:
  // these must not meet around the periodic cell.
  constexpr double kLeastDiameters = 4;
  double largest = 0;
  for (const auto& entry : written.bodies) {
    const auto* body = std::get_if<WrittenBody>(&entry);
    largest = std::max(largest, body ? body->sphere.radius : std::get<Fill>(entry).most_radius);
  }
  for (const Fill& fill : written.fill) largest = std::max(largest, fill.most_radius);
  const double least = kLeastDiameters * 2 * largest;
  for (int axis = 0; axis < 2; ++axis) {
    if ((*substrate.periodic)[axis] >= least * (1 - 1e-12)) continue;  // round-off of the units
    reading.fault_at(fmt::format("substrate.periodic[{}]", axis),
                     fmt::format("must be at least {} times the largest diameter, {:.6g} {}",
                                 kLeastDiameters, least / to_si(1, kLength, reading.units()),
                                 unit_name(kLength, reading.units())));
  }
}

void check_run(const WrittenScene& written, Reading& reading) {
  const WrittenRun& run = written.run;
  if (run.until == Run::Until::time && run.limit && *run.limit < run.time) {
    reading.fault_at("run.limit", "must be at least the time in until");
  }
  if (written.container) {
    if (run.until == Run::Until::rolling || run.until == Run::Until::rest) {
      reading.fault_at("run.until", "must be a time in a container, or periods in its place");
    }
    const double frequency = written.container->floor_frequency;
    for (const char* key : {"run.periods", "run.discard", "run.sample"}) {
      if (frequency == 0 && reading.has(key)) {
        reading.fault_at(key, "needs a floor that vibrates");
      }
    }
    if (run.periods && run.discard && *run.discard >= *run.periods) {
      reading.fault_at("run.discard", "must be less than periods");
    }
    if (run.until == Run::Until::time && run.discard && frequency > 0 &&
        static_cast<double>(*run.discard) / frequency >= run.time) {
      reading.fault_at("run.discard", "must be fewer periods than fit into until");
    }
  } else if (written.substrate || !written.surfaces.empty()) {
    for (const char* key : {"run.periods", "run.discard", "run.sample"}) {
      if (reading.has(key)) reading.fault_at(key, "is only for a container");
    }
  }
}

}  // namespace slipcheck
