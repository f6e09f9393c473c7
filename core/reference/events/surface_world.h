#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "physics/frame.h"
#include "physics/motion/driven_phase.h"
#include "reference/events/cell_grid.h"
#include "reference/events/event_scheduler.h"
#include "reference/events/least_speeds.h"
#include "reference/events/neighbours.h"
#include "reference/events/partial_frames.h"
#include "reference/events/surface_place.h"
#include "scene/scene.h"

namespace slipcheck {

/// Bodies stay in contacts that collisions at instants and one plane for each know nothing of.
class LastingContacts : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Hard spheres beside any surfaces, but for who is near whom (SurfaceWorldOf): each in flight, on
/// a parabola, or in a DrivenPhase on the one plane or plate that carries it. Own events are the
/// ends of phases, impacts on surfaces, and edges that a body comes to. An impact is collide() with
/// a partner of infinite mass, so that what carries the body takes its part in it; on a body in
/// flight it is land(). Over an edge a body flies where v² > g_n R there, v across the edge; slower
/// it turns about the edge, which is a LastingContacts, as is a body between two surfaces.
class SurfaceWorld {
 public:
  /// Bodies in the states `initial` at the time `now` [s]. The scene must outlive this.
  /// may_show_part: where everything is level and still, sinks are asked whether they take those
  /// bodies alone that an event changes.
  SurfaceWorld(const Scene& scene, std::span<const BodyState> initial, const LeastSpeeds& least,
               double now, bool may_show_part);

  /// Why the scene is not for this, "" if it is: drilling coupled to the sliding, rolling friction
  /// of sliding bodies, plates that turn, a periodic plane.
  static std::string obstacle(const Scene& scene);

  // --- for EventScheduler ---
  std::size_t size() const { return bodies_.size(); }
  double collision_time(std::uint32_t i, std::uint32_t j, double now,
                        const CellGrid::Shift& shift) const;
  std::span<const std::uint32_t> collide(std::uint32_t i, std::uint32_t j, double now);

  // --- for whoever looks on ---
  void set_sink(FrameSink* sink) { sink_ = sink; }
  void show(double now);
  /// All bodies, where the last frame had not all of them.
  void show_the_rest(double now) {
    if (partial_.is_last_partial()) show(now);
  }
  BodyState state_at(std::uint32_t i, double now) const;
  std::size_t events() const { return events_; }
  std::size_t collisions() const { return collisions_; }
  std::size_t collapses() const { return collapses_; }
  std::size_t landings() const { return landings_; }  ///< impacts on surfaces
  double last_impact_speed() const { return last_impact_speed_; }
  bool is_any_slipping() const { return slipping_ > 0; }  ///< sliding or flying
  bool is_any_moving() const { return moving_ > 0; }
  bool is_exact_pair(std::uint32_t i, std::uint32_t j) const {
    return bodies_[i].is_parabola && bodies_[j].is_parabola;
  }

 protected:
  /// When the body's path ends [s], absolute: by its phase, at a surface or over an edge.
  double path_end(std::uint32_t i, double now);
  void end_path(std::uint32_t i, double now);
  PathPoint on_path(std::uint32_t i, double now) const;
  /// Of a parabola; its bound for other paths [m/s²].
  const Vector3& acceleration(std::uint32_t i) const { return bodies_[i].acceleration; }
  double acceleration_bound(std::uint32_t i) const { return bodies_[i].bound; }
  bool is_parabola(std::uint32_t i) const { return bodies_[i].is_parabola; }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  enum class Own { phase, hit, edge };
  struct Body {
    Vector3 position, velocity, acceleration;  ///< of a parabola, at its start
    double start = 0, end = kNever;
    double bound = 0;  ///< of the acceleration in the phase [m/s²]
    double hardest_impact = 0;
    std::size_t collapses = 0;
    std::size_t support = kNone;
    std::size_t left = kNone;  ///< the plate over whose edge it has just gone
    bool is_parabola = true;
    bool slips = false, moves = false;  ///< as counted
    std::optional<double> path_end;     ///< once it is known
    Own next = Own::phase;              ///< what then happens
    std::size_t hit = kNone;            ///< the surface of Own::hit
    BodyState flight;                   ///< at its start, where nothing carries it
  };
  SurfaceContact contact_of(std::uint32_t i, std::size_t place) const;
  double touching(std::uint32_t i) const { return 1e-9 * scene_->bodies[i].radius; }

  BodyState path_state(std::uint32_t i, double now) const;
  double find_path_end(std::uint32_t i, double now);
  double first_hit(std::uint32_t i, std::size_t k, double now, double horizon) const;
  double first_edge(std::uint32_t i, double now, double horizon) const;

  void start_path(std::uint32_t i, const BodyState& state, double now);
  void count(std::uint32_t i);
  /// A hop no higher than the rounding of places is none: with less than this [m/s].
  double slowest_hop(std::uint32_t i, const Vector3& at) const;
  /// Impacts on all surfaces that the body touches and approaches.
  void meet_surfaces(std::uint32_t i, BodyState& state, double now);
  std::size_t find_support(std::uint32_t i, const BodyState& state, double now) const;
  void hit_surface(std::uint32_t i, std::size_t k, BodyState& state, double now);
  void leave_edge(std::uint32_t i, const BodyState& state, double now);
  /// What an event is about to change or has changed.
  void show_changed(std::span<const std::uint32_t> changed, double now);
  void add_support_touch(std::uint32_t i);
  [[noreturn]] void give_up(std::uint32_t i, double now, const std::string& why) const;

  const Scene* scene_;
  LeastSpeeds least_;
  double slowest_;  ///< that counts as a speed [m/s]
  std::vector<SurfacePlace> places_;
  std::vector<Body> bodies_;
  std::vector<DrivenPhase> phases_;
  std::vector<std::uint32_t> changed_;
  std::size_t events_ = 0, collisions_ = 0, collapses_ = 0, landings_ = 0;
  std::size_t slipping_ = 0, moving_ = 0;
  double last_impact_speed_ = 0;
  FrameSink* sink_ = nullptr;
  Frame frame_;
  bool shows_part_ = false;
  PartialFrames partial_;
};

/// SurfaceWorld for EventScheduler: with AllPairs, or with PlaneCells over the scene's x and y,
/// where own events are also ways from one cell to the next.
template <class Near>
class SurfaceWorldOf final : public SurfaceWorld {
 public:
  static constexpr bool kHasCells = Near::kHasCells;

  SurfaceWorldOf(const Scene& scene, std::span<const BodyState> initial, const LeastSpeeds& least,
                 double now)
      : SurfaceWorld(scene, initial, least, now, kHasCells),
        near_(scene, initial),
        leaves_cell_(kHasCells ? initial.size() : 0) {}

  double own_event_time(std::uint32_t i, double now) {
    const double end = path_end(i, now);
    if constexpr (kHasCells) {
      const PathPoint at = on_path(i, now);
      const double leaving =
          now + (is_parabola(i) ? near_.time_to_leave(i, at.position, at.velocity, acceleration(i))
                                : near_.least_time_to_leave(i, at.position, at.velocity,
                                                            acceleration_bound(i)));
      leaves_cell_[i] = leaving < end;
      return std::min(leaving, end);
    }
    return end;
  }
  BodyChange do_own_event(std::uint32_t i, double now) {
    if constexpr (kHasCells) {
      if (leaves_cell_[i]) {
        if (!is_parabola(i) && !near_.is_at_side(i, on_path(i, now).position))
          return BodyChange::nothing;
        near_.cross(i);
        return BodyChange::cell;
      }
    }
    end_path(i, now);
    return BodyChange::path;
  }
  template <class F>
  void for_each_near(std::uint32_t i, F f) const {
    near_.for_each_near(i, f);
  }
  template <class F>
  void for_each_newly_near(std::uint32_t i, F f) const {
    near_.for_each_newly_near(i, f);
  }

  std::vector<std::string> features() const {
    return {"phases on the plane that carries a body, impacts on the other surfaces",
            kHasCells ? "neighbours in cells, a calendar queue"
                      : "all pairs, a scan for the next event"};
  }

 private:
  Near near_;
  std::vector<char> leaves_cell_;
};

}  // namespace slipcheck
