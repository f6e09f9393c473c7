#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "physics/frame.h"
#include "physics/substrate_phase.h"
#include "scenario/hard_scene.h"

namespace slipcheck {

/// When a run ends.
struct RunEnd {
  Run::Until until = Run::Until::rolling;
  double time = 0;   ///< [s], for Until::time
  double limit = 0;  ///< [s]: the run has failed if it comes to this first
};

struct EventSettings {
  /// A pair that meets slower than this fraction of the scene's speed parts with it, so that an
  /// endless cascade of ever weaker collisions (inelastic collapse) stays finite.
  double collapse_fraction = 1e-6;
  /// A landing that would rebound slower than this fraction of the scene's speed does not.
  double landing_fraction = 1e-10;
  std::size_t max_events = 20'000'000;
};

struct EventRun {
  double end_time = 0;         ///< [s]
  bool reached = false;        ///< what RunEnd::until asks for
  std::string reason;          ///< why not
  std::size_t events = 0;      ///< collisions, landings and ends of phases
  std::size_t collisions = 0;  ///< of two bodies
  std::size_t collapses = 0;   ///< of these, the ones below the collapse speed
};

/// Hard spheres on a still, level substrate, from event to event: collisions at the roots of the
/// exact paths, and between them the exact phases of sliding, rolling, drilling, flight and rest
/// (SubstratePhase). Nothing is stepped; the only errors are of rounding.
class EventSolver {
 public:
  EventSolver(const HardScene& scene, std::span<const BodyState> initial,
              const EventSettings& settings = {});

  /// Runs from time 0 and shows `sink`, where given, the frames before and after each event.
  EventRun run(const RunEnd& end, FrameSink* sink);

  /// The time [s] of the first collision of two bodies or landing on the substrate, or infinity
  /// where none comes before `limit` [s]. Leaves the solver as it is.
  double first_contact(double limit) const;

  /// The same for collisions of two bodies alone that meet at `slowest` [m/s] or faster.
  double next_collision(double limit, double slowest = 0) const;

  /// All bodies' states now.
  std::vector<BodyState> states() const;
  double now() const { return now_; }

 private:
  struct Moving {
    SubstratePhase phase;
    double start = 0;  ///< of the phase [s]
    double next_collision = 0;
    std::size_t partner = 0;
    double phase_end() const { return start + phase.duration(); }
  };
  struct Event {
    double time;
    std::size_t body;
    bool is_collision;
  };

  BodyState state_of(std::size_t i) const;
  void set_state(std::size_t i, const BodyState& state);
  double collision_time(std::size_t i, std::size_t j) const;
  double approach_speed(std::size_t i, std::size_t j) const;
  double searched_collision_time(std::size_t i, std::size_t j, double horizon) const;
  void predict_for(std::size_t i);
  void predict_after_change(std::span<const std::size_t> changed);
  Event next_event() const;
  bool has_ended(const RunEnd& end) const;
  void handle(const Event& event, FrameSink* sink, EventRun& run);
  void handle_collision(std::size_t i, FrameSink* sink, EventRun& run);
  void handle_phase_end(std::size_t i, FrameSink* sink);
  Touch substrate_touch(std::size_t i) const;
  void show(FrameSink* sink);

  const HardScene* scene_;
  EventSettings settings_;
  double collapse_speed_ = 0;
  double landing_speed_ = 0;
  double now_ = 0;
  std::vector<Moving> bodies_;
  Frame frame_;
};

/// The largest speed that the bodies bring with them [m/s]: of centres, of surfaces, and of the
/// fall to the plane; of the substrate's motion, and of a fall through a radius down its tilt.
/// Scales what counts as small.
double speed_scale(const HardScene& scene, std::span<const BodyState> states);

}  // namespace slipcheck
