#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/contact/planar_collision.h"
#include "physics/frame.h"
#include "physics/numbers.h"
#include "physics/sphere.h"
#include "reference/events/cell_grid.h"
#include "reference/events/event_scheduler.h"
#include "reference/events/huge_pages.h"
#include "reference/events/least_speeds.h"
#include "reference/events/prefetch.h"
#include "scene/scene.h"

namespace slipcheck {

/// What a scene in a plane may have. A loop over events for scenes that lack something leaves out
/// what cannot change a bit of their results.
struct PlanarFeatures {
  bool box = true;    ///< gravity in the plane, walls, floor and lid
  bool radii = true;  ///< more than one
  bool spin = true;   ///< friction between bodies

  bool operator==(const PlanarFeatures&) const = default;
};

/// Hard spheres in a plane for EventScheduler: L's vertical box, where they fly on parabolas, or a
/// horizontal plane without friction, which may repeat itself. What is asked for each collision
/// lies in one cache line for each body, with its plans; what only its own events ask for in
/// another.
///
/// The plane is (x, y) with gravity along −y and spins counterclockwise: the box's (x, z) with
/// spins about −y, or the substrate's own plane with spins about z.
class PlanarWorld {
 public:
  /// Bodies in the states `initial` at time 0. `least` is for CollapseRule::Model::slowest_rebound:
  /// the landing is one on a wall, and in a box only a pair that also meets slower than the rebound
  /// parts that fast. The scene must outlive this.
  PlanarWorld(const Scene& scene, std::span<const BodyState> initial, const LeastSpeeds& least);

  /// Whether bodies of this scene stay in one plane in which only their collisions act on them.
  static bool is_planar(const Scene& scene, std::span<const BodyState> initial);

  /// What a scene has, of those that there is a loop for.
  static PlanarFeatures features(const Scene& scene);

  // --- for EventScheduler; planar_loop.h has what is not here ---
  std::size_t size() const { return bodies_.size(); }
  EventPlan& plan(std::uint32_t i) { return bodies_[i].plan; }
  // Into the caches: a body; once it is there, what its next event changes, and the cells that this
  // looks at; and the bodies in these.
  void prefetch(std::uint32_t i) const {
    slipcheck::prefetch(&bodies_[i]);
    grid_.prefetch(i);
  }
  void prefetch_cells(std::uint32_t i) const {
    const auto [dx, dy] = next_step(i);
    grid_.prefetch_cells(i, dx, dy);
    const EventPlan& plan = bodies_[i].plan;
    slipcheck::prefetch(plan.own <= plan.collision ? static_cast<const void*>(&plan) : &matter_[i]);
  }
  void prefetch_neighbours(std::uint32_t i) const {
    const auto [dx, dy] = next_step(i);
    grid_.for_most_near(i, dx, dy, [&](std::uint32_t j) { slipcheck::prefetch(&bodies_[j]); });
  }
  template <PlanarFeatures kHas = PlanarFeatures{}>
  double own_event_time(std::uint32_t i, double now);
  template <PlanarFeatures kHas = PlanarFeatures{}>
  BodyChange do_own_event(std::uint32_t i, double now);
  template <PlanarFeatures kHas = PlanarFeatures{}>
  std::span<const std::uint32_t> collide(std::uint32_t i, std::uint32_t j, double now);
  template <PlanarFeatures kHas = PlanarFeatures{}>
  EventPlan first_collision(std::uint32_t i, double now, double before, Neighbourhood neighbours);

  // --- for whoever looks on ---
  /// Shown the frames before and after each collision of two bodies from now on, partial ones if it
  /// takes them; maybe nobody. For a plane: in a box walls change paths too.
  void set_sink(FrameSink* sink) { sink_ = sink; }
  /// A frame of all bodies. On a plane they touch the substrate.
  void show(double now, FrameSink& sink);
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

 private:
  enum class Own : std::uint32_t { none, left, right, down, up, left_wall, right_wall, floor, lid };

  struct alignas(64) Body {
    double x, y, vx, vy;
    double time;  ///< of this state [s]
    EventPlan plan;
  };
  static_assert(sizeof(Body) == 64);
  /// What only its collisions ask for, and borders where the cells' numbers begin again.
  struct alignas(64) Matter {
    double spin;
    double mass, shape_factor;
    double last_collision;                  ///< [s]
    double hardest_impact;                  ///< with another body so far, its normal speed [m/s]
    std::int32_t image_x = 0, image_y = 0;  ///< how often its cell's numbers were folded
    std::uint32_t material;
  };
  static_assert(sizeof(Matter) == 64);
  /// Collisions that do not dissipate, as the TC model has them.
  static const PairContact kElastic;
  struct Surface {
    double n_x, n_y;  ///< towards the body
    double velocity;  ///< along y [m/s]
    const std::vector<PairContact>* contacts;
  };

  struct Step {
    int x, y;
  };
  /// To another cell, in the body's next event as it is planned; (0, 0) if it stays.
  Step next_step(std::uint32_t i) const {
    static constexpr std::array<Step, 9> kStep{{{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    const EventPlan& plan = bodies_[i].plan;
    // A coin toss: no branch.
    return kStep[plan.own_kind * static_cast<std::uint32_t>(plan.own <= plan.collision)];
  }
  Own own(std::uint32_t i) const { return static_cast<Own>(bodies_[i].plan.own_kind); }
  // The cell that a body is in, as its position counts them.
  std::int32_t column(std::uint32_t i) const {
    const auto x = static_cast<std::int32_t>(grid_.x_of(i));
    return grid_.period().x > 0
               ? x
               : x + matter_[i].image_x * static_cast<std::int32_t>(grid_.cells_x());
  }
  std::int32_t row(std::uint32_t i) const {
    const auto y = static_cast<std::int32_t>(grid_.y_of(i));
    return grid_.period().y > 0
               ? y
               : y + matter_[i].image_y * static_cast<std::int32_t>(grid_.cells_y());
  }
  template <PlanarFeatures kHas>
  Body& moved_to(std::uint32_t i, double now) {
    Body& body = bodies_[i];
    const double dt = now - body.time;
    if (dt == 0) return body;
    body.x += body.vx * dt;
    if constexpr (kHas.box) {
      body.y += (body.vy - 0.5 * gravity_ * dt) * dt;
      body.vy -= gravity_ * dt;
    } else {
      body.y += body.vy * dt;
    }
    body.time = now;
    return body;
  }
  /// When they touch [s], absolute, or infinite; a has moved to `now`.
  template <PlanarFeatures kHas>
  double collision_time(std::uint32_t i, std::uint32_t j, double now,
                        const CellGrid::Shift& shift) const;
  template <PlanarFeatures kHas>
  double radius_of(std::uint32_t i) const {
    return kHas.radii ? radii_[i] : radius_;
  }
  const PairContact& between(std::uint32_t i, std::uint32_t j) const {
    const std::size_t kinds = scene_->substrate.size();
    return scene_->pairs[matter_[i].material * kinds + matter_[j].material];
  }
  /// What to add to b's position so that it is near a.
  CellGrid::Shift nearest_image(const Body& a, const Body& b) const {
    const auto shift = [](double distance, double period) {
      return std::abs(distance) > 0.25 * period ? period * std::round(distance / period) : 0;
    };
    const CellGrid::Shift& period = grid_.period();
    return {period.x > 0 ? shift(a.x - b.x, period.x) : 0,
            period.y > 0 ? shift(a.y - b.y, period.y) : 0};
  }
  bool has_elastic_rule() const {  ///< that of the TC model
    return scene_->collapse.model == CollapseRule::Model::contact_time;
  }
  bool is_in_quick_succession(std::uint32_t i, double now) const {
    return now - matter_[i].last_collision < scene_->collapse.contact_time;
  }
  /// Of two bodies that touch, or nearly; how fast they approached [m/s].
  template <PlanarFeatures kHas>
  double exchange_impulse(std::uint32_t i, std::uint32_t j, const PairContact& contact);
  BodyChange meet_wall(std::uint32_t i, double now);
  void meet(std::uint32_t i, const Surface& surface, double now);
  void resolve_cluster(double now);
  void show_changed(double now, bool is_all_known);
  /// That the body touches the substrate; frames of the reference do not say how hard.
  Touch substrate_touch(std::size_t i) const {
    return {static_cast<int>(i), kSubstrate, scene_->bodies[i].mass};
  }
  void note_touch(std::uint32_t i, std::uint32_t j, const PlanarImpulse& impulse);
  void find_wall_event(std::uint32_t i, double now, double& earliest, Own& own) const;

  const Scene* scene_;
  double gravity_;
  bool upright_;  ///< the plane is (x, z)
  LeastSpeeds least_;
  std::int32_t last_column_ = 0;  ///< in a box
  CellGrid grid_;
  std::vector<std::uint32_t> place_;    ///< of the scene's bodies; neighbours lie close in memory
  std::vector<std::uint32_t> body_at_;  ///< the other way round
  std::vector<Body, HugePages<Body>> bodies_;
  std::vector<Matter, HugePages<Matter>> matter_;
  std::vector<double, HugePages<double>> radii_;
  double radius_;          ///< of all, where they are the same [m]
  double contact_square_;  ///< of the distance at contact then [m²]
  CellGrid::Around around_;
  int moved_x_ = 0, moved_y_ = 0;  ///< of the body whose cell changed last
  std::vector<std::uint32_t> changed_;
  std::size_t collisions_ = 0, collapses_ = 0, contacts_ = 0;
  double dissipated_ = 0, work_ = 0, momentum_error_ = 0;
  Vector2 wall_impulse_ = Vector2::Zero();
  FrameSink* sink_ = nullptr;
  Frame frame_;
  std::vector<std::size_t> shown_;  ///< in the last partial frame
  std::vector<BodyState> states_;   ///< of these
  std::vector<Touch> touches_;      ///< of two bodies in this collision
};

}  // namespace slipcheck
