#include "peer_backends/shared/applied.h"

#include <fmt/format.h>

#include <set>
#include <string>
#include <vector>

#include "engine/gathered_settings.h"
#include "engine/scene_needs.h"

namespace slipcheck::peer {
namespace {

constexpr const char* kBySpeed = "by speed";
constexpr const char* kBySlip = "by slip";

Setting restitution_of(const PairContact& pair, double value) {
  return std::holds_alternative<double>(pair.restitution) ? Setting(value) : Setting(kBySpeed);
}

void add_substrate(GatheredSettings& out, const Scene& scene, SlipRule rule, const ValuesOf& of) {
  const bool told_apart = rule == SlipRule::told_apart;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SubstrateContact& ground = scene.on_substrate(i);
    const ContactValues values = of(static_cast<int>(i), kFloor);
    const std::string whose = fmt::format("{}", i);
    const bool by_slip = told_apart && ground.static_friction != ground.kinetic_friction;
    const bool rolls_by_slip =
        told_apart && !ground.rolling.is_zero() && !ground.rolling_while_sliding;
    out.add("friction", whose, by_slip ? Setting(kBySlip) : Setting(values.friction));
    out.add("substrate_restitution", whose, values.restitution);
    out.add("rolling_friction", whose,
            !ground.rolling.is_constant() ? Setting(kBySpeed)
            : rolls_by_slip               ? Setting(kBySlip)
                                          : Setting(values.rolling));
    out.add("spinning_friction", whose, values.drilling);
  }
}

/// One body for each material.
void add_surfaces(GatheredSettings& out, const Scene& scene, SlipRule rule, const ValuesOf& of) {
  const bool told_apart = rule == SlipRule::told_apart;
  for (const std::size_t i : one_of_each_material(scene)) {
    for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
      const SurfaceContact& contact = scene.on_surface(i, k);
      const SubstrateContact& ground = contact.lasting;
      const ContactValues values = of(static_cast<int>(i), surface_touch(k));
      const std::string whose = fmt::format("{}-{}", i, k);
      const bool by_slip = told_apart && ground.static_friction != ground.kinetic_friction;
      const bool rolls_by_slip =
          told_apart && !ground.rolling.is_zero() && !ground.rolling_while_sliding;
      out.add("surface_friction", whose, by_slip ? Setting(kBySlip) : Setting(values.friction));
      out.add("surface_restitution", whose, restitution_of(contact.impact, values.restitution));
      out.add("surface_rolling_friction", whose,
              !ground.rolling.is_constant() ? Setting(kBySpeed)
              : rolls_by_slip               ? Setting(kBySlip)
                                            : Setting(values.rolling));
      out.add("surface_spinning_friction", whose, values.drilling);
    }
  }
}

/// One body for each material.
void add_box(GatheredSettings& out, const Scene& scene, const ValuesOf& of) {
  for (const std::size_t i : one_of_each_material(scene)) {
    const int body = static_cast<int>(i);
    const auto add = [&](int surface, const std::string& name) {
      const ContactValues values = of(body, surface);
      const std::string whose = fmt::format("{}", i);
      out.add(name + "_restitution", whose,
              restitution_of(pair_contact(scene, body, surface), values.restitution));
      out.add(name + "_friction", whose, values.friction);
    };
    add(kFloor, "floor");
    add(kWall, "wall");
    if (scene.box->lid) add(kLid, "lid");
  }
}

}  // namespace

std::vector<std::size_t> one_of_each_material(const Scene& scene) {
  std::set<std::size_t> seen;
  std::vector<std::size_t> bodies;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (seen.insert(scene.material[i]).second) bodies.push_back(i);
  return bodies;
}

void add_coefficients(Settings& settings, const Scene& scene, SlipRule rule, const ValuesOf& of) {
  GatheredSettings gathered;
  if (scene.box) {
    add_box(gathered, scene, of);
  } else {
    if (scene.has_substrate) add_substrate(gathered, scene, rule, of);
    add_surfaces(gathered, scene, rule, of);
  }
  for (const auto& [i, j] : material_pairs(scene)) {
    const ContactValues values = of(static_cast<int>(i), static_cast<int>(j));
    const std::string whose = fmt::format("{}-{}", i, j);
    gathered.add("restitution", whose, restitution_of(scene.between(i, j), values.restitution));
    gathered.add("pair_friction", whose, values.friction);
  }
  gathered.move_to(settings);
}

void add_world(Settings& settings, const Scene& scene, double time_step) {
  settings["time_step"] = time_step;
  settings["gravity"] = scene.gravity;
  if (scene.downhill == Vector2::Zero()) return;
  settings["downhill_x"] = scene.downhill.x();
  settings["downhill_y"] = scene.downhill.y();
}

}  // namespace slipcheck::peer
