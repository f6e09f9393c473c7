#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "physics/frame.h"
#include "reference/events/event_solver.h"
#include "scene/contact_scene.h"

namespace slipcheck {

struct ContactSettings {
  double tolerance = 1e-13;  ///< relative, of the integration, in [1e-13, 1e-3]
  double cut_offs = 1;       ///< factor on the fractions of EventSettings
  double start = 0;          ///< time of the initial states [s]
  std::size_t max_events = 1'000'000;
  std::size_t max_steps = 5'000'000;  ///< of the integrator
};

/// Kinetic and potential energy against what was dissipated and what the substrate's motion did.
struct EnergyBalance {
  double energy = 0;          ///< kinetic, of gravity, and elastic, now [J]
  double initial = 0;         ///< the same at the start [J]
  double dissipated = 0;      ///< by all contacts since then [J]
  double substrate_work = 0;  ///< done on the bodies by the substrate's motion [J]
  double scale = 0;           ///< largest energy that took part, elastic at the start [J]
  /// (energy + dissipated − substrate work − initial)/scale.
  double error() const {
    return scale > 0 ? (energy + dissipated - substrate_work - initial) / scale : 0;
  }
};

struct ContactRun {
  double end_time = 0;         ///< [s]
  bool reached = false;        ///< what RunEnd::until asks for
  bool failed = false;         ///< the integrator gave up
  std::string reason;          ///< why not reached
  std::size_t steps = 0;       ///< of the integrator
  std::size_t events = 0;      ///< changes of mode
  std::size_t collisions = 0;  ///< contacts of two bodies that began
  std::size_t collapses = 0;   ///< hard ones that were slower than the collapse speed
  EnergyBalance balance;
};

/// Everything in time: contacts of bodies with all their forces, and sliding, rolling, drilling,
/// lift-off and landing on a still, tilted or moving substrate. CVODE integrates between changes of
/// mode (contact begin and end, stick and slip, Coulomb's caps, breaking asperities, …), which are
/// found as roots; no sign function is ever integrated through. Pairs whose contact is hard collide
/// at an instant; others that overlap at the start are in contact from then on.
class ContactSolver {
 public:
  ContactSolver(const ContactScene& scene, std::span<const BodyState> initial,
                const ContactSettings& settings = {});
  ~ContactSolver();
  ContactSolver(ContactSolver&&) noexcept;

  /// Runs from the start and shows `sink`, where given, the frames before and after each event.
  ContactRun run(const RunEnd& end, FrameSink* sink);

  /// The time [s] at which the first two bodies touch or one lands, or infinity where that does not
  /// happen before `limit` [s]; the start, where two overlap.
  double first_contact(double limit);
  /// The same for two bodies alone that meet at `slowest` [m/s] or faster.
  double next_collision(double limit, double slowest);

  /// All bodies' states now.
  std::vector<BodyState> states() const;
  double now() const;
  EnergyBalance balance() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slipcheck
