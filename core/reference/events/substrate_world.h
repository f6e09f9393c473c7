#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "physics/frame.h"
#include "physics/motion/driven_phase.h"
#include "physics/motion/substrate_phase.h"
#include "physics/numbers.h"
#include "reference/events/event_scheduler.h"
#include "reference/events/least_speeds.h"
#include "reference/events/neighbours.h"
#include "reference/events/partial_frames.h"
#include "reference/events/path_collision.h"
#include "scene/scene.h"

namespace slipcheck {

/// Hard spheres on a substrate for EventScheduler, each in a phase with a solution of its own:
/// SubstratePhase on a still, level plane, DrivenPhase on a tilted or moving one. Own events are
/// the ends of phases (landings among them) and, where Near has cells, crossing from one to the
/// next.
template <class Phase, class Near>
class SubstrateWorld {
 public:
  using PhaseType = Phase;

  /// Bodies in the states `initial`, unfolded, at the time `now` [s]. The scene must outlive this.
  SubstrateWorld(const Scene& scene, std::span<const BodyState> initial, const LeastSpeeds& least,
                 double now);

  // --- for EventScheduler ---
  std::size_t size() const { return bodies_.size(); }
  double own_event_time(std::uint32_t i, double now);
  BodyChange do_own_event(std::uint32_t i, double now);
  /// On paths that are no parabolas maybe a time before which the two do not collide; collide()
  /// then changes nothing.
  double collision_time(std::uint32_t i, std::uint32_t j, double now,
                        const CellGrid::Shift& shift) const;
  std::span<const std::uint32_t> collide(std::uint32_t i, std::uint32_t j, double now);
  template <class F>
  void for_each_near(std::uint32_t i, F f) const {
    near_.for_each_near(i, f);
  }
  template <class F>
  void for_each_newly_near(std::uint32_t i, F f) const {
    near_.for_each_newly_near(i, f);
  }

  // --- for whoever looks on ---
  /// Shown the frames before and after each event from now on; maybe nobody. Of many bodies on a
  /// still, level plane those alone that the event changes, where it takes these.
  void set_sink(FrameSink* sink) { sink_ = sink; }
  void show(double now);
  /// All bodies, where the last frame had not all of them.
  void show_the_rest(double now) {
    if (partial_.is_last_partial()) show(now);
  }
  BodyState state_at(std::uint32_t i, double now) const;  ///< unfolded
  std::size_t events() const { return events_; }          ///< collisions and ends of phases
  std::size_t collisions() const { return collisions_; }  ///< of two bodies
  std::size_t collapses() const { return collapses_; }    ///< changed by the rule for collapse
  std::size_t landings() const { return landings_; }
  double last_impact_speed() const {
    return last_impact_speed_;
  }                                                       ///< of the last pair or landing [m/s]
  bool is_any_slipping() const { return slipping_ > 0; }  ///< sliding or flying
  bool is_any_moving() const { return moving_ > 0; }      ///< not SubstratePhase::is_at_rest
  static constexpr bool kHasCells = Near::kHasCells;
  /// Both paths are parabolas: collision_time() is no mere bound.
  bool is_exact_pair(std::uint32_t i, std::uint32_t j) const {
    return bodies_[i].is_parabola && bodies_[j].is_parabola;
  }
  static constexpr bool kIsStill = std::is_same_v<Phase, SubstratePhase>;

 private:
  using Kind = typename Phase::Kind;

  /// What is asked for at each look at a pair: two cache lines.
  struct alignas(64) Body {
    Vector3 position, velocity, acceleration;  ///< of a parabola, at its start
    double start = 0, end = 0;                 ///< of the phase [s], absolute
    double radius = 0;
    double bound = 0;  ///< of the acceleration in the phase [m/s²]
    double last_collision = -kNever;
    double hardest_impact = 0;  ///< the normal speed of its collisions so far [m/s]
    bool is_parabola = true, is_at_rest = true;
    bool leaves_cell = false;  ///< before its phase ends
  };
  Phase phase_of(std::uint32_t i, const BodyState& state, double now) const;
  /// v_S [m/s]; zero where the plane is still.
  Vector3 substrate_velocity(double now) const;
  /// From a state in the coordinates of the body's last path.
  void set_state(std::uint32_t i, BodyState state, double now);
  void count(std::uint32_t i, bool is_there);
  PathPoint on_path(std::uint32_t i, double now) const;
  double least_time_to_touch(std::uint32_t i, std::uint32_t j, double now, double horizon,
                             const CellGrid::Shift& shift) const;
  Vector3 to_near(const Vector3& x_i, const Vector3& x_j) const;
  bool is_in_quick_succession(std::uint32_t i, double now) const {
    return now - bodies_[i].last_collision < scene_->collapse.contact_time;
  }
  BodyState path_state(std::uint32_t i, double now) const {
    return phases_[i].at(now - bodies_[i].start);
  }
  /// At which these two part at least [m/s].
  double slowest_rebound(std::uint32_t i, std::uint32_t j) const {
    return least_.rebound_of(bodies_[i].hardest_impact, bodies_[j].hardest_impact);
  }
  /// Of the bodies at two places of `changed_`, which touch, or nearly; by their law or elastic.
  void exchange_impulse(std::size_t first, std::size_t second, bool elastic, double now);
  void resolve_cluster(double now);
  void land_body(std::uint32_t i, BodyState& state, double now);
  Touch substrate_touch(std::uint32_t i) const;
  /// What an event is about to change or has changed; all bodies, where it may draw in more.
  void show_changed(std::span<const std::uint32_t> changed, double now, bool is_all_known = true);

  const Scene* scene_;
  LeastSpeeds least_;
  Near near_;
  std::vector<Body> bodies_;
  std::vector<Phase> phases_;
  std::vector<std::uint32_t> changed_;  ///< in one instant
  std::vector<BodyState> states_;       ///< of these, before they have new paths
  std::size_t events_ = 0, collisions_ = 0, collapses_ = 0, landings_ = 0;
  std::size_t slipping_ = 0, moving_ = 0;
  double last_impact_speed_ = 0;
  bool was_altered_ = false;  ///< the last collision, by LeastSpeeds
  FrameSink* sink_ = nullptr;
  Frame frame_;
  static constexpr bool kShowsPart = kHasCells && kIsStill;
  PartialFrames partial_;
};

extern template class SubstrateWorld<SubstratePhase, AllPairs>;
extern template class SubstrateWorld<SubstratePhase, PlaneCells>;
extern template class SubstrateWorld<DrivenPhase, AllPairs>;
extern template class SubstrateWorld<DrivenPhase, PlaneCells>;

}  // namespace slipcheck
