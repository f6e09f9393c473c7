#include "harness/compare/box_features.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/compare/contact_kinds.h"

namespace slipcheck {
namespace {

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

}  // namespace

std::vector<Feature> box_features(const ContactScene& contacts) {
  const Scene& scene = contacts.hard;
  const Box& box = *scene.box;
  const SoftBox& soft = contacts.soft_box;
  const bool collisions = scene.bodies.size() > 1;
  const ContactKinds pairs =
      collisions ? contact_kinds(scene.pairs, contacts.soft) : ContactKinds{};
  ContactKinds surfaces =
      contact_kinds(box.on_floor, soft.on_floor) | contact_kinds(box.on_wall, soft.on_wall);
  if (box.lid) surfaces = surfaces | contact_kinds(box.on_lid, soft.on_lid);
  const ContactKinds all = pairs | surfaces;

  const double spread = spread_of_radii(scene);
  const bool unlike = spread > 1;
  const bool shaken = !box.floor.is_still();
  const bool walls_move = box.moving_walls && shaken;
  const bool collapses = all.dissipates && !all.any_soft;
  return {
      {"collisions of two bodies", collisions,
       collisions ? fmt::format("{} bodies", scene.bodies.size()) : "one body"},
      {"bodies of unlike size", unlike,
       unlike ? fmt::format("radii differ by up to a factor {:.3g}", spread) : "one radius"},
      {"contacts that last", all.any_soft,
       all.any_soft ? "forces over overlap and slip" : "collisions take no time"},
      {"restitution over the impact speed", all.speed_law,
       all.speed_law  ? "a law of hard contacts"
       : all.any_soft ? "it follows from the forces"
                      : "one number for all speeds"},
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

}  // namespace slipcheck
