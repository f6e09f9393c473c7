#include "reference/events/planar_world.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "reference/events/cluster.h"
#include "reference/events/planar_cells.h"
#include "reference/events/planar_loop.h"
#include "reference/forces/floor_flight.h"

namespace slipcheck {

const PairContact PlanarWorld::kElastic{};

bool PlanarWorld::is_planar(const Scene& scene, std::span<const BodyState> initial) {
  if (scene.box) return true;
  const auto rubs = [](const SubstrateContact& on) {
    return on.static_friction != 0 || on.kinetic_friction != 0 || !on.rolling.is_zero() ||
           on.drilling_length != 0;
  };
  if (std::ranges::any_of(scene.substrate, rubs) || scene.downhill != Vector2::Zero()) return false;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const BodyState& state = initial[i];
    if (scene.bodies[i].radius != scene.bodies.front().radius) return false;
    if (state.position.z() != scene.bodies[i].radius || state.velocity.z() != 0) return false;
    if (state.angular_velocity.x() != 0 || state.angular_velocity.y() != 0) return false;
  }
  return true;
}

PlanarFeatures PlanarWorld::features(const Scene& scene) {
  PlanarFeatures has;
  has.box = scene.box.has_value();
  has.radii = std::ranges::any_of(scene.bodies, [&](const Sphere& sphere) {
    return sphere.radius != scene.bodies.front().radius;
  });
  has.spin = has.box || std::ranges::any_of(scene.pairs, [](const PairContact& contact) {
               return has_friction(contact.friction);
             });
  return has;
}

PlanarWorld::PlanarWorld(const Scene& scene, std::span<const BodyState> initial,
                         const LeastSpeeds& least)
    : scene_(&scene),
      gravity_(scene.box ? scene.gravity : 0),
      upright_(scene.box.has_value()),
      least_(least),
      grid_(planar_cells(scene, initial)),
      place_(initial.size()),
      body_at_(initial.size()),
      bodies_(initial.size()),
      matter_(initial.size()),
      radii_(initial.size()),
      radius_(scene.bodies.front().radius),
      contact_square_(4 * radius_ * radius_),
      around_(initial.size()) {
  if (scene.box)
    last_column_ = static_cast<std::int32_t>(std::lround(scene.box->width / grid_.width_x())) - 1;
  std::vector<std::array<std::int32_t, 2>> cell(initial.size());
  std::vector<std::uint64_t> key(initial.size());
  std::vector<Body> bodies(initial.size());
  std::vector<Matter> matter(initial.size());
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const BodyState& state = initial[i];
    Body& body = bodies[i];
    Matter& of = matter[i];
    const int up = upright_ ? 2 : 1;
    body = {state.position.x(), state.position[up], state.velocity.x(), state.velocity[up], 0, {}};
    of.spin = upright_ ? -state.angular_velocity.y() : state.angular_velocity.z();
    std::int32_t ix = CellGrid::cell_of(body.x, grid_.width_x());
    const std::int32_t iy = CellGrid::cell_of(body.y, grid_.width_y());
    if (upright_) ix = std::clamp(ix, 0, last_column_);
    cell[i] = {ix, iy};
    of.image_x = CellGrid::folds_below(ix, grid_.cells_x());
    of.image_y = CellGrid::folds_below(iy, grid_.cells_y());
    body.x -= of.image_x * grid_.period().x;
    body.y -= of.image_y * grid_.period().y;
    of.mass = scene.bodies[i].mass;
    of.shape_factor = scene.bodies[i].shape_factor;
    of.material = static_cast<std::uint32_t>(scene.material[i]);
    of.last_collision = -kNever;
    of.hardest_impact = 0;
    const auto number = [](double period, std::int32_t at, std::int32_t image, std::uint32_t n) {
      return static_cast<std::uint32_t>(period > 0 ? at - image * static_cast<std::int32_t>(n)
                                                   : at) &
             0xFFFF;
    };
    key[i] = morton_number(number(grid_.period().x, ix, of.image_x, grid_.cells_x()),
                           number(grid_.period().y, iy, of.image_y, grid_.cells_y()));
  }
  std::iota(body_at_.begin(), body_at_.end(), 0u);
  std::ranges::stable_sort(body_at_, {}, [&](std::uint32_t i) { return key[i]; });
  for (std::uint32_t at = 0; at < body_at_.size(); ++at) {
    const std::uint32_t i = body_at_[at];
    place_[i] = at;
    bodies_[at] = bodies[i];
    matter_[at] = matter[i];
    radii_[at] = scene.bodies[i].radius;
    grid_.insert(at, cell[i][0], cell[i][1]);
  }
}

void PlanarWorld::find_wall_event(std::uint32_t i, double now, double& earliest, Own& own) const {
  const Box& box = *scene_->box;
  const Body& body = bodies_[i];
  const std::int32_t ix = column(i), iy = row(i);
  const double radius = radii_[i];
  const auto consider = [&](double after, Own what) {
    const double t = now + std::max(after, 0.0);
    if (t < earliest) earliest = t, own = what;
  };
  if (ix == 0 && body.vx < 0) consider((radius - body.x) / body.vx, Own::left_wall);
  if (ix == last_column_ && body.vx > 0)
    consider((box.width - radius - body.x) / body.vx, Own::right_wall);
  // In a cell that starts above its reach the floor cannot be met.
  const double A = box.floor.is_still() ? 0 : box.floor.amplitude;
  if (iy * grid_.width_y() <= A + radius)
    consider(floor_contact(box.floor, now, body.y - radius, body.vy, gravity_, earliest - now),
             Own::floor);
  if (box.lid && (iy + 1) * grid_.width_y() >= *box.lid - A - radius) {
    // Seen upside down the lid is a floor that things fall up to.
    const double gap = *box.lid - radius - body.y;
    const ShakenFloor lid = box.moving_walls ? box.floor : ShakenFloor{};
    consider(lid_contact(lid, now, gap, body.vy, gravity_, earliest - now), Own::lid);
  }
}

BodyChange PlanarWorld::meet_wall(std::uint32_t i, double now) {
  const Box& box = *scene_->box;
  const double shaken = box.floor.velocity(now) * (box.floor.is_still() ? 0 : 1);
  const double walls = box.moving_walls ? shaken : 0;
  switch (own(i)) {
    case Own::left_wall:
      meet(i, {1, 0, walls, &box.on_wall}, now);
      break;
    case Own::right_wall:
      meet(i, {-1, 0, walls, &box.on_wall}, now);
      break;
    case Own::floor:
      meet(i, {0, 1, shaken, &box.on_floor}, now);
      break;
    default:
      meet(i, {0, -1, walls, &box.on_lid}, now);
      break;
  }
  return BodyChange::path;
}

void PlanarWorld::meet(std::uint32_t i, const Surface& surface, double now) {
  Body& body = bodies_[i];
  Matter& matter = matter_[i];
  const double radius = radii_[i];
  const double vy = body.vy - surface.velocity;
  const double u_n = body.vx * surface.n_x + vy * surface.n_y;
  if (u_n >= 0) return;  // rounding
  const double u_t = -body.vx * surface.n_y + vy * surface.n_x - radius * matter.spin;
  const bool collapses = has_elastic_rule() && is_in_quick_succession(i, now);
  const PairContact& contact = collapses ? kElastic : (*surface.contacts)[matter.material];
  const bool is_slow = !has_elastic_rule() && -u_n < least_.landing;
  const double e = is_slow ? least_.landing / -u_n : restitution_at(contact.restitution, -u_n);
  const double kappa = matter.shape_factor / (1 + matter.shape_factor);
  const PlanarImpulse impulse = planar_impulse(contact, e, matter.mass, kappa, u_n, u_t);
  PlanarVelocity v{body.vx, body.vy, matter.spin};
  apply(impulse, surface.n_x, surface.n_y, radius, matter.mass, matter.shape_factor, v);
  body.vx = v.x, body.vy = v.y, matter.spin = v.spin;
  matter.last_collision = now;
  ++contacts_;
  if (collapses || is_slow) ++collapses_;
  const Vector2 push(impulse.normal * surface.n_x - impulse.tangential * surface.n_y,
                     impulse.normal * surface.n_y + impulse.tangential * surface.n_x);
  wall_impulse_ += push;
  work_ += push.y() * surface.velocity;
  dissipated_ += impulse.dissipated;
}

/// Bodies that would touch each other within the contact time collide at once.
void PlanarWorld::resolve_cluster(double now) {
  constexpr PlanarFeatures kAll;
  const double soon = now + scene_->collapse.contact_time;
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t k = 0; k < changed_.size(); ++k) {
    const std::uint32_t a = changed_[k];
    grid_.for_each_near(a, [&](std::uint32_t b, const CellGrid::Shift& shift) {
      if (!(collision_time<kAll>(a, b, now, shift) < soon)) return;
      moved_to<kAll>(b, now);
      if (std::ranges::find(changed_, b) == changed_.end()) changed_.push_back(b);
      pairs.push_back({std::min(a, b), std::max(a, b)});
    });
  }
  const auto approach = [&](const std::array<std::uint32_t, 2>& pair) {
    const Body &a = bodies_[pair[0]], &b = bodies_[pair[1]];
    const CellGrid::Shift shift = nearest_image(a, b);
    const double dx = a.x - b.x - shift.x, dy = a.y - b.y - shift.y;
    return -(dx * (a.vx - b.vx) + dy * (a.vy - b.vy)) / std::hypot(dx, dy);
  };
  collide_cluster(
      pairs, approach,
      [&](const auto& pair) {
        return least_.rebound_of(matter_[pair[0]].hardest_impact, matter_[pair[1]].hardest_impact);
      },
      [&](std::uint32_t a, std::uint32_t b) { exchange_impulse<kAll>(a, b, between(a, b)); });
}

double PlanarWorld::energy_at(double now) const {
  double energy = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& b = bodies_[i];
    const double dt = now - b.time, vy = b.vy - gravity_ * dt;
    const double y = b.y + (b.vy - 0.5 * gravity_ * dt) * dt;
    const double rim = radii_[i] * matter_[i].spin;
    energy += matter_[i].mass *
              (0.5 * (b.vx * b.vx + vy * vy + matter_[i].shape_factor * rim * rim) + gravity_ * y);
  }
  return energy;
}

Vector2 PlanarWorld::momentum_at(double now) const {
  Vector2 sum = Vector2::Zero();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& b = bodies_[i];
    sum += matter_[i].mass * Vector2(b.vx, b.vy - gravity_ * (now - b.time));
  }
  return sum;
}

}  // namespace slipcheck
