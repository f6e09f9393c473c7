#include "reference/planar_world.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/elastic_pair.h"
#include "reference/floor_flight.h"
#include "reference/planar_cells.h"

namespace slipcheck {
namespace {

/// Collisions that do not dissipate, as the TC model has them.
const PairContact kElastic{};

}  // namespace

bool PlanarWorld::is_planar(const HardScene& scene, std::span<const BodyState> initial) {
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

PlanarWorld::PlanarWorld(const HardScene& scene, std::span<const BodyState> initial,
                         double slowest_rebound, double slowest_landing)
    : scene_(&scene),
      gravity_(scene.box ? scene.gravity : 0),
      upright_(scene.box.has_value()),
      slowest_rebound_(slowest_rebound),
      slowest_landing_(slowest_landing),
      grid_(planar_cells(scene, initial)),
      place_(initial.size()),
      bodies_(initial.size()),
      matter_(initial.size()),
      own_(initial.size(), Own::none) {
  if (scene.box)
    last_column_ = static_cast<std::int32_t>(std::lround(scene.box->width / grid_.width_x())) - 1;
  const CellGrid::Shift& period = grid_.period();
  std::vector<std::uint64_t> key(initial.size());
  std::vector<Body> bodies(initial.size());
  std::vector<Matter> matter(initial.size());
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const BodyState& state = initial[i];
    Body& body = bodies[i];
    Matter& of = matter[i];
    const int up = upright_ ? 2 : 1;
    body = {state.position.x(),
            state.position[up],
            state.velocity.x(),
            state.velocity[up],
            upright_ ? -state.angular_velocity.y() : state.angular_velocity.z(),
            0,
            scene.bodies[i].radius,
            0,
            0};
    const auto fold = [](double& coordinate, double length) {
      if (length == 0) return 0;
      const double image = std::floor(coordinate / length);
      coordinate -= image * length;
      return static_cast<std::int32_t>(image);
    };
    of.image_x = fold(body.x, period.x);
    of.image_y = fold(body.y, period.y);
    body.ix = CellGrid::cell_of(body.x, grid_.width_x());
    body.iy = CellGrid::cell_of(body.y, grid_.width_y());
    if (upright_) body.ix = std::clamp(body.ix, 0, last_column_);
    of.mass = scene.bodies[i].mass;
    of.shape_factor = scene.bodies[i].shape_factor;
    of.material = static_cast<std::uint32_t>(scene.material[i]);
    of.last_collision = -kNever;
    key[i] = morton_number(static_cast<std::uint32_t>(body.ix) & 0xFFFF,
                           static_cast<std::uint32_t>(body.iy) & 0xFFFF);
  }
  std::vector<std::uint32_t> order(initial.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return key[i]; });
  for (std::uint32_t at = 0; at < order.size(); ++at) {
    place_[order[at]] = at;
    bodies_[at] = bodies[order[at]];
    matter_[at] = matter[order[at]];
    grid_.insert(at, bodies_[at].ix, bodies_[at].iy);
  }
}

double PlanarWorld::own_event_time(std::uint32_t i, double now) {
  const Body& body = moved_to(i, now);
  Own own = Own::none;
  double earliest = kNever;
  const auto consider = [&](double after, Own what) {
    const double t = now + std::max(after, 0.0);
    if (t < earliest) earliest = t, own = what;
  };
  if (body.vx < 0 && !(upright_ && body.ix == 0))
    consider((body.ix * grid_.width_x() - body.x) / body.vx, Own::left);
  else if (body.vx > 0 && !(upright_ && body.ix == last_column_))
    consider(((body.ix + 1) * grid_.width_x() - body.x) / body.vx, Own::right);

  const double above = std::max((body.iy + 1) * grid_.width_y() - body.y, 0.0);
  const double below = std::max(body.y - body.iy * grid_.width_y(), 0.0);
  const double square = body.vy * body.vy - 2 * gravity_ * above;
  if (body.vy > 0 && square >= 0) {
    consider(2 * above / (body.vy + std::sqrt(square)), Own::up);
  } else if (gravity_ > 0 || body.vy < 0) {
    const double root = std::sqrt(body.vy * body.vy + 2 * gravity_ * below);
    consider(
        body.vy > 0 ? (body.vy + root) / gravity_ : 2 * below / std::max(root - body.vy, 1e-300),
        Own::down);
  }
  if (upright_) find_wall_event(i, now, earliest, own);
  own_[i] = own;
  return earliest;
}

void PlanarWorld::find_wall_event(std::uint32_t i, double now, double& earliest, Own& own) const {
  const Box& box = *scene_->box;
  const Body& body = bodies_[i];
  const auto consider = [&](double after, Own what) {
    const double t = now + std::max(after, 0.0);
    if (t < earliest) earliest = t, own = what;
  };
  if (body.ix == 0 && body.vx < 0) consider((body.radius - body.x) / body.vx, Own::left_wall);
  if (body.ix == last_column_ && body.vx > 0)
    consider((box.width - body.radius - body.x) / body.vx, Own::right_wall);
  // In a cell that starts above its reach the floor cannot be met.
  const double A = box.floor.is_still() ? 0 : box.floor.amplitude;
  if (body.iy * grid_.width_y() <= A + body.radius)
    consider(floor_contact(box.floor, now, body.y - body.radius, body.vy, gravity_, earliest - now),
             Own::floor);
  if (box.lid && (body.iy + 1) * grid_.width_y() >= *box.lid - A - body.radius) {
    // Seen upside down the lid is a floor that things fall up to.
    const double gap = *box.lid - body.radius - body.y;
    const ShakenFloor lid = box.moving_walls ? box.floor : ShakenFloor{};
    consider(lid_contact(lid, now, gap, body.vy, gravity_, earliest - now), Own::lid);
  }
}

BodyChange PlanarWorld::do_own_event(std::uint32_t i, double now) {
  Body& body = moved_to(i, now);
  const CellGrid::Shift& period = grid_.period();
  const auto cross = [&](std::int32_t& cell, int step, double& coordinate, double length,
                         std::uint32_t cells, std::int32_t& image) {
    cell += step;
    if (length == 0) return;
    const auto n = static_cast<std::int32_t>(cells);
    if (cell < 0) cell += n, coordinate += length, --image;
    if (cell >= n) cell -= n, coordinate -= length, ++image;
  };
  const auto cross_x = [&](int step) {
    cross(body.ix, step, body.x, period.x, grid_.cells_x(), matter_[i].image_x);
    grid_.move(i, moved_x_ = step, moved_y_ = 0);
    return BodyChange::cell;
  };
  const auto cross_y = [&](int step) {
    cross(body.iy, step, body.y, period.y, grid_.cells_y(), matter_[i].image_y);
    grid_.move(i, moved_x_ = 0, moved_y_ = step);
    return BodyChange::cell;
  };
  switch (own_[i]) {
    case Own::left:
      return cross_x(-1);
    case Own::right:
      return cross_x(+1);
    case Own::down:
      return cross_y(-1);
    case Own::up:
      return cross_y(+1);
    case Own::none:
      return BodyChange::nothing;
    case Own::left_wall:
    case Own::right_wall:
    case Own::floor:
    case Own::lid:
      break;
  }
  const Box& box = *scene_->box;
  const double shaken = box.floor.velocity(now) * (box.floor.is_still() ? 0 : 1);
  const double walls = box.moving_walls ? shaken : 0;
  switch (own_[i]) {
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

bool PlanarWorld::has_elastic_rule() const {
  return scene_->collapse.model == CollapseRule::Model::contact_time;
}

bool PlanarWorld::is_in_quick_succession(std::uint32_t i, double now) const {
  return now - matter_[i].last_collision < scene_->collapse.contact_time;
}

void PlanarWorld::meet(std::uint32_t i, const Surface& surface, double now) {
  Body& body = bodies_[i];
  Matter& matter = matter_[i];
  const double vy = body.vy - surface.velocity;
  const double u_n = body.vx * surface.n_x + vy * surface.n_y;
  if (u_n >= 0) return;  // rounding
  const double u_t = -body.vx * surface.n_y + vy * surface.n_x - body.radius * body.spin;
  const bool collapses = has_elastic_rule() && is_in_quick_succession(i, now);
  const PairContact& contact = collapses ? kElastic : (*surface.contacts)[matter.material];
  const bool is_slow = !has_elastic_rule() && -u_n < slowest_landing_;
  const double kappa = matter.shape_factor / (1 + matter.shape_factor);
  const PlanarImpulse impulse =
      planar_impulse(contact, matter.mass, kappa, u_n, u_t, is_slow ? slowest_landing_ : 0);
  PlanarVelocity v{body.vx, body.vy, body.spin};
  apply(impulse, surface.n_x, surface.n_y, body.radius, matter.mass, matter.shape_factor, v);
  body.vx = v.x, body.vy = v.y, body.spin = v.spin;
  matter.last_collision = now;
  ++contacts_;
  if (collapses || is_slow) ++collapses_;
  const Vector2 push(impulse.normal * surface.n_x - impulse.tangential * surface.n_y,
                     impulse.normal * surface.n_y + impulse.tangential * surface.n_x);
  wall_impulse_ += push;
  work_ += push.y() * surface.velocity;
  dissipated_ += impulse.dissipated;
}

CellGrid::Shift PlanarWorld::nearest_image(const Body& a, const Body& b) const {
  const CellGrid::Shift& period = grid_.period();
  CellGrid::Shift shift;
  if (period.x > 0) shift.x = period.x * std::round((a.x - b.x) / period.x);
  if (period.y > 0) shift.y = period.y * std::round((a.y - b.y) / period.y);
  return shift;
}

double PlanarWorld::exchange_impulse(std::uint32_t i, std::uint32_t j, const PairContact& contact) {
  Body &a = bodies_[i], &b = bodies_[j];
  const Matter &of_a = matter_[i], &of_b = matter_[j];
  const CellGrid::Shift shift = nearest_image(a, b);
  const double dx = a.x - (b.x + shift.x), dy = a.y - (b.y + shift.y);
  const double per_distance = 1 / std::sqrt(dx * dx + dy * dy);
  const double n_x = dx * per_distance, n_y = dy * per_distance;
  const double dvx = a.vx - b.vx, dvy = a.vy - b.vy;
  const double u_n = dvx * n_x + dvy * n_y;
  if (u_n >= 0) return 0;  // rounding
  const double u_t = dvy * n_x - dvx * n_y - a.radius * a.spin - b.radius * b.spin;
  const Sphere first{a.radius, of_a.mass, of_a.shape_factor};
  const Sphere second{b.radius, of_b.mass, of_b.shape_factor};
  const bool is_slow = !has_elastic_rule() && -u_n < slowest_rebound_;
  PlanarImpulse impulse =
      planar_impulse(contact, effective_mass(first, second), tangential_mass_ratio(first, second),
                     u_n, u_t, is_slow ? slowest_rebound_ : 0);
  // That n is a unit vector but for rounding must not add up over many collisions.
  impulse.normal *= 2 - (n_x * n_x + n_y * n_y);
  if (is_slow) ++collapses_;
  PlanarVelocity v{a.vx, a.vy, a.spin}, w{b.vx, b.vy, b.spin};
  apply(impulse, n_x, n_y, a.radius, of_a.mass, of_a.shape_factor, v);
  apply(impulse, -n_x, -n_y, b.radius, of_b.mass, of_b.shape_factor, w);
  const double change_x = of_a.mass * (v.x - a.vx) + of_b.mass * (w.x - b.vx);
  const double change_y = of_a.mass * (v.y - a.vy) + of_b.mass * (w.y - b.vy);
  const double size = std::max(
      {of_a.mass * std::hypot(a.vx, a.vy), of_b.mass * std::hypot(b.vx, b.vy), impulse.normal});
  momentum_error_ =
      std::max({momentum_error_, std::abs(change_x) / size, std::abs(change_y) / size});
  a.vx = v.x, a.vy = v.y, a.spin = v.spin;
  b.vx = w.x, b.vy = w.y, b.spin = w.spin;
  dissipated_ += impulse.dissipated;
  ++collisions_;
  return -u_n;
}

std::span<const std::uint32_t> PlanarWorld::collide(std::uint32_t i, std::uint32_t j, double now) {
  moved_to(i, now);
  moved_to(j, now);
  changed_.assign({i, j});
  const bool is_quick = is_in_quick_succession(i, now) || is_in_quick_succession(j, now);
  if (is_quick) ++collapses_;
  exchange_impulse(i, j, is_quick && has_elastic_rule() ? kElastic : between(i, j));
  if (is_quick && !has_elastic_rule()) resolve_cluster(now);
  for (std::uint32_t k : changed_) matter_[k].last_collision = now;
  return changed_;
}

/// Bodies that would touch each other within the contact time collide at once, always the pair that
/// approaches fastest, until none approaches faster than a pair is made to part.
void PlanarWorld::resolve_cluster(double now) {
  const double soon = now + scene_->collapse.contact_time;
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t k = 0; k < changed_.size(); ++k) {
    const std::uint32_t a = changed_[k];
    for_each_near(a, [&](std::uint32_t b, const CellGrid::Shift& shift) {
      if (!(collision_time(a, b, now, shift) < soon)) return;
      moved_to(b, now);
      if (std::ranges::find(changed_, b) == changed_.end()) changed_.push_back(b);
      pairs.push_back({std::min(a, b), std::max(a, b)});
    });
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  const auto approach = [&](const std::array<std::uint32_t, 2>& pair) {
    const Body &a = bodies_[pair[0]], &b = bodies_[pair[1]];
    const CellGrid::Shift shift = nearest_image(a, b);
    const double dx = a.x - b.x - shift.x, dy = a.y - b.y - shift.y;
    return -(dx * (a.vx - b.vx) + dy * (a.vy - b.vy)) / std::hypot(dx, dy);
  };
  // Each turn takes energy from the cluster, or parts a pair where e = 1.
  for (std::size_t turn = 0; turn < 1000 * pairs.size(); ++turn) {
    const auto fastest = std::ranges::max_element(pairs, {}, approach);
    const auto [a, b] = *fastest;
    if (approach(*fastest) <= slowest_rebound_ || exchange_impulse(a, b, between(a, b)) == 0)
      return;
  }
}

BodyState PlanarWorld::state_at(std::size_t body, double now) const {
  const std::uint32_t i = place_[body];
  const Body& b = bodies_[i];
  const double dt = now - b.time;
  const double x = b.x + b.vx * dt + matter_[i].image_x * grid_.period().x;
  const double y = b.y + (b.vy - 0.5 * gravity_ * dt) * dt + matter_[i].image_y * grid_.period().y;
  const double vy = b.vy - gravity_ * dt;
  if (upright_) return {{x, 0, y}, {b.vx, 0, vy}, {0, -b.spin, 0}};
  return {{x, y, b.radius}, {b.vx, vy, 0}, {0, 0, b.spin}};
}

double PlanarWorld::energy_at(double now) const {
  double energy = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& b = bodies_[i];
    const double dt = now - b.time, vy = b.vy - gravity_ * dt;
    const double y = b.y + (b.vy - 0.5 * gravity_ * dt) * dt;
    const double rim = b.radius * b.spin;
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

double PlanarWorld::deepest_overlap(double now) const {
  double deepest = -kNever;
  const auto at = [&](const Body& b) {
    const double dt = now - b.time;
    return Vector2(b.x + b.vx * dt, b.y + (b.vy - 0.5 * gravity_ * dt) * dt);
  };
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    const Vector2 x = at(bodies_[i]);
    for_each_near(i, [&](std::uint32_t j, const CellGrid::Shift& shift) {
      const double contact = bodies_[i].radius + bodies_[j].radius;
      const double distance = (x - at(bodies_[j]) - Vector2(shift.x, shift.y)).norm();
      deepest = std::max(deepest, 1 - distance / contact);
    });
  }
  return deepest;
}

}  // namespace slipcheck
