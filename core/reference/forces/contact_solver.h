#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "physics/frame.h"
#include "reference/solver.h"
#include "scene/contact_scene.h"

namespace slipcheck {

struct ContactSettings {
  double tolerance = 1e-13;  ///< relative, of the integration, in [1e-13, 1e-3]
  double cut_offs = 1;       ///< factor on the fractions of EventSettings
  double start = 0;          ///< time of the initial states [s]
  std::size_t max_events = 1'000'000;
  std::size_t max_steps = 5'000'000;  ///< of the integrator
};

/// Everything in time: contacts of bodies with all their forces, and sliding, rolling, drilling,
/// lift-off and landing on a still, tilted or moving substrate. CVODE integrates between changes of
/// mode (contact begin and end, stick and slip, Coulomb's caps, breaking asperities, …), which are
/// found as roots; no sign function is ever integrated through. Pairs whose contact is hard collide
/// at an instant; others that overlap at the start are in contact from then on.
class ContactSolver final : public LookingSolver {
 public:
  ContactSolver(const ContactScene& scene, std::span<const BodyState> initial,
                const ContactSettings& settings = {});
  ~ContactSolver() override;
  ContactSolver(ContactSolver&&) noexcept;

  /// Shows `sink` the frames before and after each event.
  SolvedRun run(const RunEnd& end, FrameSink* sink) override;
  double first_contact(double limit) override;
  double next_collision(double limit, double slowest) override;
  std::vector<BodyState> states() const override;
  double now() const override;
  std::vector<std::string> features() const override {
    return {"all bodies in one system, integrated from event to event"};
  }
  EnergyBalance balance() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slipcheck
