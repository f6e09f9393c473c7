#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "physics/frame.h"
#include "reference/solver.h"
#include "scene/scene.h"

namespace slipcheck {

struct EventSettings {
  /// A pair parts at least with this fraction of the largest normal speed at which one of the two
  /// has met another body so far, so that an endless cascade of ever weaker collisions (inelastic
  /// collapse) stays finite. What happens elsewhere has no part in it.
  double collapse_fraction = 1e-6;
  /// A landing that would rebound slower than this fraction of the scene's speed does not.
  double landing_fraction = 1e-10;
  double start = 0;  ///< time of the initial states [s]
  /// More events for each body and simulated second [1/s], > 0, than any rule for collapse can
  /// still be said to keep finite: the run stops with a reason.
  double most_events = 1e7;
  /// Every pair parts at least so fast [m/s], >= 0: for a look ahead that asks for harder impacts.
  double slowest_rebound = 0;
  /// Looked at over so many events, and 1000 for each body, that no harmless burst counts; > 0.
  std::size_t burst = 1'000'000;
  /// More collisions, and 1000 for each body where there are many, that the rule for collapse
  /// changed, where friction can press bodies together, are no cascade that ends: they stay in
  /// contact, and the run stops with a reason.
  std::size_t most_collapses = 1'000'000;
  /// Takes the phases of a tilted and moving plane on any plane.
  bool general = false;
  /// Up to this many bodies on an unbounded plane are each other's neighbours; more have cells.
  std::size_t most_without_cells = 24;
};

/// Hard spheres on a substrate, from event to event: collisions at the roots of the exact paths,
/// and between them the phases of sliding, rolling, drilling, flight and rest, exact on a still,
/// level plane (SubstratePhase), and to the bound that DrivenPhase states on a tilted or moving
/// one. Nothing is stepped; on a still, level plane the only errors are of rounding. The cost of an
/// event does not grow with the number of bodies (SubstrateWorld, EventScheduler), nor, on a still,
/// level plane, that of showing it to a sink that takes partial frames.
///
/// On a plane that repeats itself states are unfolded: they go on across the border.
class EventSolver final : public LookingSolver {
 public:
  /// `scene` has a substrate and must outlive the solver; can_solve() holds.
  EventSolver(const Scene& scene, std::span<const BodyState> initial,
              const EventSettings& settings = {});
  EventSolver(const EventSolver& other);
  EventSolver& operator=(const EventSolver& other);
  EventSolver(EventSolver&&) noexcept;
  EventSolver& operator=(EventSolver&&) noexcept;
  ~EventSolver() override;

  /// Whether there are phases for what the substrate does to bodies.
  static bool can_solve(const Scene& scene);
  /// Whether these phases are exact: the substrate is level and still.
  static bool is_exact(const Scene& scene);

  /// Runs on to the end and shows `sink`, where given, the frames before and after each event.
  ///
  /// Until::rolling and Until::rest ask, whenever nothing slides or flies (moves), whether a
  /// collision still comes before the limit. The answer is found once and holds until that
  /// collision; many bodies on an unbounded plane that accelerates some more than others are then
  /// looked at in all pairs.
  SolvedRun run(const RunEnd& end, FrameSink* sink) override;

  // Both leave the solver as it is.
  double first_contact(double limit) override;
  double next_collision(double limit, double slowest) override;
  /// The same for whatever a body meets: another one, the plane or a surface.
  double next_impact(double limit, double slowest);

  std::vector<BodyState> states() const override;
  double now() const override;
  std::vector<std::string> features() const override;

 private:
  class Engine;
  template <class World, class Queue>
  class EngineOf;

  std::unique_ptr<Engine> engine_;
};

/// The largest speed that the bodies bring with them [m/s]: of centres, of surfaces, and of the
/// fall to the plane; of the substrate's motion, and of a fall through a radius down its tilt.
/// Scales what counts as small.
double speed_scale(const Scene& scene, std::span<const BodyState> states);

}  // namespace slipcheck
