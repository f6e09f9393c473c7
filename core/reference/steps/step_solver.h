#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "physics/frame.h"
#include "reference/kept_solver.h"
#include "scene/contact_scene.h"

namespace slipcheck {

struct StepSettings {
  double step = 0;  ///< h [s], > 0
  /// A landing that would rebound slower than this fraction of the scene's speed does not; nor does
  /// one slower than what gravity adds in a step.
  double landing_fraction = 1e-10;
  /// Takes the loop that leaves out nothing. The results are the same to the last bit but where
  /// GrainLoop adds in another order.
  bool general = false;
  /// More bodies are GrainLoop's, or have their neighbours looked for.
  std::size_t most_in_all_pairs = 24;
  /// That share each step of many bodies; 0: one for each core. The results are the same bits.
  std::size_t threads = 1;
  std::size_t shared_from = 1000;         ///< so many bodies are many
  std::size_t grains_shared_from = 4000;  ///< the same of GrainLoop's, which are done sooner
};

/// Of the threads, those that share the steps of the scene.
std::size_t sharing_threads(const ContactScene& scene, std::span<const BodyState> initial,
                            const StepSettings& settings);

/// The steps are too long for what the bodies do.
class StepTooLong : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The forces of ContactSolver by steps of fixed length h: velocity Verlet, symplectic without
/// dissipation and of second order for smooth motion, collisions from begin to end included (order
/// 3/2 for B (24), whose force begins like √t). An asperity that breaks, and Coulomb's cap where
/// it jumps, leave errors of first order.
///
/// The substrate's friction acts by impulses that may stop the slip within a step but never reverse
/// it, so that a body sticks exactly; when it begins or ends to stick is known to a step.
///
/// The normal and tangential law and whether the substrate is one without friction, a level plane
/// at rest with Coulomb friction or more are chosen once, into a loop that has no trace of what the
/// scene lacks; many bodies on a plane go to GrainLoop. Surfaces are at rest, and their contacts
/// soft.
class StepSolver final : public KeptSolver {
 public:
  /// The scene must outlive the solver. Throws Unsupported where bodies could meet whose contact is
  /// hard, for such a contact with a surface, and for surfaces that move.
  StepSolver(const ContactScene& scene, std::span<const BodyState> initial,
             const StepSettings& settings);
  ~StepSolver() override;
  StepSolver(StepSolver&&) noexcept;

  /// Runs to the first step at or after the end, and shows `sink` a frame a step. A run in which
  /// many bodies move so far in a step that neighbours cannot be told has failed. The run counts
  /// from time 0.
  SolvedRun run(const RunEnd& end, FrameSink* sink) override;

  std::vector<BodyState> states() const override;
  double now() const override;
  /// Kinetic energy and that of gravity and of elastic contacts, now [J].
  double energy() const;
  std::vector<std::string> features() const override;
  void exchange(StateArchive& archive) override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The largest step [s] with which StepSolver integrates the linear contact ξ̈ + γ ξ̇ + ω0² ξ = 0
/// without growth, 2 (√(1 + ε²) − ε)/ω0 with ε = γ/ω0; omega0 [1/s], > 0, gamma [1/s], >= 0.
///
/// With Ω = ω0 h and G = γ h the scheme's modes ξ_n ∝ z^n obey
///   2z (z − 1)² + 2 Ω² z² + G (z − 1)(3z − 1) = 0:
/// the force is a = −ω0² ξ − γ (w + h a'/2), where w = h a/(z − 1) is the velocity half a step
/// before, ξ = h z w/(z − 1), and a' = a/z the acceleration a step before. Jury's conditions hold
/// until z = −1, where Ω² + 4G = 4.
double step_limit(double omega0, double gamma);

}  // namespace slipcheck
