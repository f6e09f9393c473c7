#include "engine/scene_needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace slipcheck {
namespace {

bool depends_on_speed(const PairContact& pair) {
  return !std::holds_alternative<double>(pair.restitution);
}

bool bounces(const PairContact& pair) {
  return depends_on_speed(pair) || std::get<double>(pair.restitution) > 0;
}

/// Slip is neither kept (β0 = −1) nor just stopped (β0 = 0): an engine's friction can only stop it.
bool reverses_slip(const PairContact& pair) {
  const double beta0 = pair.tangential_restitution;
  return has_friction(pair.friction) && beta0 != 0 && beta0 != -1;
}

void add_pair(SceneNeeds& needs, const PairContact& pair) {
  needs.friction |= has_friction(pair.friction);
  needs.friction_law |=
      pair.tangential_restitution != -1 && !std::holds_alternative<double>(pair.friction);
  needs.bounce |= bounces(pair);
  needs.bounce_law |= depends_on_speed(pair);
  needs.reversed_slip |= reverses_slip(pair);
}

/// Whether a body may go further than its radius in a step, so that it can be on the far side of
/// another before the engine looks again: by its speed at the start, after a fall to the floor, or
/// on being hit by the floor.
bool can_pass_in_a_step(const Scene& scene, double time_step) {
  const double floor_speed = scene.box->floor.largest_speed();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyState& start = scene.initial[i];
    const double fall = std::max(0.0, 2 * scene.gravity * start.position.z());
    const double speed = std::max(floor_speed, std::sqrt(start.velocity.squaredNorm() + fall));
    if (speed * time_step > scene.bodies[i].radius) return true;
  }
  return false;
}

void add_box(SceneNeeds& needs, const Scene& scene, double time_step) {
  const Box& box = *scene.box;
  for (const std::size_t material : scene.material) {
    add_pair(needs, box.on_floor[material]);
    add_pair(needs, box.on_wall[material]);
    if (box.lid) add_pair(needs, box.on_lid[material]);
  }
  needs.moving_floor = !box.floor.is_still();
  needs.far_in_a_step = can_pass_in_a_step(scene, time_step);
}

void add_lasting(SceneNeeds& needs, const SubstrateContact& ground) {
  needs.friction |= ground.kinetic_friction > 0;
  needs.static_friction |= ground.static_friction != ground.kinetic_friction;
  needs.rolling |= !ground.rolling.is_zero();
  needs.rolling_only |= !ground.rolling.is_zero() && !ground.rolling_while_sliding;
  needs.rolling_table |= !ground.rolling.is_constant();
  needs.drilling |= ground.drilling_length > 0;
  needs.coupled_drilling |= ground.coupled_radius > 0;
}

void add_substrate(SceneNeeds& needs, const Scene& scene) {
  needs.moving_substrate = !scene.motion.is_still();
  for (const std::size_t material : scene.material) {
    add_lasting(needs, scene.substrate[material]);
    needs.bounce |= scene.substrate[material].restitution > 0;
  }
}

/// The lowest point of a plate at rest.
double lowest_of(const RectangleShape& plate) {
  return plate.centre.z() - std::abs(plate.half_length.z()) - std::abs(plate.half_width.z());
}

/// Whether a body may go further than its radius in a step, by its speed at the start or after a
/// fall to the lowest plate.
bool can_pass_a_plate(const Scene& scene, double time_step) {
  for (const Surface& surface : scene.surfaces) {
    const auto* plate = std::get_if<RectangleShape>(&surface.shape);
    if (!plate) continue;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const BodyState& start = scene.initial[i];
      const double drop = std::max(0.0, start.position.z() - lowest_of(*plate));
      const double speed = std::sqrt(start.velocity.squaredNorm() + 2 * scene.gravity * drop) +
                           surface.motion.course().largest_speed();
      if (speed * time_step > scene.bodies[i].radius) return true;
    }
  }
  return false;
}

void add_surfaces(SceneNeeds& needs, const Scene& scene, double time_step) {
  for (const std::size_t material : scene.material)
    for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
      const SurfaceContact& contact = scene.on_surfaces[material * scene.surfaces.size() + k];
      add_lasting(needs, contact.lasting);
      add_pair(needs, contact.impact);
    }
  for (const Surface& surface : scene.surfaces) {
    const SubstrateMotion::Kind kind = surface.motion.course().kind();
    needs.swinging_surface |=
        kind != SubstrateMotion::Kind::still && kind != SubstrateMotion::Kind::constant;
  }
  needs.through_in_a_step = can_pass_a_plate(scene, time_step);
}

}  // namespace

SceneNeeds needs_of(const Scene& scene, double time_step) {
  SceneNeeds needs;
  if (scene.box) {
    add_box(needs, scene, time_step);
  } else {
    if (scene.has_substrate) add_substrate(needs, scene);
    add_surfaces(needs, scene, time_step);
  }
  for (const auto& [i, j] : material_pairs(scene)) add_pair(needs, scene.between(i, j));
  return needs;
}

std::vector<std::pair<std::size_t, std::size_t>> material_pairs(const Scene& scene) {
  std::vector<std::vector<std::size_t>> first_two(scene.substrate.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    std::vector<std::size_t>& bodies = first_two[scene.material[i]];
    if (bodies.size() < 2) bodies.push_back(i);
  }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < first_two.size(); ++a) {
    if (first_two[a].size() == 2) pairs.emplace_back(first_two[a][0], first_two[a][1]);
    for (std::size_t b = a + 1; b < first_two.size(); ++b) {
      if (first_two[a].empty() || first_two[b].empty()) continue;
      pairs.push_back(std::minmax({first_two[a][0], first_two[b][0]}));
    }
  }
  return pairs;
}

double slip_at_meeting(const Scene& scene, std::size_t i, std::size_t j) {
  const BodyState &a = scene.initial[i], &b = scene.initial[j];
  const Vector3 apart = scene.to_nearest_image(a.position - b.position);
  const Vector3 v = a.velocity - b.velocity;
  const double reach = scene.bodies[i].radius + scene.bodies[j].radius;
  // |apart + v t| = reach.
  const double rate = apart.dot(v), square = v.squaredNorm();
  const double root = rate * rate - square * (apart.squaredNorm() - reach * reach);
  if (!(rate < 0) || root < 0) return v.norm();
  const Vector3 n = (apart + (-rate - std::sqrt(root)) / square * v) / reach;
  const Vector3 u = v - (scene.bodies[i].radius * a.angular_velocity +
                         scene.bodies[j].radius * b.angular_velocity)
                            .cross(n);
  return (u - n.dot(u) * n).norm();
}

Scene with_friction_numbers(Scene scene) {
  const std::size_t materials = scene.substrate.size();
  for (const auto& [i, j] : material_pairs(scene)) {
    const double mu = friction_at(scene.between(i, j).friction, slip_at_meeting(scene, i, j));
    const std::size_t a = scene.material[i], b = scene.material[j];
    scene.pairs[a * materials + b].friction = scene.pairs[b * materials + a].friction = mu;
  }
  for (PairContact& pair : scene.pairs)  // of materials that never meet
    if (!std::holds_alternative<double>(pair.friction)) pair.friction = 0;
  if (!scene.box) return scene;
  Box& box = *scene.box;
  for (auto* contacts : {&box.on_floor, &box.on_wall, &box.on_lid})
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      FrictionLaw& friction = (*contacts)[scene.material[i]].friction;
      friction = friction_at(friction, scene.initial[i].velocity.norm());
    }
  return scene;
}

std::vector<std::string> shapes_of(const Scene& scene) {
  std::vector<std::string> shapes;
  const auto add = [&](Shape shape, const char* word) {
    if (std::ranges::find(scene.bodies, shape, &Sphere::shape) != scene.bodies.end())
      shapes.emplace_back(word);
  };
  add(Shape::block, scene_part::kBlock);
  add(Shape::cylinder, scene_part::kCylinder);
  return shapes;
}

void LackList::note(bool condition, const char* kind, const char* why) {
  if (condition) lacks_.push_back({why ? fmt::format("{} ({})", kind, why) : kind, kind});
}

void LackList::note_threshold(bool condition, double threshold) {
  if (condition && threshold > 0)
    lacks_.push_back({fmt::format("restitution below {:.3g} m/s of approach", threshold),
                      "restitution below … m/s of approach"});
}

}  // namespace slipcheck
