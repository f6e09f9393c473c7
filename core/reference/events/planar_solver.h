#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "physics/frame.h"
#include "reference/events/planar_loop.h"
#include "reference/events/planar_world.h"
#include "reference/solver.h"

namespace slipcheck {

struct PlanarSettings {
  /// CollapseRule::Model::slowest_rebound: for pairs, of their bodies' hardest impact so far, and
  /// in a box, as for its walls, floor and lid, where a resting body would else bounce without end,
  /// of the scene's speed.
  double collapse_fraction = 1e-6;
  double landing_fraction = 1e-4;
  /// More events for each body and simulated second [1/s], > 0, than any rule for collapse can
  /// still be said to keep finite: the run stops with a reason.
  double most_events = 1e7;
  /// The loop over events that leaves out nothing, whatever the scene lacks: the same results.
  bool general = false;
};

/// Hard spheres in a plane from event to event (PlanarWorld, EventScheduler): L's vibrated box, or
/// a gas on a plane without friction. The only errors are of rounding.
class PlanarSolver final : public Solver {
 public:
  /// `scene` must outlive the solver; PlanarWorld::is_planar() holds.
  PlanarSolver(const Scene& scene, std::span<const BodyState> initial,
               const PlanarSettings& settings = {});

  /// Runs on from now and shows `sink`, where given, the states now, at every multiple of
  /// end.sample_interval, and at the end. On a plane, where no interval is given, also the frames
  /// before and after each collision, partial ones if it takes them. What moves there never ceases
  /// to: Until::rolling and Until::rest are reached at once or not at all.
  SolvedRun run(const RunEnd& end, FrameSink* sink) override;

  std::vector<BodyState> states() const override;
  double now() const override { return now_; }
  std::vector<std::string> features() const override;
  const PlanarWorld& world() const { return world_; }
  /// What the loop over events leaves out because the scene lacks it, in words; maybe nothing.
  std::vector<std::string> left_out() const;

 private:
  /// A scheduler whose loop knows what its scenes have.
  template <PlanarFeatures kHas>
  struct Loop {
    explicit Loop(PlanarWorld& world) : loop(world), scheduler(loop, 0) {}
    Loop(const Loop&) = delete;  // the scheduler looks at the loop
    Loop& operator=(const Loop&) = delete;

    static constexpr PlanarFeatures kFeatures = kHas;
    PlanarLoop<kHas> loop;
    EventScheduler<PlanarLoop<kHas>> scheduler;
  };
  using General = Loop<PlanarFeatures{}>;
  using OneRadius = Loop<PlanarFeatures{.radii = false}>;
  using Plane = Loop<PlanarFeatures{.box = false, .radii = false}>;
  using SmoothPlane = Loop<PlanarFeatures{.box = false, .radii = false, .spin = false}>;

  template <class Scheduler>
  SolvedRun run(Scheduler& scheduler, const RunEnd& end, FrameSink* sink);
  void choose_loop();
  bool has_ended(Run::Until until) const;

  const Scene* scene_;
  PlanarSettings settings_;
  PlanarWorld world_;
  std::variant<std::monostate, General, OneRadius, Plane, SmoothPlane> loop_;
  double now_ = 0;
  double first_energy_;
  Vector2 first_momentum_;
};

/// The largest speed that bodies bring with them into a planar scene, or that its floor gives
/// them [m/s].
double planar_speed_scale(const Scene& scene, std::span<const BodyState> states);

}  // namespace slipcheck
