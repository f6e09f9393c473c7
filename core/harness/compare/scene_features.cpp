#include "harness/compare/scene_features.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/compare/contact_kinds.h"
#include "reference/events/planar_world.h"
#include "reference/reference_solver.h"

namespace slipcheck {
namespace {

ContactKinds pair_kinds(const ContactScene& scene) {
  if (scene.hard.bodies.size() < 2) return {};
  return contact_kinds(scene.hard.pairs, scene.soft);
}

bool starts_above(const Scene& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.initial[i].position.z() > scene.bodies[i].radius * (1 + 1e-12) ||
        scene.initial[i].velocity.z() > 0)
      return true;
  return false;
}

/// Largest radius over smallest.
double spread_of_radii(const Scene& scene) {
  const auto [small, large] = std::ranges::minmax_element(scene.bodies, {}, &Sphere::radius);
  return large->radius / small->radius;
}

std::string collapse_rule(const CollapseRule& rule) {
  switch (rule.model) {
    case CollapseRule::Model::contact_time:
      return fmt::format("TC model: no loss within {:g} s of a collision", rule.contact_time);
    case CollapseRule::Model::largest_velocity:
      return fmt::format("of a cluster within {:g} s the fastest pair first", rule.contact_time);
    case CollapseRule::Model::slowest_rebound:
      break;
  }
  return "the slowest collisions keep their speed";
}

Feature collisions_of(const Scene& scene) {
  const std::size_t bodies = scene.bodies.size();
  return {"collisions of two bodies", bodies > 1,
          bodies > 1 ? fmt::format("{} bodies", bodies) : "one body"};
}

Feature lasting(const ContactKinds& kinds) {
  return {"contacts that last", kinds.any_soft,
          kinds.any_soft ? "forces over overlap and slip" : "collisions take no time"};
}

Feature by_speed(const ContactKinds& kinds) {
  return {"restitution over the impact speed", kinds.speed_law,
          kinds.speed_law  ? "a law of hard contacts"
          : kinds.any_soft ? "it follows from the forces"
                           : "one number for all speeds"};
}

Feature surfaces_of(const Scene& scene) {
  const std::size_t count = scene.surfaces.size();
  const auto moving = std::ranges::count_if(
      scene.surfaces, [](const Surface& each) { return !each.motion.is_still(); });
  return {"surfaces beside the substrate", count > 0,
          count == 0 ? "none"
                     : fmt::format("{}{}{}", count,
                                   moving > 0 ? fmt::format(", {} of them moving", moving) : "",
                                   scene.has_substrate ? "" : "; there is no substrate")};
}

std::vector<Feature> box_features(const ContactScene& contacts) {
  const Scene& scene = contacts.hard;
  const Box& box = *scene.box;
  const SoftBox& soft = contacts.soft_box;
  const ContactKinds pairs = pair_kinds(contacts);
  ContactKinds surfaces =
      contact_kinds(box.on_floor, soft.on_floor) | contact_kinds(box.on_wall, soft.on_wall);
  if (box.lid) surfaces = surfaces | contact_kinds(box.on_lid, soft.on_lid);
  const ContactKinds all = pairs | surfaces;

  const double spread = spread_of_radii(scene);
  const bool unlike = PlanarWorld::features(scene).radii;
  const bool shaken = !box.floor.is_still();
  const bool walls_move = box.moving_walls && shaken;
  const bool collapses = all.dissipates && !all.any_soft;
  return {
      collisions_of(scene),
      {"bodies of unlike size", unlike,
       unlike ? fmt::format("radii differ by up to a factor {:.3g}", spread) : "one radius"},
      lasting(all),
      by_speed(all),
      {"rubbing at collisions", pairs.rubs(), pairs.rubbing()},
      {"rubbing at floor, walls and lid", surfaces.rubs(), surfaces.rubbing()},
      {"vibrating floor", shaken,
       shaken ? "impacts at the roots of its sine" : "at rest: it gives no energy"},
      {"moving walls", walls_move,
       walls_move         ? "up and down with the floor"
       : box.moving_walls ? "they move with a floor at rest"
                          : "fixed"},
      {"lid", box.lid.has_value(),
       box.lid ? fmt::format("{:g} m over the floor", *box.lid) : "open at the top"},
      {"rule for inelastic collapse", collapses,
       collapses      ? collapse_rule(scene.collapse)
       : all.any_soft ? "contacts that last cannot collapse"
                      : "elastic bodies cannot collapse"},
  };
}

}  // namespace

std::vector<Feature> scene_features(const ContactScene& contacts) {
  const Scene& scene = contacts.hard;
  if (scene.box) return box_features(contacts);
  const ContactKinds kinds = pair_kinds(contacts);
  const bool collisions = scene.bodies.size() > 1;
  const bool rubbing = kinds.rubs();
  const bool on_surfaces = !scene.surfaces.empty();
  const auto any = [&](const auto& has) {
    return (scene.has_substrate && std::ranges::any_of(scene.substrate, has)) ||
           std::ranges::any_of(scene.on_surfaces, has, &SurfaceContact::lasting);
  };
  const bool sliding = any([](const auto& c) { return c.kinetic_friction > 0; });
  const bool rolling = any([](const auto& c) { return !c.rolling.is_zero(); });
  const bool table = any([](const auto& c) { return !c.rolling.is_constant(); });
  const bool drilling = any([](const auto& c) { return c.drilling_length > 0; });
  const bool coupled = any([](const auto& c) { return c.coupled_radius > 0; });
  const bool rolls_sliding =
      any([](const auto& c) { return c.rolling_while_sliding && !c.rolling.is_zero(); });
  const bool tilted = !scene.downhill.isZero(0), moving = !scene.motion.is_still();
  const bool periodic = scene.periodic != Vector2::Zero();
  const bool bounces = any([](const auto& c) { return c.restitution > 0; });
  const bool jumps =
      !scene.confined && (on_surfaces || starts_above(scene) || bounces ||
                          (collisions && (rubbing || PlanarWorld::features(scene).radii)));
  return {
      collisions_of(scene),
      lasting(kinds),
      by_speed(kinds),
      {"rubbing at collisions", rubbing, kinds.rubbing()},
      surfaces_of(scene),
      {on_surfaces ? "sliding friction" : "sliding friction on the substrate", sliding,
       !sliding                  ? "what slides goes on sliding"
       : has_exact_phases(scene) ? "straight slip, parabolic paths"
                                 : "Coulomb's, with the stick limit"},
      {"rolling friction", rolling,
       rolling ? (table ? "from a table over the speed" : "one coefficient")
               : "rolling bodies keep their speed"},
      {"rolling friction while sliding", rolls_sliding,
       rolls_sliding ? "integrated" : "it acts on rolling bodies alone"},
      {"drilling friction", drilling,
       coupled    ? "coupled to the sliding: integrated"
       : drilling ? "uncoupled from the sliding"
                  : "spins about the vertical last"},
      {"tilted substrate", tilted, tilted ? "gravity along the plane" : "level"},
      {"moving substrate", moving, moving ? "the slip's direction turns" : "still"},
      {"periodic cell", periodic,
       periodic ? "bodies meet the images of others across its edges" : "the plane has no edges"},
      {"flight and landing", jumps,
       on_surfaces ? "bodies can leave what carries them"
       : jumps     ? "bodies can leave the substrate"
                   : "bodies stay on the substrate"},
  };
}

}  // namespace slipcheck
