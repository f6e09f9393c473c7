#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "physics/frame.h"
#include "reference/events/planar_solver.h"
#include "reference/reference_settings.h"
#include "reference/run_end.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// A run of bodies in a box in numbers, whichever solver made it.
struct BoxRun {
  double end_time = 0;  ///< [s]
  bool reached = false;
  std::string reason;          ///< why not
  std::size_t events = 0;      ///< collisions, bounces and cell borders; 0 where contacts last
  std::size_t steps = 0;       ///< of the integrator; 0 where they are instants
  std::size_t collisions = 0;  ///< of two bodies
  std::size_t collapses = 0;   ///< changed by the rule for collapse
  double energy_error = 0;     ///< of the energy balance, relative [-]
  double momentum_error = 0;   ///< of the momentum balance, relative [-]; NaN where none is kept
};

/// The solver that is the truth for a scene in a box, chosen once.
///
/// event: hard contacts, from collision to collision (PlanarSolver).
/// contact: soft contacts resolved in time (SoftBoxSolver).
class BoxSolver {
 public:
  /// `scene` has a box and must outlive the solver. Throws Unsupported where contacts that last are
  /// asked for and some are hard, and for steps of fixed length.
  BoxSolver(const ContactScene& scene, const ReferenceSettings& settings);

  const char* name() const { return resolved_ ? "contact" : "event"; }
  bool is_resolved() const { return resolved_; }  ///< contacts last
  const ContactScene& scene() const { return *scene_; }
  /// What the loop that runs the scene was made for, in a few words each.
  std::vector<std::string> loop() const;

  /// Runs to end.time [s] and shows `sink`, where given, the states at every multiple of
  /// `sample_interval` [s], > 0; `collisions` is then how many pairs have collided.
  BoxRun run(const RunEnd& end, double sample_interval, FrameSink* sink,
             std::uint64_t* collisions = nullptr) const;

  /// All bodies after `time` [s].
  std::vector<BodyState> states_at(double time) const;

 private:
  PlanarSolver planar_solver() const;

  const ContactScene* scene_;
  ReferenceSettings settings_;
  bool resolved_;
};

}  // namespace slipcheck
