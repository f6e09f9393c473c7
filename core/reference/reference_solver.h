#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reference/kept_solver.h"
#include "reference/reference_settings.h"
#include "reference/solver.h"
#include "reference/spring_speeds.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// How finely a run is made; a second run with other numbers tells the uncertainty.
struct SolverAccuracy {
  double tolerance = 1e-13;  ///< of the integrator
  double cut_offs = 1;       ///< factor on what counts as no rebound
  double step = 1;           ///< factor on the step of `steps`
  /// Factor on the collision time, and the least restitution, of hard contacts that last, and on
  /// the collision time of soft ones taken as instants.
  double softness = 1;
  bool reversed = false;    ///< bodies in reverse order: so are collisions at one instant
  bool other_rule = false;  ///< for collapse, where it has a contact time
};

/// The solver that is the truth for a scene, chosen once.
///
/// event: hard contacts, phases from event to event (EventSolver): exact on a level, still
/// substrate, to DrivenPhase's bound for many bodies on others. Few bodies on a tilted or moving
/// substrate have their phases integrated (ContactSolver), as do laws without phases; collisions
/// are instants. In a box, and for many bodies that do nothing but collide: PlanarSolver.
/// contact: soft contacts resolved in time, to a tolerance (ContactSolver, in a box SoftBoxSolver);
/// `automatic` takes it also for hard ones where bodies stay in contact (has_lasting_contacts()).
/// steps: the same in steps of fixed length (StepSolver); for scenes of so many bodies that
/// `contact` would not come to an end, which `automatic` leaves to it.
/// Contacts that remember, surfaces beside the substrate and bodies that rest on others take
/// PileSolver, whichever of the two was asked for, in steps of their own length.
class ReferenceSolver {
 public:
  /// `scene` must outlive the solver. Throws Unsupported.
  ReferenceSolver(const ContactScene& scene, const ReferenceSettings& settings = {});
  ReferenceSolver(const ContactScene& scene, Compare::Reference asked)
      : ReferenceSolver(scene, ReferenceSettings{.asked = asked}) {}

  const char* name() const { return is_stepped() ? "steps" : resolved_ ? "contact" : "event"; }
  bool is_exact() const { return phases_; }       ///< no integrator is needed
  bool is_resolved() const { return resolved_; }  ///< contacts of bodies last
  bool is_stepped() const { return step_ > 0; }
  /// In steps of fixed length with contacts that remember; is_stepped() only where that was asked.
  bool is_piled() const { return piled_; }
  double step() const { return step_; }  ///< of `steps` [s], else 0
  /// ReferenceSettings::threads would have something to share: many bodies in steps.
  bool shares_steps() const;
  const ReferenceSettings& settings() const { return settings_; }
  /// What the loop that runs the scene was made for, in a few words each.
  std::vector<std::string> loop() const;
  /// Contacts that last are taken as instants: `event` was asked for.
  bool hardens() const { return !resolved_ && !scene_->is_hard(); }
  /// Hard contacts are taken as short ones that last (lasting_contacts.h), as bodies stay in
  /// contact: so long is a collision [s], else 0.
  double softened_to() const {
    return resolved_ && (made_.has_value() || piled_) ? collision_time_ : 0;
  }
  /// What is solved.
  const ContactScene& scene() const { return made_ ? *made_ : *scene_; }

  /// By body; empty where nothing is carried by springs. softness: as of SolverAccuracy.
  std::vector<SpringSpeeds> spring_speeds(double softness = 1) const;

  /// Another process can go on with a run: it goes in steps.
  bool keeps_state() const { return is_piled() || is_stepped(); }
  /// keeper: null, or where keeps_state() and the bodies are not reversed what keeps the run on
  /// its way. started: called once the run has the bodies; from then on it does not look at the
  /// scene's `initial`. Throws BadState for what is no state of such a run.
  SolvedRun run(const RunEnd& end, FrameSink* sink, const SolverAccuracy& accuracy = {},
                RunKeeper* keeper = nullptr, const std::function<void()>& started = {}) const;
  /// The time [s] of the first contact of two bodies or landing, or infinity where none comes
  /// before `limit` [s], and in a box.
  double first_contact(double limit, double tolerance = SolverAccuracy{}.tolerance) const;
  /// All bodies at a time before the first contact [s].
  std::vector<BodyState> states_at(double time) const;
  /// All bodies at these times [s], rising and >= 0; `states[k][i]`. Where the integrator gives up
  /// or a cascade of collisions never ends, the times that it did not come to are missing.
  std::vector<std::vector<BodyState>> states_along(
      std::span<const double> times, double tolerance = SolverAccuracy{}.tolerance) const;
  /// When two bodies next meet at `slowest` [m/s] or faster, if they are in `states` at `start`
  /// [s], or, beside surfaces, one comes to a surface; infinity where not before `limit` [s]. Where
  /// that cannot be told, `start`: surfaces that turn, contacts that last.
  double next_collision(std::span<const BodyState> states, double start, double limit,
                        double slowest) const;

 private:
  void choose_in_box();
  void choose_on_plane();
  void choose_piles();
  void harden();
  std::unique_ptr<Solver> at_start(const ContactScene& scene, const SolverAccuracy& accuracy,
                                   const RunEnd& end, bool prepares = true) const;
  std::unique_ptr<LookingSolver> looking(std::span<const BodyState> states, double start,
                                         double tolerance, double slowest = 0) const;
  SolvedRun run_varied(const RunEnd& end, FrameSink* sink, SolverAccuracy accuracy) const;

  const ContactScene* scene_;
  /// In place of the scene: its soft contacts hard, as event was asked for, or its hard ones soft.
  std::optional<ContactScene> made_;
  ReferenceSettings settings_;
  bool resolved_ = false, phases_ = false;
  bool straight_ = false;      ///< so are the phases, of many bodies
  bool piled_ = false;         ///< PileSolver
  double step_ = 0;            ///< [s]
  double collision_time_ = 0;  ///< of hard contacts, where they are taken as lasting [s]
};

/// Whether EventSolver has an exact solution for what bodies do between collisions on one plane.
bool has_exact_phases(const Scene& scene);
/// Whether the scene is run from phase to phase: they are exact, or there are many bodies.
bool runs_in_phases(const Scene& scene);

}  // namespace slipcheck
