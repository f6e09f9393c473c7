#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/numbers.h"
#include "physics/planar_collision.h"
#include "physics/sphere.h"
#include "reference/cell_grid.h"
#include "reference/event_scheduler.h"
#include "scenario/hard_scene.h"

namespace slipcheck {

/// Hard spheres in a plane for EventScheduler: L's vertical box, where they fly on parabolas, or a
/// horizontal plane without friction, which may repeat itself. What is asked for each collision
/// lies in one cache line for each body.
///
/// The plane is (x, y) with gravity along −y and spins counterclockwise: the box's (x, z) with
/// spins about −y, or the substrate's own plane with spins about z.
class PlanarWorld {
 public:
  /// Bodies in the states `initial` at time 0. slowest_rebound and slowest_landing [m/s] are those
  /// of CollapseRule::Model::slowest_rebound, for pairs and for walls. The scene must outlive this.
  PlanarWorld(const HardScene& scene, std::span<const BodyState> initial, double slowest_rebound,
              double slowest_landing);

  /// Whether bodies of this scene stay in one plane in which only their collisions act on them.
  static bool is_planar(const HardScene& scene, std::span<const BodyState> initial);

  // --- for EventScheduler ---
  std::size_t size() const { return bodies_.size(); }
  double own_event_time(std::uint32_t i, double now);
  BodyChange do_own_event(std::uint32_t i, double now);
  std::span<const std::uint32_t> collide(std::uint32_t i, std::uint32_t j, double now);

  double collision_time(std::uint32_t i, std::uint32_t j, double now,
                        const CellGrid::Shift& shift) {
    const Body& a = moved_to(i, now);
    const Body& b = bodies_[j];
    // Both fall alike, so that they approach each other on straight lines.
    const double dt = now - b.time;
    const double dx = a.x - (b.x + shift.x + b.vx * dt);
    const double dy = a.y - (b.y + shift.y + (b.vy - 0.5 * gravity_ * dt) * dt);
    const double dvx = a.vx - b.vx, dvy = a.vy - (b.vy - gravity_ * dt);
    const double approach = dx * dvx + dy * dvy;
    if (approach >= 0) return kNever;
    const double contact = a.radius + b.radius;
    const double gap = dx * dx + dy * dy - contact * contact;
    if (gap <= 0) return now;
    const double square = approach * approach - (dvx * dvx + dvy * dvy) * gap;
    if (square < 0) return kNever;
    return now + gap / (std::sqrt(square) - approach);
  }

  template <class F>
  void for_each_near(std::uint32_t i, F f) const {
    grid_.for_each_near(i, f);
  }
  template <class F>
  void for_each_newly_near(std::uint32_t i, F f) const {
    grid_.for_each_newly_near(i, moved_x_, moved_y_, f);
  }

  // --- for whoever looks on ---
  /// The state of the scene's i-th body; the world has an order of its own.
  BodyState state_at(std::size_t i, double now) const;
  std::size_t collisions() const { return collisions_; }  ///< of two bodies
  std::size_t collapses() const { return collapses_; }    ///< changed by the rule for collapse
  std::size_t contacts() const { return contacts_; }      ///< with walls, floor and lid
  double dissipated() const { return dissipated_; }       ///< in collisions, by their laws [J]
  double work() const { return work_; }                   ///< of moving walls on the bodies [J]
  /// Impulse of walls, floor and lid on the bodies [N s].
  const Vector2& wall_impulse() const { return wall_impulse_; }
  /// The largest change of momentum of a pair by a collision over the impulse [-].
  double momentum_error() const { return momentum_error_; }
  /// Kinetic and potential energy [J], and momentum [kg m/s] in the plane.
  double energy_at(double now) const;
  Vector2 momentum_at(double now) const;
  /// Deepest overlap of two neighbours over the sum of their radii [-], negative if all are apart.
  double deepest_overlap(double now) const;

 private:
  enum class Own : std::uint8_t { none, left, right, down, up, left_wall, right_wall, floor, lid };

  struct alignas(64) Body {
    double x, y, vx, vy, spin;
    double time;  ///< of this state [s]
    double radius;
    std::int32_t ix, iy;  ///< cell; folded where the plane repeats itself
  };
  /// What only a collision asks for.
  struct Matter {
    double mass, shape_factor;
    double last_collision;  ///< [s]
    std::int32_t image_x = 0, image_y = 0;
    std::uint32_t material;
  };
  struct Surface {
    double n_x, n_y;  ///< towards the body
    double velocity;  ///< along y [m/s]
    const std::vector<PairContact>* contacts;
  };

  Body& moved_to(std::uint32_t i, double now) {
    Body& body = bodies_[i];
    const double dt = now - body.time;
    if (dt == 0) return body;
    body.x += body.vx * dt;
    body.y += (body.vy - 0.5 * gravity_ * dt) * dt;
    body.vy -= gravity_ * dt;
    body.time = now;
    return body;
  }
  const PairContact& between(std::uint32_t i, std::uint32_t j) const {
    const std::size_t kinds = scene_->substrate.size();
    return scene_->pairs[matter_[i].material * kinds + matter_[j].material];
  }
  CellGrid::Shift nearest_image(const Body& a, const Body& b) const;
  bool has_elastic_rule() const;  ///< that of the TC model
  bool is_in_quick_succession(std::uint32_t i, double now) const;
  /// Of two bodies that touch, or nearly; how fast they approached [m/s].
  double exchange_impulse(std::uint32_t i, std::uint32_t j, const PairContact& contact);
  void meet(std::uint32_t i, const Surface& surface, double now);
  void resolve_cluster(double now);
  void find_wall_event(std::uint32_t i, double now, double& earliest, Own& own) const;

  const HardScene* scene_;
  double gravity_;
  bool upright_;  ///< the plane is (x, z)
  double slowest_rebound_, slowest_landing_;
  std::int32_t last_column_ = 0;  ///< in a box
  CellGrid grid_;
  std::vector<std::uint32_t> place_;  ///< of the scene's bodies; neighbours lie close in memory
  std::vector<Body> bodies_;
  std::vector<Matter> matter_;
  std::vector<Own> own_;           ///< what each body's next own event is
  int moved_x_ = 0, moved_y_ = 0;  ///< of the body whose cell changed last
  std::vector<std::uint32_t> changed_;
  std::size_t collisions_ = 0, collapses_ = 0, contacts_ = 0;
  double dissipated_ = 0, work_ = 0, momentum_error_ = 0;
  Vector2 wall_impulse_ = Vector2::Zero();
};

}  // namespace slipcheck
